#include "io/scene/json_light_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/scene/point_json.h"
#include "io/scene/points_file.h"
#include "io/scene/scene_keys.h"

namespace io {
namespace {

using radiosity::GridPlan;
using radiosity::LightRequirement;
using radiosity::Observer;
using radiosity::Vec3;

/// Cosine and sine of angles that count as none.
constexpr double kRightAngle = 1e-6;

double number_in(const JsonItem& item, double above, double most) {
  const double number = item.number();
  if (!(number > above && number <= most)) {
    item.fail(std::isinf(most) ? fmt::format("is {}, expected more than {}", number, above)
                               : fmt::format("is {}, expected more than {} and at most {}", number,
                                             above, most));
  }
  return number;
}

double above_zero(const JsonItem& item) {
  return number_in(item, 0, std::numeric_limits<double>::infinity());
}

LightRequirement read_requirement(const JsonItem& item) {
  item.check_keys(keys::kRequired);
  LightRequirement required;
  if (const auto mean = item.find("Em")) required.mean = above_zero(*mean);
  if (const auto uniformity = item.find("U0")) required.uniformity = number_in(*uniformity, 0, 1);
  if (const auto diversity = item.find("Ud")) required.diversity = number_in(*diversity, 0, 1);
  if (const auto glare = item.find("UGR")) required.glare = above_zero(*glare);
  return required;
}

std::vector<Vec3> read_directions(const JsonItem& item) {
  std::vector<Vec3> directions;
  for (std::size_t k = 0; k < item.size(); ++k) directions.push_back(item[k].direction());
  if (directions.empty()) item.fail("has no direction");
  return directions;
}

void read_rectangle(const JsonItem& item, double unit, GridPlan& plan) {
  plan.corner = unit * item.at("corner").point();
  const JsonItem sides = item.at("sides");
  if (sides.size() != 2) sides.fail("expected the two sides from the corner, [[x, y, z], ...]");
  for (std::size_t k = 0; k < 2; ++k) {
    plan.sides[k] = unit * sides[k].point();
    if (!(plan.sides[k].norm() > 0)) sides[k].fail("has no length");
  }
  const double cosine = plan.sides[0].normalized().dot(plan.sides[1].normalized());
  if (!(std::abs(cosine) < kRightAngle)) sides.fail("are not at a right angle");
}

/// A list in the scene itself, or a file of one.
void read_points(const JsonItem& item, const std::filesystem::path& folder, double unit,
                 radiosity::Scene& scene, GridPlan& plan) {
  const JsonItem points = item.at("points");
  if (points.value().is_string()) {
    if (item.has("normals")) item.at("normals").fail("goes with a list of points, not a file");
    const std::filesystem::path path = folder / points.text();
    scene.files.push_back(path);
    add_points(path, unit, plan);
    return;
  }
  for (std::size_t k = 0; k < points.size(); ++k) plan.points.push_back(unit * points[k].point());
  if (plan.points.empty()) points.fail("has no points");
  plan.normals.assign(plan.points.size(), plan.up.value_or(Vec3::UnitZ()));
  const auto normals = item.find("normals");
  if (!normals) return;
  if (normals->size() != plan.points.size()) {
    normals->fail(
        fmt::format("has {} directions for {} points", normals->size(), plan.points.size()));
  }
  for (std::size_t k = 0; k < plan.points.size(); ++k) {
    plan.normals[k] = (*normals)[k].direction();
  }
}

void read_place(const JsonItem& item, const std::filesystem::path& folder, double unit,
                radiosity::Scene& scene, GridPlan& plan) {
  const int n_kinds = static_cast<int>(item.has("surface")) + static_cast<int>(item.has("corner")) +
                      static_cast<int>(item.has("points"));
  if (n_kinds != 1) {
    item.fail("expected one of \"surface\", \"corner\" with \"sides\", and \"points\"");
  }
  const auto refuse = [&](const char* key, const char* other) {
    if (item.has(key)) item.at(key).fail(fmt::format("does not go with \"{}\"", other));
  };
  if (!item.has("surface")) refuse("offset", item.has("corner") ? "corner" : "points");
  if (!item.has("corner")) refuse("sides", item.has("surface") ? "surface" : "points");
  if (!item.has("points")) refuse("normals", item.has("surface") ? "surface" : "corner");
  if (const auto surface = item.find("surface")) {
    plan.surface = surface->text();
    const bool is_there =
        std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                    [&](const auto& known) { return known.name == plan.surface; });
    if (!is_there) surface->fail(fmt::format("no surface \"{}\" in the scene", plan.surface));
    if (const auto offset = item.find("offset")) plan.offset = unit * offset->number();
  } else if (item.has("corner")) {
    read_rectangle(item, unit, plan);
  } else {
    refuse("spacing", "points");
    refuse("border", "points");
    read_points(item, folder, unit, scene, plan);
  }
}

GridPlan read_grid(const JsonItem& item, const std::filesystem::path& folder, double unit,
                   radiosity::Scene& scene) {
  item.check_keys(keys::kGrid);
  GridPlan plan{.name = item.at("name").text()};
  if (const auto up = item.find("up")) plan.up = up->direction();
  read_place(item, folder, unit, scene, plan);
  if (const auto spacing = item.find("spacing")) plan.spacing = unit * above_zero(*spacing);
  if (const auto border = item.find("border")) {
    plan.border = unit * border->number();
    if (!(*plan.border >= 0)) border->fail("is negative");
  }
  if (const auto cylindrical = item.find("cylindrical")) {
    plan.is_cylindrical = cylindrical->boolean();
  }
  if (const auto vertical = item.find("vertical")) plan.vertical = read_directions(*vertical);
  if (const auto semi = item.find("semi_cylindrical")) {
    plan.semi_cylindrical = read_directions(*semi);
  }
  if (const auto eyes = item.find("luminance_from")) {
    if (eyes->size() == 0) eyes->fail("has no point");
    for (std::size_t k = 0; k < eyes->size(); ++k) {
      plan.luminance_from.push_back(unit * (*eyes)[k].point());
    }
  }
  if (const auto required = item.find("required")) plan.required = read_requirement(*required);
  return plan;
}

Observer read_observer(const JsonItem& item, double unit) {
  item.check_keys(keys::kObserver);
  Observer observer{.name = item.at("name").text()};
  const Vec3 position = item.at("position").point();
  observer.position = unit * position;
  if (item.has("look_at") == item.has("direction")) {
    item.fail("expected either \"look_at\" or \"direction\"");
  }
  if (const auto direction = item.find("direction")) {
    observer.direction = direction->direction();
  } else {
    const Vec3 view = item.at("look_at").point() - position;
    if (!(view.norm() > 0)) item.at("look_at").fail("is the observer's position");
    observer.direction = view.stableNormalized();
  }
  if (const auto up = item.find("up")) observer.up = up->direction();
  if (!(observer.up.cross(observer.direction).norm() > kRightAngle)) {
    item.fail("looks along its own \"up\" ([0, 0, 1] if absent)");
  }
  if (const auto limit = item.find("UGR")) observer.limit = above_zero(*limit);
  return observer;
}

/// Throws if two of a list have one name.
template <typename Named>
void check_names(const JsonItem& list, const std::vector<Named>& named) {
  for (std::size_t k = 1; k < named.size(); ++k) {
    const auto same = std::any_of(named.begin(), named.begin() + static_cast<std::ptrdiff_t>(k),
                                  [&](const Named& other) { return other.name == named[k].name; });
    if (same) list[k].at("name").fail("is the name of another one, too");
  }
}

Json vectors_json(const std::vector<Vec3>& vectors) {
  Json list = Json::array();
  for (const Vec3& v : vectors) list.push_back(point_json(v));
  return list;
}

Json requirement_json(const LightRequirement& required) {
  Json json = Json::object();
  if (required.mean) json["Em"] = *required.mean;
  if (required.uniformity) json["U0"] = *required.uniformity;
  if (required.diversity) json["Ud"] = *required.diversity;
  if (required.glare) json["UGR"] = *required.glare;
  return json;
}

Json grid_json(const GridPlan& plan) {
  Json json = {{"name", plan.name}};
  if (plan.is_list()) {
    json["points"] = vectors_json(plan.points);
    json["normals"] = vectors_json(plan.normals);
  } else if (!plan.surface.empty()) {
    json["surface"] = plan.surface;
    json["offset"] = plan.offset;
  } else {
    json["corner"] = point_json(plan.corner);
    json["sides"] = {point_json(plan.sides[0]), point_json(plan.sides[1])};
  }
  if (plan.spacing > 0) json["spacing"] = plan.spacing;
  if (plan.border) json["border"] = *plan.border;
  if (plan.up) json["up"] = point_json(*plan.up);
  if (plan.is_cylindrical) json["cylindrical"] = true;
  if (!plan.vertical.empty()) json["vertical"] = vectors_json(plan.vertical);
  if (!plan.semi_cylindrical.empty()) {
    json["semi_cylindrical"] = vectors_json(plan.semi_cylindrical);
  }
  if (!plan.luminance_from.empty()) json["luminance_from"] = vectors_json(plan.luminance_from);
  if (const Json required = requirement_json(plan.required); !required.empty()) {
    json["required"] = required;
  }
  return json;
}

Json observer_json(const Observer& observer) {
  Json json = {{"name", observer.name},
               {"position", point_json(observer.position)},
               {"direction", point_json(observer.direction)},
               {"up", point_json(observer.up)}};
  if (observer.limit) json["UGR"] = *observer.limit;
  return json;
}

}  // namespace

double read_maintenance_factor(const JsonItem& item) { return number_in(item, 0, 1); }

void read_light_plan(const JsonItem& root, const std::filesystem::path& folder, double unit,
                     radiosity::Scene& scene) {
  radiosity::LightPlan& plan = scene.light_plan;
  if (const auto factor = root.find("maintenance_factor")) {
    plan.maintenance_factor = read_maintenance_factor(*factor);
  }
  if (const auto grids = root.find("grids")) {
    for (std::size_t k = 0; k < grids->size(); ++k) {
      plan.grids.push_back(read_grid((*grids)[k], folder, unit, scene));
    }
    check_names(*grids, plan.grids);
  }
  if (const auto observers = root.find("observers")) {
    for (std::size_t k = 0; k < observers->size(); ++k) {
      plan.observers.push_back(read_observer((*observers)[k], unit));
    }
    check_names(*observers, plan.observers);
  }
}

Json light_plan_json(const radiosity::LightPlan& plan) {
  Json json = Json::object();
  if (plan.maintenance_factor != 1) json["maintenance_factor"] = plan.maintenance_factor;
  for (const GridPlan& grid : plan.grids) json["grids"].push_back(grid_json(grid));
  for (const Observer& observer : plan.observers) {
    json["observers"].push_back(observer_json(observer));
  }
  return json;
}

}  // namespace io
