#include "radiosity/picture/measured_grid.h"

#include <algorithm>
#include <cassert>
#include <mutex>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/camera_view.h"

namespace radiosity {
namespace {

/// Points along a side of the tiles that are gathered together.
constexpr Index kTilePoints = 8;
/// How far above the plane one looks around, of the grid's size: the plane may be that of a table.
constexpr double kRaised = 1e-4;
/// Share of directions in which a point in a solid meets backs; one outside a convex room meets
/// them in half of them at most.
constexpr double kSurrounded = 0.5;

}  // namespace

PointPlace point_place(const Visibility& visibility, const Vec3& point, const Vec3& normal,
                       const std::optional<Vec3>& down) {
  const auto below = visibility.first_hit(point, -normal);
  const bool is_outside = down && !(*down == -normal ? below : visibility.first_hit(point, *down));
  const PointPlace if_not_inside = is_outside ? PointPlace::outside : PointPlace::open;
  const auto above = visibility.first_hit(point, normal);
  const auto is_back = [](const std::optional<Hit>& hit) { return hit && !hit->front; };
  if (is_back(below) && is_back(above)) return PointPlace::inside;
  if (!is_back(below) && !is_back(above)) return if_not_inside;
  // A solid may stand on the floor without a bottom of its own.
  return surroundings(visibility, point).backs > kSurrounded ? PointPlace::inside : if_not_inside;
}

MeasuredGrid measure(const FinalGather& gather, const Visibility& visibility, const PointGrid& grid,
                     const std::optional<Vec3>& down, const Progress& progress) {
  MeasuredGrid result{.grid = grid,
                      .places = std::vector<PointPlace>(static_cast<std::size_t>(grid.size())),
                      .irradiance = Eigen::MatrixXd::Zero(grid.size(), gather.n_bands())};
  const Vec3 normal = grid.normal();
  const double size = (static_cast<double>(grid.n_columns) * grid.column +
                       static_cast<double>(grid.n_rows) * grid.row)
                          .norm();
  const Index n_across = (grid.n_columns + kTilePoints - 1) / kTilePoints;
  const Index n_along = (grid.n_rows + kTilePoints - 1) / kTilePoints;
  std::mutex mutex;
  Index n_done = 0;
  parallel_for(n_across * n_along, [&](Index tile) {
    progress.check();
    const Index first_column = tile % n_across * kTilePoints;
    const Index first_row = tile / n_across * kTilePoints;
    std::vector<Index> kept;
    std::vector<Vec3> points;
    Index n_points = 0;
    for (Index r = first_row; r < std::min(first_row + kTilePoints, grid.n_rows); ++r) {
      for (Index c = first_column; c < std::min(first_column + kTilePoints, grid.n_columns); ++c) {
        const Index k = r * grid.n_columns + c;
        ++n_points;
        const Vec3 point = grid.point(k);
        PointPlace& place = result.places[static_cast<std::size_t>(k)];
        place = point_place(visibility, point + kRaised * size * normal, normal, down);
        if (place != PointPlace::open) continue;
        kept.push_back(k);
        points.push_back(point);
      }
    }
    const Eigen::MatrixXd irradiance = gather.irradiance(points, normal);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      result.irradiance.row(kept[k]) = irradiance.row(static_cast<Index>(k));
    }
    const std::scoped_lock lock(mutex);
    n_done += n_points;
    if (progress.report) {
      progress.report("points", static_cast<double>(n_done), static_cast<double>(grid.size()), "");
    }
  });
  return result;
}

GridSummary summary(const std::vector<PointPlace>& places, const Eigen::VectorXd& values) {
  assert(static_cast<Index>(places.size()) == values.size());
  GridSummary result;
  for (Index k = 0; k < values.size(); ++k) {
    const PointPlace place = places[static_cast<std::size_t>(k)];
    if (place == PointPlace::inside) ++result.n_inside;
    if (place == PointPlace::outside) ++result.n_outside;
    if (place != PointPlace::open) continue;
    if (result.n == 0 || values[k] < result.least) {
      result.least = values[k];
      result.least_at = k;
    }
    if (result.n == 0 || values[k] > result.greatest) {
      result.greatest = values[k];
      result.greatest_at = k;
    }
    result.mean += values[k];
    ++result.n;
  }
  if (result.n > 0) result.mean /= static_cast<double>(result.n);
  return result;
}

}  // namespace radiosity
