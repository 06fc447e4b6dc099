#include "study/known_factors.h"

#include <fmt/format.h>

#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/base/fingerprint.h"

namespace study {
namespace {

using namespace radiosity;

[[noreturn]] void refuse_known(const KnownFactors& known, const std::string& reason) {
  throw SolveError(fmt::format("{}: {}", known.source, reason));
}

void check_surfaces(const Scene& scene, const KnownFactors& known) {
  const std::vector<std::string>& names = known.mesh.surface_names;
  if (names.size() != scene.surfaces.size()) {
    refuse_known(known, fmt::format("has form factors of {} surfaces, but {} has {}", names.size(),
                                    scene.source, scene.surfaces.size()));
  }
  for (std::size_t s = 0; s < names.size(); ++s) {
    if (names[s] == scene.surfaces[s].name) continue;
    refuse_known(known, fmt::format("has a surface '{}' where {} has '{}'", names[s], scene.source,
                                    scene.surfaces[s].name));
  }
  if (known.mesh.n_polygons() != scene.n_polygons()) {
    refuse_known(known, fmt::format("has form factors of {} polygons, but {} has {}",
                                    known.mesh.n_polygons(), scene.source, scene.n_polygons()));
  }
  if (known.geometry != geometry_fingerprint(scene)) {
    refuse_known(known, fmt::format("has form factors of other polygons than those of {}, or of "
                                    "other digits, precision or symmetry",
                                    scene.source));
  }
}

bool has_choice(const meshing::PatchChoice& choice) {
  return choice.max_edge || choice.n_patches || choice.as_is || choice.adaptive;
}

void check_patches(const Scene& scene, const KnownFactors& known, const StudyOptions& options,
                   const StudyEvents& events) {
  if (!has_choice(options.patches)) return;
  const PatchMesh mesh = meshing::make_patches(
      scene, meshing::make_patch_options(options.patches, scene, events.progress));
  if (mesh.vertices == known.mesh.vertices && mesh.corners == known.mesh.corners) return;
  refuse_known(known, fmt::format("has form factors of {} patches, which are others than the {} of "
                                  "these options; leave them out to take those of the file",
                                  known.mesh.size(), mesh.size()));
}

void check_made(const Scene& scene, const KnownFactors& known, const StudyOptions& options,
                const StudyEvents& events) {
  const bool is_closed = known.transport->report().closed;
  const Closed asked = closedness(scene, options.closed);
  if (asked != Closed::automatic && (asked == Closed::yes) != is_closed) {
    refuse_known(known, is_closed
                            ? "was made for a closed scene, but this one is said to be open"
                            : "was made for an open scene, but this one is said to be closed");
  }
  const double tolerance = factor_tolerance(options);
  if (known.tolerance <= tolerance) return;
  events.warn(
      fmt::format("{}: its form factors were made to a relative error of {:.2g}, more than "
                  "the {:.2g} that is asked",
                  known.source, known.tolerance, tolerance));
}

}  // namespace

std::string geometry_fingerprint(const Scene& scene) {
  Fingerprint fingerprint;
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    fingerprint.add(scene.polygon_surface[i]);
    fingerprint.add(scene.polygon(i).size());
    for (const std::int32_t corner : scene.polygon(i)) fingerprint.add(scene.vertices[corner]);
  }
  for (const Surface& surface : scene.surfaces) {
    fingerprint.add(surface.name);
    fingerprint.add(surface.two_sided);
  }
  fingerprint.add(scene.precision);
  add_symmetry(fingerprint, scene.symmetry);
  return fingerprint.text();
}

void check_known(const Scene& scene, const KnownFactors& known, const StudyOptions& options,
                 const StudyEvents& events) {
  check_surfaces(scene, known);
  check_patches(scene, known, options, events);
  check_made(scene, known, options, events);
}

}  // namespace study
