#pragma once

#include <span>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// What directions u from the origin to a planar convex polygon that faces it add up to: its
/// corners run counter-clockwise seen from the origin.

/// Ω = ∫ dω, steradian. (Van Oosterom & Strackee 1983, triangle by triangle)
double solid_angle(std::span<const Vec3> polygon);

/// ∫ u dω: for a luminance L, n · ∫ u dω L is what the polygon adds to the illuminance of a plane
/// with the normal n less that of its other side. = -1/2 Σ_k θ_k Γ_k (Lambert 1760)
Vec3 light_vector(std::span<const Vec3> polygon);

/// ∫ sinθ dω with the angle θ between u and an axis of unit length, from which no corner is more
/// than a right angle away: 1/π of it times L is what the polygon adds to the illuminance of a
/// small cylinder about the axis. By Stokes' theorem = -Σ_k a·m_k ∫ (θ - sinθ cosθ) / (2 sin²θ) ds
/// along the arcs that the edges are seen as, with normals m_k; by Gauss' rule in parts so short
/// that it is exact but for 1e-12.
double cylinder_integral(std::span<const Vec3> polygon, const Vec3& axis);

}  // namespace radiosity
