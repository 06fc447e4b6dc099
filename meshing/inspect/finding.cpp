#include "meshing/inspect/finding.h"

#include <cassert>

#include "meshing/base/text.h"

namespace meshing {

using radiosity::Index;

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

}  // namespace meshing
