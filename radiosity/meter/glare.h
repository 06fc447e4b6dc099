#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/meter/photometer.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Guth's position index p of a source in a direction (any length), for somebody who looks along
/// `view` with `up` above: 1 in the line of sight, larger away from it.
/// ln p = (35.2 - 0.31889 τ - 1.22 exp(-2τ/9)) 10⁻³ σ + (21 + 0.26667 τ - 0.002963 τ²) 10⁻⁵ σ²,
/// degrees: σ from the line of sight, τ of the plane of both from the vertical (Guth 1963; Levin
/// 1975). The table of CIE 117 is by up to 12 % off this, which is 0.8 units of UGR. Directions
/// below the line of sight count as those as far above it. Empty beyond what the table covers: a
/// source 1.9 times as high or 3 times as far aside as it is ahead, or behind.
std::optional<double> position_index(const Vec3& direction, const Vec3& view, const Vec3& up);

/// A part of a surface that hangs together and emits, as an observer sees it. Images of a symmetric
/// scene are sources of their own.
struct GlareSource {
  std::string surface;
  double luminance = 0;           ///< mean of what is seen of its own light, cd/m²
  double solid_angle = 0;         ///< of what is seen, exactly, sr
  Vec3 direction = Vec3::Zero();  ///< to its middle, ∫ u dω, unit
  /// Empty: so far from the line of sight that it does not count.
  std::optional<double> position = {};
};

/// Glare by CIE 117: UGR = 8 lg (0.25 / L_b Σ L² ω / p²).
struct Glare {
  double background = 0;  ///< L_b = E_i / π of the indirect illuminance at the eye, cd/m²
  double luminance = 0;   ///< of what the eye looks at, in the line of sight, cd/m²
  std::vector<GlareSource> sources = {};  ///< in the order of the scene

  /// Empty if nothing dazzles, or if it does in a black room.
  [[nodiscard]] std::optional<double> ugr() const;
};

/// CIE 117 is for sources of 0.0003 to 0.1 sr.
inline constexpr double kSmallestGlareSource = 3e-4;
inline constexpr double kLargestGlareSource = 0.1;

/// The glare of the photometer's first light for an observer. Its sources are patches.
Glare find_glare(const Observer& observer, const PatchMesh& mesh, const Photometer& photometer);

}  // namespace radiosity
