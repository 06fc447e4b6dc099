#include "meshing/inspect.h"

#include <algorithm>
#include <cassert>

#include "meshing/findings.h"
#include "meshing/text.h"

namespace meshing {

using radiosity::Index;
using radiosity::Vec3;

std::string_view kind_name(Finding::Kind kind) {
  switch (kind) {
    case Finding::Kind::degenerate_polygon:
      return "degenerate-polygon";
    case Finding::Kind::duplicate_polygon:
      return "duplicate-polygon";
    case Finding::Kind::coplanar_overlap:
      return "coplanar-overlap";
    case Finding::Kind::non_planar_polygon:
      return "non-planar-polygon";
    case Finding::Kind::non_manifold_edge:
      return "non-manifold-edge";
    case Finding::Kind::flipped_orientation:
      return "flipped-orientation";
    case Finding::Kind::t_junction:
      return "t-junction";
    case Finding::Kind::gap:
      return "gap";
    case Finding::Kind::suspicious_unit:
      return "suspicious-unit";
  }
  assert(false && "unknown kind of finding");
  return "";
}

bool ExaminedScene::emits(Index polygon) const {
  const auto material = static_cast<std::size_t>(scene.surfaces[surface(polygon)].material);
  return material < scene.materials.size() &&
         scene.materials[material].emission.kind != radiosity::Emission::Kind::none;
}

std::vector<Vec3> ExaminedScene::points(Index polygon) const {
  std::vector<Vec3> result;
  for (const std::int32_t v : polygons.polygon(polygon)) result.push_back(polygons.vertices[v]);
  return result;
}

Vec3 ExaminedScene::center(Index polygon) const {
  const std::span<const std::int32_t> corners = polygons.polygon(polygon);
  const Vec3& first = polygons.vertices[corners[0]];
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : corners) sum += polygons.vertices[v] - first;
  return first + sum / static_cast<double>(corners.size());
}

ExaminedScene examine(const radiosity::Scene& scene) {
  ExaminedScene examined{
      .scene = scene, .polygons = weld(scene), .edges = {}, .shapes = {}, .bounds = {}, .size = 0};
  examined.edges = make_edge_table(examined.polygons);
  examined.shapes.reserve(scene.n_polygons());
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    examined.shapes.push_back(polygon_shape(examined.points(i), scene.precision));
  }
  for (const Vec3& p : examined.polygons.vertices) examined.bounds.extend(p);
  if (!examined.bounds.isEmpty()) examined.size = examined.bounds.diagonal().norm();
  return examined;
}

void FindingList::add(Finding::Kind kind, Finding::Severity severity, Index polygon,
                      const std::string& what) {
  const std::int32_t surface = scene_.polygon_surface[polygon];
  const std::string message = polygon_name(scene_, polygon) + ": " + what;
  const auto [entry, is_new] = index_.try_emplace({kind, surface}, findings_.size());
  if (is_new) {
    findings_.push_back({.kind = kind,
                         .severity = severity,
                         .surface = scene_.surfaces[surface].name,
                         .polygon = polygon,
                         .count = 1,
                         .message = message});
    return;
  }
  Finding& known = findings_[entry->second];
  ++known.count;
  if (severity > known.severity) {
    known.severity = severity;
    known.polygon = polygon;
    known.message = message;
  }
}

namespace {

std::vector<Finding> find_suspicious_unit(const ExaminedScene& examined) {
  constexpr double kLargest = 200;    // m
  constexpr double kSmallest = 0.05;  // m
  std::string hint;
  if (examined.size > kLargest) {
    hint = "if the file is in millimetres use --unit mm";
  } else if (examined.size > 0 && examined.size < kSmallest) {
    hint = "if the file is in another unit than metres name it with --unit";
  } else {
    return {};
  }
  Finding finding{.kind = Finding::Kind::suspicious_unit,
                  .severity = Finding::Severity::note,
                  .surface = {},
                  .polygon = -1,
                  .count = 1,
                  .message = "the scene is " + number(examined.size) + " m across; " + hint};
  return {finding};
}

void count_polygons(const ExaminedScene& examined, Inspection& result) {
  const radiosity::Scene& scene = examined.scene;
  result.n_vertices = static_cast<Index>(scene.vertices.size());
  result.n_polygons = scene.n_polygons();
  result.surface_area.assign(scene.surfaces.size(), 0.0);
  result.surface_polygons.assign(scene.surfaces.size(), 0);
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    const std::size_t n = scene.polygon(i).size();
    ++(n == 3 ? result.n_triangles : n == 4 ? result.n_quads : result.n_other);
    result.surface_area[examined.surface(i)] += examined.shapes[i].vector_area.norm();
    ++result.surface_polygons[examined.surface(i)];
  }
  for (const double a : result.surface_area) result.area += a;
}

}  // namespace

Inspection inspect(const radiosity::Scene& scene) {
  const ExaminedScene examined = examine(scene);
  Inspection result;
  count_polygons(examined, result);
  result.bounds = examined.bounds;
  const Closure closure = examine_closure(examined);
  result.closed = closure.closed;
  result.n_boundary_edges = closure.n_boundary_edges;

  for (const auto& find :
       {find_bad_polygons, find_duplicates, find_coplanar_overlaps, find_non_manifold_edges,
        find_flipped_orientation, find_gaps, find_suspicious_unit}) {
    const std::vector<Finding> found = find(examined);
    result.findings.insert(result.findings.end(), found.begin(), found.end());
  }
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return result;
}

std::vector<std::string> serious_findings(const radiosity::Scene& scene) {
  constexpr radiosity::Index kInspectedPolygons = 200'000;
  std::vector<std::string> messages;
  if (scene.n_polygons() > kInspectedPolygons) return messages;
  for (const Finding& finding : inspect(scene).findings) {
    if (finding.severity == Finding::Severity::serious) messages.push_back(finding.message);
  }
  return messages;
}

}  // namespace meshing
