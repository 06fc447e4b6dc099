// Meshes of VTK XML.

#include <string>

#include "io/result/result_file.h"
#include "tests/support/sample_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::Scene;
using radiosity::Vec3;

class VtkMeshReader : public ScratchFiles {
 protected:
  /// The message for the grid with a part replaced.
  [[nodiscard]] std::string error_with(const std::string& part, const std::string& other) const {
    std::string content = kVtu;
    content.replace(content.find(part), part.size(), other);
    return error_of(file("a.vtu", content));
  }
};

const std::string kVtp = R"(<VTKFile type="PolyData" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="5" NumberOfVerts="0" NumberOfLines="1" NumberOfStrips="0" NumberOfPolys="2">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0 0 0 1</DataArray></Points>
<Lines><DataArray type="Int32" Name="connectivity" format="ascii">0 1</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">2</DataArray></Lines>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 0 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 7</DataArray></Polys>
<CellData><DataArray type="Int32" Name="surface" format="ascii">7 1 2</DataArray></CellData>
</Piece></PolyData></VTKFile>)";

TEST_F(VtkMeshReader, ReadsPolygonsOfGrids) {
  const Scene scene = read("a.vtu", kVtu);
  ASSERT_EQ(scene.n_polygons(), 3);
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].name, "surface 3");
  EXPECT_EQ(scene.surfaces[1].name, "surface 8");
  EXPECT_EQ(scene.polygon_surface, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(scene.polygon(1).size(), 4U);
  EXPECT_EQ(scene.vertices[scene.polygon(2)[0]], Vec3(0, 0, 2));
  EXPECT_CONTAINS(scene.warnings.back(), "cell 1 is of type 3; only polygons are read");
}

TEST_F(VtkMeshReader, TakesTheCornersOfHigherOrdersAndPassesBitsAndTextsOver) {
  std::string content = kVtu;
  content.replace(content.find("5 3 9 5"), 7, "69 68 70 76");
  content.insert(content.find("<CellData>") + 10,
                 R"(<DataArray type="Bit" Name="flags" format="ascii">1 0 1 1</DataArray>
<Array type="String" Name="texts" format="ascii">97 98 0 0 99 0 100 0</Array>)");
  const Scene scene = read("a.vtu", content);
  ASSERT_EQ(scene.n_polygons(), 3);
  EXPECT_EQ(scene.polygon(1).size(), 4U);
}

TEST_F(VtkMeshReader, ReadsPolyDataWithValuesOfLinesBefore) {
  const Scene scene = read("a.vtp", kVtp);
  ASSERT_EQ(scene.n_polygons(), 2);
  ASSERT_EQ(scene.surfaces.size(), 2U);
  EXPECT_EQ(scene.surfaces[0].name, "surface 1");
  EXPECT_EQ(scene.surfaces[1].name, "surface 2");
}

/// The grid with values of its cells, "name type columns" with these numbers.
std::string grid_with(const std::vector<std::pair<std::string, std::string>>& arrays) {
  std::string content = kVtu;
  for (const auto& [head, numbers] : arrays) {
    const std::size_t blank = head.find(' ');
    content.insert(content.find("<CellData>") + 10,
                   "<DataArray type=\"Float64\" Name=\"" + head.substr(0, blank) +
                       "\" NumberOfComponents=\"" + head.substr(blank + 1) +
                       "\" format=\"ascii\">" + numbers + "</DataArray>");
  }
  return content;
}

TEST_F(VtkMeshReader, TakesMaterialsFromCells) {
  const Scene scene =
      read("a.vtu", grid_with({{"reflectance 3", "0.5 0.25 0 0 0 0 0.5 0.25 0 0.75 0.75 0.75"},
                               {"radiance 1", "0 0 2 0"}}));
  EXPECT_EQ(scene.bands.kind, radiosity::Bands::Kind::rgb);
  ASSERT_EQ(scene.surfaces.size(), 3U);
  EXPECT_EQ(scene.surfaces[0].name, "surface 3");
  EXPECT_EQ(scene.surfaces[1].name, "surface 3:material 2");
  EXPECT_EQ(scene.surfaces[2].name, "surface 8");
  const auto material = [&](int s) { return scene.materials[scene.surfaces[s].material]; };
  EXPECT_EQ(material(0).reflectance, Eigen::Vector3d(0.5, 0.25, 0));
  EXPECT_EQ(material(0).emission.kind, radiosity::Emission::Kind::none);
  EXPECT_EQ(material(1).reflectance, material(0).reflectance);
  EXPECT_EQ(material(1).emission.kind, radiosity::Emission::Kind::radiance);
  EXPECT_EQ(material(1).emission.value, Eigen::Vector3d(2, 2, 2));
  EXPECT_EQ(material(2).reflectance, Eigen::Vector3d(0.75, 0.75, 0.75));
}

TEST_F(VtkMeshReader, TakesTemperaturesWithEmissivities) {
  const Scene scene =
      read("a.vtu",
           grid_with({{"emissivity 1", "0.75 1 0.75 0.5"}, {"temperature 1", "300 0 300 400"}}));
  EXPECT_EQ(scene.bands.kind, radiosity::Bands::Kind::grey);
  ASSERT_EQ(scene.surfaces.size(), 2U);
  const auto& wall = scene.materials[scene.surfaces[0].material];
  EXPECT_EQ(wall.reflectance[0], 0.25);
  EXPECT_EQ(wall.emission.kind, radiosity::Emission::Kind::temperature);
  EXPECT_EQ(wall.emission.value[0], 300);
  // As those of a scene, for a grey one; for others only without temperatures.
  const std::string mesh = R"({"bands": "rgb", "surfaces": [{"name": "a", "mesh": "a.vtu"}]})";
  EXPECT_CONTAINS(error_of("a.json", mesh), "have 1 bands (grey), the scene has 3 (RGB)");
  (void)file("a.vtu", grid_with({{"emissivity 1", "0.75 1 0.75 0.5"}}));
  const Scene in_color = read("b.json", mesh);
  EXPECT_EQ(in_color.materials[0].reflectance, Eigen::Vector3d(0.25, 0.25, 0.25));
}

TEST_F(VtkMeshReader, ExplainsBadMaterials) {
  const auto error = [&](const std::vector<std::pair<std::string, std::string>>& arrays) {
    return error_of(file("a.vtu", grid_with(arrays)));
  };
  EXPECT_CONTAINS(error({{"reflectance 1", "0 0 1.5 0"}}), "cell 2: reflectance 1.5 is outside");
  EXPECT_CONTAINS(error({{"emissivity 1", "1 1 1 1"}, {"temperature 1", "1 1 nan 1"}}),
                  "cell 2: temperature is nan");
  EXPECT_CONTAINS(error({{"reflectance 2", "0 0 0 0 0 0 0 0"}}), "2 columns, expected 1, or 3");
  EXPECT_CONTAINS(error({{"emissivity 1", "1 1 1 1"}, {"reflectance 1", "0 0 0 0"}}),
                  "has both \"reflectance\" and \"emissivity\"");
  EXPECT_CONTAINS(
      error(
          {{"reflectance 1", "0 0 0 0"}, {"exitance 1", "1 1 1 1"}, {"temperature 1", "1 1 1 1"}}),
      "has both \"exitance\" and \"temperature\"");
  const Scene scene = read("a.vtu", grid_with({{"temperature 1", "1 1 1 1"}}));
  EXPECT_CONTAINS(scene.warnings.front(), "has \"temperature\", but neither \"reflectance\"");
}

TEST_F(VtkMeshReader, ReadsWhatIsWrittenAsAResult) {
  radiosity::PatchMesh mesh;
  mesh.surface_names = {"floor", "east wall"};
  mesh.surface_two_sided = {false, false};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  mesh.add_patch({0, 1, 2, 3}, 0, 0);
  mesh.add_patch({1, 4, 5, 2}, 1, 1);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(2, 1);
  radiosity::Solution solution;
  solution.radiosity = solution.irradiance = solution.exitance = ones;
  solution.reflectance = solution.radiosity_error = ones;
  io::write(folder() / "a.vtp", mesh, solution);
  const Scene scene = io::read_scene(folder() / "a.vtp");
  ASSERT_EQ(scene.n_polygons(), 2);
  EXPECT_EQ(scene.surfaces[1].name, "east wall");
  EXPECT_EQ(scene.vertices[scene.polygon(1)[2]], Vec3(1, 1, 1));
  EXPECT_EQ(scene.materials[scene.surfaces[1].material].reflectance, Eigen::VectorXd::Ones(1));
  EXPECT_EQ(scene.materials[scene.surfaces[1].material].emission.value, Eigen::VectorXd::Ones(1));
}

// Bands of heat stay what they are, also three of them, which are no colours.
TEST_F(VtkMeshReader, ReadsResultsInBandsOfHeat) {
  using radiosity::Bands;
  radiosity::PatchMesh mesh;
  mesh.surface_names = {"plate"};
  mesh.surface_two_sided = {false};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_patch({0, 1, 2, 3}, 0, 0);
  for (const Bands& bands :
       {Bands{Bands::Kind::thermal, {}, {4, 8}}, Bands{Bands::Kind::thermal, {}, {5}},
        Bands{Bands::Kind::solar_infrared, {}, {}},
        Bands{Bands::Kind::solar_infrared, {}, {2.5}}}) {
    const Eigen::MatrixXd values = Eigen::RowVectorXd::LinSpaced(bands.count(), 0.1, 0.7);
    radiosity::Solution solution;
    solution.radiosity = solution.irradiance = solution.exitance = values;
    solution.reflectance = solution.radiosity_error = values;
    io::write(folder() / "a.vtp", mesh, solution, {.bands = bands});
    const Scene scene = io::read_scene(folder() / "a.vtp");
    EXPECT_EQ(scene.bands.kind, bands.kind);
    EXPECT_EQ(scene.bands.edges, bands.edges);
    EXPECT_EQ(scene.materials[scene.surfaces[0].material].reflectance, values.transpose());
  }
}

TEST_F(VtkMeshReader, ExplainsBadFiles) {
  EXPECT_CONTAINS(error_with("0 1 2 0 1 3 4 5 6 7 8 9", "0 1 2 0 1 3 4 5 6 7 8 10"),
                  "cell 3 uses point 10, but there are 10");
  EXPECT_CONTAINS(error_with("3 5 9 12", "3 5 4 12"), "cell 2 ends where it cannot");
  EXPECT_CONTAINS(error_with("3 5 9 12", "3 5 9 13"), "cell 3 ends where it cannot");
  EXPECT_CONTAINS(error_with("3 5 9 12", "3 5 9"), "are not as they should be");
  EXPECT_CONTAINS(error_with("Name=\"types\"", "Name=\"kinds\""), "types of its cells");
  EXPECT_CONTAINS(error_with("5 3 9 5", "10 3 12 3"), "has no polygons");
  EXPECT_CONTAINS(error_with("<VTKFile type=\"UnstructuredGrid\"", "<VTKFile type=\"ImageData\""),
                  "another kind");
  EXPECT_CONTAINS(error_of(file("a.vtu", "solid")), "a.vtu");
}

}  // namespace
