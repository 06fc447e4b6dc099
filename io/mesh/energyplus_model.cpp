#include "io/mesh/energyplus_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "io/base/extension.h"
#include "io/base/json_item.h"
#include "io/base/line_reader.h"
#include "io/mesh/idf_as_epjson.h"
#include "io/mesh/idf_objects.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Vec3;

/// What EnergyPlus takes where a material does not say.
constexpr double kUsualEmissivity = 0.9;
constexpr double kGlassEmissivity = 0.84;

struct Zone {
  std::string name;
  Vec3 origin = Vec3::Zero();
  double turn = 0;  // about z, radian
  bool is_divided = false;
};

/// A part of a zone.
struct Space {
  std::string name;
  std::string zone;  // in lower case
};

/// The side of a construction towards the zone.
struct Lining {
  std::string material;
  double emissivity = kUsualEmissivity;
  bool is_air = false;
};

class ModelReader {
 public:
  ModelReader(const Json& json, const std::filesystem::path& path) : root_(json, path) {
    if (!json.is_object()) root_.fail("expected an object");
  }

  EnergyPlusModel run() {
    read_rules();
    read_zones();
    read_spaces();
    read_linings();
    refuse_other_surfaces();
    each("BuildingSurface:Detailed",
         [&](const JsonItem& item, const std::string& name) { add_surface(item, name); });
    for (const char* type : {"Wall:Detailed", "RoofCeiling:Detailed", "Floor:Detailed"}) {
      each(type, [&](const JsonItem& item, const std::string& name) { add_surface(item, name); });
    }
    each("FenestrationSurface:Detailed",
         [&](const JsonItem& item, const std::string& name) { add_window(item, name); });
    if (root_.has("InternalMass")) {
      model_.warnings.emplace_back(
          "internal masses (InternalMass) have no place in the zone, so they get no form factors");
    }
    if (n_unlined_ > 0) {
      model_.warnings.push_back(fmt::format(
          "{} surfaces have a construction whose innermost layer's emissivity is not known; {} is "
          "taken",
          n_unlined_, kUsualEmissivity));
    }
    return std::move(model_);
  }

 private:
  template <typename Visit>
  void each(const std::string& type, const Visit& visit) {
    const auto objects = root_.find(type);
    if (!objects) return;
    if (!objects->value().is_object()) objects->fail("expected objects by their names");
    for (const auto& [name, unused] : objects->value().items()) {
      const JsonItem item = objects->at(name);
      if (!item.value().is_object()) item.fail("expected an object");
      visit(item, name);
    }
  }

  /// A text field; "" if it is not there.
  static std::string word(const JsonItem& item, std::string_view key) {
    const auto field = item.find(key);
    if (!field) return {};
    return field->value().is_string() ? field->value().get<std::string>() : field->text();
  }
  static double number(const JsonItem& item, std::string_view key, double absent) {
    const auto field = item.find(key);
    return field ? field->number() : absent;
  }

  void read_rules() {
    each("GlobalGeometryRules", [&](const JsonItem& item, const std::string& /*name*/) {
      const std::string direction = folded(word(item, "vertex_entry_direction"));
      if (direction != "counterclockwise" && direction != "clockwise") {
        item.at("vertex_entry_direction").fail("expected Counterclockwise or Clockwise");
      }
      is_clockwise_ = direction == "clockwise";
      const std::string system = folded(word(item, "coordinate_system"));
      if (system != "relative" && system != "world" && system != "absolute") {
        item.at("coordinate_system").fail("expected Relative, World or Absolute");
      }
      is_relative_ = system == "relative";
    });
    if (!root_.has("GlobalGeometryRules")) {
      root_.fail("has no GlobalGeometryRules, which say how corners run");
    }
  }

  void read_zones() {
    each("Zone", [&](const JsonItem& item, const std::string& name) {
      Zone zone{.name = name};
      zone.turn = -number(item, "direction_of_relative_north", 0) * kPi / 180;
      for (int axis = 0; axis < 3; ++axis) {
        zone.origin[axis] = number(item, fmt::format("{}_origin", "xyz"[axis]), 0);
      }
      if (!zones_.emplace(folded(name), zone).second) item.fail("stands twice");
    });
  }

  void read_spaces() {
    each("Space", [&](const JsonItem& item, const std::string& name) {
      const Space space{.name = name, .zone = folded(word(item, "zone_name"))};
      zone_of(item).is_divided = true;
      if (!spaces_.emplace(folded(name), space).second) item.fail("stands twice");
    });
  }

  /// That which an object names.
  Zone& zone_of(const JsonItem& item) {
    const std::string wanted = word(item, "zone_name");
    const auto zone = zones_.find(folded(wanted));
    if (zone != zones_.end()) return zone->second;
    item.fail(fmt::format("is of the zone \"{}\", which there is not", wanted));
  }

  [[nodiscard]] std::string enclosure_of(const JsonItem& item, const Zone& zone) const {
    const std::string wanted = word(item, "space_name");
    if (wanted.empty()) return zone.is_divided ? zone.name + "-Remainder" : zone.name;
    const auto space = spaces_.find(folded(wanted));
    if (space != spaces_.end() && space->second.zone == folded(zone.name)) {
      return space->second.name;
    }
    item.fail(
        fmt::format("is in the space \"{}\", which its zone \"{}\" has not", wanted, zone.name));
  }

  void read_linings() {
    std::map<std::string, double> emissivities;
    const auto read_layers = [&](const char* type, const char* key, double usual) {
      each(type, [&](const JsonItem& item, const std::string& name) {
        const double value = number(item, key, usual);
        if (!(value > 0 && value <= 1)) {
          item.fail(
              fmt::format("has the emissivity {}, expected more than 0 and at most 1", value));
        }
        emissivities[folded(name)] = value;
      });
    };
    read_layers("Material", "thermal_absorptance", kUsualEmissivity);
    read_layers("Material:NoMass", "thermal_absorptance", kUsualEmissivity);
    read_layers("WindowMaterial:Glazing", "back_side_infrared_hemispherical_emissivity",
                kGlassEmissivity);
    read_layers("WindowMaterial:SimpleGlazingSystem", "-", kGlassEmissivity);
    each("Construction", [&](const JsonItem& item, const std::string& name) {
      Lining lining{.material = word(item, "outside_layer")};
      for (int layer = 2; layer <= 10; ++layer) {
        const std::string inner = word(item, fmt::format("layer_{}", layer));
        if (!inner.empty()) lining.material = inner;
      }
      const auto known = emissivities.find(folded(lining.material));
      if (known == emissivities.end()) return;
      lining.emissivity = known->second;
      linings_.emplace(folded(name), lining);
    });
    each("Construction:AirBoundary", [&](const JsonItem& /*item*/, const std::string& name) {
      linings_.emplace(folded(name), Lining{.material = name, .is_air = true});
    });
  }

  void refuse_other_surfaces() {
    for (const char* type :
         {"Wall:Exterior", "Wall:Adiabatic", "Wall:Underground", "Wall:Interzone", "Roof",
          "Ceiling:Adiabatic", "Ceiling:Interzone", "Floor:GroundContact", "Floor:Adiabatic",
          "Floor:Interzone", "Window", "Door", "GlazedDoor", "Window:Interzone", "Door:Interzone",
          "GlazedDoor:Interzone"}) {
      each(type, [&](const JsonItem& item, const std::string& /*name*/) {
        item.fail(
            "is given by a starting point; expected corners (BuildingSurface:Detailed, "
            "FenestrationSurface:Detailed)");
      });
    }
  }

  EnergyPlusSurface make_surface(const JsonItem& item, const std::string& name) {
    EnergyPlusSurface surface{.name = name};
    const std::string construction = word(item, "construction_name");
    const auto lining = linings_.find(folded(construction));
    if (lining == linings_.end()) {
      ++n_unlined_;
      surface.material = "usual";
      surface.emissivity = kUsualEmissivity;
    } else {
      if (lining->second.is_air) {
        item.fail(
            fmt::format("is a boundary of air, \"{}\", to another zone; form factors of "
                        "joined zones are not made",
                        construction));
      }
      surface.material = lining->second.material;
      surface.emissivity = lining->second.emissivity;
    }
    if (!places_.emplace(folded(name), model_.surfaces.size()).second) item.fail("stands twice");
    return surface;
  }

  [[nodiscard]] Vec3 in_world(const Vec3& corner, const Zone& zone) const {
    if (!is_relative_) return corner;
    return zone.origin + Vec3(std::cos(zone.turn) * corner.x() - std::sin(zone.turn) * corner.y(),
                              std::sin(zone.turn) * corner.x() + std::cos(zone.turn) * corner.y(),
                              corner.z());
  }

  void set_corners(std::vector<Vec3> corners, const Zone& zone, EnergyPlusSurface& surface) const {
    // There normals point out of the zone.
    if (!is_clockwise_) std::reverse(corners.begin(), corners.end());
    for (Vec3& corner : corners) corner = in_world(corner, zone);
    surface.corners = std::move(corners);
  }

  static std::vector<Vec3> listed_corners(const JsonItem& item) {
    const JsonItem list = item.at("vertices");
    std::vector<Vec3> corners;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const JsonItem corner = list[k];
      corners.emplace_back(corner.at("vertex_x_coordinate").number(),
                           corner.at("vertex_y_coordinate").number(),
                           corner.at("vertex_z_coordinate").number());
    }
    if (corners.size() < 3) list.fail("has fewer than three corners");
    return corners;
  }

  void add_surface(const JsonItem& item, const std::string& name) {
    EnergyPlusSurface surface = make_surface(item, name);
    const Zone& zone = zone_of(item);
    surface.enclosure = enclosure_of(item, zone);
    set_corners(listed_corners(item), zone, surface);
    walls_in_.push_back(&zone);
    model_.surfaces.push_back(std::move(surface));
  }

  /// Numbered fields, the fourth corner may be missing; or the list that an .idf gives.
  static std::vector<Vec3> window_corners(const JsonItem& item) {
    if (item.has("vertices")) return listed_corners(item);
    std::vector<Vec3> corners;
    for (int k = 1; k <= 4; ++k) {
      if (k == 4 && !item.has("vertex_4_x_coordinate")) break;
      Vec3 corner;
      for (int axis = 0; axis < 3; ++axis) {
        corner[axis] = item.at(fmt::format("vertex_{}_{}_coordinate", k, "xyz"[axis])).number();
      }
      corners.push_back(corner);
    }
    return corners;
  }

  void add_window(const JsonItem& item, const std::string& name) {
    EnergyPlusSurface window = make_surface(item, name);
    const std::string wanted = word(item, "building_surface_name");
    const auto base = places_.find(folded(wanted));
    if (base == places_.end() || base->second >= model_.surfaces.size() ||
        model_.surfaces[base->second].base >= 0) {
      item.fail(fmt::format("is in the surface \"{}\", which there is not", wanted));
    }
    const double multiplier = number(item, "multiplier", 1);
    if (multiplier != 1) {
      item.fail(fmt::format("has the multiplier {}; expected each window by itself", multiplier));
    }
    window.base = static_cast<int>(base->second);
    window.enclosure = model_.surfaces[base->second].enclosure;
    set_corners(window_corners(item), *walls_in_[base->second], window);
    model_.surfaces.push_back(std::move(window));
  }

  JsonItem root_;
  bool is_clockwise_ = false;
  bool is_relative_ = false;
  std::map<std::string, Zone> zones_;  // these by names in lower case
  std::map<std::string, Space> spaces_;
  std::map<std::string, Lining> linings_;      // of constructions
  std::map<std::string, std::size_t> places_;  // of surfaces in the model
  std::vector<const Zone*> walls_in_;          // of all but windows
  std::size_t n_unlined_ = 0;
  EnergyPlusModel model_;
};

}  // namespace

EnergyPlusModel read_energyplus_model(const std::filesystem::path& path,
                                      const radiosity::Progress& progress) {
  const Json json =
      lower_case_extension(path) == ".idf" ? idf_as_epjson(path, progress) : parse_json(path);
  return ModelReader(json, path).run();
}

}  // namespace io
