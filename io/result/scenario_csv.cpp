#include "io/result/scenario_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"

namespace io {
namespace {

using radiosity::QuantityShare;
using radiosity::QuantitySummary;

void add_columns(const QuantitySummary& quantity, std::string& header) {
  const Eigen::Index n_bands =
      quantity.info.is_additive ? quantity.total.sum.size() : quantity.total.mean.size();
  for (Eigen::Index band = 0; band < n_bands; ++band) {
    std::string name(quantity.info.column);
    if (!quantity.info.is_photometric) name += fmt::format("_{}", band);
    header += quantity.info.is_additive ? fmt::format(",{}", name)
                                        : fmt::format(",{0},{0}_min,{0}_max", name);
  }
}

void add_values(const QuantityShare& share, bool is_additive, std::string& row) {
  const auto out = std::back_inserter(row);
  if (is_additive) {
    for (const double sum : share.sum) fmt::format_to(out, ",{}", sum);
    return;
  }
  for (Eigen::Index band = 0; band < share.mean.size(); ++band) {
    fmt::format_to(out, ",{},{},{}", share.mean[band], share.least[band], share.greatest[band]);
  }
}

}  // namespace

void write_scenario_csv(const std::filesystem::path& path,
                        const std::vector<ScenarioRow>& scenarios) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    std::string header = "scenario,surface,area";
    for (const QuantitySummary& quantity : scenarios.front().quantities) {
      add_columns(quantity, header);
    }
    stream << header << '\n';
    for (const ScenarioRow& scenario : scenarios) {
      const auto& surfaces = scenario.quantities.front().surfaces;
      for (std::size_t s = 0; s < surfaces.size(); ++s) {
        std::string row = fmt::format("{},{},{}", csv_field(scenario.name),
                                      csv_field(surfaces[s].surface), surfaces[s].area);
        for (const QuantitySummary& quantity : scenario.quantities) {
          add_values(quantity.surfaces[s], quantity.info.is_additive, row);
        }
        stream << row << '\n';
      }
    }
  });
}

}  // namespace io
