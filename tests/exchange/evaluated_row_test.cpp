// Rows evaluated by themselves, against those of an operator.
#include "radiosity/exchange/evaluated_row.h"

#include <gtest/gtest.h>

#include <stop_token>
#include <vector>

#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

class EvaluatedRow : public testing::Test {
 protected:
  const PatchMesh mesh_ = test::box_in_box(4, 2);
  const Visibility visibility_{mesh_};
  const std::unique_ptr<Transport> dense_ =
      make_dense_transport(mesh_, visibility_, {.tolerance = 1e-3, .closed = Closed::no});
  const EvaluatedRowOptions options_{.tolerance = 1e-3};
};

TEST_F(EvaluatedRow, IsTheOneOfAllPairs) {
  for (const std::int32_t patch : {0, 17, 50, 100}) {
    const JointRow row = evaluated_row(mesh_, visibility_, {patch}, options_);
    EXPECT_LT((row.factor - rows_of(*dense_).row(patch)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((row.error - rows_of(*dense_).row_error(patch)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(EvaluatedRow, OfSeveralPatchesIsTheirMeanByArea) {
  const std::vector<std::int32_t> patches{0, 1, 2, 16, 97, 98, 99};
  const JointRow row = evaluated_row(mesh_, visibility_, patches, options_);
  const JointRow expected = joint_row(*dense_, patches);
  EXPECT_LT((row.factor - expected.factor).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((row.error - expected.error).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(EvaluatedRow, IsTheSameWithAnyNumberOfThreads) {
  std::vector<std::int32_t> patches;
  for (std::int32_t i = 0; i < 96; ++i) patches.push_back(i);
  const JointRow expected = evaluated_row(mesh_, visibility_, patches, options_);
  for (const std::size_t n_threads : {1U, 3U}) {
    const ThreadLimit limit(n_threads);
    EXPECT_EQ(evaluated_row(mesh_, visibility_, patches, options_).factor, expected.factor);
  }
}

TEST_F(EvaluatedRow, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(evaluated_row(mesh_, visibility_, {0, 1},
                             {.progress = {.report = {}, .stop = source.get_token()}}),
               Interrupted);
}

}  // namespace
}  // namespace radiosity
