// Meshes of Gmsh.

#include <cmath>
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

TEST_F(MshReader, ReadsBinaryFilesOfBothVersionsAndOrders) {
  const Scene expected = read("a.msh", kMsh2);
  for (const int version : {2, 4}) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      const Scene scene = read("a.msh", binary_msh(version, order));
      SCOPED_TRACE(version);
      EXPECT_EQ(scene.vertices, expected.vertices);
      EXPECT_EQ(scene.corners, expected.corners);
      EXPECT_EQ(scene.polygon_surface, expected.polygon_surface);
      ASSERT_EQ(scene.surfaces.size(), 2U);
      EXPECT_EQ(scene.surfaces[0].name, "hot wall");
      EXPECT_EQ(scene.surfaces[1].name, "surface 8");
    }
  }
}

TEST_F(MshReader, ReadsParametricNodesOfTheOldVersion) {
  std::string text = kMsh2;
  for (auto at = text.find("Nodes"); at != std::string::npos; at = text.find("Nodes", at + 11)) {
    text.replace(at, 5, "ParametricNodes");
  }
  text.replace(text.find("1 0 0 0\n"), 8, "1 0 0 0 2 5 0.25 0.75\n");
  EXPECT_EQ(read("a.msh", text).n_polygons(), 3);
  std::string binary =
      "$MeshFormat\n2.2 1 8\n" + bytes(1) + "\n$EndMeshFormat\n$ParametricNodes\n4\n";
  for (int k = 0; k < 4; ++k) {
    binary += bytes(k + 1) + bytes(k == 1 ? 1. : 0.) + bytes(k == 2 ? 1. : 0.) + bytes(0.);
    binary += bytes(k) + bytes(4);  // on a point, a curve, a surface, in a volume
    for (int parameter = 0; parameter < k % 3; ++parameter) binary += bytes(0.5);
  }
  binary += "\n$EndParametricNodes\n$Elements\n1\n" + bytes(2) + bytes(1) + bytes(0) + bytes(1) +
            bytes(1) + bytes(2) + bytes(3) + "\n$EndElements\n";
  const Scene scene = read("a.msh", binary);
  ASSERT_EQ(scene.n_polygons(), 1);
  EXPECT_EQ(scene.vertices[scene.polygon(0)[2]], Vec3(0, 1, 0));
}

TEST_F(MshReader, SkipsBinarySectionsThatItDoesNotKnow) {
  std::string content = binary_msh(4, std::endian::little);
  content.insert(content.find("$Nodes"),
                 std::string("$Other\n\0\n$\n\xff$EndOther\n\n$EndOther\n", 33));
  EXPECT_EQ(read("a.msh", content).n_polygons(), 3);
}

TEST_F(MshReader, RefusesBinaryFilesThatAreCutOff) {
  for (const int version : {2, 4}) {
    const std::string content = binary_msh(version, std::endian::little);
    // Wherever it ends, up to the line behind the last section.
    for (std::size_t n = 1; n + 1 < content.size(); n += 3) {
      EXPECT_CONTAINS(error_of(file("a.msh", content.substr(0, n))), "a.msh");
    }
  }
}

TEST_F(MshReader, ExplainsBadBinaryFiles) {
  const std::string old = binary_msh(2, std::endian::little);
  const std::string present = binary_msh(4, std::endian::little);
  const auto error = [&](std::string content, const std::string& part, const std::string& other) {
    content.replace(content.find(part), part.size(), other);
    return error_of(file("a.msh", content));
  };
  EXPECT_CONTAINS(error(old, bytes(1), bytes(2)), "$MeshFormat, byte 24: is in no known order");
  EXPECT_CONTAINS(error(old, "1 8", "1 4"), "a.msh:2: has numbers of 4 bytes, expected 8");
  EXPECT_CONTAINS(error(old, "$Nodes\n10", "$Nodes\n99"),
                  "$Nodes: found 99 as the number of nodes");
  EXPECT_CONTAINS(error(old, bytes(22) + bytes(23), bytes(22) + bytes(24)), "node 24 is not there");
  EXPECT_CONTAINS(error(old, bytes(15) + bytes(1), bytes(15) + bytes(6)),
                  "found 6 elements of type 15, expected 1 to 5");
  EXPECT_CONTAINS(error(old, bytes(15) + bytes(1), bytes(35) + bytes(1)),
                  "has cells of type 35, which is not known");
  EXPECT_CONTAINS(error(old, bytes(2.0), bytes(std::nan(""))), "coordinate z is not finite");
  const std::string seven = bytes(5) + bytes(1) + bytes(std::int64_t{7});
  EXPECT_CONTAINS(error(present, seven, bytes(5) + bytes(1) + bytes(std::int64_t{1} << 60)),
                  "found 1152921504606846976 as a number of nodes, but ");
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
      {"$MeshFormat\n2.2 1 8\n", "file ends where the number 1 should stand"},
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
