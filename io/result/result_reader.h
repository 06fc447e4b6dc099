#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"

namespace io {

/// A solution as `write` left it in a file.
struct StoredResult {
  radiosity::PatchMesh mesh;
  radiosity::Solution solution;  ///< all but `seconds`, which no file tells
  radiosity::Bands bands;
  std::optional<radiosity::Camera> camera;
  std::vector<std::string> warnings;  ///< what the file does not tell and was made up
};

/// Reads a .vtp that `write` made, or that another program saved with all of its arrays. Vertices,
/// corners and fields are those written, to the last bit; area, normal and centroid are computed
/// from the corners by `add_patch`. Of what older files lack, twins are found by their corners,
/// energies summed over the patches, and bands taken from their number: one is grey, three are RGB;
/// any other number gets 1, 2, 3... for wavelengths and a warning. Throws SceneError naming the
/// file if it is no .vtp, lacks arrays, is of a newer version, is cut off or damaged, or holds
/// values that make no sense.
StoredResult read_result(const std::filesystem::path& path);

}  // namespace io
