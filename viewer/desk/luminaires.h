#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"
#include "viewer/desk/desk.h"

namespace viewer {

/// What the luminaires of an emitter give by the mix of now, lm; empty if it is none of them.
std::optional<double> emitter_lumens(const Desk& desk, std::size_t emitter);

/// How long the lines of luminaires are, m: a share of the scene's size.
double luminaire_size(const Session& session);

/// Where a point, m, appears in the picture, x and y in [0, 1] from its top left; may be beyond;
/// empty if it lies behind the camera.
std::optional<Eigen::Vector2d> picture_place(const Desk& desk, const radiosity::Vec3& point);

/// Whether nothing lies before a point, m; it may lie on a surface.
bool is_seen_from_camera(const Desk& desk, const radiosity::Vec3& point);
/// Whether the luminaires are drawn and nothing lies before that one.
bool is_luminaire_seen(const Desk& desk, std::size_t luminaire);

/// The luminaire whose mark is at a place of the picture, if any is.
std::optional<std::size_t> luminaire_at(const Desk& desk, double x, double y);

/// Makes it the one whose photometric solid is shown, or none. Throws std::out_of_range.
void choose_luminaire(Desk& desk, std::optional<std::size_t> luminaire);

/// The first luminaire of an emitter; empty if it has none.
std::optional<std::size_t> first_luminaire(const Desk& desk, std::size_t emitter);

}  // namespace viewer
