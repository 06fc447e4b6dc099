#include "radiosity/solve/led_solver.h"

#include <cstddef>
#include <span>
#include <utility>

namespace radiosity {
namespace {

enum class Order : unsigned char { apply, apply_transposed, end, failure };

std::span<std::byte> bytes_of(Order& order) { return std::as_writable_bytes(std::span(&order, 1)); }

std::span<std::byte> bytes_of(Eigen::VectorXd& values) {
  return std::as_writable_bytes(std::span(values.data(), static_cast<std::size_t>(values.size())));
}

/// On the first rank: tells the others what to do.
void tell(Ranks& ranks, Order order) { ranks.broadcast(0, bytes_of(order)); }

LinearSolution lead(Ranks& ranks, const LinearSolver& solver, const LinearSystem& system) {
  // Whoever fails within a product, of which the others make their shares, has nobody who listens.
  bool is_alone = true;
  const auto shared = [&](Order order, const auto& product) {
    return [&, order](const Eigen::VectorXd& u) {
      tell(ranks, order);
      Eigen::VectorXd sent = u;
      ranks.broadcast(0, bytes_of(sent));
      is_alone = false;
      Eigen::VectorXd result = product(sent);
      is_alone = true;
      return result;
    };
  };
  LinearSystem led = system;
  led.apply = shared(Order::apply, system.apply);
  led.apply_transposed = shared(Order::apply_transposed, system.apply_transposed);
  LinearSolution solution;
  try {
    solution = solver(led);
  } catch (...) {
    if (is_alone) tell(ranks, Order::failure);
    throw;
  }
  tell(ranks, Order::end);
  return solution;
}

void follow(Ranks& ranks, const LinearSystem& system) {
  Eigen::VectorXd u(system.right_side.size());
  for (Order order{};;) {
    ranks.broadcast(0, bytes_of(order));
    if (order == Order::end) return;
    if (order == Order::failure) throw FirstRankFailed();
    ranks.broadcast(0, bytes_of(u));
    (void)(order == Order::apply ? system.apply(u) : system.apply_transposed(u));
  }
}

}  // namespace

LinearSolver led_by_first_rank(Ranks& ranks, LinearSolver solver) {
  return [&ranks, solver = std::move(solver)](const LinearSystem& system) {
    LinearSolution solution;
    if (ranks.rank() == 0) {
      solution = lead(ranks, solver, system);
    } else {
      follow(ranks, system);
      solution.unknowns.resize(system.right_side.size());
    }
    ranks.broadcast(0, bytes_of(solution.unknowns));
    ranks.broadcast(0, std::as_writable_bytes(std::span(&solution.iterations, 1)));
    return solution;
  };
}

}  // namespace radiosity
