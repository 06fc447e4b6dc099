#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "radiosity/scene/scene.h"

namespace io {

/// Finds and makes the surfaces of a mesh file. A surface is identified by the name of its object
/// and its material; it gets the object's name, or `name:material` where another surface has that
/// already. Polygons outside any object are named after their material or else `default_name`.
class SurfaceIndex {
 public:
  /// `scene` must outlive the index, which appends to scene.surfaces.
  SurfaceIndex(radiosity::Scene& scene, std::string default_name)
      : scene_(scene), default_name_(std::move(default_name)) {}

  /// The surface of object `object` (empty: none) with `material`, an index into scene.materials
  /// or -1 for none; `wanted` is then the name of a material that is not there, if any. Makes it
  /// if it is new.
  std::int32_t find_or_add(const std::string& object, int material, const std::string& wanted = {});

  /// `wanted`, or if that is taken `wanted-2`, `wanted-3`...
  [[nodiscard]] std::string unused_name(const std::string& wanted);

 private:
  radiosity::Scene& scene_;
  std::string default_name_;
  std::map<std::tuple<std::string, int, std::string>, std::int32_t> surfaces_;
  std::set<std::string> names_;
  std::map<std::string, int> last_number_;  // by name: all -2 to -last_number are taken
};

}  // namespace io
