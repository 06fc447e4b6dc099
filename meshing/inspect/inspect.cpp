#include "meshing/inspect/inspect.h"

#include <algorithm>
#include <cassert>

#include "meshing/base/text.h"
#include "meshing/inspect/findings.h"
#include "radiosity/scene/patch_mesh.h"

namespace meshing {

using radiosity::Index;
using radiosity::Vec3;

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
    if (finding.severity != Finding::Severity::serious) continue;
    const std::string more =
        finding.count > 1 ? " (and " + std::to_string(finding.count - 1) + " more like this)" : "";
    messages.push_back(finding.message + more);
  }
  return messages;
}

std::optional<std::string> overlap_finding(const radiosity::Scene& scene) {
  const ExaminedScene examined = examine(scene);
  for (const auto& find : {find_coplanar_overlaps, find_duplicates}) {
    for (const Finding& finding : find(examined)) {
      if (finding.severity == Finding::Severity::serious) return finding.message;
    }
  }
  return std::nullopt;
}

}  // namespace meshing
