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
  constexpr std::size_t kFactors = 120 * 120;  // a scene
  // Segments are drawn in single precision and summed up by packets of 16. At the tolerance of the
  // second scene there are none, and what closed forms and rules keep of double precision counts.
  constexpr double kSampled = 16 * 0x1p-24;
  constexpr double kUnsampled = 1e-10;
  const std::vector<double> optimised = numbers_printed_by(PRINT_OPTIMISED);
  const std::vector<double> plain = numbers_printed_by(PRINT_UNOPTIMISED);
  ASSERT_EQ(optimised.size(), 3 * kFactors);
  ASSERT_EQ(plain.size(), optimised.size());
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const double rounding = k / kFactors == 1 ? kUnsampled : kSampled;
    EXPECT_NEAR(optimised[k], plain[k], rounding * plain[k]) << "number " << k;
  }
}

}  // namespace
