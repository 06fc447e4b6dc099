#include "radiosity/picture/lightmap.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/picture/patch_interpolation.h"
#include "radiosity/scene/corner_values.h"

namespace radiosity {
namespace {

/// Texels from a point of a polygon to the farthest of the four that it is interpolated between,
/// and a little for rounding.
constexpr double kReach = 1.42;
/// Texels along a side of the tiles whose points are gathered together.
constexpr int kLightTile = 16;

/// The point of a patch that is nearest to one in its plane.
Vec3 nearest_point(const PatchMesh& mesh, Index patch, const Vec3& x) {
  const int n = mesh.n_corners(patch);
  double least = std::numeric_limits<double>::infinity();
  Vec3 nearest = x;
  bool is_inside = true;
  for (int k = 0; k < n; ++k) {
    const Vec3& a = mesh.corner(patch, k);
    const Vec3 edge = mesh.corner(patch, (k + 1) % n) - a;
    if (edge.cross(x - a).dot(mesh.normal[patch]) >= 0) continue;
    is_inside = false;
    const double t = std::clamp(edge.dot(x - a) / edge.squaredNorm(), 0.0, 1.0);
    const Vec3 candidate = a + t * edge;
    const double distance = (candidate - x).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return is_inside ? x : nearest;
}

/// What each texel of a chart shows: points of its patches; patch -1 where it shows nothing.
std::vector<SurfacePoint> points_of(const PatchMesh& mesh, const LightAtlas& atlas,
                                    const AtlasChart& chart) {
  const auto n = static_cast<std::size_t>(chart.width) * static_cast<std::size_t>(chart.height);
  std::vector<SurfacePoint> points(n, {-1, Vec3::Zero()});
  std::vector<double> distances(n, std::pow(kReach * atlas.texel, 2));
  for (const std::int32_t patch : chart.patches) {
    Eigen::AlignedBox2d box;
    for (int k = 0; k < mesh.n_corners(patch); ++k) {
      box.extend(atlas.coordinates(chart, mesh.corner(patch, k)));
    }
    const auto first = [](double low, int from) {
      return std::max(from, static_cast<int>(std::floor(low - kReach)));
    };
    const auto last = [](double high, int end) {
      return std::min(end - 1, static_cast<int>(std::ceil(high + kReach)));
    };
    for (int y = first(box.min().y(), chart.y); y <= last(box.max().y(), chart.y + chart.height);
         ++y) {
      for (int x = first(box.min().x(), chart.x); x <= last(box.max().x(), chart.x + chart.width);
           ++x) {
        const auto place = static_cast<std::size_t>(y - chart.y) * chart.width + (x - chart.x);
        // Inside one patch it is inside no other.
        if (points[place].patch >= 0 && distances[place] == 0) continue;
        const Vec3 middle = atlas.point(chart, x, y);
        const Vec3 nearest = nearest_point(mesh, patch, middle);
        const double distance = (nearest - middle).squaredNorm();
        if (distance >= distances[place]) continue;
        points[place] = {patch, nearest};
        distances[place] = distance;
      }
    }
  }
  return points;
}

void set_texel(const Eigen::RowVectorXd& radiosity, int x, int y, Image& image) {
  const Index pixel = static_cast<Index>(y) * image.width + x;
  image.values.row(pixel) = (radiosity / kPi).cast<float>();
  image.alpha[static_cast<std::size_t>(pixel)] = 1;
}

/// Calls `draw(chart, points of its texels)` for all charts and tells the rows that are done.
template <typename Draw>
void draw_charts(const PatchMesh& mesh, const LightAtlas& atlas, const Progress& progress,
                 const Draw& draw) {
  int n_rows = 0;
  for (const AtlasChart& chart : atlas.charts) n_rows += chart.height;
  RowCounter counter(progress, n_rows);
  parallel_for(std::ssize(atlas.charts), [&](std::ptrdiff_t k) {
    progress.check();
    const AtlasChart& chart = atlas.charts[static_cast<std::size_t>(k)];
    draw(chart, points_of(mesh, atlas, chart));
    counter.add_rows(chart.height);
  });
}

}  // namespace

Image make_lightmap(const PatchMesh& mesh, const LightAtlas& atlas,
                    const Eigen::MatrixXd& radiosity, const RenderOptions& options) {
  assert(radiosity.rows() == mesh.size());
  const Eigen::MatrixXd corners = corner_values(mesh, radiosity, options.crease_angle);
  Image image = blank_image(atlas.width, atlas.height, radiosity.cols());
  draw_charts(mesh, atlas, options.progress,
              [&](const AtlasChart& chart, const std::vector<SurfacePoint>& points) {
                for (std::size_t k = 0; k < points.size(); ++k) {
                  if (points[k].patch < 0) continue;
                  set_texel(interpolate(mesh, corners, points[k].patch, points[k].position),
                            chart.x + static_cast<int>(k) % chart.width,
                            chart.y + static_cast<int>(k) / chart.width, image);
                }
              });
  return image;
}

Image make_gathered_lightmap(const PatchMesh& mesh, const LightAtlas& atlas,
                             const FinalGather& gather, const SurfaceLight& light,
                             const RenderOptions& options) {
  Image image = blank_image(atlas.width, atlas.height, light.exitance.cols());
  const auto draw_tile = [&](const AtlasChart& chart, const std::vector<SurfacePoint>& of_chart,
                             int left, int top) {
    std::vector<SurfacePoint> points;
    std::vector<std::array<int, 2>> places;
    for (int y = top; y < std::min(top + kLightTile, chart.height); ++y) {
      for (int x = left; x < std::min(left + kLightTile, chart.width); ++x) {
        const SurfacePoint& point = of_chart[static_cast<std::size_t>(y) * chart.width + x];
        if (point.patch < 0) continue;
        points.push_back(gather.settled(point));
        places.push_back({chart.x + x, chart.y + y});
      }
    }
    const Eigen::MatrixXd irradiance = gather.irradiance(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Index patch = points[k].patch;
      const Eigen::RowVectorXd received = irradiance.row(static_cast<Index>(k));
      set_texel(light.exitance.row(patch) + light.reflectance.row(patch).cwiseProduct(received),
                places[k][0], places[k][1], image);
    }
  };
  draw_charts(mesh, atlas, options.progress,
              [&](const AtlasChart& chart, const std::vector<SurfacePoint>& points) {
                const int n_columns = (chart.width + kLightTile - 1) / kLightTile;
                const int n_rows = (chart.height + kLightTile - 1) / kLightTile;
                parallel_for(std::ptrdiff_t{n_columns} * n_rows, [&](std::ptrdiff_t tile) {
                  options.progress.check();
                  draw_tile(chart, points, static_cast<int>(tile % n_columns) * kLightTile,
                            static_cast<int>(tile / n_columns) * kLightTile);
                });
              });
  return image;
}

}  // namespace radiosity
