#include "radiosity/visibility/edge_spokes.h"

#include <algorithm>

namespace radiosity {
namespace {

/// Spokes that may be one but differ by more than this, as slender patches do, tell nothing.
constexpr double kWide = 0.1;

/// Spokes that are one, by number from the first to before the last, all round.
struct Stack {
  std::size_t begin;
  std::size_t end;
};

class StackJoiner {
 public:
  StackJoiner(const PatchSides& sides, std::span<const Spoke> spokes, SideJoints& joints)
      : sides_(sides), spokes_(spokes), joints_(joints) {}

  void run() {
    std::vector<Stack> stacks;
    const std::size_t n = spokes_.size();
    std::size_t first = 0;
    while (first < n && are_one(first + n - 1)) ++first;
    if (first == n) return join_everything(n > 1 ? Stack{0, n} : Stack{0, 1});
    for (std::size_t k = first; k < first + n; ++k) {
      if (k == first || !are_one(k - 1)) stacks.push_back({k, k});
      stacks.back().end = k + 1;
    }
    for (std::size_t s = 0; s < stacks.size(); ++s) {
      const Stack& stack = stacks[s];
      if (turn(stack.begin, stack.end - 1) > kWide) join_everything(stack);
      join_between(stack, stacks[s + 1 < stacks.size() ? s + 1 : 0]);
    }
  }

 private:
  [[nodiscard]] const Spoke& spoke(std::size_t k) const { return spokes_[k % spokes_.size()]; }

  [[nodiscard]] double turn(std::size_t from, std::size_t to) const {
    const double whole = to / spokes_.size() > from / spokes_.size() ? 2 * kPi : 0;
    return spoke(to).angle - spoke(from).angle + whole;
  }

  /// Whether a spoke and the next one are.
  [[nodiscard]] bool are_one(std::size_t k) {
    if (spokes_.size() == 1) return false;
    const Spoke& one = spoke(k);
    const Spoke& next = spoke(k + 1);
    const double apart = turn(k, k + 1);
    if (apart > one.slack + next.slack) return false;
    if (apart <= kWide) return true;
    join_all(sides_, one.patch, next.patch, joints_);
    return false;
  }

  void join_everything(const Stack& stack) {
    for (std::size_t k = stack.begin; k < stack.end; ++k) {
      join_all(sides_, spoke(k).patch, spoke(stack.begin).patch, joints_);
    }
  }

  [[nodiscard]] bool looks(const Spoke& s, bool forwards) const {
    return s.front_is_forwards == forwards || sides_.mesh.twin[s.patch] >= 0;
  }

  /// Appends the sides of a stack that are free in one direction.
  void add_free(const Stack& stack, bool forwards, std::vector<Index>& free) const {
    bool any_looks = false;
    for (std::size_t k = stack.begin; k < stack.end; ++k) {
      any_looks |= looks(spoke(k), forwards);
    }
    for (std::size_t k = stack.begin; k < stack.end; ++k) {
      const Spoke& s = spoke(k);
      if (any_looks && !looks(s, forwards)) continue;
      free.push_back(s.front_is_forwards == forwards ? sides_.front(s.patch)
                                                     : sides_.back(s.patch));
    }
  }

  void join_between(const Stack& one, const Stack& next) {
    free_.clear();
    add_free(one, true, free_);
    add_free(next, false, free_);
    for (const Index side : free_) {
      if (side != free_[0]) joints_.emplace_back(free_[0], side);
    }
  }

  const PatchSides& sides_;
  std::span<const Spoke> spokes_;
  SideJoints& joints_;
  std::vector<Index> free_;
};

}  // namespace

void join_all(const PatchSides& sides, std::int32_t i, std::int32_t j, SideJoints& joints) {
  joints.emplace_back(sides.front(i), sides.back(i));
  joints.emplace_back(sides.front(i), sides.front(j));
  joints.emplace_back(sides.front(j), sides.back(j));
}

void join_in_turn(const PatchSides& sides, std::span<const Spoke> spokes, SideJoints& joints) {
  if (!spokes.empty()) StackJoiner(sides, spokes, joints).run();
}

}  // namespace radiosity
