// Other light and other materials for the same surfaces.
#include "radiosity/scene/scenario.h"

#include <gtest/gtest.h>

#include <string>

#include "radiosity/base/error.h"

namespace radiosity {
namespace {

Eigen::VectorXd list_of(std::initializer_list<double> list) {
  Eigen::VectorXd result(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

/// Two lamps of one material, a heater, and a wall.
Scene lit_room() {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  scene.materials = {{"lamp", list_of({0.1}), {Emission::Kind::power, list_of({40})}},
                     {"iron", list_of({0.3}), {Emission::Kind::temperature, list_of({400})}},
                     {"plaster", list_of({0.8}), {}}};
  scene.surfaces = {{"lamp 1", 0}, {"lamp 2", 0}, {"heater", 1}, {"wall", 2}};
  return scene;
}

TEST(Scenario, DimsLuminairesByName) {
  Scene scene = lit_room();
  for (const char* name : {"panel-1-1", "panel-1-2", "panel-2-1"}) {
    Luminaire luminaire;
    luminaire.name = name;
    scene.luminaires.push_back(luminaire);
  }
  const Scene dimmed = scene_of(scene, {"evening", {{"panel-1-*", 0.5}, {"*-2-1", 0}}, {}});
  EXPECT_EQ(dimmed.luminaires[0].dimming, 0.5);
  EXPECT_EQ(dimmed.luminaires[1].dimming, 0.5);
  EXPECT_EQ(dimmed.luminaires[2].dimming, 0);
  EXPECT_EQ(dimmed.surfaces[0].emission_factor, 1);
}

const Material& material_of(const Scene& scene, std::size_t surface) {
  return scene.materials[scene.surfaces[surface].material];
}

std::string refusal(const Scenario& scenario) {
  try {
    (void)scene_of(lit_room(), scenario);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(Scenario, PatternsStandForNames) {
  EXPECT_TRUE(matches("wall", "wall"));
  EXPECT_FALSE(matches("wall", "walls"));
  EXPECT_FALSE(matches("walls", "wall"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("*", "anything"));
  EXPECT_TRUE(matches("lamp ?", "lamp 1"));
  EXPECT_FALSE(matches("lamp ?", "lamp 12"));
  EXPECT_FALSE(matches("lamp ?", "lamp "));
  EXPECT_TRUE(matches("*/lamp*", "hall/lamp/3"));
  EXPECT_TRUE(matches("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(matches("a*b*c", "a-c-b"));
  EXPECT_TRUE(matches("**", "a"));
  EXPECT_FALSE(matches("", "a"));
  EXPECT_TRUE(matches("", ""));
}

TEST(Scenario, DimsSurfacesByThemselves) {
  const Scene scene = scene_of(lit_room(), {"dim", {{"lamp*", 0.5}, {"lamp 2", 0}}, {}});
  EXPECT_EQ(scene.surfaces[0].emission_factor, 0.5);
  EXPECT_EQ(scene.surfaces[1].emission_factor, 0);
  EXPECT_EQ(scene.surfaces[2].emission_factor, 1);
  EXPECT_EQ(material_of(scene, 0).emission.value[0], 40);
}

TEST(Scenario, SwitchesOnWhatIsOffInTheScene) {
  Scene dark = lit_room();
  dark.surfaces[0].emission_factor = 0;
  dark.surfaces[1].emission_factor = 0.3;
  const Scene scene = scene_of(dark, {"lit", {{"lamp 1", 1}}, {}});
  EXPECT_EQ(scene.surfaces[0].emission_factor, 1);
  EXPECT_EQ(scene.surfaces[1].emission_factor, 0.3);
}

TEST(Scenario, PaintsMaterials) {
  const Scene scene =
      scene_of(lit_room(), {"dark", {}, {{"*", list_of({0.2})}, {"plas*", list_of({0})}}});
  EXPECT_EQ(material_of(scene, 0).reflectance, list_of({0.2}));
  EXPECT_EQ(material_of(scene, 2).reflectance, list_of({0.2}));
  EXPECT_EQ(material_of(scene, 3).reflectance, list_of({0}));
  EXPECT_EQ(material_of(scene, 0).emission.value[0], 40);
}

TEST(Scenario, NamesThatStandForNothingAreErrors) {
  EXPECT_EQ(refusal({"a", {{"*", 0}}, {}}), "");
  EXPECT_NE(refusal({"a", {{"window", 1}}, {}}).find("no surface 'window' that emits"),
            std::string::npos);
  EXPECT_NE(refusal({"a", {{"wall", 1}}, {}}).find("that emits"), std::string::npos);
  EXPECT_NE(refusal({"b", {}, {{"wood", list_of({1})}}}).find("scenario 'b'"), std::string::npos);
  EXPECT_NE(refusal({"b", {}, {{"iron", list_of({1, 0})}}}).find("expected 1"), std::string::npos);
}

TEST(Scenario, SwitchesWhatOnlyBacksEmit) {
  Scene scene = lit_room();
  scene.surfaces[3].two_sided = true;
  scene.surfaces[3].back_material = 1;
  EXPECT_EQ(scene_of(scene, {"off", {{"wall", 0}}, {}}).surfaces[3].emission_factor, 0);
}

// Of emissivity 0 no heat is given off: iron at 400 K, or of a given heat, but not at 0 K and not
// what emits light.
TEST(Scenario, DoesNotTakeTheEmissivityOfHeat) {
  const Scenario white{"white", {}, {{"*", list_of({1})}}};
  EXPECT_NE(refusal(white).find("the reflectance 1 of 'iron'"), std::string::npos)
      << refusal(white);
  for (const Emission::Kind kind : {Emission::Kind::heat_flux, Emission::Kind::heat_power}) {
    Scene scene = lit_room();
    scene.materials[1].emission = {kind, list_of({-3})};
    EXPECT_THROW((void)scene_of(scene, white), SceneError);
    scene.materials[1].emission.value[0] = 0;
    EXPECT_EQ(scene_of(scene, white).materials[1].reflectance, list_of({1}));
  }
}

}  // namespace
}  // namespace radiosity
