#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "radiosity/patch_mesh.h"

namespace radiosity {

/// Where a ray first meets a patch.
struct Hit {
  std::int32_t patch = -1;  ///< index into the patch mesh; of twins, the one facing the ray
  double distance = 0;      ///< m
  bool front = false;       ///< whether the ray arrives at the emitting side
};

/// Answers what blocks a straight line between patches. Immutable after construction; all methods
/// may be called from many threads.
class Visibility {
 public:
  /// Largest number of segments in one call of `blocked`.
  static constexpr int kPacket = 16;

  explicit Visibility(const PatchMesh& mesh);
  ~Visibility();
  Visibility(Visibility&&) noexcept;
  Visibility& operator=(Visibility&&) noexcept;
  Visibility(const Visibility&) = delete;
  Visibility& operator=(const Visibility&) = delete;

  /// Bit k is set if the open segment from[k]-to[k] is blocked by a patch other than `source`,
  /// `target` and patches in the plane of one of these. At most kPacket segments, coherent ones
  /// for speed. from[k] lies on patch `source`, to[k] on patch `target`, m.
  [[nodiscard]] std::uint32_t blocked(std::span<const Vec3> from, std::span<const Vec3> to,
                                      std::int32_t source, std::int32_t target) const;

  /// First patch met by the ray from `origin` (m) in `direction` (any length but 0), not counting
  /// patch `source` and those in its plane (-1: none is left out). Empty if the ray escapes.
  [[nodiscard]] std::optional<Hit> first_hit(const Vec3& origin, const Vec3& direction,
                                             std::int32_t source = -1) const;

  /// First patch whose emitting side the ray meets, as if the others' backs were not there.
  [[nodiscard]] std::optional<Hit> first_front_hit(const Vec3& origin, const Vec3& direction) const;

  struct Implementation;  ///< private to visibility.cpp

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace radiosity
