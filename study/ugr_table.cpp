#include "study/ugr_table.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/meter/luminaire_glare.h"
#include "radiosity/scene/luminaire.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/luminaire_light.h"
#include "radiosity/visibility/visibility.h"

namespace study {
namespace {

using radiosity::Index;
using radiosity::Luminaire;
using radiosity::PatchMesh;
using radiosity::Scene;
using radiosity::Vec3;

/// Of H: the ceiling is above the luminaires, the eye in front of its wall and above its floor by
/// so little. 1e-3 of the distances moves no UGR by more than 0.02.
constexpr double kGap = 1e-3;
/// Of the form factors, and of the iteration.
constexpr double kTableTolerance = 1e-3;

/// Surfaces and materials of a room.
constexpr std::int32_t kCeiling = 0;
constexpr std::int32_t kWalls = 1;
constexpr std::int32_t kFloor = 2;

/// An empty room from the origin to `size`, m.
Scene empty_room(const Vec3& size) {
  Scene scene;
  scene.source = "room of the UGR table";
  scene.bands.kind = radiosity::Bands::Kind::grey;
  for (int k = 0; k < 8; ++k) {
    scene.vertices.emplace_back((k & 1) != 0 ? size.x() : 0, (k & 2) != 0 ? size.y() : 0,
                                (k & 4) != 0 ? size.z() : 0);
  }
  for (const char* name : {"ceiling", "walls", "floor"}) {
    const auto material = static_cast<int>(scene.materials.size());
    scene.materials.push_back({name, Eigen::VectorXd::Zero(1), {}});
    scene.surfaces.push_back({name, material});
  }
  const auto add = [&](std::array<std::int32_t, 4> corners, std::int32_t surface) {
    scene.add_polygon(corners, surface);
  };
  add({4, 6, 7, 5}, kCeiling);
  add({0, 4, 5, 1}, kWalls);
  add({1, 5, 7, 3}, kWalls);
  add({3, 7, 6, 2}, kWalls);
  add({2, 6, 4, 0}, kWalls);
  add({0, 1, 3, 2}, kFloor);
  return scene;
}

/// Rows of luminaires above all of the room, whose C0 is turned by an angle from +x.
void hang(const radiosity::Photometry& photometry, const UgrRoom& room,
          const UgrTableOptions& options, double turn, Scene& scene) {
  scene.photometries = {photometry};
  scene.luminaires.clear();
  const auto n_across = static_cast<long>(std::lround(room.across / options.spacing));
  const auto n_along = static_cast<long>(std::lround(room.along / options.spacing));
  const Vec3 step = options.height * Vec3(room.across / static_cast<double>(n_across),
                                          room.along / static_cast<double>(n_along), 0);
  Luminaire luminaire;
  luminaire.axes = radiosity::aimed_axes(-Vec3::UnitZ(), turn, Vec3::UnitZ(), Vec3::UnitX());
  luminaire.watts_per_lumen = Eigen::VectorXd::Ones(1);
  luminaire.divisions = {1, 1};  // as in the tabular method
  for (long row = 0; row < n_along; ++row) {
    for (long column = 0; column < n_across; ++column) {
      luminaire.position = {step.x() * (static_cast<double>(column) + 0.5),
                            step.y() * (static_cast<double>(row) + 0.5), options.height};
      scene.luminaires.push_back(luminaire);
    }
  }
}

/// Σ L² ω / p² of all luminaires.
double dazzle(const Scene& scene, const PatchMesh& mesh, const UgrRoom& room,
              const UgrTableOptions& options) {
  const double gap = kGap * options.height;
  radiosity::Observer observer;
  observer.position = {room.across * options.height / 2, gap, gap};
  observer.direction = Vec3::UnitY();
  const radiosity::LuminaireGlare glare(scene, mesh, Eigen::VectorXd::Ones(1));
  double sum = 0;
  for (const radiosity::GlareSource& source : glare.sources(observer)) {
    if (!source.position) continue;
    sum += radiosity::square(source.luminance / *source.position) * source.solid_angle;
  }
  return sum;
}

/// Mean indirect illuminance of the walls.
double wall_light(const PatchMesh& mesh, const radiosity::Transport& transport,
                  const Eigen::MatrixXd& direct, const UgrReflectances& reflectances) {
  Eigen::MatrixXd rho(mesh.size(), 1);
  for (Index i = 0; i < mesh.size(); ++i) {
    rho(i, 0) = reflectances[static_cast<std::size_t>(mesh.surface[i])];
  }
  radiosity::SolveOptions solving;
  solving.tolerance = kTableTolerance;
  solving.estimates_errors = false;
  solving.incident = direct;
  const radiosity::Solution light =
      solve(transport, Eigen::MatrixXd::Zero(mesh.size(), 1), rho, solving);
  const Eigen::MatrixXd indirect = light.exchanged_irradiance();
  double sum = 0;
  double area = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (mesh.surface[i] != kWalls) continue;
    sum += mesh.area[i] * indirect(i, 0);
    area += mesh.area[i];
  }
  return sum / area;
}

/// A row of the table: a room, by reflectances.
void fill_row(const radiosity::Photometry& photometry, const UgrTableOptions& options, Index row,
              const radiosity::Progress& progress, UgrTable& table) {
  const UgrRoom& room = options.rooms[static_cast<std::size_t>(row)];
  Scene scene = empty_room(options.height * Vec3(room.across, room.along, 1 + kGap));
  const PatchMesh mesh =
      meshing::make_patches(scene, {.n_patches = options.n_patches, .progress = progress});
  const radiosity::Visibility visibility(mesh);
  const auto transport = make_transport(
      mesh, visibility,
      {.tolerance = kTableTolerance, .closed = radiosity::Closed::yes, .progress = progress});
  for (const bool looks_along_c0 : {true, false}) {
    hang(photometry, room, options, looks_along_c0 ? radiosity::kPi / 2 : 0, scene);
    const Eigen::MatrixXd direct =
        radiosity::LuminaireLight(scene, mesh).irradiance(progress).irradiance;
    const double sum = dazzle(scene, mesh, room, options);
    Eigen::MatrixXd& values = looks_along_c0 ? table.along_c0 : table.along_c90;
    for (std::size_t k = 0; k < options.reflectances.size(); ++k) {
      const double background =
          wall_light(mesh, *transport, direct, options.reflectances[k]) / radiosity::kPi;
      values(row, static_cast<Index>(k)) = sum > 0 ? 8 * std::log10(0.25 / background * sum)
                                                   : -std::numeric_limits<double>::infinity();
    }
  }
}

}  // namespace

std::vector<UgrRoom> usual_ugr_rooms() {
  std::vector<UgrRoom> rooms;
  for (const double across : {2., 4.}) {
    for (const double along : {2., 3., 4., 6., 8., 12.}) rooms.push_back({across, along});
  }
  for (const double along : {4., 6., 8., 12.}) rooms.push_back({8, along});
  for (const double along : {4., 6., 8.}) rooms.push_back({12, along});
  return rooms;
}

std::vector<UgrReflectances> usual_ugr_reflectances() {
  return {{0.7, 0.5, 0.2}, {0.7, 0.3, 0.2}, {0.5, 0.5, 0.2}, {0.5, 0.3, 0.2}, {0.3, 0.3, 0.2}};
}

namespace {

void check_options(const UgrTableOptions& options) {
  constexpr double kMostAcross = 1000;  // luminaires
  constexpr double kRounding = 1e-6;
  for (const UgrRoom& room : options.rooms) {
    for (const double side : {room.across, room.along}) {
      const double n = side / options.spacing;
      if (n >= 1 - kRounding && n <= kMostAcross && std::abs(n - std::round(n)) <= kRounding * n) {
        continue;
      }
      throw radiosity::SceneError(fmt::format(
          "a room of {:g} H by {:g} H with luminaires {:g} H apart: expected sides of 1 "
          "to {:g} times as much",
          room.across, room.along, options.spacing, kMostAcross));
    }
  }
  for (const UgrReflectances& rho : options.reflectances) {
    for (const double value : rho) {
      if (value >= 0 && value < 1) continue;
      throw radiosity::SceneError(
          fmt::format("a reflectance of the UGR table is {:g}, expected one in [0, 1)", value));
    }
  }
}

}  // namespace

UgrTable make_ugr_table(const radiosity::Photometry& photometry, const UgrTableOptions& options,
                        const StudyEvents& events) {
  if (!(photometry.along_c0 > 0 && photometry.along_c90 > 0)) {
    throw radiosity::SceneError(photometry.file.string() +
                                ": has no luminous opening, whose luminance UGR is made of");
  }
  check_options(options);
  const auto n_rooms = static_cast<Index>(options.rooms.size());
  UgrTable table{.made_by = options, .along_c0 = {}, .along_c90 = {}};
  table.along_c0.resize(n_rooms, static_cast<Index>(options.reflectances.size()));
  table.along_c90 = table.along_c0;
  // What single rooms report would jump to and fro.
  radiosity::Progress quiet = events.progress;
  quiet.report = {};
  for (Index row = 0; row < n_rooms; ++row) {
    events.progress.check();
    if (events.progress.report) {
      events.progress.report("rooms", static_cast<double>(row), static_cast<double>(n_rooms),
                             "rooms");
    }
    fill_row(photometry, options, row, quiet, table);
  }
  return table;
}

}  // namespace study
