#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace io {

/// How Mitsuba is to render; all may be given anew on its command line (-D spp=256).
struct MitsubaOptions {
  int width = 512;   ///< pixels
  int height = 512;  ///< pixels
  int samples = 64;  ///< paths through each pixel
};

/// The meshes that `write_mitsuba` writes beside `path`, "room.0.ply" beside "room.xml": one for
/// each surface that has patches, by its number.
std::vector<std::filesystem::path> mitsuba_meshes(const std::filesystem::path& path,
                                                  const radiosity::PatchMesh& mesh);

/// Writes a scene for the path tracer Mitsuba 3 (.xml): the patches of each surface as binary PLY
/// (m, double), diffuse, black on the back unless they are two-sided, with area lights of the
/// radiance M_e / π where they emit, and the camera. Three bands are `rgb`, one is grey, more are
/// spectra over the wavelengths, which want a spectral variant. `mesh` is of the scene's polygons.
/// Each file is written beside and renamed into place, the .xml last. Throws SceneError if a
/// surface emits to both sides, which area lights do not, has a heat given, is a shield or has a
/// back of its own; OutputError.
void write_mitsuba(const std::filesystem::path& path, const radiosity::Scene& scene,
                   const radiosity::PatchMesh& mesh, const radiosity::Camera& camera,
                   const MitsubaOptions& options = {});

}  // namespace io
