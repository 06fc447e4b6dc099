// Pictures of surfaces with textures, pixel by pixel against the texels that rays meet.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/picture/gather_interpolation.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/picture/render.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/patch_texture.h"
#include "radiosity/scene/radiometry.h"

namespace radiosity {
namespace {

constexpr int kTexels = 7;
constexpr int kPixels = 60;
constexpr double kFactor = 0.8;

/// Rays and pixels are in single precision.
constexpr double kSingle = 2e-6;

double linear(int byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

/// A board in the plane of x, y, that reflects random texels, and a black lamp above it; turned and
/// moved.
struct Board {
  Board(const std::vector<Vec3>& corners, const std::vector<Eigen::Vector2d>& coordinates,
        const Eigen::Isometry3d& motion)
      : place(motion) {
    std::mt19937_64 random(3);
    for (int k = 0; k < 3 * kTexels * kTexels; ++k) {
      bytes.push_back(static_cast<std::uint8_t>(random() % 256));
    }
    scene.bands.kind = Bands::Kind::rgb;
    scene.materials.resize(2);
    scene.materials[0].name = "board";
    scene.materials[0].reflectance = Eigen::Vector3d::Constant(0.5);
    scene.materials[0].texture =
        Texture{.image = std::make_shared<TextureImage>(kTexels, kTexels, bytes),
                .factor = Eigen::Array3d::Constant(kFactor)};
    scene.materials[1].name = "lamp";
    scene.materials[1].reflectance = Eigen::Vector3d::Zero();
    scene.materials[1].emission = {.kind = Emission::Kind::exitance, .value = emitted};
    scene.surfaces.resize(2);
    scene.surfaces[0].name = "board";
    scene.surfaces[0].material = 0;
    scene.surfaces[1].name = "lamp";
    scene.surfaces[1].material = 1;
    add(corners, 0);
    add(lamp, 1);
    scene.texture_coordinates = coordinates;
    scene.texture_coordinates.resize(coordinates.size() + lamp.size(),
                                     Eigen::Vector2d::Constant(std::nan("")));
    mesh = meshing::make_patches(scene, {.max_edge = 0.6});
    camera.position = place * Vec3(0.2, 0.1, 3);
    camera.direction = place.linear() * Vec3(0, 0, -1);
    camera.up = place.linear() * Vec3(0, 1, 0);
    camera.vertical_fov = 2 * std::atan(1.1 / 3);
  }

  void add(const std::vector<Vec3>& corners, std::int32_t surface) {
    std::vector<std::int32_t> indices;
    for (const Vec3& corner : corners) {
      indices.push_back(static_cast<std::int32_t>(scene.vertices.size()));
      scene.vertices.emplace_back(place * corner);
    }
    scene.add_polygon(indices, surface);
  }

  /// What of the board lies behind the middle of a pixel.
  static Vec3 behind(int column, int row) {
    const double step = 2.2 / kPixels;
    return {0.2 - 1.1 + (column + 0.5) * step, 0.1 + 1.1 - (row + 0.5) * step, 0};
  }

  /// What reflects at texture coordinates; empty near a border of texels.
  [[nodiscard]] std::optional<Eigen::Array3d> texel(const Eigen::Vector2d& coordinate) const {
    const Eigen::Array2d spot = kTexels * (coordinate.array() - coordinate.array().floor());
    const Eigen::Array2d in = spot.floor();
    if ((spot - in).minCoeff() < 1e-3 || (spot - in).maxCoeff() > 1 - 1e-3) return std::nullopt;
    const auto first = 3 * static_cast<std::size_t>(in.y() * kTexels + in.x());
    return kFactor *
           Eigen::Array3d(linear(bytes[first]), linear(bytes[first + 1]), linear(bytes[first + 2]));
  }

  using Coordinates = std::function<Eigen::Vector2d(const Vec3&)>;

  /// Compares both kinds of pictures with `coordinate` of the places that are seen.
  void expect_pictures(const Coordinates& coordinate) const {
    const Visibility visibility(mesh);
    const TextureMap textures(scene, mesh);
    ASSERT_FALSE(textures.is_empty());
    const Eigen::MatrixXd own = exitance(scene, mesh);
    const Eigen::MatrixXd rho = reflectance(scene, mesh);
    const RenderOptions options{.width = kPixels, .height = kPixels, .samples = 1};
    // Light that is the same all over, so that patches of different means have the same.
    const Eigen::MatrixXd even = Eigen::MatrixXd::Ones(mesh.size(), 1) * received.transpose();
    const Image smooth = render_textured(mesh, visibility, own + rho.cwiseProduct(even), own, even,
                                         textures, camera, options);
    const FinalGather gather(mesh, own);
    const Image gathered =
        render_gathered(gather, visibility, {own, rho, textures}, camera, options);
    int n = 0;
    for (int row = 0; row < kPixels; ++row) {
      for (int column = 0; column < kPixels; ++column) {
        const Index pixel = row * kPixels + column;
        if (smooth.alpha[static_cast<std::size_t>(pixel)] == 0) continue;
        const Vec3 x = behind(column, row);
        const auto expected = texel(coordinate(x));
        if (!expected) continue;
        ++n;
        const double factor = point_to_polygon(x, Vec3(0, 0, 1), lamp);
        for (Index c = 0; c < 3; ++c) {
          EXPECT_NEAR(smooth.values(pixel, c), (*expected)[c] * received[c] / kPi, kSingle * 10)
              << x.transpose();
          EXPECT_NEAR(gathered.values(pixel, c), (*expected)[c] * emitted[c] * factor / kPi,
                      kSingle * 10 + kInterpolationTolerance * emitted[c] / kPi)
              << x.transpose();
        }
      }
    }
    EXPECT_GT(n, kPixels * kPixels / 2);
  }

  Eigen::Isometry3d place;
  std::vector<std::uint8_t> bytes;
  std::vector<Vec3> lamp{{-1, -1, 4}, {-1, 1, 4}, {1.5, 1, 4}, {1.5, -1, 4}};
  Eigen::Vector3d emitted{1, 2, 3};
  Eigen::Vector3d received{4, 5, 6};
  Scene scene;
  PatchMesh mesh;
  Camera camera;
};

Eigen::Isometry3d turned() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(2.1, Vec3(1, 2, -1).normalized()));
  motion.pretranslate(Vec3(5, -3, 1));
  return motion;
}

TEST(TexturedPicture, ShowsTexels) {
  for (const Eigen::Isometry3d& place :
       {Eigen::Isometry3d(Eigen::Isometry3d::Identity()), turned()}) {
    // Twice the picture along x, mirrored along y and sheared.
    const auto coordinate = [](const Vec3& x) {
      return Eigen::Vector2d(0.1 + x.x() + 0.2 * x.y(), 0.3 - 0.5 * x.y());
    };
    const std::vector<Vec3> corners{{-1, -1, 0}, {1.4, -1, 0}, {1.4, 1.2, 0}, {-1, 1.2, 0}};
    std::vector<Eigen::Vector2d> coordinates;
    for (const Vec3& corner : corners) coordinates.push_back(coordinate(corner));
    Board(corners, coordinates, place).expect_pictures(coordinate);
  }
}

TEST(TexturedPicture, FollowsTheTrianglesOfAQuad) {
  const std::vector<Vec3> corners{{-1, -1, 0}, {1.4, -1, 0}, {1.4, 1.2, 0}, {-1, 1.2, 0}};
  const std::vector<Eigen::Vector2d> given{{0, 0}, {1, 0}, {0.7, 0.9}, {0.1, 1}};
  const auto coordinate = [&](const Vec3& x) {
    // Barycentric in the triangle from the first corner on whose side of the diagonal it lies.
    const double side = (corners[2] - corners[0]).cross(x - corners[0]).z();
    const std::size_t a = side < 0 ? 1 : 2;
    const Vec3 u = corners[a] - corners[0];
    const Vec3 v = corners[a + 1] - corners[0];
    const double area = u.cross(v).z();
    const double s = (x - corners[0]).cross(v).z() / area;
    const double t = u.cross(x - corners[0]).z() / area;
    return Eigen::Vector2d(given[0] + s * (given[a] - given[0]) + t * (given[a + 1] - given[0]));
  };
  Board(corners, given, turned()).expect_pictures(coordinate);
}

}  // namespace
}  // namespace radiosity
