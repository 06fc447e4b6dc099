#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/picture/rgb_picture.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/scene.h"

namespace viewer {

/// A scene that comes with the program.
struct Example {
  std::string path;
  std::string name;                                    ///< the file's, until it has been read
  std::string description;                             ///< likewise ""
  std::shared_ptr<const io::RgbPicture> picture = {};  ///< null until it is made
};

/// Size of their pictures, pixels.
inline constexpr int kExampleWidth = 240;
inline constexpr int kExampleHeight = 180;

/// The .json files of a folder, sorted by name; none if it cannot be read.
std::vector<Example> find_examples(const std::filesystem::path& folder);

/// A small picture of a scene from its camera, by a few shots of light in few patches: the light
/// as the eye sees it or, where surfaces radiate by heat, the radiosity in false colour. The same
/// each time. Throws MeshError, SolveError, Interrupted.
io::RgbPicture example_picture(const radiosity::Scene& scene, const radiosity::Progress& progress);

}  // namespace viewer
