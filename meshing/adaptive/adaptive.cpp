#include "meshing/adaptive/adaptive.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "meshing/adaptive/refinable_mesh.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/patch_texture.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/refinement.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve_conditions.h"
#include "radiosity/visibility/incident_light.h"
#include "radiosity/visibility/sun_edges.h"

namespace meshing {
namespace {

using namespace radiosity;

/// About so many patches to start from, unless the scene has more polygons.
constexpr long kFirstPatches = 400;
/// At most this share of the patches is spent on the start.
constexpr long kFirstShare = 4;
/// What a round divides holds this share of the squared error at most.
constexpr double kLargestShare = 0.8;
constexpr int kMaxRounds = 40;
/// A patch that is divided makes so many more.
constexpr long kPartsMore = 3;
/// At most this share of the patches is spent on textures, ...
constexpr long kTextureShare = 4;
/// The part of them that may be spent on the edges of the sun's shadows, and on textures.
constexpr long kSunShare = 3;
/// Tolerances that the sun's light may be off within patches: what leaves them as a whole is exact,
/// so that it is the picture that suffers, which refinement_indicator weighs by 1/100, squared.
constexpr double kSunTolerances = 10;
/// ... where their reflectance varies by more than that (standard deviation).
constexpr double kTextureDeviation = 0.05;
/// Of the solutions on the way.
constexpr double kSolveTolerance = 1e-5;
/// Dense operators may take this part of the memory each: one is made from another, and is larger
/// than was asked for, since neighbours are divided, too.
constexpr std::size_t kDenseOperators = 3;
/// Compressed ones may take this share: with what patches that can be divided take there are 6.4 kB
/// a patch, and some more patches than were asked for.
constexpr double kCompressedShare = 0.4;
/// Patches are numbered by int32, and there may be more than were asked for.
constexpr double kMostPatches = 1e9;

/// The patches of a moment with their form factors and radiosity.
struct Stage {
  Visibility visibility;
  TransportKind kind = TransportKind::dense;
  std::unique_ptr<Transport> transport = nullptr;
  Solution solution = {};
};

class Refiner {
 public:
  Refiner(const Scene& scene, const AdaptiveOptions& options)
      : scene_(scene),
        options_(options),
        memory_(options.transport.memory > 0 ? options.transport.memory : usable_memory()),
        max_patches_(most_patches()),
        patches_(
            make_patches(scene, {.n_patches = first_patches(), .progress = options.progress})) {}

  AdaptiveMesh run() {
    const auto start = std::chrono::steady_clock::now();
    follow_textures();
    follow_sun();
    Stage stage = make_stage(nullptr, {});
    AdaptiveMesh result{.mesh = {}, .visibility = Visibility(PatchMesh{}), .transport = nullptr};
    for (;; ++result.refinement.n_rounds) {
      result.refinement.error = estimated_error(stage);
      result.refinement.is_accurate = result.refinement.error <= options_.tolerance;
      if (result.refinement.is_accurate || result.refinement.n_rounds == kMaxRounds) break;
      const std::vector<Index> marked =
          patches_to_refine(refinement_indicator(patches_.mesh(), *stage.transport, stage.solution,
                                                 options_.progress),
                            share_to_refine(result.refinement.error), affordable(max_patches_));
      if (marked.empty()) break;
      const std::vector<std::int32_t> earlier = patches_.refine(marked);
      std::unique_ptr<Transport> transport = std::move(stage.transport);
      stage = {Visibility(PatchMesh{})};  // out of the way before the next is made
      stage = make_stage(std::move(transport), earlier);
    }
    if (stage.kind == TransportKind::dense) make_closed(stage);
    result.transport = std::move(stage.transport);
    result.mesh = patches_.mesh();
    result.visibility = std::move(stage.visibility);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result.refinement.seconds = elapsed.count();
    return result;
  }

 private:
  /// Divides patches within which a texture varies, those first that matter most, before any form
  /// factor is made: what their light does to others would tell nothing of it.
  void follow_textures() {
    const long most = max_patches_ / kTextureShare;
    while (patches_.mesh().size() < most) {
      const PatchMesh& mesh = patches_.mesh();
      const Eigen::VectorXd deviation = texture_deviation(scene_, mesh);
      std::vector<Index> marked;
      for (Index i = 0; i < deviation.size(); ++i) {
        if (deviation[i] > kTextureDeviation) marked.push_back(i);
      }
      if (marked.empty()) return;
      std::stable_sort(marked.begin(), marked.end(), [&](Index a, Index b) {
        return mesh.area[a] * square(deviation[a]) > mesh.area[b] * square(deviation[b]);
      });
      const Index most_marked = std::max<Index>(1, affordable(most));
      if (static_cast<Index>(marked.size()) > most_marked) marked.resize(most_marked);
      patches_.refine(marked);
    }
  }

  /// Divides patches that edges of the sun's shadows cut, those first that matter most, likewise,
  /// until the sun's light that is reflected at first is right to ten tolerances, as a root mean
  /// square over all places.
  void follow_sun() {
    if (!scene_.sun) return;
    const long most = max_patches_ / kSunShare;
    while (patches_.mesh().size() < most) {
      const PatchMesh& mesh = patches_.mesh();
      const SunEdges edges = find_sun_edges(scene_, mesh, options_.progress);
      std::vector<std::pair<double, Index>> cut;  // squared errors
      double left = 0;
      double area = 0;
      for (Index i = 0; i < mesh.size(); ++i) {
        const double error = mesh.area[i] * square(edges.deviation[i]);
        area += mesh.area[i];
        left += error;
        if (error > 0) cut.emplace_back(-error, i);
      }
      std::sort(cut.begin(), cut.end());
      // A patch that is divided has half of its squared error or less.
      const double allowed = area * square(kSunTolerances * options_.tolerance * edges.typical);
      const Index most_marked = std::max<Index>(1, affordable(most));
      std::vector<Index> marked;
      for (const auto& [error, i] : cut) {
        if (left <= allowed || static_cast<Index>(marked.size()) == most_marked) break;
        left += error / 2;
        marked.push_back(i);
      }
      if (marked.empty()) return;
      std::sort(marked.begin(), marked.end());
      patches_.refine(marked);
    }
  }

  [[nodiscard]] long first_patches() const {
    return std::max(1L, std::min(kFirstPatches, max_patches_ / kFirstShare));
  }

  /// Patches for which there is memory, or fewer if fewer were asked for. A dense operator is made
  /// from the one before, so both must fit, with some patches more than so many: neighbours are
  /// divided, too.
  [[nodiscard]] long most_patches() const {
    const long dense = largest_problem(memory_ / kDenseOperators);
    const double limit = kCompressedShare * static_cast<double>(memory_limit(memory_));
    const auto compressed = static_cast<long>(
        std::min(limit / static_cast<double>(compressed_transport_bytes(1)), kMostPatches));
    const long fits =
        options_.choice.by_rows || options_.choice.kind == TransportKind::dense ? dense
        : options_.choice.kind == TransportKind::compressed                     ? compressed
                                                            : std::max(dense, compressed);
    return std::min(options_.max_patches, fits);
  }

  /// Bytes left for another operator; 0 if nobody knows.
  [[nodiscard]] std::size_t memory_beside(const Transport* earlier) const {
    if (memory_ == 0) return 0;
    const std::size_t taken = earlier != nullptr ? earlier->bytes() : 0;
    return memory_ > taken ? memory_ - taken : 1;
  }

  /// Of the patches as they are; `earlier` is the operator of those before, if there were any, and
  /// `same` what they were in it.
  [[nodiscard]] Stage make_stage(std::unique_ptr<Transport> earlier,
                                 const std::vector<std::int32_t>& same) const {
    const PatchMesh& mesh = patches_.mesh();
    const TransportOptions& asked = options_.transport;
    Stage stage{Visibility(mesh)};
    stage.kind =
        chosen_kind(options_.choice, mesh.size(), asked.tolerance, memory_ / kDenseOperators);
    const bool is_dense = stage.kind == TransportKind::dense;
    if (!is_dense) earlier.reset();
    TransportOptions transport = asked;
    transport.closed = is_dense ? Closed::no : asked.closed;
    transport.known = {earlier.get(), same};
    transport.memory = memory_beside(earlier.get());
    const Eigen::MatrixXd incident = incident_irradiance(scene_, mesh, options_.progress);
    const Eigen::MatrixXd emitted = exitance(scene_, mesh).cwiseAbs();
    const Eigen::MatrixXd rho = reflectance(scene_, mesh);
    const ExpectedLight light{initial_radiosity(emitted, rho, incident), rho, emitted};
    stage.transport = make_transport(mesh, stage.visibility, transport, choice(stage.kind), light);
    SolveOptions solving;
    solving.tolerance = kSolveTolerance;
    solving.estimates_errors = false;
    solving.progress = options_.progress;
    const Conditions conditions = make_conditions(scene_, mesh, *stage.transport, incident);
    solving = with_conditions(std::move(solving), conditions, conditions.exitance.cols());
    stage.solution = solve(mesh, *stage.transport, conditions, solving);
    return stage;
  }

  [[nodiscard]] TransportChoice choice(TransportKind kind) const {
    return {.kind = kind, .by_rows = options_.choice.by_rows};
  }

  /// Makes a dense operator once more with all pairs known, to be closed if the scene is.
  void make_closed(Stage& stage) const {
    std::vector<std::int32_t> same(patches_.mesh().size());
    std::iota(same.begin(), same.end(), 0);
    TransportOptions last = options_.transport;
    last.known = {stage.transport.get(), same};
    last.memory = memory_beside(stage.transport.get());
    stage.transport =
        make_transport(patches_.mesh(), stage.visibility, last, choice(TransportKind::dense));
  }

  [[nodiscard]] double estimated_error(const Stage& stage) const {
    return kErrorMargin * discretisation_error(patches_.mesh(), *stage.transport, stage.solution,
                                               options_.progress)
                              .relative;
  }

  /// Share of the squared error to be got rid of, a little more than is asked.
  [[nodiscard]] double share_to_refine(double error) const {
    const double left = options_.tolerance / error;
    return std::min(kLargestShare, 1.1 * (1 - left * left));
  }

  /// How many patches may be divided for `most` in all.
  [[nodiscard]] Index affordable(long most) const {
    return std::max<Index>(0, (most - patches_.mesh().size()) / kPartsMore);
  }

  const Scene& scene_;
  const AdaptiveOptions& options_;
  std::size_t memory_;  // bytes for operators; 0 if the machine does not tell
  long max_patches_;
  RefinableMesh patches_;
};

}  // namespace

AdaptiveMesh make_adaptive_patches(const Scene& scene, const AdaptiveOptions& options) {
  return Refiner(scene, options).run();
}

}  // namespace meshing
