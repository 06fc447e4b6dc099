#include "meshing/patches/patches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshing/base/text.h"
#include "meshing/patches/contact_cuts.h"
#include "meshing/patches/contact_lines.h"
#include "meshing/patches/image_overlap.h"
#include "meshing/patches/patch_builder.h"
#include "radiosity/base/error.h"

namespace meshing {
namespace {

using radiosity::Index;
using radiosity::MeshError;
using radiosity::PatchMesh;
using radiosity::Scene;
using radiosity::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Patches and vertices are numbered by int32.
constexpr double kMaxPatches = std::numeric_limits<std::int32_t>::max();

[[noreturn]] void refuse_polygon(const Scene& scene, Index i, const PolygonShape& shape) {
  const std::string where = source_prefix(scene) + polygon_name(scene, i);
  if (shape.kind == PolygonKind::self_crossing) {
    throw MeshError(where + ": its edges cross each other (a bow tie); expected the corners of a " +
                    "simple polygon in order around it; reorder its corners");
  }
  throw MeshError(where + ": its " + std::to_string(scene.polygon(i).size()) +
                  " corners enclose no area (" + number(shape.vector_area.norm()) +
                  " m² within an extent of " + number(shape.extent) +
                  " m: repeated corners or all on one line); remove it");
}

void measure_polygons(const Scene& scene, const radiosity::Progress& progress, Topology& topology) {
  const WeldedPolygons& polygons = topology.polygons;
  topology.kinds.resize(polygons.size());
  topology.areas.resize(polygons.size());
  std::vector<Vec3> points;
  for (Index i = 0; i < polygons.size(); ++i) {
    if (i % 4096 == 0) progress.check();
    points.clear();
    for (const std::int32_t v : polygons.polygon(i)) points.push_back(polygons.vertices[v]);
    const PolygonShape shape = polygon_shape(points, scene.precision);
    if (shape.kind == PolygonKind::zero_area || shape.kind == PolygonKind::self_crossing) {
      refuse_polygon(scene, i, shape);
    }
    topology.kinds[i] = shape.kind;
    topology.areas[i] = shape.vector_area.norm();
  }
}

Topology make_topology(const Scene& scene, const radiosity::Progress& progress) {
  Topology topology;
  topology.polygons = weld(scene);
  measure_polygons(scene, progress, topology);
  topology.edges = make_edge_table(topology.polygons);
  return topology;
}

/// Fewer are made in no time, and nothing is told of it.
constexpr double kMany = 50'000;

/// Which attempt at a number of patches it is, of how many as far as one knows.
struct Attempts {
  int k = 0;
  int n = 1;

  /// What one attempt tells as a share of all.
  [[nodiscard]] radiosity::Progress progress(const radiosity::Progress& of_all) const {
    radiosity::Progress result{.report = {}, .stop = of_all.stop};
    if (!of_all.report) return result;
    result.report = [k = k, n = std::max(n, k + 1), &of_all](std::string_view stage, double done,
                                                             double total, std::string_view unit) {
      of_all.report(stage, k * total + done, n * total, unit);
    };
    return result;
  }
};

/// Finds the mesh with about n patches, remembering what it has learnt about the scene.
class PatchMaker {
 public:
  PatchMaker(const Scene& scene, const radiosity::Progress& progress)
      : scene_(scene), progress_(progress), topology_(make_topology(scene, progress)) {}

  [[nodiscard]] PatchMesh as_is() const { return with_limit({.coarse = kInfinity}); }
  /// Cut along contact lines, as are those that follow.
  [[nodiscard]] PatchMesh cut_with_limit(const EdgeLimit& limit);
  [[nodiscard]] PatchMesh cut_with_about(double n_patches, double least_edge);

 private:
  [[nodiscard]] PatchMesh with_limit(const EdgeLimit& limit, const Attempts& attempts = {}) const {
    const EdgeDivision division = divide(limit);
    const PatchCount count = count_patches(scene_, topology_, division);
    if (count.certain + count.estimated > kMaxPatches) {
      throw MeshError(source_prefix(scene_) + "a max edge of " + number(limit.coarse) +
                      " m gives about " + number(count.certain + count.estimated) +
                      " patches, but at most 2147483647 are possible; ask for a larger max edge "
                      "or fewer patches");
    }
    const bool is_told = count.certain + count.estimated >= kMany;
    return build_patches(scene_, topology_, division,
                         is_told ? attempts.progress(progress_)
                                 : radiosity::Progress{.report = {}, .stop = progress_.stop});
  }

  [[nodiscard]] PatchMesh cut(const PatchMesh& mesh) const {
    return cut_along_contacts(mesh, lines_, static_cast<Index>(topology_.polygons.vertices.size()),
                              progress_);
  }
  [[nodiscard]] EdgeDivision divide(const EdgeLimit& limit) const {
    return divide_edges(topology_.polygons, topology_.edges, topology_.kinds, limit);
  }
  [[nodiscard]] PatchCount count(const EdgeLimit& limit) const {
    return count_patches(scene_, topology_, divide(limit));
  }
  [[nodiscard]] EdgeLimit limit_for(double n_patches, double fill_factor) const;

  const Scene& scene_;
  const radiosity::Progress& progress_;
  Topology topology_;
  std::vector<std::vector<Segment>> lines_;  // per polygon
};

/// The limit whose expected count is nearest to n_patches, if polygons that are filled get
/// fill_factor times what is estimated.
EdgeLimit PatchMaker::limit_for(double n_patches, double fill_factor) const {
  const auto expected = [&](const EdgeLimit& limit) {
    progress_.check();
    const PatchCount c = count(limit);
    return c.certain + fill_factor * c.estimated;
  };
  double area = 0;
  for (const double a : topology_.areas) area += a;
  double fine = std::sqrt(area / n_patches);
  while (expected({.coarse = fine}) < n_patches) fine /= 2;
  // At the coarsest nothing is divided but for the sake of good angles.
  const double coarsest = std::sqrt(area) * static_cast<double>(topology_.kinds.size());
  double coarse = 2 * fine;
  while (expected({.coarse = coarse}) > n_patches && coarse < coarsest) coarse *= 2;
  constexpr int kHalvings = 30;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = std::sqrt(fine * coarse);
    (expected({.coarse = middle}) > n_patches ? fine : coarse) = middle;
  }

  // Edges of equal or commensurable lengths take the step from `coarse` to `fine` all at once.
  EdgeLimit few{.coarse = coarse, .fine = fine, .n_fine = 0};
  EdgeLimit many{.coarse = coarse, .fine = fine, .n_fine = topology_.edges.size()};
  while (many.n_fine - few.n_fine > 1) {
    EdgeLimit middle = few;
    middle.n_fine += (many.n_fine - few.n_fine) / 2;
    (expected(middle) > n_patches ? many : few) = middle;
  }
  return n_patches - expected(few) <= expected(many) - n_patches ? few : many;
}

PatchMesh PatchMaker::cut_with_limit(const EdgeLimit& limit) {
  lines_ = polygon_contact_lines(as_is());
  return cut(with_limit(limit));
}

PatchMesh PatchMaker::cut_with_about(double n_patches, double least_edge) {
  PatchMesh best = as_is();
  lines_ = polygon_contact_lines(best);
  best = cut(best);
  const auto error = [&](const PatchMesh& m) {
    return std::abs(static_cast<double>(m.size()) - n_patches);
  };
  if (n_patches <= static_cast<double>(best.size())) return best;
  constexpr double kCloseEnough = 0.02;
  constexpr int kAttempts = 4;
  double fill_factor = 1;
  double n_cut = 0;  // how many more there are for being cut
  for (int k = 0; k < kAttempts; ++k) {
    EdgeLimit limit = limit_for(std::max(1.0, n_patches - n_cut), fill_factor);
    if (limit.fine < least_edge) limit = {.coarse = std::max(limit.coarse, least_edge)};
    const PatchCount expected = count(limit);
    // What is filled comes out with a few per cent more than estimated, and once more if that is
    // most of all.
    const bool is_mostly_filled = expected.estimated > n_patches / 2;
    const PatchMesh whole = with_limit(limit, {.k = k, .n = is_mostly_filled ? 2 : 1});
    PatchMesh mesh = cut(whole);
    n_cut = static_cast<double>(mesh.size() - whole.size());
    if (expected.estimated > 0) {
      fill_factor = (static_cast<double>(whole.size()) - expected.certain) / expected.estimated;
    }
    if (error(mesh) < error(best)) best = std::move(mesh);
    if (error(best) <= kCloseEnough * n_patches || limit.coarse == least_edge) break;
    if (expected.estimated == 0 && n_cut == 0) break;
  }
  return best;
}

/// The median of the polygons' longest edges, m.
double usual_length(const Scene& scene) {
  std::vector<double> lengths;
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    const std::span<const std::int32_t> polygon = scene.polygon(i);
    double longest = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3& next = scene.vertices[polygon[(k + 1) % polygon.size()]];
      longest = std::max(longest, (next - scene.vertices[polygon[k]]).norm());
    }
    lengths.push_back(longest);
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

double polygon_area(const Scene& scene, Index i) {
  std::vector<Vec3> corners;
  for (const auto vertex : scene.polygon(i)) corners.push_back(scene.vertices[vertex]);
  return radiosity::vector_area(corners).norm();
}

}  // namespace

PatchOptions make_patch_options(const PatchChoice& choice, const radiosity::Scene& scene,
                                const radiosity::Progress& progress) {
  PatchOptions options{
      .max_edge = choice.max_edge, .n_patches = choice.n_patches, .progress = progress};
  if (choice.adaptive) {
    options.n_patches = std::min(options.n_patches.value_or(kDefaultPatches), kDefaultPatches);
  }
  const bool nothing_said = !options.max_edge && !options.n_patches && !choice.as_is;
  if (!nothing_said) return options;
  const long n_polygons = scene.n_polygons();
  options.n_patches = std::max(kDefaultPatches, n_polygons + kDefaultBeyondPolygons);
  if (n_polygons >= kDefaultPatches) {
    constexpr double kLarge = 2;
    options.least_edge = kLarge * usual_length(scene);
  }
  return options;
}

Index least_patches(const Scene& scene, const PatchOptions& options) {
  Index least = scene.n_polygons();
  if (!options.least_edge) least = std::max<Index>(least, options.n_patches.value_or(0));
  if (options.max_edge) {
    double area = 0;
    for (Index i = 0; i < scene.n_polygons(); ++i) area += polygon_area(scene, i);
    // The largest patch whose edges are no longer than L is the square L².
    const double squares = area / (*options.max_edge * *options.max_edge);
    least = std::max(least, static_cast<Index>(std::min(squares, 1e9)));
  }
  return least;
}

namespace {

PatchMesh make_part(PatchMaker& maker, const PatchOptions& options) {
  if (options.n_patches) {
    return maker.cut_with_about(static_cast<double>(*options.n_patches),
                                options.least_edge.value_or(0));
  }
  if (options.max_edge) return maker.cut_with_limit({.coarse = *options.max_edge});
  return maker.as_is();
}

}  // namespace

PatchMesh make_patches(const Scene& scene, const PatchOptions& options) {
  assert(!(options.max_edge && options.n_patches));
  assert(!options.max_edge || *options.max_edge > 0);
  assert(!options.n_patches || *options.n_patches > 0);
  PatchMaker maker(scene, options.progress);
  if (scene.symmetry.is_none()) return make_part(maker, options);
  std::vector<radiosity::Motion> images = radiosity::image_motions(scene.symmetry);
  PatchMesh polygons = maker.as_is();
  polygons.images = images;
  refuse_overlapping_images(scene, polygons);
  PatchMesh mesh = make_part(maker, options);
  mesh.images = std::move(images);
  return mesh;
}

std::optional<std::string> uncut_warning(const PatchMesh& mesh) {
  const std::vector<Index> crossed = crossed_patches(mesh);
  if (crossed.empty()) return std::nullopt;
  const Index first = crossed[0];
  return std::to_string(crossed.size()) + " of " + std::to_string(mesh.size()) +
         " patches could not be cut where others stand on them or pass through them, one of "
         "surface '" +
         mesh.surface_names[mesh.surface[first]] + "' at " + place(mesh.centroid[first]) +
         ": light may leak there";
}

}  // namespace meshing
