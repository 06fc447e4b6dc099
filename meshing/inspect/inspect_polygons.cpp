#include <algorithm>
#include <map>

#include "meshing/base/outline.h"
#include "meshing/base/polygon_shape.h"
#include "meshing/base/text.h"
#include "meshing/inspect/findings.h"

namespace meshing {

using radiosity::Index;
using radiosity::Vec3;
using Kind = Finding::Kind;
using Severity = Finding::Severity;

std::vector<Finding> find_bad_polygons(const ExaminedScene& examined) {
  FindingList findings(examined.scene);
  for (Index i = 0; i < examined.polygons.size(); ++i) {
    const PolygonShape& shape = examined.shapes[i];
    const std::size_t n_given = examined.scene.polygon(i).size();
    if (shape.kind == PolygonKind::zero_area) {
      findings.add(Kind::degenerate_polygon, Severity::serious, i,
                   "its " + std::to_string(n_given) + " corners enclose no area; remove it");
    } else if (has_crossing_outline(shape.kind, examined.points(i))) {
      findings.add(Kind::degenerate_polygon, Severity::serious, i,
                   "its outline crosses or touches itself; reorder its corners or split it");
    } else if (examined.polygons.polygon(i).size() < n_given) {
      findings.add(Kind::degenerate_polygon, Severity::note, i,
                   "a corner repeats the one before it and will be ignored");
    }
  }
  // The worst per surface is the one to describe, so that comes first.
  std::vector<Index> non_planar;
  for (Index i = 0; i < examined.polygons.size(); ++i) {
    const PolygonKind kind = examined.shapes[i].kind;
    if (kind == PolygonKind::non_planar_quad || kind == PolygonKind::non_planar_polygon) {
      non_planar.push_back(i);
    }
  }
  const auto relative = [&](Index i) {
    return examined.shapes[i].deviation / examined.shapes[i].extent;
  };
  std::stable_sort(non_planar.begin(), non_planar.end(),
                   [&](Index a, Index b) { return relative(a) > relative(b); });
  constexpr double kStronglyBent = 1e-2;
  for (const Index i : non_planar) {
    findings.add(Kind::non_planar_polygon,
                 relative(i) > kStronglyBent ? Severity::warning : Severity::note, i,
                 "its corners are up to " + number(examined.shapes[i].deviation) +
                     " m off a plane; it becomes triangles; split it yourself to choose how");
  }
  return findings.take();
}

std::vector<Finding> find_duplicates(const ExaminedScene& examined) {
  FindingList findings(examined.scene);
  std::vector<std::pair<Outline, Index>> sorted;
  sorted.reserve(examined.polygons.size());
  for (Index i = 0; i < examined.polygons.size(); ++i) {
    if (examined.is_usable(i)) sorted.emplace_back(outline(examined.polygons.polygon(i)), i);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first.corners < b.first.corners; });
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    const auto& [outline_a, a] = sorted[k - 1];
    const auto& [outline_b, b] = sorted[k];
    if (outline_a.corners != outline_b.corners) continue;
    const std::string other = polygon_name(examined.scene, a);
    const bool either_two_sided = examined.is_two_sided(a) || examined.is_two_sided(b);
    if (outline_a.reversed == outline_b.reversed || either_two_sided) {
      findings.add(Kind::duplicate_polygon, Severity::serious, b,
                   "it is the same as " + other + "; remove one of them");
    } else {
      findings.add(
          Kind::duplicate_polygon, Severity::note, b,
          "it lies back-to-back with " + other + "; a thin wall is better one two-sided surface");
    }
  }
  return findings.take();
}

}  // namespace meshing
