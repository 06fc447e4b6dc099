#include "io/result/network_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"
#include "io/base/extension.h"
#include "io/base/printable.h"
#include "io/result/hdf5_output.h"
#include "radiosity/scene/radiometry.h"

namespace io {
namespace {

using radiosity::ExchangeNetwork;
using radiosity::Index;

constexpr std::int64_t kNetworkVersion = 1;

void write_network_csv(const std::filesystem::path& path, const NamedNetwork& named) {
  const ExchangeNetwork& network = named.network;
  const Eigen::MatrixXd gebhart = network.gebhart();
  const Eigen::MatrixXd script_f = network.script_f();
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "from,to,from_node,to_node,coupling,error,gebhart,script_f\n";
    for (Index s = 0; s < network.area.size() && stream; ++s) {
      const std::string from = csv_field(named.names[s]);
      for (Index t = 0; t < network.area.size(); ++t) {
        if (network.couplings(s, t) == 0) continue;
        stream << fmt::format("{},{},{},{},{},{},{},{}\n", from, csv_field(named.names[t]),
                              named.numbers[s], named.numbers[t], network.couplings(s, t),
                              network.error(s, t), gebhart(s, t), script_f(s, t));
      }
      const auto add = [&](const char* name, std::int64_t number, double coupling) {
        if (coupling == 0) return;
        stream << fmt::format("{},{},{},{},{},,{},{}\n", from, name, named.numbers[s],
                              number == 0 ? "" : std::to_string(number), coupling,
                              coupling / network.emitting[s], coupling / network.area[s]);
      };
      add("(space)", named.space, network.to_space[s]);
      add("(backs)", 0, network.to_backs[s]);
    }
  });
}

void write_matrix(hid_t file, const char* name, const Eigen::MatrixXd& matrix) {
  std::vector<double> values;
  for (Index s = 0; s < matrix.rows(); ++s) {
    for (Index t = 0; t < matrix.cols(); ++t) values.push_back(matrix(s, t));
  }
  hdf5::write_dataset(file, name, values,
                      {static_cast<hsize_t>(matrix.rows()), static_cast<hsize_t>(matrix.cols())});
}

void write_network_hdf5(const std::filesystem::path& path, const NamedNetwork& named) {
  const ExchangeNetwork& network = named.network;
  hdf5::write_file(path, [&](hid_t file) {
    hdf5::write_attribute(file, "version", kNetworkVersion);
    hdf5::write_attribute(file, "error_bound", network.error_bound);
    hdf5::write_attribute(file, "space_node", named.space);
    write_matrix(file, "couplings", network.couplings);
    write_matrix(file, "error", network.error);
    write_matrix(file, "gebhart", network.gebhart());
    write_matrix(file, "script_f", network.script_f());
    hdf5::write_list(file, "to_space", network.to_space);
    hdf5::write_list(file, "to_backs", network.to_backs);
    hdf5::write_list(file, "area", network.area);
    hdf5::write_list(file, "emitting", network.emitting);
    hdf5::write_list(file, "node", named.numbers);
    hdf5::write_names(file, "names", named.names);
  });
}

/// Each pair of coupled nodes once, and each node with space.
void for_each_coupling(
    const NamedNetwork& named, const ExchangeNetwork& network,
    const std::function<void(std::int64_t from, std::int64_t to, double coupling)>& visit) {
  for (Index s = 0; s < network.area.size(); ++s) {
    for (Index t = s + 1; t < network.area.size(); ++t) {
      if (network.couplings(s, t) > 0) {
        visit(named.numbers[s], named.numbers[t], network.couplings(s, t));
      }
    }
    if (network.to_space[s] > 0) visit(named.numbers[s], named.space, network.to_space[s]);
  }
}

/// What each node is, behind a mark of comments.
void write_nodes(std::ofstream& stream, const NamedNetwork& named, const char* comment) {
  for (std::size_t s = 0; s < named.names.size(); ++s) {
    const auto k = static_cast<Index>(s);
    stream << fmt::format("{} {}: {}, {:.6g} m2, emissivity {:.6g}\n", comment, named.numbers[s],
                          printable(named.names[s]), named.network.area[k],
                          named.network.emitting[k] / named.network.area[k]);
  }
  if (named.network.to_space.any()) {
    stream << fmt::format("{} {}: space\n", comment, named.space);
  }
}

void write_esatan(const std::filesystem::path& path, const NamedNetwork& named) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "# Radiative couplings, m2, of nodes\n";
    write_nodes(stream, named, "#");
    stream << "$CONDUCTORS\n";
    for_each_coupling(named, named.network,
                      [&](std::int64_t from, std::int64_t to, double coupling) {
                        stream << fmt::format("GR({}, {}) = {};\n", from, to, coupling);
                      });
  });
}

void write_sinda(const std::filesystem::path& path, const NamedNetwork& named,
                 const SindaStyle& style) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "C Radiative couplings, " << (style.has_sigma ? "W/K4" : "m2") << ", of nodes\n";
    write_nodes(stream, named, "C");
    stream << "HEADER CONDUCTOR DATA, RADIATION\n";
    std::int64_t number = 0;
    for_each_coupling(named, named.network,
                      [&](std::int64_t from, std::int64_t to, double coupling) {
                        number += style.is_positive ? 1 : -1;
                        stream << fmt::format(
                            "{}, {}, {}, {}\n", number, from, to,
                            style.has_sigma ? radiosity::kStefanBoltzmann * coupling : coupling);
                      });
  });
}

void write_oppenheim(const std::filesystem::path& path, const NamedNetwork& named) {
  write_stream_atomically(path, [&](std::ofstream& stream) {
    stream << "kind,from,to,conductance\n";
    for (std::size_t s = 0; s < named.numbers.size(); ++s) {
      const double emitting = named.network.emitting[static_cast<Index>(s)];
      const double area = named.network.area[static_cast<Index>(s)];
      stream << fmt::format("surface,E{0},J{0},{1}\n", named.numbers[s],
                            emitting * area / (area - emitting));
    }
    const ExchangeNetwork& black = named.black.value();
    const bool has_space = black.to_space.any();
    for_each_coupling(named, black, [&](std::int64_t from, std::int64_t to, double coupling) {
      const char node = has_space && to == named.space ? 'E' : 'J';
      stream << fmt::format("space,J{},{}{},{}\n", from, node, to, coupling);
    });
  });
}

}  // namespace

const std::vector<std::string>& network_extensions() {
  static const std::vector<std::string> extensions = {".csv", ".h5", ".esatan", ".sinda",
                                                      ".oppenheim"};
  return extensions;
}

void write_network(const std::filesystem::path& path, const NamedNetwork& named,
                   const SindaStyle& sinda) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".h5") {
    write_network_hdf5(path, named);
  } else if (extension == ".esatan") {
    write_esatan(path, named);
  } else if (extension == ".sinda") {
    write_sinda(path, named, sinda);
  } else if (extension == ".oppenheim") {
    write_oppenheim(path, named);
  } else {
    write_network_csv(path, named);
  }
}

}  // namespace io
