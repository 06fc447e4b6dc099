#include "apps/run/factors_from.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/options/origin.h"
#include "apps/run/scene_input.h"
#include "meshing/patches/patches.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "study/warnings.h"

namespace apps {
namespace {

using namespace radiosity;

/// What rounding and the kernels of proved pairs may add to the sum of all shares.
constexpr double kUnexplained = 1e-6;
/// A sum that is further off than so many standard errors has another cause.
constexpr double kSigmas = 6;

DestinationEstimate from_point(const PointOrigin& origin, const PatchMesh& polygons,
                               const Progress& progress) {
  const Destinations shares = point_factors(polygons, origin.point, origin.normal, progress);
  return {shares, {Eigen::VectorXd::Zero(shares.surfaces.size())}};
}

DestinationEstimate from_surface(std::int32_t surface, const study::Study& assembled,
                                 const SamplingOptions& options) {
  // Points see fewer, larger polygons sooner than the patches.
  const PatchMesh polygons = meshing::make_patches(assembled.scene, {.progress = options.progress});
  DestinationEstimate shares = sampled_destinations(polygons, surface, options);
  shares.value.surfaces = surface_form_factors(assembled.mesh, *assembled.transport).row(surface);
  shares.error.surfaces =
      surface_form_factor_errors(assembled.mesh, *assembled.transport).row(surface);
  return shares;
}

void warn_of_sum(const DestinationEstimate& shares, const study::StudyEvents& events) {
  const double sigma =
      std::hypot(shares.error.surfaces.norm(), shares.error.backs, shares.error.sky);
  const double excess = shares.value.sum() - 1;
  if (std::abs(excess) <= kUnexplained + kSigmas * sigma) return;
  events.warn(
      fmt::format("the factors add up to {:.6g} instead of 1, more than their errors explain: do "
                  "polygons overlap in one plane? (radiosity inspect tells)",
                  1 + excess));
}

}  // namespace

FactorsFrom compute_factors_from(const std::string& from, const CommonOptions& common,
                                 const study::StudyOptions& compute,
                                 const study::StudyEvents& events) {
  Scene scene = read_checked_scene(common, events);
  FactorsFrom result{from, {}, {}};
  for (const Surface& surface : scene.surfaces) result.surface_names.push_back(surface.name);
  const Origin origin = parse_origin(from, scene);
  if (const auto* point = std::get_if<PointOrigin>(&origin)) {
    study::warn_of_findings(scene, events);
    const PatchMesh polygons = meshing::make_patches(scene, {.progress = events.progress});
    result.shares = from_point(*point, polygons, events.progress);
  } else {
    const study::Study assembled = study::assemble(std::move(scene), compute, events);
    result.shares = from_surface(std::get<std::int32_t>(origin), assembled,
                                 {.seed = compute.seed, .progress = events.progress});
  }
  warn_of_sum(result.shares, events);
  return result;
}

}  // namespace apps
