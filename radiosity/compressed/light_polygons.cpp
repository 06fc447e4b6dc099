#include "radiosity/compressed/light_polygons.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "radiosity/compressed/closed_blocks.h"
#include "radiosity/exchange/pair_blockers.h"
#include "radiosity/exchange/polygon_exchange.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {
namespace {

/// Polygons at most that light is taken from exactly, and the error of each pair, in tolerances.
constexpr std::size_t kMostLights = 32;
constexpr double kLightShare = 0.1;

/// The polygon that these patches divide, if it is convex, plane and uncovered; relative to the
/// centre of the prepared mesh.
std::optional<ConvexPolygon> undivided(const ExchangeEvaluator& evaluator, const PatchMesh& mesh,
                                       const std::vector<std::int32_t>& patches) {
  const auto outline = mesh.outline(mesh.polygon[patches[0]]);
  if (outline.size() > kMostCorners) return std::nullopt;
  const PreparedMesh& prepared = evaluator.prepared();
  const HalfSpace& plane = prepared.planes[patches[0]];
  ConvexPolygon polygon;
  for (const Vec3& corner : outline) polygon.push_back(corner - prepared.center);
  if (vector_area(polygon.points()).dot(plane.normal) < 0) {
    std::reverse(&polygon[0], &polygon[0] + polygon.size());
  }
  double area = 0;
  for (const std::int32_t patch : patches) {
    area += mesh.area[patch];
    if (evaluator.coverage().share[patch] > 0 ||
        evaluator.region(patch) != evaluator.region(patches[0])) {
      return std::nullopt;
    }
  }
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3& a = polygon[k];
    const Vec3& b = polygon[(k + 1) % polygon.size()];
    const Vec3& c = polygon[(k + 2) % polygon.size()];
    if (std::abs(plane.normal.dot(a) - plane.offset) > prepared.thickness) return std::nullopt;
    if ((b - a).cross(c - b).dot(plane.normal) < 0) return std::nullopt;
  }
  constexpr double kSameArea = 1e-6;
  if (std::abs(vector_area(polygon.points()).norm() - area) > kSameArea * area) {
    return std::nullopt;
  }
  return polygon;
}

/// Closing changes the exchange with lights, and that put right opens the rows: each time the
/// change is some thousand times smaller.
constexpr int kLightRounds = 2;

bool has_light(const CompressedTransport& transport, const std::vector<std::int32_t>& patches) {
  const auto& known = transport.parts().sources;
  return std::any_of(known.begin(), known.end(),
                     [&](const auto& source) { return source.patches == patches; });
}

/// What a polygon exchanges with each patch, m².
Eigen::VectorXd exchange_with(const CompressedTransport& transport,
                              const std::vector<std::int32_t>& patches) {
  Eigen::VectorXd indicator = Eigen::VectorXd::Zero(transport.size());
  for (const std::int32_t patch : patches) indicator[patch] = 1;
  return transport.apply(indicator).col(0).cwiseProduct(transport.area());
}

/// Adds to the operator, as it stands, what it lacks of the exchange with these polygons.
void set_light(CompressedTransport& transport, const std::vector<LightPolygon>& lights) {
  for (const LightPolygon& light : lights) {
    transport.add_source({light.patches, light.exchange - exchange_with(transport, light.patches)});
  }
}

}  // namespace

std::vector<std::vector<std::int32_t>> emitting_polygons(const PatchMesh& mesh,
                                                         const Eigen::MatrixXd& exitance) {
  if (exitance.size() == 0 || mesh.n_polygons() == 0) return {};
  std::map<std::int32_t, std::vector<std::int32_t>> found;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.size()); ++i) {
    if (!(exitance.row(i).maxCoeff() > 0)) continue;
    // Two-sided polygons have patches of either side.
    const bool is_back = mesh.twin[i] >= 0 && mesh.twin[i] < i;
    found[is_back ? -1 - mesh.polygon[i] : mesh.polygon[i]].push_back(i);
    if (found.size() > kMostLights) return {};
  }
  std::vector<std::vector<std::int32_t>> polygons;
  for (auto& [key, patches] : found) polygons.push_back(std::move(patches));
  return polygons;
}

std::vector<LightPolygon> make_light_polygons(
    const ExchangeEvaluator& evaluator, const PatchMesh& mesh,
    const std::vector<std::vector<std::int32_t>>& polygons, const TransportOptions& options) {
  std::vector<LightPolygon> lights;
  for (const std::vector<std::int32_t>& patches : polygons) {
    const auto polygon = undivided(evaluator, mesh, patches);
    if (!polygon) continue;
    options.progress.check();
    Eigen::VectorXd exchange(mesh.size());
    const int maker =
        options.ranks != nullptr ? static_cast<int>(lights.size()) % options.ranks->size() : 0;
    if (options.ranks == nullptr || options.ranks->rank() == maker) {
      exchange = polygon_exchange(evaluator, *polygon, patches[0], kLightShare * options.tolerance,
                                  options.seed, options.progress);
    }
    lights.push_back({patches, std::move(exchange)});
  }
  if (options.ranks == nullptr) return lights;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    Eigen::VectorXd& exchange = lights[k].exchange;
    options.ranks->broadcast(static_cast<int>(k) % options.ranks->size(),
                             std::as_writable_bytes(std::span(
                                 exchange.data(), static_cast<std::size_t>(exchange.size()))));
  }
  return lights;
}

void close_with_light(CompressedTransport& transport, const std::vector<LightPolygon>& lights,
                      const PatchMesh& mesh, const Visibility& visibility,
                      const TransportOptions& options) {
  set_light(transport, lights);
  const ClosedSums sums = find_closed_sums(transport, mesh, visibility, options);
  close_blocks(transport, sums);
  if (!transport.report().closed || lights.empty()) return;
  for (int round = 0; round < kLightRounds; ++round) {
    set_light(transport, lights);
    close_blocks(transport, sums);
  }
}

void add_missing_light(Transport& transport, const PatchMesh& mesh, const Visibility& visibility,
                       const TransportOptions& options, const Eigen::MatrixXd& exitance) {
  auto* compressed = dynamic_cast<CompressedTransport*>(&transport);
  if (compressed == nullptr) return;
  auto missing = emitting_polygons(mesh, exitance);
  std::erase_if(missing, [&](const auto& patches) { return has_light(*compressed, patches); });
  if (missing.empty()) return;
  const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
  const ExchangeEvaluator evaluator(mesh, visibility, coverage,
                                    {.tolerance = options.tolerance, .seed = options.seed});
  std::vector<LightPolygon> lights = make_light_polygons(evaluator, mesh, missing, options);
  for (const CompressedTransport::Parts::Source& source : compressed->parts().sources) {
    lights.push_back({source.patches, exchange_with(*compressed, source.patches)});
  }
  compressed->set_multipliers({});
  close_with_light(*compressed, lights, mesh, visibility, options);
  find_backs(*compressed, mesh, visibility, options);
}

}  // namespace radiosity
