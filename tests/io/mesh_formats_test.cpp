// The same mesh in every format.

#include <string>

#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Scene;

class MeshFormats : public ScratchFiles {};

TEST_F(MeshFormats, AllGiveTheSameMesh) {
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0 0 2\nv 0 1 2\nv 1 1 2\n"
      "o a\nf 1 2 3\nf 4 5 6 7\no b\nf 8 9 10\n";
  const Scene expected = read("a.obj", obj);
  const auto expect_same = [&](const Scene& scene, const char* what) {
    SCOPED_TRACE(what);
    EXPECT_EQ(scene.vertices, expected.vertices);
    EXPECT_EQ(scene.corners, expected.corners);
    EXPECT_EQ(scene.first_corner, expected.first_corner);
    EXPECT_EQ(scene.polygon_surface, expected.polygon_surface);
    EXPECT_EQ(scene.precision, expected.precision);
  };
  expect_same(read("a.msh", kMsh2), "msh 2");
  expect_same(read("a.msh", kMsh41), "msh 4.1");
  expect_same(read("a.msh", binary_msh(2, std::endian::big)), "msh 2, binary");
  expect_same(read("a.msh", binary_msh(4, std::endian::little)), "msh 4.1, binary");
  expect_same(read("a.vtu", kVtu), "vtu");
  expect_same(read("a.vtk", legacy_vtk(4, VtkValues::text)), "vtk 4.2");
  expect_same(read("a.vtk", legacy_vtk(5, VtkValues::binary)), "vtk 5.1, binary");
  std::string vtp = kVtu.substr(0, kVtu.find("<VTKFile"));
  vtp +=
      R"(<VTKFile type="PolyData" byte_order="LittleEndian"><PolyData><Piece NumberOfPoints="10" NumberOfPolys="3">)";
  const std::size_t points = kVtu.find("<Points>");
  vtp += kVtu.substr(points, kVtu.find("<Cells>") - points) +
         R"(<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7 8 9
</DataArray><DataArray type="Int64" Name="offsets" format="ascii">3 7 10</DataArray></Polys>
<CellData><DataArray type="Int32" Name="surface" format="ascii">3 3 8</DataArray></CellData>
</Piece></PolyData></VTKFile>)";
  expect_same(read("a.vtp", vtp), "vtp");
}

}  // namespace
