#include "viewer/desk/hidden_surfaces.h"

#include <algorithm>
#include <utility>

namespace viewer {

using radiosity::Hit;
using radiosity::Vec3;

HiddenSurfaces HiddenSurfaces::of(std::vector<bool> flags) {
  HiddenSurfaces hidden;
  if (std::find(flags.begin(), flags.end(), true) != flags.end()) {
    hidden.flags_ = std::make_shared<const std::vector<bool>>(std::move(flags));
  }
  return hidden;
}

HiddenSurfaces HiddenSurfaces::with(std::span<const std::int32_t> surfaces, std::size_t n_surfaces,
                                    bool are_hidden) const {
  std::vector<bool> flags = flags_ ? *flags_ : std::vector<bool>();
  flags.resize(n_surfaces);
  for (const std::int32_t surface : surfaces) {
    flags.at(static_cast<std::size_t>(surface)) = are_hidden;
  }
  return of(std::move(flags));
}

HiddenSurfaces HiddenSurfaces::all_but(std::span<const std::int32_t> surfaces,
                                       std::size_t n_surfaces) {
  std::vector<bool> flags(n_surfaces, true);
  for (const std::int32_t surface : surfaces) flags.at(static_cast<std::size_t>(surface)) = false;
  return of(std::move(flags));
}

std::optional<Hit> first_seen(const radiosity::Visibility& visibility,
                              const radiosity::PatchMesh& mesh, const HiddenSurfaces& hidden,
                              Backs backs, const Vec3& origin, const Vec3& direction) {
  constexpr int kMostSteps = 1000;
  constexpr double kStep = 1e-5;  // beyond a hidden surface, of the way to it
  double passed = 0;
  for (int k = 0; k < kMostSteps; ++k) {
    const Vec3 start = origin + passed * direction;
    std::optional<Hit> hit = backs == Backs::hidden ? visibility.first_front_hit(start, direction)
                                                    : visibility.first_hit(start, direction);
    if (!hit) return std::nullopt;
    if (hidden.is_empty() || !hidden.contains(mesh.surface[hit->patch])) {
      hit->distance += passed;
      return hit;
    }
    passed += std::max(hit->distance, visibility.end_gap()) * (1 + kStep) + visibility.end_gap();
  }
  return std::nullopt;
}

}  // namespace viewer
