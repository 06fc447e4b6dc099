// Meshes of Gmsh.

#include <string>

#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Scene;
using radiosity::Vec3;

class MshReader : public ScratchFiles {};

const std::string kNodes2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n7 1 1 0\n4 0 1 "
    "0\n$EndNodes\n";

TEST_F(MshReader, ReadsBothVersions) {
  for (const std::string& content : {kMsh2, kMsh41}) {
    const Scene scene = read("a.msh", content);
    SCOPED_TRACE(content.substr(0, 20));
    ASSERT_EQ(scene.n_polygons(), 3);
    ASSERT_EQ(scene.surfaces.size(), 2U);
    EXPECT_EQ(scene.surfaces[0].name, "hot wall");
    EXPECT_EQ(scene.surfaces[1].name, "surface 8");
    EXPECT_EQ(scene.polygon_surface, (std::vector<std::int32_t>{0, 0, 1}));
    EXPECT_EQ(scene.polygon(1).size(), 4U);
    EXPECT_EQ(scene.vertices[scene.polygon(0)[2]], Vec3(1, 1, 0));
    EXPECT_EQ(scene.vertices[scene.polygon(2)[0]], Vec3(0, 0, 2));
  }
}

TEST_F(MshReader, TakesTheCornersOfHigherOrders) {
  const std::string content = kNodes2 + "$Elements\n1\n1 9 2 0 3 1 2 7 4 4 4\n$EndElements\n";
  const Scene scene = read("a.msh", content);
  ASSERT_EQ(scene.n_polygons(), 1);
  EXPECT_EQ(scene.polygon(0).size(), 3U);
}

TEST_F(MshReader, TurnsWhatItsGroupTurns) {
  std::string content = kMsh41;
  const std::string group = "5 0 0 0 1 1 0 1 3 0";
  content.replace(content.find(group), group.size(), "5 0 0 0 1 1 0 1 -3 0");
  const Scene straight = read("a.msh", kMsh41);
  const Scene turned = read("b.msh", content);
  EXPECT_EQ(turned.surfaces[0].name, "hot wall");
  EXPECT_EQ(turned.polygon(0)[0], straight.polygon(0)[2]);
  EXPECT_EQ(turned.polygon(0)[2], straight.polygon(0)[0]);
}

TEST_F(MshReader, SkipsSectionsThatItDoesNotKnow) {
  std::string content = kMsh2;
  content.insert(content.find("$Nodes"), "$Comments\nmade by hand\n$EndComments\n");
  EXPECT_EQ(read("a.msh", content).n_polygons(), 3);
}

TEST_F(MshReader, ExplainsBadFiles) {
  struct Bad {
    std::string content;
    std::string message;
  };
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::vector<Bad> bad = {
      {"v 0 0 0\n", "a.msh:1: expected $ and the name of a section"},
      {"$Nodes\n0\n$EndNodes\n", "is no mesh of Gmsh"},
      {"$MeshFormat\n2.2 1 8\n", "a.msh:2: is binary, expected text"},
      {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", "has version 4, expected 2 or 4.1"},
      {"$MeshFormat\n2.2 0 8\n", "file ends in $MeshFormat"},
      {head, "a.msh: has no polygons"},
      {head + "$Nodes\n2\n1 0 0 0\n", "file ends in $Nodes"},
      {head + "$Nodes\n-1\n", "found -1 as the number of nodes"},
      {head + "$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n", "a.msh:7: node 1 stands twice"},
      {head + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "coordinate y is not finite"},
      {head + "$Elements\n", "has elements before its nodes"},
      {kNodes2 + "$Elements\n1\n1 2 2 0 3 1 2 9\n$EndElements\n", "node 9 is not there"},
      {kNodes2 + "$Elements\n1\n1 4 2 0 3 1 2 7 4\n$EndElements\n",
       "has no triangles or quads, but 1 other cells"},
      {kNodes2 + "$Elements\n99999999999\n1 2 2 0 3 1 2 7\n", "file ends in $Elements"},
  };
  for (const auto& [content, message] : bad) {
    EXPECT_CONTAINS(error_of(file("a.msh", content)), message);
  }
}

}  // namespace
