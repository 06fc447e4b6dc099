#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/scene.h"

namespace meshing {

/// Something about a scene that its author should know.
struct Finding {
  enum class Kind {
    degenerate_polygon,
    duplicate_polygon,
    coplanar_overlap,  ///< e.g. a light lying in the plane of a ceiling that has no hole for it
    non_planar_polygon,
    non_manifold_edge,
    flipped_orientation,  ///< normal seems to point the wrong way
    t_junction,
    gap,              ///< boundary edges that almost but not quite meet
    suspicious_unit,  ///< e.g. a room of 500 m: millimetres read as metres
  };
  enum class Severity { note, warning, serious };
  Kind kind;
  Severity severity;
  std::string surface;            ///< name of the surface concerned; empty if the whole scene
  radiosity::Index polygon = -1;  ///< input polygon concerned, file order, or -1
  long count = 1;                 ///< how many like this were found (only the first is described)
  std::string message;            ///< one line: what, where, and what to do about it
};

/// "coplanar-overlap" and so on, for machine-readable output.
std::string_view kind_name(Finding::Kind kind);

/// Gathers findings, one per kind and surface: the first of the most severe ones is described, the
/// others are counted.
class FindingList {
 public:
  explicit FindingList(const radiosity::Scene& scene) : scene_(scene) {}

  /// `what` completes "surface 'x', polygon 3: ".
  void add(Finding::Kind kind, Finding::Severity severity, radiosity::Index polygon,
           const std::string& what);

  [[nodiscard]] std::vector<Finding> take() { return std::move(findings_); }

 private:
  const radiosity::Scene& scene_;
  std::map<std::pair<Finding::Kind, std::int32_t>, std::size_t> index_;
  std::vector<Finding> findings_;
};

}  // namespace meshing
