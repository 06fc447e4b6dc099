// Some hundred damaged files of each format; bench/fuzz_readers reads thousands.

#include "tests/support/reader_fuzz.h"

#include <gtest/gtest.h>

#include "tests/support/damaged_files.h"
#include "tests/support/output_folder.h"

namespace {

using namespace radiosity;

class ReaderFuzz : public OutputFolder, public testing::WithParamInterface<std::string> {};

TEST_P(ReaderFuzz, DamagedFilesAreReadOrRefused) {
  constexpr long kMutants = 200;
  [[maybe_unused]] const test::LeaksAllowed leaks_of_libraries;
  const test::FuzzReport report = test::fuzz_reader(GetParam(), 0, kMutants, folder());
  for (const std::string& fault : report.faults) ADD_FAILURE() << fault;
  EXPECT_EQ(report.n_read + report.n_refused, kMutants);
  EXPECT_GT(report.n_refused, kMutants / 10);
}

INSTANTIATE_TEST_SUITE_P(Formats, ReaderFuzz, testing::ValuesIn(test::fuzz_formats()),
                         [](const auto& format) { return format.param; });

}  // namespace
