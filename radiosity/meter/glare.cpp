#include "radiosity/meter/glare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "radiosity/base/disjoint_sets.h"
#include "radiosity/polygon/directions_to_polygon.h"

namespace radiosity {
namespace {

/// Where the table of position indices ends: height and distance aside over distance ahead.
constexpr double kHighest = 1.9;
constexpr double kFurthestAside = 3;

constexpr Index kDirect = static_cast<Index>(LightPart::direct);
constexpr Index kIndirect = static_cast<Index>(LightPart::indirect);

/// Of each patch the least one that it hangs together with by patches of its surface that emit.
std::vector<Index> luminous_parts(const PatchMesh& mesh, const Eigen::MatrixXd& exitance) {
  DisjointSets sets(mesh.size());
  std::map<std::tuple<std::int32_t, double, double, double>, Index> at_corner;
  std::map<std::pair<std::int32_t, std::int32_t>, Index> of_polygon;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!(exitance(i, kDirect) > 0)) continue;
    const std::int32_t surface = mesh.surface[i];
    const auto polygon = of_polygon.emplace(std::pair(surface, mesh.polygon[i]), i);
    if (!polygon.second) sets.join(i, polygon.first->second);
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const Vec3& x = mesh.corner(i, k);
      const auto corner = at_corner.emplace(std::tuple(surface, x[0], x[1], x[2]), i);
      if (!corner.second) sets.join(i, corner.first->second);
    }
  }
  std::vector<Index> parts;
  for (Index i = 0; i < mesh.size(); ++i) parts.push_back(sets.find(i));
  return parts;
}

/// Whether a direction from the origin meets a polygon that faces it.
bool is_met(const Vec3& direction, std::span<const Vec3> polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& next = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    if (polygon[k].cross(next).dot(direction) > 0) return false;
  }
  return true;
}

/// What is seen of a source, added up.
struct SeenSource {
  double solid_angle = 0;
  double brightness = 0;  // ∫ L dω
  Vec3 vector = Vec3::Zero();
};

}  // namespace

std::optional<double> position_index(const Vec3& direction, const Vec3& view, const Vec3& up) {
  const Vec3 right = view.cross(up).normalized();
  const Vec3 above = right.cross(view);
  const double ahead = direction.dot(view);
  const double height = std::abs(direction.dot(above));
  const double aside = std::abs(direction.dot(right));
  if (!(ahead > 0) || height > kHighest * ahead || aside > kFurthestAside * ahead) {
    return std::nullopt;
  }
  constexpr double kDegrees = 180 / kPi;
  const double sigma = kDegrees * std::atan2(std::hypot(height, aside), ahead);
  const double tau = kDegrees * std::atan2(aside, height);
  return std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2 * tau / 9)) * 1e-3 * sigma +
                  (21 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
}

std::optional<double> Glare::ugr() const {
  double sum = 0;
  for (const GlareSource& source : sources) {
    if (source.position) {
      sum += square(source.luminance / *source.position) * source.solid_angle;
    }
  }
  if (!(sum > 0 && background > 0)) return std::nullopt;
  return 8 * std::log10(0.25 / background * sum);
}

Glare find_glare(const Observer& observer, const PatchMesh& mesh, const Photometer& photometer) {
  const Eigen::MatrixXd& exitance = photometer.exitance();
  const std::vector<Index> parts = luminous_parts(mesh, exitance);
  std::map<Index, SeenSource> seen;  // by the least patch of a part, of the whole mesh
  Glare result;
  double indirect = 0;
  photometer.gather().look(
      observer.position, observer.direction, [&](std::int32_t patch, std::span<const Vec3> piece) {
        const Index i = patch % mesh.size();
        const Vec3 vector = light_vector(piece);
        indirect += exitance(i, kIndirect) / kPi * observer.direction.dot(vector);
        if (is_met(observer.direction, piece)) {
          result.luminance = (exitance(i, kDirect) + exitance(i, kIndirect)) / kPi;
        }
        if (!(exitance(i, kDirect) > 0)) return;
        SeenSource& source = seen[patch - i + parts[static_cast<std::size_t>(i)]];
        const double angle = solid_angle(piece);
        source.solid_angle += angle;
        source.brightness += exitance(i, kDirect) / kPi * angle;
        source.vector += vector;
      });
  result.background = indirect / kPi;
  for (const auto& [patch, source] : seen) {
    if (!(source.solid_angle > 0)) continue;
    const Vec3 direction = source.vector.normalized();
    result.sources.push_back(
        {.surface = mesh.surface_names[mesh.surface[patch % mesh.size()]],
         .luminance = source.brightness / source.solid_angle,
         .solid_angle = source.solid_angle,
         .direction = direction,
         .position = position_index(direction, observer.direction, observer.up)});
  }
  return result;
}

}  // namespace radiosity
