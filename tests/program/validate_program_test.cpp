// End-to-end tests of `radiosity validate`.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

const Arguments kQuick = {"validate", "cube", "plates", "furnace", "--quiet"};

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(Program, ValidateWritesItsReport) {
  const Outcome outcome = run(with(kQuick, {"-o", result("new/report")}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3) << outcome.out;

  const Json report = Json::parse(contents(result("new/report/report.json")));
  EXPECT_EQ(report.at("passed"), true);
  ASSERT_EQ(report.at("cases").size(), 3U);
  EXPECT_EQ(report.at("cases")[0].at("name"), "cube");
  for (const Json& one : report.at("cases")) {
    EXPECT_EQ(one.at("status"), "passed");
    EXPECT_GT(one.at("checks").size(), 0U);
    for (const Json& check : one.at("checks")) {
      EXPECT_EQ(check.at("passed"), true);
      EXPECT_FALSE(check.at("derivation").get<std::string>().empty());
    }
  }
  for (const char* key : {"version", "machine", "date", "threads", "seed"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST_F(Program, ValidatePageNeedsNothingElse) {
  ASSERT_EQ(run(with(kQuick, {"-o", result("")})).exit_code, 0);
  const std::string page = contents(result("report.html"));
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  for (const char* outside : {"<script", "src=\"http", "href=\"http", "url(", "@import", "<link"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  EXPECT_EQ(results(), (std::vector<std::string>{"report.html", "report.json"}));
}

TEST_F(Program, ValidatePrintsJsonIfAsked) {
  const Outcome outcome =
      run({"validate", "cube", "--json", "--quiet", "--threads", "1", "-o", result("")});
  EXPECT_EQ(outcome.exit_code, 0);
  const Json printed = Json::parse(outcome.out);
  EXPECT_EQ(printed, Json::parse(contents(result("report.json"))));
  EXPECT_EQ(printed.at("threads"), 1);
}

TEST_F(Program, ValidateListsItsCases) {
  const Outcome outcome = run({"validate", "--list"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* name :
       {"form-factors", "furnace", "sphere", "plates", "cube", "cornell-box",
        "cornell-box-spectral", "hemisphere-vs-area", "energy", "convergence", "room"}) {
    EXPECT_NE(outcome.out.find(std::string(name) + " "), std::string::npos) << name;
  }
}

TEST_F(Program, ValidateRefusesBadUsage) {
  expect_error(run({"validate", "cub", "-o", result("")}), 2, "form-factors");
  expect_error(run({"validate", "cube"}), 2, "--output");
  expect_error(run({"validate", "cube", "-o", result(""), "--threads", "-1"}), 2, "--threads");
  EXPECT_TRUE(results().empty());
}

TEST_F(Program, ValidateTellsWhatIsMissing) {
  expect_error(run({"validate", "cube", "-o", result(""), "--data", "no-such-folder"}), 1,
               "no-such-folder");
  expect_error(run({"validate", "cube", "-o", result(""), "--scenes", "no-such-folder"}), 1,
               "no-such-folder");
  const std::string file = write_file("file", "");
  expect_error(run({"validate", "cube", "-o", file}), 1, "file");
  expect_error(run({"validate", "cube", "-o", file + "/report"}), 1, "file");
}

TEST_F(Program, ValidateLeavesNothingOnAFullDisk) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  fs::create_symlink("/dev/full", result("report.html"));
  const Outcome outcome = run({"validate", "cube", "--quiet", "-o", result("")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

/// The reference data with one number changed.
class AlteredData : public Program {
 protected:
  std::string altered_data(const std::string& from, const std::string& to) const {
    const fs::path data = folder() / "data";
    fs::create_directory(data);
    std::string text = contents(fs::path(RADIOSITY_TEST_DATA) / "form-factors.json");
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    std::ofstream(data / "form-factors.json") << text;
    return data.string();
  }
};

TEST_F(AlteredData, ACaseFails) {
  // B0 of the cube of six patches, wrong in the seventh digit.
  const std::string data = altered_data("1.0909090981", "1.0909080981");
  const Outcome outcome =
      run({"validate", "cube", "furnace", "--quiet", "--data", data, "-o", result("")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("1 of 2 cases failed: cube"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("failed"), std::string::npos);
  const Json report = Json::parse(contents(result("report.json")));
  EXPECT_EQ(report.at("passed"), false);
  EXPECT_EQ(report.at("cases")[0].at("status"), "failed");
  EXPECT_EQ(report.at("cases")[1].at("status"), "passed");
  EXPECT_NE(contents(result("report.html")).find("✗ failed"), std::string::npos);
  // Of the radiosity of the six patches, ‖ΔB‖/‖B‖ is how far that number was moved; what else adds
  // to it stays within the check's tolerance. All other checks hold.
  const double moved = 1e-6 / std::hypot(1.0909080981, 0.1817458261, 2 * 0.1818362689);
  int n_failed = 0;
  for (const Json& check : report.at("cases")[0].at("checks")) {
    if (check.at("passed") == true) continue;
    ++n_failed;
    EXPECT_NEAR(check.at("value").get<double>(), moved, check.at("tolerance").get<double>());
  }
  EXPECT_EQ(n_failed, 1);
}

TEST_F(AlteredData, ABrokenFileFailsTheCasesThatReadIt) {
  const std::string data = altered_data("\"cases\"", "\"causes\"");
  const Outcome outcome =
      run({"validate", "cube", "furnace", "--quiet", "--data", data, "-o", result("")});
  EXPECT_EQ(outcome.exit_code, 1);
  const Json report = Json::parse(contents(result("report.json")));
  const auto message = report.at("cases")[0].at("message").get<std::string>();
  EXPECT_NE(message.find("form-factors.json"), std::string::npos) << message;
  EXPECT_EQ(report.at("cases")[1].at("status"), "passed");
}

TEST_F(Program, ValidateIsInterrupted) {
  // A quick case, after which it tells its outcome, and long ones.
  const Running running =
      start({"validate", "furnace", "cornell-box", "convergence", "-o", result("")});
  EXPECT_TRUE(running.has_told("furnace"));
  running.send(SIGINT);
  const Outcome outcome = running.wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.err.find("interrupted"), std::string::npos);
  EXPECT_TRUE(results().empty());
}

}  // namespace
