#include "apps/options/light_options.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/options/surface_names.h"
#include "apps/terminal/number_list.h"
#include "io/scene/points_file.h"
#include "radiosity/base/error.h"

namespace apps {
namespace {

using radiosity::GridPlan;
using radiosity::LightPlan;
using radiosity::Observer;
using radiosity::Scene;
using radiosity::Vec3;

/// Cosine of angles that count as right, sine of those that count as none.
constexpr double kSmallAngle = 1e-6;

constexpr std::size_t kRectangleNumbers = 9;
constexpr std::size_t kObserverNumbers = 6;

std::string check_grid(const std::string& text) {
  const auto numbers = as_numbers(text, kRectangleNumbers);
  if (!numbers) {
    if (split_at_commas(text).size() < kRectangleNumbers) return "";
    return fmt::format("found '{}', expected a surface or nine numbers", text);
  }
  const Vec3 a(numbers->data() + 3);
  const Vec3 b(numbers->data() + 6);
  if (a.norm() > 0 && b.norm() > 0 && std::abs(a.dot(b)) <= kSmallAngle * a.norm() * b.norm()) {
    return "";
  }
  return fmt::format("found '{}', expected a corner and two sides at a right angle", text);
}

std::string check_observer(const std::string& text) {
  const auto numbers = as_numbers(text, kObserverNumbers);
  if (!numbers) return fmt::format("found '{}', expected six numbers x,y,z,dx,dy,dz", text);
  const Vec3 direction(numbers->data() + 3);
  if (direction.cross(Vec3::UnitZ()).norm() > kSmallAngle * direction.norm()) return "";
  return fmt::format("found '{}', expected to look elsewhere than up or down", text);
}

std::string check_facing(const std::string& text) {
  const auto numbers = as_numbers(text, 3);
  if (numbers && Vec3(numbers->data()).norm() > 0) return "";
  return fmt::format("found '{}', expected three numbers x,y,z, not all 0", text);
}

std::string check_eye(const std::string& text) {
  if (as_numbers(text, 3)) return "";
  return fmt::format("found '{}', expected three numbers x,y,z", text);
}

std::string check_factor(const std::string& text) {
  const auto number = as_number(text);
  if (number && *number > 0 && *number <= 1) return "";
  return fmt::format("found '{}', expected a number above 0 and at most 1", text);
}

std::string check_not_negative(const std::string& text) {
  const auto number = as_number(text);
  if (number && *number >= 0) return "";
  return fmt::format("found '{}', expected a number of at least 0", text);
}

bool has_surface(const Scene& scene, const std::string& name) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                     [&](const auto& surface) { return surface.name == name; });
}

/// Of "floor" or "floor:0.75"; names may have a colon, too.
void set_surface(const Scene& scene, const std::string& text, GridPlan& plan) {
  plan.surface = text;
  const std::size_t colon = text.rfind(':');
  if (!has_surface(scene, text) && colon != std::string::npos) {
    if (const auto offset = as_number(text.substr(colon + 1))) {
      plan.surface = text.substr(0, colon);
      plan.offset = *offset;
    }
  }
  if (!has_surface(scene, plan.surface)) {
    throw radiosity::SceneError(
        fmt::format("{}: no surface \"{}\" for a grid, the nearest is \"{}\"; expected a surface's "
                    "name, or that with an offset as in floor:0.75",
                    scene.source, plan.surface, nearest_surface(scene, plan.surface)));
  }
}

GridPlan grid_of(const Scene& scene, const std::string& text, const LightOptions& options) {
  GridPlan plan{.name = text};
  if (const auto numbers = as_numbers(text, kRectangleNumbers)) {
    plan.corner = Vec3(numbers->data());
    plan.sides = {Vec3(numbers->data() + 3), Vec3(numbers->data() + 6)};
  } else {
    set_surface(scene, text, plan);
  }
  plan.spacing = options.spacing.value_or(0);
  plan.border = options.border;
  return plan;
}

Vec3 direction_of(const std::string& text) {
  return Vec3(as_numbers(text, 3)->data()).stableNormalized();
}

Observer observer_of(const std::string& text) {
  const std::vector<double> numbers = *as_numbers(text, kObserverNumbers);
  return {.name = text,
          .position = Vec3(numbers.data()),
          .direction = Vec3(numbers.data() + 3).stableNormalized()};
}

/// Names that are taken get a number.
template <typename Named>
void add_named(std::vector<Named>& list, Named item) {
  const std::string name = item.name;
  const auto is_taken = [&] {
    return std::any_of(list.begin(), list.end(),
                       [&](const Named& other) { return other.name == item.name; });
  };
  for (int k = 2; is_taken(); ++k) item.name = fmt::format("{} {}", name, k);
  list.push_back(std::move(item));
}

}  // namespace

void add_light_options(CLI::App& command, LightOptions& options) {
  const std::string group = "Points";
  command
      .add_option("--grid", options.grids,
                  "Measure on a plane: above a flat surface, by its name and, if wanted, an offset "
                  "in metres (floor:0.75), or in a rectangle, by a corner and two sides "
                  "(x,y,z,ax,ay,az,bx,by,bz); may be repeated")
      ->check(check_grid)
      ->type_name("GRID")
      ->allow_extra_args(false)
      ->group(group);
  command
      .add_option("--points", options.points,
                  "Measure at the points of this file (.csv of x,y,z or x,y,z,nx,ny,nz, metres); "
                  "may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->group(group);
  command
      .add_option("--spacing", options.spacing,
                  "Of the points of --grid at most, metres; default: by EN 12464-1")
      ->check(check_positive)
      ->type_name("L")
      ->group(group);
  command
      .add_option("--border", options.border,
                  "Left out along the edges of --grid, metres; default: by EN 12464-1, and 0 of a "
                  "rectangle")
      ->check(check_not_negative)
      ->type_name("L")
      ->group(group);
  command
      .add_flag("--cylindrical", options.is_cylindrical, "Cylindrical illuminance at all points")
      ->group(group);
  command
      .add_option("--vertical", options.vertical,
                  "Illuminance of planes that face this direction, at all points; may be repeated")
      ->check(check_facing)
      ->type_name("x,y,z")
      ->allow_extra_args(false)
      ->group(group);
  command
      .add_option("--semi-cylindrical", options.semi_cylindrical,
                  "Semi-cylindrical illuminance of what faces this horizontal direction, at all "
                  "points; may be repeated")
      ->check(check_facing)
      ->type_name("x,y,z")
      ->allow_extra_args(false)
      ->group(group);
  command
      .add_option(
          "--luminance-from", options.luminance_from,
          "Luminance, cd/m2, of what an eye at x,y,z sees in the direction of each point; may "
          "be repeated")
      ->check(check_eye)
      ->type_name("x,y,z")
      ->allow_extra_args(false)
      ->group(group);
  command
      .add_option("--observer", options.observers,
                  "Glare (UGR) for an eye at x,y,z that looks along dx,dy,dz, z upwards; may be "
                  "repeated")
      ->check(check_observer)
      ->type_name("x,y,z,dx,dy,dz")
      ->allow_extra_args(false)
      ->group(group);
  command
      .add_option("--maintenance-factor", options.maintenance_factor,
                  "Share of what all lamps emit when new that is left at maintenance; default: as "
                  "the scene says, else 1")
      ->check(check_factor)
      ->type_name("F")
      ->group(group);
}

LightPlan light_plan(const Scene& scene, const LightOptions& options) {
  LightPlan plan = scene.light_plan;
  if (options.maintenance_factor) plan.maintenance_factor = *options.maintenance_factor;
  for (const std::string& text : options.grids) {
    add_named(plan.grids, grid_of(scene, text, options));
  }
  for (const std::string& file : options.points) {
    GridPlan points{.name = std::filesystem::path(file).stem().string()};
    io::add_points(file, 1, points);
    add_named(plan.grids, std::move(points));
  }
  for (const std::string& text : options.observers) add_named(plan.observers, observer_of(text));
  if (plan.grids.empty() && plan.observers.empty()) {
    throw radiosity::SceneError(
        fmt::format("{}: there is nothing to measure; expected \"grids\" or \"observers\" in the "
                    "scene, or --grid, --points or --observer",
                    scene.source));
  }
  for (GridPlan& grid : plan.grids) {
    grid.is_cylindrical = grid.is_cylindrical || options.is_cylindrical;
    for (const std::string& text : options.vertical) grid.vertical.push_back(direction_of(text));
    for (const std::string& text : options.semi_cylindrical) {
      grid.semi_cylindrical.push_back(direction_of(text));
    }
    for (const std::string& text : options.luminance_from) {
      grid.luminance_from.emplace_back(as_numbers(text, 3)->data());
    }
  }
  return plan;
}

}  // namespace apps
