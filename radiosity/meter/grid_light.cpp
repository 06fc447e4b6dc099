#include "radiosity/meter/grid_light.h"

#include <array>
#include <cstdio>
#include <mutex>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/gather_interpolation.h"

namespace radiosity {
namespace {

/// How far above a point one looks around, of the scene's size.
constexpr double kRaised = 1e-5;

/// One quantity of all points, dark still.
GridQuantity quantity(std::string name, Index n_points, const Photometer& photometer) {
  return {.name = std::move(name),
          .values = Eigen::MatrixXd::Zero(n_points, photometer.n_columns())};
}

void measure_planes(GridLight& result, const Photometer& photometer, const Visibility& visibility,
                    const std::optional<Vec3>& down, double raised, const Progress& progress) {
  GridQuantity& illuminance = result.quantities.front();
  const MeasuringPoints& where = result.where;
  if (where.grid) {
    MeasuredGrid measured = measure(photometer.gather(), visibility, *where.grid, down, progress);
    illuminance.values = std::move(measured.irradiance);
    for (Index k = 0; k < illuminance.values.cols(); k += kLightParts) {
      illuminance.values.col(k + 2) +=
          kInterpolationTolerance * (illuminance.values.col(k) + illuminance.values.col(k + 1));
    }
    result.places = std::move(measured.places);
  } else {
    result.places.resize(where.points.size());
    parallel_for(where.size(), [&](Index k) {
      progress.check();
      const auto i = static_cast<std::size_t>(k);
      const Vec3& normal = where.normals[i];
      result.places[i] = point_place(visibility, where.points[i] + raised * normal, normal, down);
      if (result.places[i] != PointPlace::open) return;
      illuminance.values.row(k) =
          photometer.gather().irradiance(std::span(&where.points[i], 1), normal);
    });
  }
  for (Index k = 0; k < where.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const bool is_off = !where.is_off.empty() && where.is_off[i];
    if (is_off && result.places[i] == PointPlace::open) result.places[i] = PointPlace::outside;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(photometer.n_columns());
    if (result.places[i] == PointPlace::open) {
      row = illuminance.values.row(k);
      photometer.add_incident(where.points[i], where.normals[i], row);
    }
    illuminance.values.row(k) = row;
  }
}

/// All that takes a look around, at each open point.
void measure_around(const GridPlan& plan, GridLight& result, const Photometer& photometer,
                    const Visibility& visibility, double raised, const Progress& progress) {
  const MeasuringPoints& where = result.where;
  const std::size_t first = result.quantities.size();
  for (const Vec3& direction : plan.vertical) {
    result.quantities.push_back(
        quantity(quantity_name("vertical", direction), where.size(), photometer));
  }
  if (plan.is_cylindrical) {
    result.quantities.push_back(quantity("cylindrical", where.size(), photometer));
  }
  for (const Vec3& direction : plan.semi_cylindrical) {
    result.quantities.push_back(
        quantity(quantity_name("semi-cylindrical", direction), where.size(), photometer));
  }
  if (result.quantities.size() == first) return;
  const Vec3 usual = plan.is_list() ? Vec3::UnitZ() : where.normals.front();
  const Vec3 up = plan.up.value_or(usual);
  std::mutex mutex;
  Index n_done = 0;
  parallel_for(where.size(), [&](Index k) {
    progress.check();
    const auto i = static_cast<std::size_t>(k);
    if (result.places[i] == PointPlace::open) {
      const Vec3& point = where.points[i];
      const auto below = visibility.first_hit(point + raised * up, -up);
      const bool is_on_patch = below && below->distance < 2 * raised;
      const auto around =
          photometer.around(point, up, is_on_patch, plan.vertical, plan.semi_cylindrical);
      std::size_t next = first;
      for (Index d = 0; d < around.planes.rows(); ++d) {
        result.quantities[next++].values.row(k) = around.planes.row(d);
      }
      if (plan.is_cylindrical) result.quantities[next++].values.row(k) = around.cylinder;
      for (Index d = 0; d < around.half_cylinders.rows(); ++d) {
        result.quantities[next++].values.row(k) = around.half_cylinders.row(d);
      }
    }
    const std::scoped_lock lock(mutex);
    ++n_done;
    if (progress.report) {
      progress.report("views", static_cast<double>(n_done), static_cast<double>(where.size()),
                      "points");
    }
  });
}

}  // namespace

std::string quantity_name(const char* what, const Vec3& vector) {
  std::array<char, 80> text{};
  (void)std::snprintf(text.data(), text.size(), "%s %.4g,%.4g,%.4g", what, vector.x() + 0.0,
                      vector.y() + 0.0, vector.z() + 0.0);
  return text.data();
}

GridLight measure_grid(const GridPlan& plan, const PatchMesh& mesh, const Visibility& visibility,
                       const Photometer& photometer, const std::optional<Vec3>& down,
                       const Progress& progress) {
  GridLight result{.where = make_measuring_points(plan, mesh), .places = {}, .quantities = {}};
  const double raised = kRaised * bounds(mesh).diagonal().norm();
  result.quantities.push_back(quantity("illuminance", result.where.size(), photometer));
  measure_planes(result, photometer, visibility, down, raised, progress);
  measure_around(plan, result, photometer, visibility, raised, progress);
  return result;
}

}  // namespace radiosity
