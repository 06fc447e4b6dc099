#pragma once

#include <optional>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace viewer {

/// Which axis of a file points upwards. Programs that make files do not agree.
enum class UpAxis { y, z };

/// "y" or "z".
std::string up_name(UpAxis axis);
/// Empty if it is neither.
std::optional<UpAxis> up_named(const std::string& name);
radiosity::Vec3 up_direction(UpAxis axis);

/// The camera's up axis if there is a camera; else the one across which there is clearly more area,
/// as floors and ceilings have; else y.
UpAxis guessed_up(const radiosity::PatchMesh& mesh, const std::optional<radiosity::Camera>& camera);

/// A camera that sees the whole scene from outside, from the right and above.
radiosity::Camera outside_camera(const radiosity::PatchMesh& mesh, UpAxis up);

}  // namespace viewer
