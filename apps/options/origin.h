#pragma once

#include <string>
#include <variant>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace apps {

/// A surface element of its own.
struct PointOrigin {
  radiosity::Vec3 point;   ///< m
  radiosity::Vec3 normal;  ///< unit
};

/// What the factors of --from start from: an element, or a surface by its index.
using Origin = std::variant<PointOrigin, std::int32_t>;

/// The surface of that name or else, if it starts with a number and a comma, the element
/// "x,y,z,nx,ny,nz" (m; the normal of any length). Throws CLI::ValidationError if these are not six
/// numbers or the normal is zero, SceneError naming the nearest surface if there is none of that
/// name.
Origin parse_origin(const std::string& text, const radiosity::Scene& scene);

}  // namespace apps
