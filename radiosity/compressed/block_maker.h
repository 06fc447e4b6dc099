#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"
#include "radiosity/base/work_part.h"
#include "radiosity/compressed/block_fit.h"
#include "radiosity/compressed/block_store.h"
#include "radiosity/compressed/cluster_polynomials.h"
#include "radiosity/compressed/cluster_shapes.h"
#include "radiosity/compressed/made_blocks.h"
#include "radiosity/compressed/pair_sampler.h"
#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {

/// Divides the exchange between all patches into blocks of which each is polynomial but for an
/// error that is small enough.
class BlockMaker {
 public:
  /// All must outlive this. Where there are ranks, all make and refine together.
  BlockMaker(const ExchangeEvaluator& evaluator, const ClusterPolynomials& polynomials,
             const std::vector<double>& areas, const Progress& progress, Ranks* ranks = nullptr);
  BlockMaker(const BlockMaker&) = delete;
  BlockMaker& operator=(const BlockMaker&) = delete;

  /// What a density error, in common to a block, comes to in F 1, next to 1: root of the mean
  /// square over all area.
  [[nodiscard]] double action_error(std::int32_t a, std::int32_t b, double density_error) const;

  [[nodiscard]] const ClusterShapes& shapes() const { return shapes_; }

  /// Blocks of at most `limit` action_error() each, or entries. A store has the parts as they are
  /// made, and those that it has are taken from there.
  [[nodiscard]] MadeBlocks make(double limit, BlockStore* store = nullptr) const;
  /// Of what make() puts into a store, every n-th from the part's number on, of n.
  void make_part(double limit, BlockStore& store, WorkPart part) const;
  /// The same from blocks of a larger limit: those that are off by more are divided.
  [[nodiscard]] MadeBlocks refine(MadeBlocks blocks, double limit,
                                  BlockStore* store = nullptr) const;

 private:
  struct Item {
    std::int32_t a;
    std::int32_t b;
    Between between{};  // of a and b
    std::vector<DensitySample> samples{};
    std::optional<bool> varies_more_in_a{};  // if known; else the larger is divided
  };
  using Items = std::vector<Item>;
  struct Worker {
    ExchangeEvaluator::Worker exchange;
    BlockFitter fitter;
  };
  [[nodiscard]] MadeBlocks make(Items items, double limit, BlockStore* store) const;
  /// Works on items level by level until there are enough of them to do in parallel; what is made
  /// on the way goes into `made`.
  void spread(Items& items, double limit, MadeBlocks& made) const;
  [[nodiscard]] MadeBlocks make_item(Item item, double limit) const;
  void work(Item item, double limit, Worker& worker, MadeBlocks& made, Items& open) const;
  bool fit_visible(const Item& item, double limit, BlockFitter& fitter, MadeBlocks& made) const;
  bool fit_sampled(Item& item, double limit, Worker& worker, MadeBlocks& made) const;
  [[nodiscard]] double unseen(const Item& item) const;
  void evaluate_near(const Item& item, ExchangeEvaluator::Worker& worker, MadeBlocks& made) const;
  void divide(const Item& item, Items& open) const;
  void accept(const Item& item, DegreePair degrees, const BlockFit& fit, double error,
              MadeBlocks& made) const;

  const ExchangeEvaluator& evaluator_;
  const ClusterPolynomials& polynomials_;
  const std::vector<double>& areas_;
  const Progress& progress_;
  Ranks* ranks_;
  ClusterShapes shapes_;
  PairSampler sampler_;
};

}  // namespace radiosity
