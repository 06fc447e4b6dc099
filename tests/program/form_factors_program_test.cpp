// End-to-end tests of `radiosity form-factors`: work file, interruption, memory, small pairs.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/support/program.h"
#include "tests/support/wait_until.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

class FormFactorsProgram : public Program {
 protected:
  /// A job of a second or two, followed by `more`.
  Arguments job(const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"form-factors", RADIOSITY_SCENES "/cornell-box.json",
                           "--patches",    "500",
                           "--threads",    "2",
                           "-o",           result(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// A job of no time.
  Arguments cube(const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"form-factors", write_cube(0.5, 1), "--as-is", "--quiet",
                           "-o",           result(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  /// Runs the job and stops it by a signal as soon as the work file has grown to `size`; starts
  /// from the work file that is there.
  Outcome stop_at(const std::string& output, std::uintmax_t size, int signal) const {
    const Running running = start(job(output, {"--resume"}));
    const fs::path work_file = result(output + ".partial");
    std::error_code ignored;
    EXPECT_TRUE(wait_until(
        [&] { return fs::exists(work_file) && fs::file_size(work_file, ignored) >= size; }));
    running.send(signal);
    return running.wait();
  }
  void expect_success(const Arguments& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(FormFactorsProgram, KilledAtAnyMomentItResumesToTheSameBytes) {
  expect_success(job("whole.h5"));
  std::mt19937_64 random(11);  // NOLINT: fixed seed
  std::uintmax_t size = 0;
  for (int trial = 0; trial < 3; ++trial) {
    size += std::uniform_int_distribution<std::uintmax_t>(1, 120'000)(random);
    SCOPED_TRACE(size);
    EXPECT_EQ(stop_at("f.h5", size, SIGKILL).exit_code, -SIGKILL);
    EXPECT_EQ(results(), (Names{"f.h5.partial", "whole.h5"}));
  }
  expect_success(job("f.h5", {"--resume"}));
  EXPECT_EQ(results(), (Names{"f.h5", "whole.h5"}));
  EXPECT_TRUE(contents(result("f.h5")) == contents(result("whole.h5")));
}

TEST_F(FormFactorsProgram, InterruptedItTellsHowToGoOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome outcome = stop_at("f.h5", 100'000, signal);
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_NE(outcome.err.find("radiosity: interrupted"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("f.h5.partial keeps what is done"), std::string::npos);
    EXPECT_NE(outcome.err.find("--resume"), std::string::npos);
    EXPECT_EQ(results(), Names{"f.h5.partial"});
    fs::remove(result("f.h5.partial"));
  }
}

TEST_F(FormFactorsProgram, WorkFileOfAnotherComputationIsLeftAlone) {
  stop_at("f.h5", 10'000, SIGKILL);
  const std::string before = contents(result("f.h5.partial"));
  const Arguments other_scene = {"form-factors", write_cube(0.5, 1), "-o", result("f.h5"),
                                 "--resume"};
  for (const Arguments& arguments :
       {other_scene, job("f.h5", {"--resume", "--tolerance", "0.02"}),
        job("f.h5", {"--resume", "--seed", "1"}), job("f.h5", {"--resume", "--closed", "yes"}),
        job("f.h5", {"--resume", "--min-factor", "1e-9"})}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_error(run(arguments), 1, "cannot be resumed");
    EXPECT_TRUE(contents(result("f.h5.partial")) == before);
  }
  Arguments other_patches = job("f.h5", {"--resume"});
  other_patches[3] = "400";
  expect_error(run(other_patches), 1, "cannot be resumed");
  EXPECT_TRUE(contents(result("f.h5.partial")) == before);
}

TEST_F(FormFactorsProgram, WorkFileIsReplacedWithAWarning) {
  stop_at("f.h5", 10'000, SIGKILL);
  const Outcome outcome = run(job("f.h5"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("--resume would have continued it"), std::string::npos) << outcome.err;
  EXPECT_EQ(results(), Names{"f.h5"});
}

TEST_F(FormFactorsProgram, DoesNotReplaceWhatIsNoWorkFile) {
  const std::string notes = result("f.h5.partial");
  std::ofstream(notes) << "somebody's notes";
  expect_error(run(cube("f.h5")), 1, "no");
  expect_error(run(cube("f.h5", {"--resume"})), 1, "not a work file");
  EXPECT_EQ(contents(notes), "somebody's notes");
}

TEST_F(FormFactorsProgram, CompleteResultIsNotComputedAgain) {
  expect_success(cube("f.h5", {"--resume"}));  // without a work file, it simply starts
  const std::string before = contents(result("f.h5"));
  const auto time = fs::last_write_time(result("f.h5"));
  const Outcome outcome = run(cube("f.h5", {"--resume", "--json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("outputs"), Json({result("f.h5")}));
  ASSERT_EQ(json.at("warnings").size(), 1U);
  EXPECT_NE(json["warnings"][0].get<std::string>().find("complete already"), std::string::npos);
  EXPECT_EQ(fs::last_write_time(result("f.h5")), time);
  // Other options give another result.
  expect_success(cube("f.h5", {"--resume", "--seed", "1"}));
  EXPECT_FALSE(contents(result("f.h5")) == before);
}

TEST_F(FormFactorsProgram, WorkFileLiesBesideTheTableToo) {
  expect_success(cube("f.csv"));
  EXPECT_EQ(results(), Names{"f.csv"});
  const std::string whole = contents(result("f.csv"));
  stop_at("f.csv", 10'000, SIGKILL);
  EXPECT_EQ(results(), (Names{"f.csv", "f.csv.partial"}));
  EXPECT_EQ(contents(result("f.csv")), whole);
}

TEST_F(FormFactorsProgram, FullDiskIsOneLineAndKeepsTheWorkFile) {
  {
    const SmallDisk disk(100'000);
    expect_error(run(job("f.h5", {"--quiet"})), 1, "f.h5.partial: cannot write");
  }
  EXPECT_EQ(results(), Names{"f.h5.partial"});
  {
    const SmallDisk disk(1'500'000);  // enough for the work file
    expect_error(run(job("f.h5", {"--quiet", "--resume"})), 1, "f.h5: ");
  }
  EXPECT_EQ(results(), Names{"f.h5.partial"});
  expect_success(job("f.h5", {"--resume"}));
  EXPECT_EQ(results(), Names{"f.h5"});
}

TEST_F(FormFactorsProgram, MemoryIsReadWithItsUnit) {
  for (const char* text : {"lots", "", "GB", "-1GB", "0", "1XB", "2 G B", "nan", "1e40", "1Gib2"}) {
    SCOPED_TRACE(text);
    expect_error(run(cube("f.h5", {"--memory", text})), 2, "--memory");
  }
  for (const char* text :
       {"2GB", "500MB", "1.5G", "750MiB", "800000000", "1e9", "1 gib", "700000k"}) {
    SCOPED_TRACE(text);
    expect_success(cube("f.h5", {"--memory", text}));
  }
}

TEST_F(FormFactorsProgram, TooLittleMemoryTellsTheLeastThatWorks) {
  const Outcome refused = run(cube("f.h5", {"--memory", "1MB"}));
  expect_error(refused, 1, "use --memory ");
  const std::string words = "use --memory ";
  const std::size_t begin = refused.err.find(words) + words.size();
  const std::string least = refused.err.substr(begin, refused.err.find(' ', begin) - begin);
  EXPECT_TRUE(results().empty());
  expect_success(cube("f.h5", {"--memory", least}));
  expect_success(cube("g.h5"));
  EXPECT_TRUE(contents(result("f.h5")) == contents(result("g.h5")));
}

TEST_F(FormFactorsProgram, TellsWhatSmallPairsHeld) {
  for (const char* text : {"0", "1", "-0.1", "nan", "some"}) {
    expect_error(run(cube("f.h5", {"--min-factor", text})), 2, "--min-factor");
  }
  const Outcome outcome = run(cube("f.h5", {"--min-factor", "0.2", "--json"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json dropped = Json::parse(outcome.out).at("dropped");
  // Opposite faces of a cube: 0.1998; those side by side: 0.2000.
  EXPECT_EQ(dropped.at("min_factor"), 0.2);
  EXPECT_EQ(dropped.at("entries"), 6);
  EXPECT_NEAR(dropped.at("share").get<double>(), 0.199824895698387383, 1e-9);
  EXPECT_NEAR(dropped.at("largest_row_share").get<double>(), 0.199824895698387383, 1e-9);
  EXPECT_EQ(dropped.at("unbalanced_rows"), 0);
  EXPECT_NE(run(cube("f.h5", {"--min-factor", "0.2"})).out.find("dropped"), std::string::npos);
}

}  // namespace
