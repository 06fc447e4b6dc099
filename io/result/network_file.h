#pragma once

#include <cstdint>
#include <filesystem>
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
};

/// ".csv", ".h5", ".esatan", ".sinda".
const std::vector<std::string>& network_extensions();

/// Writes the network as the extension of the file says:
/// - .csv: from,to,from_node,to_node,coupling,error,gebhart,script_f, a row for each two nodes that
///   are coupled, in both orders, and for each node with itself, "(space)" and "(backs)";
/// - .h5: /couplings, /error, /gebhart, /script_f (s x s), /to_space, /to_backs, /area, /emitting,
///   /node (s) and /names, in m² (docs/command-line.md);
/// - .esatan: the lines GR(i, j) = m²; of a block $CONDUCTORS;
/// - .sinda: HEADER CONDUCTOR DATA with lines -k, i, j, m², negative numbers for radiation; with
///   `has_sigma` the couplings are times σ, W/K⁴.
/// Of the last two each pair stands once, and what is coupled to backs is not told. Throws
/// OutputError.
void write_network(const std::filesystem::path& path, const NamedNetwork& named,
                   bool has_sigma = false);

}  // namespace io
