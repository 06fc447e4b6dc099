#include "meshing/adaptive/adaptive.h"

#include <algorithm>
#include <chrono>

#include "meshing/adaptive/refinable_mesh.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/refinement.h"
#include "radiosity/solve/solution.h"

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
/// What is asked is to be met by an estimate that may itself be half as much again.
constexpr double kMargin = 1.5;
/// Of the solutions on the way.
constexpr double kSolveTolerance = 1e-5;

/// The patches of a moment with their form factors and radiosity.
struct Stage {
  Visibility visibility;
  std::unique_ptr<Transport> transport;
  Solution solution;
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
    Stage stage = make_stage({});
    AdaptiveMesh result{.mesh = {}, .visibility = Visibility(PatchMesh{}), .transport = nullptr};
    for (;; ++result.refinement.n_rounds) {
      result.refinement.error = estimated_error(stage);
      result.refinement.is_accurate = result.refinement.error <= options_.tolerance;
      if (result.refinement.is_accurate || result.refinement.n_rounds == kMaxRounds) break;
      const std::vector<Index> marked =
          patches_to_refine(refinement_indicator(patches_.mesh(), *stage.transport, stage.solution,
                                                 options_.progress),
                            share_to_refine(result.refinement.error), affordable());
      if (marked.empty()) break;
      const std::vector<std::int32_t> earlier = patches_.refine(marked);
      stage = make_stage({stage.transport.get(), earlier});
    }
    // Once more with all pairs known, to be closed if the scene is.
    std::vector<std::int32_t> same(patches_.mesh().size());
    for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::int32_t>(i);
    TransportOptions last = options_.transport;
    last.known = {stage.transport.get(), same};
    last.memory = memory_beside(stage.transport.get());
    result.transport = make_dense_transport(patches_.mesh(), stage.visibility, last);
    result.mesh = patches_.mesh();
    result.visibility = std::move(stage.visibility);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result.refinement.seconds = elapsed.count();
    return result;
  }

 private:
  [[nodiscard]] long first_patches() const {
    return std::max(1L, std::min(kFirstPatches, max_patches_ / kFirstShare));
  }

  /// Each operator is made from the one before, so both must fit, with some patches more than so
  /// many: neighbours are divided, too.
  [[nodiscard]] long most_patches() const {
    constexpr std::size_t kOperators = 3;
    return std::min<long>(options_.max_patches, largest_problem(memory_ / kOperators));
  }

  /// Bytes left for another operator; 0 if nobody knows.
  [[nodiscard]] std::size_t memory_beside(const Transport* earlier) const {
    if (memory_ == 0) return 0;
    const std::size_t taken = earlier != nullptr ? earlier->bytes() : 0;
    return memory_ > taken ? memory_ - taken : 1;
  }

  [[nodiscard]] Stage make_stage(const KnownPairs& known) const {
    const PatchMesh& mesh = patches_.mesh();
    Stage stage{Visibility(mesh), nullptr, {}};
    TransportOptions transport = options_.transport;
    transport.closed = Closed::no;
    transport.known = known;
    transport.memory = memory_beside(known.transport);
    stage.transport = make_dense_transport(mesh, stage.visibility, transport);
    SolveOptions solving;
    solving.tolerance = kSolveTolerance;
    solving.estimates_errors = false;
    solving.progress = options_.progress;
    stage.solution =
        solve(*stage.transport, exitance(scene_, mesh), reflectance(scene_, mesh), solving);
    return stage;
  }

  [[nodiscard]] double estimated_error(const Stage& stage) const {
    return kMargin * discretisation_error(patches_.mesh(), *stage.transport, stage.solution,
                                          options_.progress)
                         .relative;
  }

  /// Share of the squared error to be got rid of, a little more than is asked.
  [[nodiscard]] double share_to_refine(double error) const {
    const double left = options_.tolerance / error;
    return std::min(kLargestShare, 1.1 * (1 - left * left));
  }

  /// How many patches may be divided.
  [[nodiscard]] Index affordable() const {
    constexpr long kPartsMore = 3;
    return std::max<Index>(0, (max_patches_ - patches_.mesh().size()) / kPartsMore);
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
