// Couplings between many nodes beside solves of three bands: processor time of the table, of one
// such solve, and how many solves of three bands for three nodes each the table is worth. Usage:
// exchange_bench [PATCHES] [NODES], default 20000 and 500; dense up to 10000 patches, else
// compressed.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "bench/usage.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/solve/exchange_network.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

int main(int argc, char** argv) {
  using namespace radiosity;
  const int wanted = argc > 1 ? std::atoi(argv[1]) : 20000;
  const Index n_nodes = argc > 2 ? std::atoi(argv[2]) : 500;
  // Of the patches a fifth is on the box.
  const auto edge = [&](double share) { return static_cast<int>(std::sqrt(share * wanted / 6)); };
  const PatchMesh mesh = test::box_in_box(edge(0.8), edge(0.2));
  const Index n = mesh.size();
  double start = bench::processor_seconds();
  const auto transport = make_transport(mesh, Visibility(mesh), {.tolerance = 1e-2});
  fmt::print("{} patches, form factors {:.1f} s\n", n, bench::processor_seconds() - start);
  std::vector<std::int32_t> node(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) node[i] = static_cast<std::int32_t>(i * n_nodes / n);
  Eigen::VectorXd emissivity(n);
  for (Index i = 0; i < n; ++i) emissivity[i] = 0.1 + 0.08 * (node[i] % 11);

  // The light of three nodes in three bands, as exact as couplings are.
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(n, 3);
  for (Index i = 0; i < n; ++i) {
    if (node[i] < 3) exitance(i, node[i]) = emissivity[i];
  }
  const Eigen::MatrixXd reflectance = (1 - emissivity.array()).replicate(1, 3);
  for (const double tolerance : {NetworkOptions().tolerance, 1e-5}) {
    start = bench::processor_seconds();
    (void)solve(*transport, exitance, reflectance,
                {.tolerance = tolerance, .estimates_errors = false});
    const double one = bench::processor_seconds() - start;
    start = bench::processor_seconds();
    const ExchangeNetwork network =
        exchange_network(*transport, emissivity, node, n_nodes, {.tolerance = tolerance});
    const double table = bench::processor_seconds() - start;
    fmt::print(
        "to {:.0e}: a solve of 3 bands {:.3f} s, the table of {} nodes {:.1f} s: {:.1f} solves, "
        "{:.2f} of one for each 3 nodes; asymmetry {:.1g}\n",
        tolerance, one, n_nodes, table, table / one, 3 * table / one / static_cast<double>(n_nodes),
        network.asymmetry);
  }
}
