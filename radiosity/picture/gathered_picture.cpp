#include "radiosity/picture/gathered_picture.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {
namespace {

/// Pixels along a side of the tiles whose points are gathered together.
constexpr int kTileSide = 16;

/// The rays of one pixel that meet one plane.
struct Share {
  Index pixel;
  std::vector<SurfacePoint> points;
};

/// The mean of a share's points, if all rays of the pixel meet its plane; else the one nearest to
/// it, since the mean itself might be out of sight.
SurfacePoint middle_point(const Share& share, int n_rays) {
  Vec3 mean = Vec3::Zero();
  for (const SurfacePoint& point : share.points) mean += point.position;
  mean /= static_cast<double>(share.points.size());
  const SurfacePoint nearest = *std::min_element(
      share.points.begin(), share.points.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
        return (a.position - mean).squaredNorm() < (b.position - mean).squaredNorm();
      });
  if (share.points.size() < static_cast<std::size_t>(n_rays)) return nearest;
  return {nearest.patch, mean};
}

class GatherRenderer {
 public:
  GatherRenderer(const FinalGather& gather, const Visibility& visibility, const SurfaceLight& light,
                 const Camera& camera, const RenderOptions& options)
      : gather_(gather),
        light_(light),
        rays_(visibility, camera, options.width, options.height, options.samples) {}

  /// Fills the pixels of a tile from (x, y) on.
  void draw_tile(int x, int y, Image& image) const {
    std::vector<Share> shares;
    for (int row = y; row < std::min(y + kTileSide, image.height); ++row) {
      for (int column = x; column < std::min(x + kTileSide, image.width); ++column) {
        add_shares(column, row, image, shares);
      }
    }
    std::vector<SurfacePoint> points;
    for (const Share& share : shares) {
      points.push_back(gather_.settled(middle_point(share, rays_.n_samples())));
    }
    const Eigen::MatrixXd irradiance = gather_.irradiance(points);
    for (std::size_t k = 0; k < shares.size(); ++k) {
      add_light(shares[k], irradiance.row(static_cast<Index>(k)), image);
    }
  }

 private:
  /// Casts a pixel's rays.
  void add_shares(int x, int y, Image& image, std::vector<Share>& shares) const {
    const Index pixel = static_cast<Index>(y) * image.width + x;
    const std::size_t first = shares.size();
    int n_hits = 0;
    for (int k = 0; k < rays_.n_samples(); ++k) {
      const auto seen = rays_.first_front(x, y, k);
      if (!seen) continue;
      ++n_hits;
      auto share =
          std::find_if(shares.begin() + static_cast<std::ptrdiff_t>(first), shares.end(),
                       [&](const Share& candidate) {
                         return gather_.are_coplanar(candidate.points.front().patch, seen->patch);
                       });
      if (share == shares.end()) share = shares.insert(shares.end(), {pixel, {}});
      share->points.push_back(*seen);
    }
    image.alpha[pixel] = static_cast<float>(n_hits) / static_cast<float>(rays_.n_samples());
  }

  void add_light(const Share& share, const Eigen::RowVectorXd& irradiance, Image& image) const {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(irradiance.cols());
    for (const SurfacePoint& point : share.points) {
      const Index patch = point.patch % light_.exitance.rows();  // images have its light
      sum += light_.exitance.row(patch);
      if (const auto texel = light_.textures.at(point.patch, point.position)) {
        sum += texel->matrix().transpose().cwiseProduct(irradiance);
      } else {
        sum += light_.reflectance.row(patch).cwiseProduct(irradiance);
      }
    }
    image.values.row(share.pixel) += (sum / (kPi * rays_.n_samples())).cast<float>();
  }

  const FinalGather& gather_;
  SurfaceLight light_;
  PrimaryRays rays_;
};

}  // namespace

Image render_gathered(const FinalGather& gather, const Visibility& visibility,
                      const SurfaceLight& light, const Camera& camera,
                      const RenderOptions& options) {
  assert(options.width > 0 && options.height > 0 && options.samples > 0);
  const GatherRenderer renderer(gather, visibility, light, camera, options);
  Image image = blank_image(options.width, options.height, light.exitance.cols());
  RowCounter counter(options.progress, options.height);
  const int n_columns = (options.width + kTileSide - 1) / kTileSide;
  const int n_rows = (options.height + kTileSide - 1) / kTileSide;
  std::vector<std::atomic<int>> tiles_done(n_rows);
  parallel_for(std::ptrdiff_t{n_columns} * n_rows, [&](std::ptrdiff_t tile) {
    options.progress.check();
    const auto row = static_cast<int>(tile / n_columns);
    const auto column = static_cast<int>(tile % n_columns);
    renderer.draw_tile(column * kTileSide, row * kTileSide, image);
    if (++tiles_done[row] < n_columns) return;
    counter.add_rows(std::min(kTileSide, options.height - row * kTileSide));
  });
  return image;
}

}  // namespace radiosity
