// The list of surfaces: what each has as a whole, and which are in the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "radiosity/solve/quantity.h"
#include "radiosity/solve/surface_flux.h"
#include "tests/support/shapes.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/desk_surfaces.h"
#include "viewer/desk/outlines.h"
#include "viewer/desk/surface_totals.h"

namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Quantity;
using radiosity::Vec3;
using viewer::HiddenSurfaces;
using viewer::SurfaceTotal;
using namespace radiosity::test;

constexpr double kSum = 1e-12;  // relative rounding of a sum over the patches

TEST(SurfaceTotals, AddUpToTheScene) {
  viewer::Session session(coarse());
  EXPECT_TRUE(viewer::surface_totals(session.known()).empty());
  open(session, kBox);
  const PatchMesh& mesh = *session.model().mesh;
  const auto totals = viewer::surface_totals(session.known());
  ASSERT_EQ(totals.size(), mesh.surface_names.size());
  const auto field = [&](Quantity quantity) {
    return make_field(quantity, mesh, session.light()->solution, session.model().bands)
        .values.col(0)
        .eval();
  };
  const Eigen::VectorXd lux = field(Quantity::illuminance);
  const Eigen::Map<const Eigen::VectorXd> area(mesh.area.data(), mesh.size());
  double flux = 0;
  double arrived = 0;
  double whole = 0;
  Index n_patches = 0;
  for (const SurfaceTotal& total : totals) {
    EXPECT_FALSE(total.material.empty());
    EXPECT_FALSE(total.heat);
    flux += total.flux.value();
    arrived += total.irradiance.value() * total.area;
    whole += total.area;
    n_patches += total.n_patches;
  }
  EXPECT_EQ(n_patches, mesh.size());
  EXPECT_NEAR(whole, area.sum(), kSum * area.sum());
  const double lumen = field(Quantity::luminous_flux).sum();
  EXPECT_NEAR(flux, lumen, kSum * lumen);
  EXPECT_NEAR(arrived, lux.dot(area), kSum * lux.dot(area));
}

// A source that is dimmed to 1/16 of its power is half as hot.
TEST(SurfaceTotals, OfHeatHaveTemperatures) {
  viewer::Session session({.patches = {.n_patches = 60}});
  open(session, kThermal);
  const auto temperature_of = [&](const std::string& name) -> std::optional<double> {
    for (const SurfaceTotal& total : viewer::surface_totals(session)) {
      if (total.name == name) return total.temperature;
    }
    return std::nullopt;
  };
  EXPECT_EQ(temperature_of("heater"), 400);
  EXPECT_EQ(viewer::temperature_text(400), "400.0 K, 126.9 °C");
  const auto heater = viewer::emitter_named(session.mix(), "heater");
  ASSERT_TRUE(heater);
  session.set_emitter(*heater, 1.0 / 16, true);
  EXPECT_NEAR(temperature_of("heater").value(), 200, 1e-10);
  std::vector<SurfaceTotal> totals = viewer::surface_totals(session);
  sort(totals, {.column = viewer::total_column_named("temperature").value(), .is_falling = true});
  EXPECT_GE(totals.front().temperature.value(), totals.back().temperature.value());
}

TEST(SurfaceTotals, OfHeatAreItsNetFluxes) {
  viewer::Session session(coarse());
  open(session, kThermal);
  const auto fluxes = radiosity::surface_fluxes(*session.model().mesh, session.light()->solution);
  const auto totals = viewer::surface_totals(session.known());
  ASSERT_EQ(totals.size(), fluxes.size());
  for (std::size_t s = 0; s < totals.size(); ++s) {
    const double size = totals[s].flux.value();
    EXPECT_NEAR(totals[s].heat.value(), fluxes[s].heat, kSum * std::max(1.0, size));
  }
}

TEST(SurfaceTotals, AreSortedAsAsked) {
  std::vector<SurfaceTotal> totals(3);
  totals[0].name = "b";
  totals[1].name = "a";
  totals[2].name = "c";
  totals[0].area = 2;
  totals[1].area = 3;
  totals[2].area = 1;
  totals[1].flux = 7;
  totals[2].flux = 9;
  const auto names = [&](const viewer::TotalOrder& order) {
    std::vector<SurfaceTotal> sorted = totals;
    viewer::sort(sorted, order);
    return sorted[0].name + sorted[1].name + sorted[2].name;
  };
  using viewer::TotalColumn;
  EXPECT_EQ(names({}), "abc");
  EXPECT_EQ(names({.is_falling = true}), "cba");
  EXPECT_EQ(names({.column = TotalColumn::area}), "cba");
  EXPECT_EQ(names({.column = TotalColumn::flux}), "acb");
  EXPECT_EQ(names({.column = TotalColumn::flux, .is_falling = true}), "cab");
  EXPECT_EQ(viewer::total_column_named("irradiance"), TotalColumn::irradiance);
  EXPECT_FALSE(viewer::total_column_named("colour"));
}

TEST(HiddenSurfaces, AreThoseThatWereHidden) {
  HiddenSurfaces hidden;
  const std::vector<std::int32_t> two = {2};
  EXPECT_TRUE(hidden.is_empty());
  hidden = hidden.with(two, 4, true);
  EXPECT_TRUE(hidden.contains(2));
  EXPECT_FALSE(hidden.contains(1));
  EXPECT_FALSE(hidden.contains(99));
  EXPECT_TRUE(hidden.with(two, 4, false).is_empty());
  const HiddenSurfaces others = HiddenSurfaces::all_but(std::vector{1}, 4);
  for (int s = 0; s < 4; ++s) EXPECT_EQ(others.contains(s), s != 1);
  EXPECT_THROW(static_cast<void>(hidden.with(std::vector{4}, 4, true)), std::out_of_range);
}

// The eye goes through what is hidden, to what is behind.
TEST(HiddenSurfaces, LetTheEyePass) {
  const PatchMesh mesh = box_in_box(3, 2);  // its walls at 0 and 1, the box from 0.35 to 0.65
  const radiosity::Visibility visibility(mesh);
  const Vec3 origin(0.1, 0.45, 0.5);
  const auto see = [&](const HiddenSurfaces& hidden) {
    return first_seen(visibility, mesh, hidden, viewer::Backs::hidden, origin, Vec3::UnitX());
  };
  const auto near = see({});
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->distance, 0.25, 1e-6);
  const auto n = mesh.surface_names.size();
  const auto far = see(HiddenSurfaces().with(std::vector{mesh.surface[near->patch]}, n, true));
  ASSERT_TRUE(far);
  EXPECT_NEAR(far->distance, 0.9, 1e-4);
  EXPECT_EQ(mesh.normal[far->patch], -Vec3::UnitX());
  HiddenSurfaces all;
  for (std::size_t s = 0; s < n; ++s) {
    all = all.with(std::vector{static_cast<std::int32_t>(s)}, n, true);
  }
  EXPECT_FALSE(see(all));
}

TEST(HiddenSurfaces, HaveNoOutlines) {
  PatchMesh mesh;
  add_box(mesh, Vec3(0, 0, 0), Vec3(1, 1, 1), 2, Facing::inwards);
  double length = 0;
  for (const auto& line : make_outlines(mesh, HiddenSurfaces::all_but(std::vector{0}, 6))) {
    length += (line.ends[1] - line.ends[0]).norm();
  }
  EXPECT_NEAR(length, 4, 1e-9);  // of one face
}

TEST(SurfaceList, MarksHidesAndForgets) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  viewer::update(desk);
  desk.region = {.left = 0, .top = 0, .width = 600, .height = 600};
  const PatchMesh& mesh = *desk.session.model().mesh;
  const Index patch = viewer::patch_at(desk, 0.3, 0.6).value();
  const std::int32_t surface = mesh.surface[patch];
  desk.session.select(patch);
  viewer::update(desk);
  const std::vector<std::int32_t> it = {surface};
  EXPECT_EQ(desk.marks.surfaces(), it);  // as clicked in the picture
  EXPECT_TRUE(desk.marks.lines().empty());
  viewer::mark_surfaces(desk, it);  // as clicked in the list
  EXPECT_FALSE(desk.marks.lines().empty());
  viewer::set_shown(desk, it, false);
  EXPECT_NE(mesh.surface[viewer::patch_at(desk, 0.3, 0.6).value()], surface);
  viewer::isolate(desk, it);
  EXPECT_EQ(mesh.surface[viewer::patch_at(desk, 0.3, 0.6).value()], surface);
  EXPECT_THROW(viewer::isolate(desk, std::vector{1000}), std::out_of_range);
  EXPECT_EQ(viewer::surface_named(mesh, mesh.surface_names[surface]), surface);
  EXPECT_FALSE(viewer::surface_named(mesh, "no such surface"));
  const double area = viewer::sorted_totals(desk).front().area;
  EXPECT_GT(area, 0);
  open(desk.session, kRoom);
  viewer::update(desk);
  EXPECT_TRUE(desk.look.hidden.is_empty());
  EXPECT_TRUE(desk.marks.surfaces().empty());
  EXPECT_EQ(viewer::sorted_totals(desk).size(), desk.session.model().mesh->surface_names.size());
}

/// A patch of a group of surfaces that is seen from the room's camera, if any.
std::set<std::int32_t> seen_surfaces(const viewer::Desk& desk) {
  std::set<std::int32_t> seen;
  constexpr int kPlaces = 10;
  for (int x = 0; x < kPlaces; ++x) {
    for (int y = 0; y < kPlaces; ++y) {
      const auto patch = viewer::patch_at(desk, (x + 0.5) / kPlaces, (y + 0.5) / kPlaces);
      if (patch) seen.insert(desk.session.model().mesh->surface[*patch]);
    }
  }
  return seen;
}

// Materials and lamps go with their surfaces, in the list as in the picture.
TEST(SurfaceGroups, AreShownHiddenAndMarkedTogether) {
  viewer::Desk desk(coarse());
  open(desk.session, kBox);
  viewer::update(desk);
  desk.region = {.left = 0, .top = 0, .width = 600, .height = 600};
  const radiosity::Scene& scene = *desk.session.model().scene;
  const auto groups = viewer::material_groups(scene);
  ASSERT_EQ(groups.size(), scene.materials.size());
  const auto totals = viewer::sorted_totals(desk);
  std::size_t n = 0;
  double area = 0;
  double flux = 0;
  for (const viewer::SurfaceGroup& group : groups) {
    n += group.surfaces.size();
    for (const std::int32_t surface : group.surfaces) {
      EXPECT_EQ(scene.surfaces[surface].material, static_cast<std::int32_t>(group.index));
    }
    const SurfaceTotal total = viewer::group_total(group, totals);
    area += total.area;
    flux += total.flux.value_or(0);
    viewer::isolate(desk, group.surfaces);
    for (const std::int32_t surface : seen_surfaces(desk)) {
      EXPECT_TRUE(std::count(group.surfaces.begin(), group.surfaces.end(), surface)) << surface;
    }
    desk.look.hidden = {};
    viewer::set_shown(desk, group.surfaces, false);
    for (const std::int32_t surface : seen_surfaces(desk)) {
      EXPECT_FALSE(std::count(group.surfaces.begin(), group.surfaces.end(), surface)) << surface;
    }
    viewer::set_shown(desk, group.surfaces, true);
    EXPECT_TRUE(desk.look.hidden.is_empty());
    viewer::mark_surfaces(desk, group.surfaces);
    EXPECT_EQ(desk.marks.surfaces(), group.surfaces);
    EXPECT_FALSE(desk.marks.lines().empty());
  }
  EXPECT_EQ(n, scene.surfaces.size());
  const auto sum = [&](const auto& get) {
    return std::accumulate(totals.begin(), totals.end(), 0.0,
                           [&](double so_far, const SurfaceTotal& t) { return so_far + get(t); });
  };
  EXPECT_NEAR(area, sum([](const SurfaceTotal& t) { return t.area; }), kSum * area);
  EXPECT_NEAR(flux, sum([](const SurfaceTotal& t) { return t.flux.value_or(0); }), kSum * flux);
  const auto lamps = viewer::lamp_groups(desk.session.mix());
  ASSERT_EQ(lamps.size(), 1U);
  EXPECT_EQ(lamps[0].name, desk.session.mix().emitters[0].name);
  EXPECT_EQ(lamps[0].surfaces, desk.session.mix().emitters[0].surfaces);
}

}  // namespace
