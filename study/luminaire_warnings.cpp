#include "study/luminaire_warnings.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/luminaire_light.h"

namespace study {
namespace {

using namespace radiosity;

/// Directions that are looked in, even over the sphere.
constexpr int kDirections = 400;

/// The k-th of them: points on a spiral, in steps of the golden angle. (Vogel 1979)
Vec3 spiral_direction(int k) {
  const double z = 1 - (2 * k + 1.0) / kDirections;
  const double angle = k * kPi * (3 - std::sqrt(5.0));
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

/// What is said of a luminaire; "" if it lights something. What a solid covers, as the floor below
/// a cupboard that stands on it, is nothing.
std::string problem_of(const Luminaire& luminaire, const PhotometricWeb& web, const PatchMesh& mesh,
                       const Visibility& visibility, const Coverage& coverage) {
  // Off what it is mounted on.
  const Vec3 origin = luminaire.position - 2 * visibility.end_gap() * luminaire.axes.col(2);
  std::string behind;
  for (int k = 0; k < kDirections; ++k) {
    const Vec3 direction = spiral_direction(k);
    if (intensity(web, luminaire.axes.transpose() * direction) == 0) continue;
    const std::optional<Hit> hit = visibility.first_hit(origin, direction);
    if (!hit) continue;
    const auto patch = static_cast<std::int32_t>(hit->patch % mesh.size());
    if (hit->front && !coverage.is_covered(patch)) return "";
    if (!hit->front) behind = mesh.surface_names[mesh.surface[patch]];
  }
  if (behind.empty()) return "its light meets no surface";
  return fmt::format(
      "its light meets backs only, such as that of '{}': it is outside of the room, or inside of a "
      "solid or a wall",
      behind);
}

}  // namespace

void warn_of_luminaires(const Scene& scene, const PatchMesh& mesh, const Visibility& visibility,
                        const StudyEvents& events) {
  if (!events.warned || scene.luminaires.empty()) return;
  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  for (const Luminaire& luminaire : scene.luminaires) {
    const std::string problem = problem_of(luminaire, scene.photometries[luminaire.photometry].web,
                                           mesh, visibility, coverage);
    if (!problem.empty()) {
      events.warn(fmt::format("luminaire '{}' lights nothing: {}", luminaire.name, problem));
    }
  }
  const LuminaireLight light(scene, mesh);
  if (const auto& cut = light.cut_openings(); !cut.empty()) {
    events.warn(fmt::format(
        "{} of {} luminaires, such as '{}', have a luminous opening that a surface cuts "
        "through, and count as points",
        cut.size(), scene.luminaires.size(), scene.luminaires[cut.front()].name));
  }
}

}  // namespace study
