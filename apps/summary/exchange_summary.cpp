#include "apps/summary/exchange_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/printable.h"

namespace apps {
namespace {

using radiosity::ExchangeNetwork;
using radiosity::Index;

/// Couplings are shown if they are no more.
constexpr Index kMostShown = 200;

/// Each pair once, in descending order of what is coupled; a node with itself, space and backs,
/// too.
std::vector<Row> coupling_rows(const io::NamedNetwork& named) {
  const ExchangeNetwork& network = named.network;
  const Eigen::MatrixXd gebhart = network.gebhart();
  std::vector<Row> rows = {{"between", "and", "coupling, m²", "one-sigma error", "B from", "B to"}};
  for (Index s = 0; s < network.area.size(); ++s) {
    const std::string from = one_line(named.names[s]);
    for (Index t = s; t < network.area.size(); ++t) {
      if (network.couplings(s, t) == 0) continue;
      rows.push_back({from, one_line(named.names[t]),
                      fmt::format("{:.9g}", network.couplings(s, t)),
                      fmt::format("{:.1e}", network.error(s, t)),
                      fmt::format("{:.6f}", gebhart(s, t)), fmt::format("{:.6f}", gebhart(t, s))});
    }
    const auto add = [&](const char* to, double coupling) {
      if (coupling == 0) return;
      rows.push_back({from, to, fmt::format("{:.9g}", coupling), "-",
                      fmt::format("{:.6f}", coupling / network.emitting[s]), "-"});
    };
    add("(space)", network.to_space[s]);
    add("(backs)", network.to_backs[s]);
  }
  return rows;
}

nlohmann::ordered_json matrix_json(const Eigen::MatrixXd& matrix) {
  auto rows = nlohmann::ordered_json::array();
  for (Index s = 0; s < matrix.rows(); ++s) {
    const Eigen::VectorXd row = matrix.row(s);
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

std::vector<double> numbers_of(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace

std::string exchange_text(const ExchangeSummary& summary) {
  const ExchangeNetwork& network = summary.named.network;
  const study::Study& study = summary.study;
  const Index n = network.area.size();
  std::string result = line("scene", one_line(study.scene.source));
  result += line("patches", fmt::format("{} on {} surfaces", study.mesh.size(),
                                        study.mesh.surface_names.size()));
  result += line("nodes", fmt::format("{}", n));
  result += line("  asymmetry", fmt::format("{:.1e} of what a node emits, at most, before it was "
                                            "averaged",
                                            network.asymmetry));
  result += line("  error bound", fmt::format("{:.1e} from the iteration", network.error_bound));
  if (summary.min_coupling > 0) {
    result += line("  left out", fmt::format("{} couplings below {:g} of what a node emits",
                                             summary.n_dropped, summary.min_coupling));
  }
  if (const auto n_pairs = (network.couplings.array() > 0).count(); n_pairs <= 2 * kMostShown) {
    result += table(coupling_rows(summary.named));
  } else {
    result += line("couplings", fmt::format("{}", n_pairs));
  }
  for (const std::string& output : summary.outputs) result += line("written", one_line(output));
  return result;
}

std::string exchange_json(const ExchangeSummary& summary,
                          const std::vector<std::string>& warnings) {
  const ExchangeNetwork& network = summary.named.network;
  const nlohmann::ordered_json json = {{"patches", summary.study.mesh.size()},
                                       {"names", summary.named.names},
                                       {"nodes", summary.named.numbers},
                                       {"space_node", summary.named.space},
                                       {"area", numbers_of(network.area)},
                                       {"emitting", numbers_of(network.emitting)},
                                       {"couplings", matrix_json(network.couplings)},
                                       {"error", matrix_json(network.error)},
                                       {"to_space", numbers_of(network.to_space)},
                                       {"to_backs", numbers_of(network.to_backs)},
                                       {"gebhart", matrix_json(network.gebhart())},
                                       {"script_f", matrix_json(network.script_f())},
                                       {"asymmetry", network.asymmetry},
                                       {"error_bound", network.error_bound},
                                       {"left_out", summary.n_dropped},
                                       {"outputs", summary.outputs},
                                       {"warnings", warnings}};
  return io::printable_json(
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace apps
