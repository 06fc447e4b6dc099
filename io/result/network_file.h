#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/solve/exchange_network.h"

namespace io {

/// A network whose nodes have names and numbers.
struct NamedNetwork {
  radiosity::ExchangeNetwork network;
  std::vector<std::string> names;     ///< of the nodes
  std::vector<std::int64_t> numbers;  ///< of the nodes, each another, above 0
  std::int64_t space = 99999;         ///< number of the node that stands for space
  /// The same of nodes that are black, without reflections: the couplings are A_s F_st.
  std::optional<radiosity::ExchangeNetwork> black = std::nullopt;
};

/// How conductors of .sinda are told.
struct SindaStyle {
  bool has_sigma = false;    ///< couplings times σ, W/K⁴
  bool is_positive = false;  ///< their numbers above 0, not below it as those of radiation
};

/// ".csv", ".h5", ".esatan", ".sinda", ".oppenheim".
const std::vector<std::string>& network_extensions();

/// Writes the network as the extension of the file says:
/// - .csv: from,to,from_node,to_node,coupling,error,gebhart,script_f, a row for each two nodes that
///   are coupled, in both orders, and for each node with itself, "(space)" and "(backs)";
/// - .h5: /couplings, /error, /gebhart, /script_f (s x s), /to_space, /to_backs, /area, /emitting,
///   /node (s) and /names, in m² (docs/command-line.md);
/// - .esatan: the lines GR(i, j) = m²; of a block $CONDUCTORS;
/// - .sinda: HEADER CONDUCTOR DATA with lines -k, i, j, m²;
/// - .oppenheim: kind,from,to,conductance, m², of Oppenheim's network (1956): "surface" from the
///   black-body emission E of each node to its radiosity J, ε A / (1 - ε), inf of black ones; and
///   "space" from J to J, A_s F_st, or to E of space. The nodes E and J have one number. Needs
///   `black`.
/// Of the last three each pair stands once, and what is coupled to backs is not told. Throws
/// OutputError.
void write_network(const std::filesystem::path& path, const NamedNetwork& named,
                   const SindaStyle& sinda = {});

}  // namespace io
