#pragma once

#include <optional>
#include <string>

#include "radiosity/base/progress.h"

namespace io {

struct ReadOptions {
  /// Unit of the file's coordinates ("m", "mm", "cm", "in", "ft", "km", "um"); overrides what a
  /// JSON scene says. Absent: the JSON scene's `unit`, else metre.
  std::optional<std::string> unit{};
  /// Scene::precision, m; overrides what a JSON scene says. Absent: the JSON scene's `precision`,
  /// else found from the digits of the coordinates.
  std::optional<double> precision{};
  /// Refuse what otherwise is read with a warning: bad polygons, materials that are not there,
  /// bytes after the end.
  bool strict = false;
  radiosity::Progress progress{};
};

/// Metres per unit. Throws SceneError for a unknown name, listing the known ones.
double metres_per_unit(const std::string& unit);

}  // namespace io
