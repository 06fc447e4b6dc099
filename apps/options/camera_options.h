#pragma once

#include <optional>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// What the command line says of the camera; the rest is as the scene has it.
struct CameraOptions {
  std::optional<std::string> view;           ///< name of one of the scene's views
  std::optional<radiosity::Vec3> position;   ///< m
  std::optional<radiosity::Vec3> look_at;    ///< m; or `direction`
  std::optional<radiosity::Vec3> direction;  ///< of any length but 0
  std::optional<radiosity::Vec3> up;         ///< of any length but 0
  std::optional<double> fov;                 ///< full vertical angle, degrees, in (0, 180)
};

/// Binds the options to the command; `options` must outlive the parsing.
void add_camera_options(CLI::App& command, CameraOptions& options);

/// A camera, and whether anybody said where it stands.
struct ChosenCamera {
  radiosity::Camera camera;
  bool is_placed = true;  ///< false: it was put where all of the scene is in view
};

/// The scene's camera, or the view of its that is named, with the options in place of its parts.
/// Without either a position is found from where all is in view, and a view from a position that is
/// given goes to the middle of the scene. Throws CLI::ValidationError if no view is called so, if
/// the camera is at the point it looks at, or if --up is parallel to the view.
ChosenCamera choose_camera(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                           const CameraOptions& options);

}  // namespace apps
