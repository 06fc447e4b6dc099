// End-to-end tests of form factors that are used again: operator files, scenarios, rows.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

constexpr const char* kRoom = RADIOSITY_SCENES "/l-room.json";
constexpr const char* kBox = RADIOSITY_SCENES "/cornell-box.json";

class ReuseProgram : public Program {
 protected:
  /// Form factors of the room, of some kind.
  std::string made(const std::string& kind, const std::string& name = "o.h5") const {
    const Outcome outcome = run(
        {"solve", kRoom, "--patches", "300", "--transport", kind, "-o", result(name), "--quiet"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return result(name);
  }
};

TEST_F(ReuseProgram, AKeptOperatorGivesTheSameResults) {
  for (const std::string kind : {"dense", "compressed"}) {
    SCOPED_TRACE(kind);
    const Json first = json_of({"solve", kRoom, "--patches", "300", "--transport", kind, "-o",
                                result("o.h5"), "-o", result("a.csv")});
    const Json again =
        json_of({"solve", kRoom, "--operator", result("o.h5"), "-o", result("b.csv")});
    EXPECT_EQ(first.at("form_factors").at("kind"), kind);
    EXPECT_EQ(again.at("form_factors").at("kind"), kind);
    EXPECT_EQ(again["form_factors"].at("read_from"), result("o.h5"));
    EXPECT_FALSE(first["form_factors"].contains("read_from"));
    EXPECT_EQ(again.at("patches"), first.at("patches"));
    const double emitted = first["energy"]["emitted"][0];
    for (const char* share : {"emitted", "absorbed", "escaped"}) {
      EXPECT_NEAR(again["energy"][share][0].get<double>(), first["energy"][share][0].get<double>(),
                  1e-9 * emitted);
    }
    if (kind == "compressed") {
      EXPECT_EQ(contents(result("a.csv")), contents(result("b.csv")));
    }
  }
}

TEST_F(ReuseProgram, AKeptOperatorIsVerifiedForOtherLight) {
  const std::string file = made("compressed");
  const Json solved = json_of({"solve", kRoom, "--operator", file, "--verify"});
  const Json& verified = solved.at("form_factors").at("compressed").at("for_this_light");
  EXPECT_GE(verified.at("rows").get<int>(), 96);
  EXPECT_GT(verified.at("verified_error").get<double>(), 0);
  EXPECT_LE(verified.at("verified_error").get<double>(), 1e-2);
  const Json dense = json_of({"solve", kRoom, "--operator", made("dense"), "--verify"});
  EXPECT_FALSE(dense.at("form_factors").contains("compressed"));
  expect_error(run({"solve", kRoom, "--verify"}), 2, "--operator");
}

TEST_F(ReuseProgram, FilesOfFormFactorsServe) {
  ASSERT_EQ(run({"form-factors", kRoom, "--patches", "200", "-o", result("F.h5")}).exit_code, 0);
  const Json solved = json_of({"solve", kRoom, "--operator", result("F.h5")});
  EXPECT_EQ(solved.at("form_factors").at("kind"), "dense");
  ASSERT_EQ(run({"form-factors", kRoom, "--patches", "200", "--transport", "compressed",
                 "--tolerance", "0.01", "-o", result("G.h5"), "-o", result("G.csv")})
                .exit_code,
            0);
  EXPECT_EQ(json_of({"solve", kRoom, "--operator", result("G.h5")})["form_factors"]["kind"],
            "compressed");
}

TEST_F(ReuseProgram, OtherSurfacesAndPatchesAreRefused) {
  const std::string file = made("dense");
  expect_error(run({"solve", kBox, "--operator", file}), 1, "surfaces");
  expect_error(run({"solve", kRoom, "--operator", file, "--unit", "mm"}), 1, "other polygons");
  expect_error(run({"solve", kRoom, "--operator", file, "--patches", "100"}), 1, "patches");
  expect_error(run({"solve", kRoom, "--operator", file, "--adaptive"}), 2, "--operator");
  expect_error(run({"solve", kRoom, "--operator", file, "-o", file}), 1, "o.h5");
  expect_error(run({"solve", kRoom, "--operator", kRoom}), 1, "is not an operator");
  expect_error(run({"solve", kRoom, "--operator", result("none.h5")}), 1, "no such file");
  const std::string whole = contents(file);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() / 2);
  expect_error(run({"solve", kRoom, "--operator", file}), 1, "o.h5");
}

TEST_F(ReuseProgram, AFullDiskIsOneLine) {
  {
    const SmallDisk disk(50'000);
    expect_error(run({"solve", kRoom, "--patches", "300", "-o", result("o.h5"), "--quiet"}), 1,
                 "o.h5");
  }
  EXPECT_TRUE(results().empty());
}

TEST_F(ReuseProgram, MethodsThatGoByRowsAreDense) {
  const Json json = json_of({"solve", kRoom, "--patches", "200", "--method", "gauss-seidel"});
  EXPECT_EQ(json.at("form_factors").at("kind"), "dense");
  expect_error(run({"solve", kRoom, "--patches", "200", "--method", "southwell", "--transport",
                    "compressed"}),
               1, "goes by rows");
}

TEST_F(ReuseProgram, SolvesScenarios) {
  const std::string list = write_file("s.json", R"({"scenarios": [
    {"name": "on"}, {"name": "half", "lights": {"*": 0.5}},
    {"name": "dark", "reflectances": {"*": 0}}]})");
  const Json json =
      json_of({"solve", kRoom, "--patches", "200", "--scenarios", list, "--table", result("t.csv"),
               "-o", result("r.csv"), "-o", result("o.h5"), "--quantity", "power"});
  EXPECT_EQ(results(), (Names{"o.h5", "r-dark.csv", "r-half.csv", "r-on.csv", "t.csv"}));
  ASSERT_EQ(json.at("scenarios").size(), 3U);
  const auto emitted = [&](int k) {
    return json["scenarios"][k]["energy"]["emitted"][0].get<double>();
  };
  EXPECT_NEAR(emitted(1), 0.5 * emitted(0), 1e-12 * emitted(0));
  EXPECT_EQ(json["scenarios"][2].at("name"), "dark");
  EXPECT_EQ(json["outputs"].size(), 5U);
  const std::string table = contents(result("t.csv"));
  EXPECT_EQ(table.rfind("scenario,surface,area,irradiance_0,irradiance_0_min,irradiance_0_max,", 0),
            0U)
      << table;
  EXPECT_NE(table.find("power_0,power_1,power_2\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\nhalf,"), std::string::npos);
  // As solved alone, with the operator that was written beside.
  const Json alone = json_of({"solve", kRoom, "--operator", result("o.h5")});
  for (const char* share : {"emitted", "absorbed"}) {
    EXPECT_NEAR(alone["energy"][share][0].get<double>(),
                json["scenarios"][0]["energy"][share][0].get<double>(), 1e-7 * emitted(0));
  }
  expect_error(run({"solve", kRoom, "--table", result("t.csv")}), 2, "--scenarios");
  expect_error(run({"solve", kRoom, "--scenarios", list, "-o", list}), 2, "expected a file name");
}

TEST_F(ReuseProgram, TellsRowsOfScenesAndFiles) {
  const std::string dense = made("dense", "d.h5");
  const std::string compressed = made("compressed", "c.h5");
  const Json evaluated =
      json_of({"form-factors", kRoom, "--patches", "300", "--row", "5", "-o", result("row.csv")});
  const Json read = json_of({"form-factors", dense, "--row", "5"});
  const Json approximate = json_of({"form-factors", compressed, "--row", "5"});
  const Json exact = json_of({"form-factors", compressed, "--row", "5", "--exact"});
  EXPECT_TRUE(evaluated.at("evaluated").get<bool>());
  EXPECT_FALSE(read.at("evaluated").get<bool>());
  EXPECT_TRUE(exact.at("evaluated").get<bool>());
  EXPECT_EQ(exact.at("factors"), evaluated.at("factors"));
  EXPECT_NEAR(read.at("sum").get<double>(), evaluated.at("sum").get<double>(), 1e-2);
  EXPECT_NEAR(approximate.at("sum").get<double>(), evaluated.at("sum").get<double>(), 0.1);
  EXPECT_EQ(contents(result("row.csv")).rfind("patch,surface,factor,error\n", 0), 0U);
  const std::string surface = evaluated["factors"][0]["surface"];
  EXPECT_GT(json_of({"form-factors", dense, "--row", surface}).at("row_patches").size(), 1U);
  expect_error(run({"form-factors", dense, "--row", "100000"}), 1, "no patch of that number");
  expect_error(run({"form-factors", kRoom, "--row", "walk"}), 1, "nearest");
  expect_error(run({"form-factors", kRoom, "--row", "1", "-o", result("x.h5")}), 2, ".csv");
  expect_error(run({"form-factors", kRoom, "--exact", "-o", result("x.h5")}), 2, "--row");
}

}  // namespace
