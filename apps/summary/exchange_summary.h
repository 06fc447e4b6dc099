#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/network_file.h"
#include "study/study.h"

namespace apps {

/// What `exchange` did.
struct ExchangeSummary {
  const study::Study& study;
  const io::NamedNetwork& named;
  const std::vector<std::string>& outputs;
  double min_coupling = 0;  ///< of which smaller ones were left out, if any
  std::int64_t n_dropped = 0;
};

/// As an aligned table: all couplings if nodes are few.
std::string exchange_text(const ExchangeSummary& summary);

/// As one JSON object, with all couplings.
std::string exchange_json(const ExchangeSummary& summary, const std::vector<std::string>& warnings);

}  // namespace apps
