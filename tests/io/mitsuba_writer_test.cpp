#include "io/scene/mitsuba_writer.h"

#include <string>

#include "meshing/patches/patches.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::PatchMesh;
using radiosity::Scene;

class MitsubaWriter : public ScratchFiles {
 protected:
  /// What is written of a floor and a sheet above it, whose material is this.
  [[nodiscard]] std::string written(const std::string& members, const std::string& sheet) const {
    const Scene scene = read("a.json", "{" + members + R"(
      "materials": {"floor": {"reflectance": 0.5}, "sheet": )" +
                                           sheet +
                                           R"(},
      "surfaces": [
        {"name": "a \"floor\" & <more>", "material": "floor",
         "polygons": [[[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 2, 0], [0, 1, 0]]]},
        {"name": "sheet", "material": "sheet", "two_sided": true,
         "polygons": [[[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]]}]})");
    const PatchMesh mesh = meshing::make_patches(scene);
    radiosity::Camera camera;
    io::write_mitsuba(folder() / "b.xml", scene, mesh, camera, {.samples = 7});
    std::ifstream stream(folder() / "b.xml");
    return {std::istreambuf_iterator<char>(stream), {}};
  }
};

TEST_F(MitsubaWriter, WritesAMeshForEachSurface) {
  const std::string xml = written("", R"({"reflectance": [0.25, 0.5, 1]})");
  EXPECT_CONTAINS(xml, "id=\"surface-0-a__floor_____more_\"");
  EXPECT_CONTAINS(xml, "name=\"spp\" value=\"7\"");
  EXPECT_CONTAINS(xml,
                  "<bsdf type=\"twosided\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                  "value=\"0.25, 0.5, 1\"/></bsdf></bsdf>");
  EXPECT_EQ(xml.find("emitter"), std::string::npos);
  // Of the sheet only the front; both keep their way round.
  const PatchMesh floor = meshing::make_patches(io::read_scene(folder() / "b.0.ply"));
  const PatchMesh sheet = meshing::make_patches(io::read_scene(folder() / "b.1.ply"));
  double area = 0;
  for (const double each : floor.area) area += each;
  EXPECT_DOUBLE_EQ(area, 3);
  for (const auto& normal : floor.normal) EXPECT_EQ(normal, radiosity::Vec3::UnitZ());
  ASSERT_EQ(sheet.size(), 2);
  EXPECT_DOUBLE_EQ(sheet.area[0] + sheet.area[1], 1);
}

TEST_F(MitsubaWriter, WritesSpectraOverWavelengths) {
  const std::string xml = written(R"("bands": [450, 600],)", R"({"reflectance": [0.25, 0.5]})");
  EXPECT_CONTAINS(xml, "<spectrum name=\"reflectance\" value=\"450:0.25, 600:0.5\"/>");
}

TEST_F(MitsubaWriter, WritesTheEnvironment) {
  const std::string xml =
      written(R"("environment": {"radiance": [1, 2, 0.5]},)", R"({"reflectance": 0.5})");
  EXPECT_CONTAINS(
      xml, "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1, 2, 0.5\"/></emitter>");
}

TEST_F(MitsubaWriter, RefusesHeats) {
  try {
    (void)written(R"("bands": "grey",)", R"({"reflectance": 0.5, "adiabatic": true})");
    FAIL();
  } catch (const radiosity::SceneError& error) {
    EXPECT_CONTAINS(error.what(), "surface \"sheet\" has a heat given");
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "b.xml"));
}

TEST_F(MitsubaWriter, RefusesLightsOfTwoSides) {
  try {
    (void)written("", R"({"reflectance": 0, "radiance": 1})");
    FAIL();
  } catch (const radiosity::SceneError& error) {
    EXPECT_CONTAINS(error.what(), "surface \"sheet\" emits to both sides");
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "b.xml"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "b.0.ply"));
}

}  // namespace
