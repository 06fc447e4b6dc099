#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "viewer/desk/surface_line.h"

namespace viewer {

/// Surfaces that are left out of the picture; light goes as if they were there. Cheap to copy, and
/// what is hidden never changes.
class HiddenSurfaces {
 public:
  [[nodiscard]] bool contains(std::int32_t surface) const {
    return flags_ && static_cast<std::size_t>(surface) < flags_->size() && (*flags_)[surface];
  }
  [[nodiscard]] bool is_empty() const { return !flags_; }
  /// The same with these hidden or not, of so many surfaces.
  [[nodiscard]] HiddenSurfaces with(std::span<const std::int32_t> surfaces, std::size_t n_surfaces,
                                    bool are_hidden) const;
  /// All but these.
  static HiddenSurfaces all_but(std::span<const std::int32_t> surfaces, std::size_t n_surfaces);

  friend bool operator==(const HiddenSurfaces& a, const HiddenSurfaces& b) {
    return a.flags_ == b.flags_;
  }

 private:
  static HiddenSurfaces of(std::vector<bool> flags);

  std::shared_ptr<const std::vector<bool>> flags_;  // per surface; null if none is hidden
};

/// What a camera sees of a mesh: the first patch that a ray meets which is not hidden and, with
/// `backs` hidden, turns its emitting side to it. `direction` of unit length.
std::optional<radiosity::Hit> first_seen(const radiosity::Visibility& visibility,
                                         const radiosity::PatchMesh& mesh,
                                         const HiddenSurfaces& hidden, Backs backs,
                                         const radiosity::Vec3& origin,
                                         const radiosity::Vec3& direction);

}  // namespace viewer
