// The exchange network of a thermal scene, as the window tells it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/exchange_network.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/couplings.h"
#include "viewer/desk/desk.h"

namespace radiosity::test {
namespace {

void find_network(viewer::Desk& desk, const std::string& path) {
  open(desk.session, path);
  viewer::update(desk);
  desk.network.set_wanted(true);
  wait_until(desk.session, [&] {
    viewer::update(desk);
    return desk.session.is_idle() && desk.network.network() != nullptr;
  });
}

std::vector<viewer::Coupling> couplings_of(const viewer::Desk& desk, std::int32_t surface) {
  return viewer::couplings(desk.network.network(), desk.session.model().mesh->surface_names,
                           surface);
}

/// Of the surface of that name.
std::int32_t surface_of(const viewer::Desk& desk, const std::string& name) {
  const auto& names = desk.session.model().mesh->surface_names;
  return static_cast<std::int32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// What surfaces lose by their couplings is what they lose by their light: Σ_t σ GR_st (T_s⁴ -
// T_t⁴).
TEST(Couplings, CarryTheHeatThatTheLightTells) {
  viewer::Desk desk(coarse());
  find_network(desk, kThermal);
  const auto& mesh = *desk.session.model().mesh;
  const Scene& scene = *desk.session.model().scene;
  const auto temperature = [&](std::int32_t surface) {
    return scene.materials[scene.surfaces[surface].material].emission.value[0];
  };
  double largest = 0;
  for (const SurfaceFlux& flux : desk.fluxes) largest = std::max(largest, std::abs(flux.heat));
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(mesh.surface_names.size()); ++s) {
    double heat = 0;
    double shares = 0;
    double last = 1e300;
    const auto all = couplings_of(desk, s);
    for (const viewer::Coupling& coupling : all) {
      EXPECT_LE(coupling.area, last);  // the largest first
      last = coupling.area;
      shares += coupling.gebhart;
      const bool is_surface = coupling.name != "space" && coupling.name != "backs";
      const double t = is_surface ? temperature(surface_of(desk, coupling.name)) : 0;
      heat += kStefanBoltzmann * coupling.area * (std::pow(temperature(s), 4) - std::pow(t, 4));
    }
    // What emits nothing is coupled to nothing.
    EXPECT_NEAR(shares, all.empty() ? 0 : 1, 1e-5);
    EXPECT_NEAR(heat, desk.fluxes[s].heat, 1e-5 * largest) << mesh.surface_names[s];
  }
}

TEST(Couplings, FollowThePaintAndTellWhatIsUnderTheMouse) {
  viewer::Desk desk(coarse());
  find_network(desk, kThermal);
  const std::int32_t radiator = surface_of(desk, "radiator");
  const auto before = couplings_of(desk, radiator);
  ASSERT_FALSE(before.empty());
  EXPECT_NE(viewer::coupling_text(desk.network.network(), desk.session.model().mesh->surface_names,
                                  radiator)
                .find("couples most with " + before[0].name),
            std::string::npos);
  EXPECT_FALSE(viewer::absorbed_sunlight(desk.session.model().bands, desk.fluxes,
                                         radiator));  // there is none
  const auto& mesh = *desk.session.model().mesh;
  const auto patch = std::find(mesh.surface.begin(), mesh.surface.end(), radiator);
  desk.hovered = patch - mesh.surface.begin();
  EXPECT_NE(viewer::hovered_text(desk).find("couples most"), std::string::npos);
  // Blacker paint couples more.
  const int material = desk.session.model().scene->surfaces[radiator].material;
  desk.session.set_reflectance(static_cast<std::size_t>(material), Eigen::VectorXd::Zero(1));
  wait_until(desk.session, [&] {
    viewer::update(desk);
    return desk.session.is_idle() && desk.network.network() != nullptr && !desk.network.is_busy();
  });
  EXPECT_GT(couplings_of(desk, radiator)[0].area, before[0].area);
  open(desk.session, kBox);
  viewer::update(desk);
  EXPECT_TRUE(couplings_of(desk, 0).empty());
  EXPECT_FALSE(desk.network.is_wanted());
}

// In space, of the satellite: what is absorbed of the sun is (1 - ρ) of what arrives in its band.
TEST(Couplings, TellWhatTheSunHeats) {
  viewer::Desk desk(coarse());
  find_network(desk, std::string(RADIOSITY_SCENES) + "/satellite.json");
  const auto& mesh = *desk.session.model().mesh;
  const Solution& light = desk.session.light()->solution;
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(mesh.surface_names.size()); ++s) {
    double absorbed = 0;
    for (Index i = 0; i < mesh.size(); ++i) {
      if (mesh.surface[i] != s) continue;
      absorbed += mesh.area[i] * (1 - light.reflectance(i, 0)) * light.irradiance(i, 0);
    }
    EXPECT_NEAR(viewer::absorbed_sunlight(desk.session.model().bands, desk.fluxes, s).value(),
                absorbed, 1e-9 * (1 + absorbed));
  }
  // All that the infrared loses: with backs and space the shares are whole.
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(mesh.surface_names.size()); ++s) {
    double shares = 0;
    for (const viewer::Coupling& coupling : couplings_of(desk, s)) shares += coupling.gebhart;
    EXPECT_NEAR(shares, 1, 1e-4);
  }
}

}  // namespace
}  // namespace radiosity::test
