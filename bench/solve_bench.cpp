// Products that each method needs for a guaranteed relative error of 1e-8, as counters, and the
// time they take. Arguments: 100 ρ.
#include <benchmark/benchmark.h>

#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {

constexpr std::uint64_t kSeed = 7;

test::DenseTestTransport make_ring() {
  std::mt19937_64 random(kSeed);
  return test::chamber_ring(12, 50, 0.02, random);
}

test::DenseTestTransport make_long_box() { return test::rough_box({1, 1, 8}, 0.25); }

/// Uniform reflectance, the slowest case for a given largest one; one patch in thirty emits.
void solve_with(benchmark::State& state, Method method, const test::DenseTestTransport& transport) {
  const double rho = static_cast<double>(state.range(0)) / 100;
  const Index n = transport.size();
  const Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(n, 3, rho);
  Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(n, 3);
  exitance.topRows(n / 30).setOnes();
  Solution solution;
  for (auto _ : state) {
    solution = solve(transport, exitance, reflectance, {.method = method});
  }
  state.counters["products"] = solution.products;
  state.counters["bound"] = solution.error_bound;
  state.counters["converged"] = solution.converged ? 1 : 0;
}

void register_all() {
  for (const Method method : {Method::conjugate_gradients, Method::chebyshev, Method::gauss_seidel,
                              Method::southwell, Method::jacobi}) {
    for (const char* name : {"ring", "box"}) {
      benchmark::RegisterBenchmark(
          (std::string(method_name(method)) + "/" + name).c_str(),
          [method, is_ring = name == std::string("ring")](benchmark::State& state) {
            solve_with(state, method, is_ring ? make_ring() : make_long_box());
          })
          ->Arg(50)
          ->Arg(80)
          ->Arg(95)
          ->Arg(99)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

const bool kRegistered = (register_all(), true);

}  // namespace
}  // namespace radiosity
