/// Optimised code, with the instruction set chosen at run time, against the same code compiled
/// without any optimisation.

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <vector>

namespace {

std::vector<double> numbers_printed_by(const char* program) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(program, "r"), pclose);
  std::vector<double> numbers;
  double number = 0;
  while (pipe && std::fscanf(pipe.get(), "%lf", &number) == 1) numbers.push_back(number);
  return numbers;
}

TEST(Optimisation, ChangesFormFactorsByRoundingOnly) {
  const std::vector<double> optimised = numbers_printed_by(PRINT_OPTIMISED);
  const std::vector<double> plain = numbers_printed_by(PRINT_UNOPTIMISED);
  ASSERT_EQ(optimised.size(), 3 * 120 * 120U);
  ASSERT_EQ(plain.size(), optimised.size());
  // Rounding may choose another rule or another order of cuts: within what these differ by.
  constexpr double kRounding = 1e-9;
  double sum = 0;
  double difference = 0;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    sum += plain[k];
    difference += std::abs(optimised[k] - plain[k]);
    EXPECT_NEAR(optimised[k], plain[k], 1e-3 * plain[k] + kRounding) << "number " << k;
  }
  EXPECT_LE(difference, kRounding * sum);
}

}  // namespace
