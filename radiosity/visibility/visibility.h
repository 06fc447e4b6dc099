#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Where a ray first meets a patch.
struct Hit {
  /// Index into the patch mesh; of twins, the one facing the ray. Patch i of image g of a symmetric
  /// part of n patches is i + g n (whole_mesh.h).
  std::int32_t patch = -1;
  double distance = 0;  ///< m
  bool front = false;   ///< whether the ray arrives at the emitting side
};

/// Straight lines between two patches in single precision, relative to Visibility::center(), m.
struct SegmentPacket {
  static constexpr int kSize = 16;
  using Lanes = std::array<float, kSize>;
  alignas(64) std::array<Lanes, 3> from;  ///< x, y, z
  alignas(64) std::array<Lanes, 3> to;
};

/// Answers what blocks a straight line between patches. Immutable after construction; all methods
/// may be called from many threads. Images of the mesh block light and are hit, too; all numbers of
/// patches are those of the whole.
class Visibility {
 public:
  /// Largest number of segments in one call of `blocked`.
  static constexpr int kPacket = SegmentPacket::kSize;

  explicit Visibility(const PatchMesh& mesh);
  ~Visibility();
  Visibility(Visibility&&) noexcept;
  Visibility& operator=(Visibility&&) noexcept;
  Visibility(const Visibility&) = delete;
  Visibility& operator=(const Visibility&) = delete;

  /// The centre of the mesh's box, m.
  [[nodiscard]] const Vec3& center() const;

  /// Bit k is set if the open segment from[k]-to[k] is blocked by a patch other than `source`,
  /// `target` and patches in the plane of one of these. Segments start on patch `source` and end on
  /// patch `target`.
  [[nodiscard]] std::uint32_t blocked(const SegmentPacket& segments, std::int32_t source,
                                      std::int32_t target) const;
  /// The same for at most kPacket segments from[k]-to[k], m.
  [[nodiscard]] std::uint32_t blocked(std::span<const Vec3> from, std::span<const Vec3> to,
                                      std::int32_t source, std::int32_t target) const;

  /// First patch met by the ray from `origin` (m) in `direction` (any length but 0), not counting
  /// patch `source` and those in its plane (-1: none is left out); of patches back to back the one
  /// that faces the ray. Empty if the ray escapes.
  [[nodiscard]] std::optional<Hit> first_hit(const Vec3& origin, const Vec3& direction,
                                             std::int32_t source = -1) const;

  /// First patch whose emitting side the ray meets, as if the others' backs were not there.
  [[nodiscard]] std::optional<Hit> first_front_hit(const Vec3& origin, const Vec3& direction) const;

  /// How close to its ends a segment meets nothing, m.
  [[nodiscard]] double end_gap() const;

  struct Implementation;  ///< private to visibility.cpp

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace radiosity
