#include "io/mesh/idf_as_epjson.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "io/base/line_reader.h"
#include "io/mesh/idf_objects.h"

namespace io {
namespace {

using Names = std::span<const std::string_view>;

constexpr auto kRulesFields = std::to_array<std::string_view>(
    {"starting_vertex_position", "vertex_entry_direction", "coordinate_system"});
constexpr auto kZoneFields = std::to_array<std::string_view>(
    {"name", "direction_of_relative_north", "x_origin", "y_origin", "z_origin"});
constexpr auto kSpaceFields = std::to_array<std::string_view>({"name", "zone_name"});
constexpr auto kConstructionFields = std::to_array<std::string_view>(
    {"name", "outside_layer", "layer_2", "layer_3", "layer_4", "layer_5", "layer_6", "layer_7",
     "layer_8", "layer_9", "layer_10"});
constexpr auto kMaterialFields =
    std::to_array<std::string_view>({"name", "", "", "", "", "", "thermal_absorptance"});
constexpr auto kNoMassFields =
    std::to_array<std::string_view>({"name", "", "", "thermal_absorptance"});
constexpr auto kGlazingFields =
    std::to_array<std::string_view>({"name", "", "", "", "", "", "", "", "", "", "", "",
                                     "back_side_infrared_hemispherical_emissivity"});
constexpr auto kName = std::to_array<std::string_view>({"name"});
/// Of surfaces up to their corners.
constexpr auto kSurfaceFields = std::to_array<std::string_view>(
    {"name", "surface_type", "construction_name", "zone_name", "space_name",
     "outside_boundary_condition", "outside_boundary_condition_object", "sun_exposure",
     "wind_exposure", "view_factor_to_ground", "number_of_vertices"});
constexpr auto kWindowFields = std::to_array<std::string_view>(
    {"name", "surface_type", "construction_name", "building_surface_name",
     "outside_boundary_condition_object", "view_factor_to_ground", "frame_and_divider_name",
     "multiplier", "number_of_vertices"});

/// Fields that hold numbers; names may look like them.
constexpr auto kNumbers = std::to_array<std::string_view>(
    {"direction_of_relative_north", "x_origin", "y_origin", "z_origin", "thermal_absorptance",
     "back_side_infrared_hemispherical_emissivity", "multiplier"});

struct FixedKind {
  std::string_view type;
  Names names;
};

/// Types whose fields have fixed places.
constexpr auto kKinds = std::to_array<FixedKind>({{"GlobalGeometryRules", kRulesFields},
                                                  {"Zone", kZoneFields},
                                                  {"Space", kSpaceFields},
                                                  {"Construction", kConstructionFields},
                                                  {"Construction:AirBoundary", kName},
                                                  {"Material", kMaterialFields},
                                                  {"Material:NoMass", kNoMassFields},
                                                  {"WindowMaterial:Glazing", kGlazingFields},
                                                  {"WindowMaterial:SimpleGlazingSystem", kName},
                                                  {"InternalMass", kName}});

/// With corners at the end; the first one has a type of surface, which the others are by name.
constexpr auto kSurfaces = std::to_array<std::string_view>(
    {"BuildingSurface:Detailed", "Wall:Detailed", "RoofCeiling:Detailed", "Floor:Detailed"});
constexpr std::string_view kWindows = "FenestrationSurface:Detailed";

/// Surfaces given in other ways than by their corners.
constexpr auto kOthers = std::to_array<std::string_view>(
    {"Wall:Exterior", "Wall:Adiabatic", "Wall:Underground", "Wall:Interzone", "Roof",
     "Ceiling:Adiabatic", "Ceiling:Interzone", "Floor:GroundContact", "Floor:Adiabatic",
     "Floor:Interzone", "Window", "Door", "GlazedDoor", "Window:Interzone", "Door:Interzone",
     "GlazedDoor:Interzone"});

bool is_alike(std::string_view a, std::string_view b) { return folded(a) == folded(b); }

/// What stands where a surface's boundary condition does.
bool is_boundary_condition(const std::string& word) {
  static const std::set<std::string> known = {"adiabatic",
                                              "foundation",
                                              "ground",
                                              "outdoors",
                                              "othersidecoefficients",
                                              "othersideconditionsmodel",
                                              "surface",
                                              "zone",
                                              "space"};
  const std::string lower = folded(word);
  return known.contains(lower) || lower.starts_with("ground");
}

class IdfReader {
 public:
  explicit IdfReader(const std::filesystem::path& path) : path_(path) {}

  Json run(const std::vector<IdfObject>& objects) {
    for (const IdfObject& object : objects) add(object);
    return std::move(json_);
  }

 private:
  [[noreturn]] void fail_at(const IdfObject& object, const std::string& what) const {
    const std::string name = object.fields.empty() ? "" : " \"" + object.fields.front() + "\"";
    fail(fmt::format("{}:{}", path_.string(), object.line),
         fmt::format("{}{} {}", object.type, name, what));
  }

  void add(const IdfObject& object) {
    for (const FixedKind& kind : kKinds) {
      if (is_alike(object.type, kind.type)) return add_fixed(object, kind);
    }
    for (const std::string_view type : kSurfaces) {
      if (is_alike(object.type, type)) return add_surface(object, type);
    }
    if (is_alike(object.type, kWindows)) return add_window(object);
    for (const std::string_view type : kOthers) {
      if (!is_alike(object.type, type)) continue;
      fail_at(object,
              "is given by a starting point; expected corners (BuildingSurface:Detailed, "
              "FenestrationSurface:Detailed)");
    }
  }

  /// The fields of these names, as texts or numbers; empty ones are left out.
  Json fields_of(const IdfObject& object, Names names) const {
    Json fields = Json::object();
    for (std::size_t k = 0; k < std::min(names.size(), object.fields.size()); ++k) {
      const std::string& word = object.fields[k];
      if (names[k].empty() || names[k] == "name" || word.empty()) continue;
      const std::string key(names[k]);
      if (std::find(kNumbers.begin(), kNumbers.end(), key) == kNumbers.end()) {
        fields[key] = word;
        continue;
      }
      const auto value = parse_number<double>(word);
      if (!value || !std::isfinite(*value)) {
        fail_at(object,
                fmt::format("has the {} \"{}\", expected a number", key, word.substr(0, 40)));
      }
      fields[key] = *value;
    }
    return fields;
  }

  void put(const IdfObject& object, std::string_view type, Json fields) {
    const bool is_named = type != "GlobalGeometryRules";
    if (is_named && (object.fields.empty() || object.fields.front().empty())) {
      fail_at(object, "has no name");
    }
    const std::string name = is_named ? object.fields.front() : "GlobalGeometryRules 1";
    if (!names_[std::string(type)].insert(folded(name)).second) {
      fail_at(object, "stands twice");
    }
    json_[std::string(type)][name] = std::move(fields);
  }

  void add_fixed(const IdfObject& object, const FixedKind& kind) {
    put(object, kind.type, fields_of(object, kind.names));
  }

  /// Three coordinates for each corner, in the fields from the given one on.
  Json corners_of(const IdfObject& object, std::size_t first) const {
    const auto& fields = object.fields;
    std::size_t end = fields.size();
    while (end > first && fields[end - 1].empty()) --end;
    if ((end - std::min(first, end)) % 3 != 0 || end < first + 9) {
      fail_at(object, fmt::format("has {} coordinates, expected three for each of at least three "
                                  "corners",
                                  end - std::min(first, end)));
    }
    Json corners = Json::array();
    for (std::size_t k = first; k < end; k += 3) {
      Json corner = Json::object();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = parse_number<double>(fields[k + axis]);
        if (!value || !std::isfinite(*value)) {
          fail_at(object, fmt::format("has a corner at \"{}\", expected a number",
                                      fields[k + axis].substr(0, 40)));
        }
        corner[fmt::format("vertex_{}_coordinate", "xyz"[axis])] = *value;
      }
      corners.push_back(std::move(corner));
    }
    return corners;
  }

  void check_count(const IdfObject& object, std::size_t field, std::size_t n) const {
    const auto told = parse_number<double>(object.fields[field]);
    if (!told || *told == static_cast<double>(n)) return;  // autocalculate
    fail_at(object, fmt::format("has {} corners, and says {}", n, object.fields[field]));
  }

  void add_surface(const IdfObject& object, std::string_view type) {
    std::vector<std::string_view> names(kSurfaceFields.begin(), kSurfaceFields.end());
    if (type != kSurfaces.front()) names.erase(names.begin() + 1);
    const auto condition = static_cast<std::size_t>(
        std::find(names.begin(), names.end(), "outside_boundary_condition") - names.begin());
    const bool has_space =
        condition < object.fields.size() && is_boundary_condition(object.fields[condition]);
    if (!has_space) names.erase(std::find(names.begin(), names.end(), "space_name"));
    if (object.fields.size() < names.size()) fail_at(object, "ends too early");
    Json fields = fields_of(object, names);
    fields["vertices"] = corners_of(object, names.size());
    check_count(object, names.size() - 1, fields["vertices"].size());
    put(object, kSurfaces.front(), std::move(fields));
  }

  void add_window(const IdfObject& object) {
    std::vector<std::string_view> names(kWindowFields.begin(), kWindowFields.end());
    const auto n_coordinates = [&] {
      return static_cast<std::ptrdiff_t>(object.fields.size()) -
             static_cast<std::ptrdiff_t>(names.size());
    };
    // Before 9.0 the name of a shading control stood before that of the frame.
    if (n_coordinates() % 3 == 1) names.insert(names.begin() + 6, "shading_control_name");
    if (object.fields.size() < names.size()) fail_at(object, "ends too early");
    Json fields = fields_of(object, names);
    fields["vertices"] = corners_of(object, names.size());
    check_count(object, names.size() - 1, fields["vertices"].size());
    put(object, kWindows, std::move(fields));
  }

  const std::filesystem::path& path_;
  Json json_ = Json::object();
  std::map<std::string, std::set<std::string>> names_;  // by type, in lower case
};

}  // namespace

Json idf_as_epjson(const std::filesystem::path& path, const radiosity::Progress& progress) {
  return IdfReader(path).run(read_idf_objects(path, progress));
}

}  // namespace io
