#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"
#include "radiosity/base/work_stamp.h"
#include "radiosity/operator/known_pairs.h"
#include "radiosity/operator/transport.h"

namespace radiosity {

/// Whether the surfaces enclose the space that they light.
enum class Closed {
  no,        ///< light may escape; nothing is corrected
  yes,       ///< row sums are 1; small sampling errors are corrected symmetrically
  automatic  ///< found out from the form factors
};

struct TransportOptions {
  double tolerance = 1e-2;            ///< relative error asked of the form factors, > 0
  Closed closed = Closed::automatic;  ///< whether all row sums must be 1
  std::uint64_t seed = 0;             ///< of the visibility samples
  std::size_t memory = 0;  ///< bytes the operator may take; 0 = what the machine has available
  KnownPairs known = {};   ///< from an operator that was not corrected to be closed
  /// The processes that make it together, each with the same patches and options: of a dense one
  /// each keeps its share. Null: this one alone. The result has the same bits.
  Ranks* ranks = nullptr;
  Progress progress{};
  /// Where a compressed operator keeps its parts as they are made, so that a run that is stopped
  /// can go on: the result has the same bits. Stays when all is done. Empty: nowhere.
  std::filesystem::path work_file = {};
  WorkStart work_start = WorkStart::anew;  ///< whether what is there is gone on with
  /// Is given rougher operators on the way to a compressed one, on the thread that makes it: first,
  /// where less than 0.04 is asked, one for a tolerance of 0.1, then those whose verified error is
  /// not small enough yet. Their report tells that error. What is made in the end has the same bits
  /// with it or without, and takes some 15 % longer with it. Never called for dense operators.
  std::function<void(std::unique_ptr<Transport>)> rough = {};
};

}  // namespace radiosity
