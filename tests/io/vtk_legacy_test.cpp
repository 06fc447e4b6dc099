// Meshes of legacy VTK files.

#include <string>

#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Scene;
using radiosity::Vec3;

const std::string kPolyData =
    "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
    "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1\nLINES 1 3\n2 0 1\nPOLYGONS 2 9\n4 0 1 2 3\n3 0 3 4\n"
    "CELL_DATA 3\nSCALARS surface int\nLOOKUP_TABLE colours\n7 1 2\n"
    "LOOKUP_TABLE colours 2\n0 0 0 1\n1 1 1 1\nNORMALS n float\n0 0 1 0 0 1 0 0 1\n"
    "SCALARS flags bit 1\nLOOKUP_TABLE default\n1 0 1\n";

class VtkLegacy : public ScratchFiles {
 protected:
  /// The message for the file with a part replaced.
  [[nodiscard]] std::string error_with(const std::string& part, const std::string& other) const {
    std::string content = kPolyData;
    content.replace(content.find(part), part.size(), other);
    return error_of(file("a.vtk", content));
  }
};

TEST_F(VtkLegacy, ReadsWhatTheSameGridInXmlHolds) {
  const Scene expected = read("a.vtu", kVtu);
  for (const int version : {4, 5}) {
    for (const VtkValues kind : {VtkValues::text, VtkValues::binary}) {
      SCOPED_TRACE(version);
      const Scene scene = read("a.vtk", legacy_vtk(version, kind));
      EXPECT_EQ(scene.vertices, expected.vertices);
      EXPECT_EQ(scene.corners, expected.corners);
      EXPECT_EQ(scene.first_corner, expected.first_corner);
      EXPECT_EQ(scene.polygon_surface, expected.polygon_surface);
      ASSERT_EQ(scene.surfaces.size(), 2U);
      EXPECT_EQ(scene.surfaces[0].name, "surface 3");
      EXPECT_EQ(scene.surfaces[1].name, "surface 8");
      EXPECT_EQ(scene.warnings.size(), expected.warnings.size());
    }
  }
}

TEST_F(VtkLegacy, ReadsPolyDataWithValuesOfLinesBefore) {
  const Scene scene = read("a.vtk", kPolyData);
  ASSERT_EQ(scene.n_polygons(), 2);
  EXPECT_EQ(scene.surfaces[0].name, "surface 1");
  EXPECT_EQ(scene.surfaces[1].name, "surface 2");
  EXPECT_EQ(scene.vertices[scene.polygon(1)[2]], Vec3(0, 0, 1));
}

TEST_F(VtkLegacy, TakesNamesOfSurfacesFromFields) {
  std::string content = kPolyData;
  content.insert(content.find("POINTS"),
                 "FIELD FieldData 1\nsurface_names 1 3 string\nroof\neast%20wall\nfloor\n");
  const Scene scene = read("a.vtk", content);
  EXPECT_EQ(scene.surfaces[0].name, "east wall");
  EXPECT_EQ(scene.surfaces[1].name, "floor");
}

TEST_F(VtkLegacy, ExplainsBadFiles) {
  EXPECT_CONTAINS(error_of(file("a.vtk", "solid")), "is no legacy VTK file");
  EXPECT_CONTAINS(error_with("3.0", "9.0"), "a.vtk:2: has an unknown version");
  EXPECT_CONTAINS(error_with("ASCII", "TEXT"), "expected ASCII or BINARY, found \"text\"");
  EXPECT_CONTAINS(error_with("POLYDATA", "STRUCTURED_GRID"), "expected POLYDATA or UNSTR");
  EXPECT_CONTAINS(error_with("1 0 0", "1 x 0"), "a.vtk:6: expected a float in the points");
  EXPECT_CONTAINS(error_with("5 float", "5 bit"), "expected a type of numbers, found \"bit\"");
  EXPECT_CONTAINS(error_with("5 float", "-5 float"), "expected the number of points");
  EXPECT_CONTAINS(error_with("5 float", "5 quad"), "expected a type of numbers, found \"quad\"");
  EXPECT_CONTAINS(error_with("2 9", "2 8"), "cell 1 does not fit into the 8 numbers");
  EXPECT_CONTAINS(error_with("POLYGONS 2 9", "POLYGONS 1 9"), "take 5 numbers, but there are 9");
  EXPECT_CONTAINS(error_with("3 0 3 4", "3 0 3 5"), "cell 1 uses point 5, but there are 5");
  EXPECT_CONTAINS(error_with("CELL_DATA 3", "CELL_DATA 2"), "has values of 2 cells, but 3 cells");
  EXPECT_CONTAINS(error_with("NORMALS n", "NORMALS surface"), "\"surface\" is there twice");
  EXPECT_CONTAINS(error_with("NORMALS", "NORMAL"), "found \"normal\", expected a keyword");
  EXPECT_CONTAINS(error_with("1 0 1\n", "1 0\n"), "ends where the values \"flags\" should");
}

TEST_F(VtkLegacy, RefusesBinaryFilesThatAreCutOff) {
  const std::string content = legacy_vtk(5, VtkValues::binary);
  const std::string head = content.substr(0, content.find("CONNECTIVITY") + 40);
  EXPECT_CONTAINS(error_of(file("a.vtk", head)), "file ends in the cells of cells: ");
  std::string huge = content;
  huge.replace(huge.find("POINTS 10"), 9, "POINTS 2000000000");
  EXPECT_CONTAINS(error_of(file("a.vtk", huge)), "file ends in the points: ");
}

}  // namespace
