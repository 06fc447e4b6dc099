#include <gtest/gtest.h>

#include <vector>

#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "tests/support/direct_solve.h"
#include "tests/support/every_method.h"
#include "tests/support/matrix_transport.h"

namespace radiosity {
namespace {

using test::DenseTestTransport;
using test::random_matrix;
using test::relative_error;

constexpr std::uint64_t kStepSeed = 20250312;
constexpr Index kStepPatches = 30;
/// n products of sums of n terms leave about n roundings.
constexpr double kStepRounding = 1e-13;

/// A step with its fields worked out.
struct Seen {
  SolveStep step;
  Eigen::MatrixXd radiosity;
  Eigen::MatrixXd unshot;
};

class SolveSteps : public ::testing::TestWithParam<Method> {
 protected:
  /// Solves, and keeps what the watcher sees.
  Solution watch(Method method, const Eigen::MatrixXd& start = {}) {
    seen_.clear();
    return solve(transport_, exitance_, reflectance_,
                 {.method = method, .start = start, .on_step = [&](const SolveStep& step) {
                    seen_.push_back({step, step.radiosity(), step.unshot()});
                  }});
  }
  [[nodiscard]] Eigen::MatrixXd bounced(const Eigen::MatrixXd& b) const {
    return reflectance_.cwiseProduct(transport_.form_factors() * b);
  }
  [[nodiscard]] double power(const Eigen::MatrixXd& b) const {
    return (transport_.area().transpose() * b).sum();
  }

  std::mt19937_64 random_{kStepSeed};
  DenseTestTransport transport_ = test::random_closed(kStepPatches, random_);
  Eigen::MatrixXd exitance_ = random_matrix(kStepPatches, 3, -3, 1, random_).cwiseMax(0);
  Eigen::MatrixXd reflectance_ = random_matrix(kStepPatches, 3, -0.2, 0.9, random_).cwiseMax(0);
  std::vector<Seen> seen_;
};

INSTANTIATE_TEST_SUITE_P(Solve, SolveSteps, ::testing::ValuesIn(test::kMethods),
                         test::method_test_name);

TEST_P(SolveSteps, LeadFromTheExitanceToTheSolution) {
  const Solution solution = watch(GetParam());
  ASSERT_GE(seen_.size(), 2u);
  EXPECT_EQ(seen_.front().radiosity, exitance_);
  EXPECT_EQ(seen_.back().radiosity, solution.radiosity);
  EXPECT_EQ(seen_.back().step.iteration, solution.iterations);
  // A last product, which makes the irradiance, may follow.
  EXPECT_LE(seen_.back().step.products, solution.products);
}

TEST_P(SolveSteps, CountWhatIsUnshot) {
  const Eigen::MatrixXd starts[] = {{}, random_matrix(kStepPatches, 3, 0, 2, random_)};
  for (const Eigen::MatrixXd& start : starts) {
    watch(GetParam(), start);
    for (const Seen& seen : seen_) {
      const Eigen::MatrixXd& b = seen.radiosity;
      const Eigen::MatrixXd expected = GetParam() == Method::southwell
                                           ? Eigen::MatrixXd(exitance_ + bounced(b - seen.unshot))
                                           : Eigen::MatrixXd(exitance_ + bounced(b) - seen.unshot);
      EXPECT_LE((b - expected).norm(), kStepRounding * b.norm()) << "step " << seen.step.iteration;
    }
  }
}

TEST_P(SolveSteps, HaveValidBounds) {
  const Eigen::MatrixXd expected =
      test::solve_directly(transport_.form_factors(), exitance_, reflectance_);
  const Eigen::MatrixXd starts[] = {{}, random_matrix(kStepPatches, 3, 0, 2, random_)};
  for (const Eigen::MatrixXd& start : starts) {
    watch(GetParam(), start);
    for (const Seen& seen : seen_) {
      // The reference has rounding errors too.
      EXPECT_LE(relative_error(transport_.area(), seen.radiosity, expected),
                seen.step.error_bound + kStepRounding)
          << "step " << seen.step.iteration;
    }
  }
}

TEST_P(SolveSteps, ChangeNothing) {
  const Solution watched = watch(GetParam());
  const Solution alone = solve(transport_, exitance_, reflectance_, test::with_method(GetParam()));
  EXPECT_EQ(watched.radiosity, alone.radiosity);
  EXPECT_EQ(watched.products, alone.products);
}

TEST_F(SolveSteps, OfJacobiAreBounces) {
  // Of one column, since a column that has converged waits for the others.
  exitance_ = exitance_.col(0).eval();
  reflectance_ = reflectance_.col(0).eval();
  watch(Method::jacobi);
  Eigen::MatrixXd sum = exitance_;
  Eigen::MatrixXd bounce = exitance_;
  for (const Seen& seen : seen_) {
    EXPECT_LE((seen.radiosity - sum).norm(), kStepRounding * sum.norm());
    bounce = bounced(bounce);
    // What has arrived and is not passed on is the next bounce: a difference of sums.
    EXPECT_LE((seen.unshot - bounce).norm(), kStepRounding * sum.norm());
    sum += bounce;
  }
}

TEST_F(SolveSteps, OfSouthwellShootOnePatchEach) {
  watch(Method::southwell);
  EXPECT_EQ(seen_.front().unshot, exitance_);
  const double emitted = power(exitance_);
  const Eigen::MatrixXd absorptance = 1 - reflectance_.array();
  for (std::size_t k = 1; k < seen_.size(); ++k) {
    const Seen& before = seen_[k - 1];
    const Seen& now = seen_[k];
    EXPECT_EQ(now.step.iteration, static_cast<int>(k));
    EXPECT_GE(now.unshot.minCoeff(), 0);
    // Walls absorb in a closed room what is shot and not reflected.
    EXPECT_LE(power(now.unshot), power(before.unshot) * (1 + kStepRounding));
    EXPECT_GE((now.radiosity - before.radiosity).minCoeff(), -kStepRounding * now.radiosity.norm());
    const Eigen::MatrixXd arrived = transport_.form_factors() * (now.radiosity - now.unshot);
    EXPECT_NEAR(power(absorptance.cwiseProduct(arrived)) + power(now.unshot), emitted,
                kStepRounding * emitted * kStepPatches);
    // The brightest patch is the only one to lose unshot light.
    Index source = 0;
    (transport_.area().asDiagonal() * before.unshot).rowwise().sum().maxCoeff(&source);
    for (Index i = 0; i < kStepPatches; ++i) {
      if (i == source) continue;
      EXPECT_GE((now.unshot - before.unshot).row(i).minCoeff(), 0);
    }
  }
}

}  // namespace
}  // namespace radiosity
