#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// What a standard or a client asks of the light; what is absent is not asked for.
struct LightRequirement {
  std::optional<double> mean = {};        ///< maintained E_m, lux, at least
  std::optional<double> uniformity = {};  ///< U_0 = E_min / E_m, at least
  std::optional<double> diversity = {};   ///< U_d = E_min / E_max, at least
  std::optional<double> glare = {};       ///< UGR of every observer, at most
};

/// Points at which light is to be measured: a plane above a surface, a rectangle, or a list.
struct GridPlan {
  std::string name;
  std::string surface = {};    ///< that the plane is parallel to; "" = a rectangle or a list
  double offset = 0;           ///< of the plane from the surface, to its emitting side, m
  Vec3 corner = Vec3::Zero();  ///< of the rectangle, m
  /// From its corner along the sides, at a right angle, m; it looks to side 0 x side 1.
  std::array<Vec3, 2> sides = {Vec3::Zero(), Vec3::Zero()};
  std::vector<Vec3> points = {};   ///< of a list, m; empty otherwise
  std::vector<Vec3> normals = {};  ///< of the sides that are measured, unit, one per point
  double spacing = 0;              ///< m, at most; 0: by EN 12464-1 (`largest_spacing`)
  /// Left out along the edges, m; absent: min(0.5 m, 0.15 of the shorter side) above a surface (EN
  /// 12464-1:2021), 0 in a rectangle.
  std::optional<double> border = {};
  std::optional<Vec3> up = {};      ///< axis of cylinders, unit; absent: the plane's normal, or z
  bool is_cylindrical = false;      ///< whether cylindrical illuminance is measured
  std::vector<Vec3> vertical = {};  ///< directions that planes face, unit
  std::vector<Vec3> semi_cylindrical = {};  ///< directions that half cylinders face, unit
  std::vector<Vec3> luminance_from = {};    ///< eyes that see what is in the way of points, m
  LightRequirement required = {};

  [[nodiscard]] bool is_list() const { return !points.empty(); }
};

/// Somebody who may be dazzled.
struct Observer {
  std::string name;
  Vec3 position = Vec3::Zero();      ///< of the eye, m
  Vec3 direction = Vec3::UnitX();    ///< of view, unit
  Vec3 up = Vec3::UnitZ();           ///< not parallel to that, unit
  std::optional<double> limit = {};  ///< of UGR
};

/// What is to be found out of the light in a scene.
struct LightPlan {
  std::vector<GridPlan> grids = {};
  std::vector<Observer> observers = {};
  /// Of what all lamps emit when new, the share that is left when they are next looked after, (0,
  /// 1]. Materials may have one of their own besides.
  double maintenance_factor = 1;
};

}  // namespace radiosity
