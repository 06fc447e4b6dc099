// End-to-end tests of `radiosity form-factors --part` and `radiosity merge`.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/wait_until.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

class PartsProgram : public Program {
 protected:
  Arguments job(const std::string& scene, const Arguments& options,
                const std::string& output = "f.h5") const {
    Arguments arguments = {"form-factors", scene, "--quiet", "-o", result(output)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  static std::string part_name(int k, int n, const std::string& stem = "f") {
    return stem + "." + std::to_string(k) + "-of-" + std::to_string(n) + ".h5";
  }
  void make_part(const std::string& scene, Arguments options, int k, int n,
                 const std::string& output = "f.h5") const {
    options.insert(options.end(), {"--part", std::to_string(k) + "/" + std::to_string(n)});
    expect_success(job(scene, options, output));
  }
  void make_parts(const std::string& scene, const Arguments& options, int n,
                  const std::string& output = "f.h5") const {
    for (int k = 1; k <= n; ++k) make_part(scene, options, k, n, output);
  }
  Arguments merge(const Names& parts, const Arguments& options = {}) const {
    Arguments arguments = {"merge", "--quiet", "-o", result("f.h5")};
    for (const std::string& part : parts) arguments.push_back(result(part));
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  static Names part_names(int n) {
    Names names;
    for (int k = n; k >= 1; --k) names.push_back(part_name(k, n));  // in any order
    return names;
  }
  void expect_success(const Arguments& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  /// Whether n parts, put together, are the bytes of one run.
  void expect_same(const std::string& scene, const Arguments& options, int n) const {
    make_parts(scene, options, n);
    expect_success(merge(part_names(n)));
    expect_success(job(scene, options, "whole.h5"));
    EXPECT_TRUE(contents(result("f.h5")) == contents(result("whole.h5")));
    EXPECT_GT(contents(result("f.h5")).size(), 1000U);
  }
};

/// Writes another text, of at most the same length, into an attribute of an HDF5 file.
void set_attribute(const std::string& path, const char* name, std::string text) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  text.resize(H5Tget_size(type), '\0');
  EXPECT_GE(H5Awrite(attribute, type, text.data()), 0);
  H5Tclose(type);
  H5Aclose(attribute);
  H5Fclose(file);
}

const std::string kCornellBox = RADIOSITY_SCENES "/cornell-box.json";

TEST_F(PartsProgram, SixteenPartsOfWhichThreeWereMadeAgainAreTheBytesOfOneRun) {
  const Arguments options = {"--patches", "500", "--tolerance", "0.01"};
  make_parts(kCornellBox, options, 16);
  for (const int k : {3, 8, 16}) {
    const std::string before = contents(result(part_name(k, 16)));
    fs::remove(result(part_name(k, 16)));
    Arguments again = options;
    again.insert(again.end(), {"--threads", "1", "--memory", "300MB"});
    make_part(kCornellBox, again, k, 16);
    EXPECT_TRUE(contents(result(part_name(k, 16))) == before) << k;
  }
  expect_success(merge(part_names(16)));
  expect_success(job(kCornellBox, options, "whole.h5"));
  EXPECT_TRUE(contents(result("f.h5")) == contents(result("whole.h5")));
  fs::remove(result("whole.h5"));
  EXPECT_EQ(results().size(), 17U);  // nothing but the parts is left beside it
}

TEST_F(PartsProgram, OpenTurnedAndSmallScenesAreTheSame) {
  const std::string turned =
      write_file("turned.obj",
                 "v 1 2 3\nv 1.8 2.6 3\nv 1.2 3.4 3\nv 0.4 2.8 3\n"
                 "v 1.1 2.1 4.7\nv 1.7 2.5 4.5\nv 1.2 3.3 4.6\n"
                 "v 1 2.4 3.7\nv 1.5 2.8 3.7\nv 1.3 3 3.9\n"
                 "o floor\nf 1 2 3 4\no roof\nf 7 6 5\no between\nf 8 9 10\n");
  expect_same(turned, {"--patches", "150", "--min-factor", "1e-3", "--seed", "4"}, 5);
}

TEST_F(PartsProgram, TwoSidedScenesAreTheSame) {
  expect_same(RADIOSITY_SCENES "/satellite-shield.json",
              {"--patches", "200", "--tolerance", "0.01"}, 2);
}

TEST_F(PartsProgram, MorePartsThanStripsAndOneOnlyAreTheSame) {
  expect_same(write_cube(0.5, 1), {"--as-is"}, 9);
  expect_same(write_cube(0.5, 1), {"--as-is"}, 1);
}

TEST_F(PartsProgram, SymmetricScenesAreTheSame) {
  const std::string quarter = write_file("quarter.json", R"({"bands": "grey",
      "materials": {"wall": {"reflectance": 0.5, "exitance": 1}},
      "surfaces": [
        {"name": "floor", "material": "wall",
         "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]},
        {"name": "rest", "material": "wall",
         "polygons": [[[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]],
                      [[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]],
                      [[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]]]}],
      "symmetry": {"mirror": ["x=0", "y=0"]}})");
  expect_same(quarter, {"--patches", "200", "--tolerance", "0.01"}, 3);
}

TEST_F(PartsProgram, CompressedOnesAreTheSame) {
  const Arguments options = {"--patches",  "1600",        "--transport",
                             "compressed", "--tolerance", "0.015"};
  make_part(kCornellBox, options, 1, 2);
  Arguments second = options;
  second.insert(second.end(), {"--part", "2/2", "--json"});
  EXPECT_GT(Json::parse(run(job(kCornellBox, second)).out).at("part").at("records"), 1000);
  expect_success(merge(part_names(2)));
  expect_success(job(kCornellBox, options, "whole.h5"));
  EXPECT_TRUE(contents(result("f.h5")) == contents(result("whole.h5")));
}

TEST_F(PartsProgram, MergeMakesRoundsThatFollow) {
  expect_same(RADIOSITY_SCENES "/window.json",
              {"--patches", "1500", "--transport", "compressed", "--tolerance", "0.02"}, 2);
  const Outcome merged = run(merge(part_names(2), {"--json"}));
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(Json::parse(merged.out).at("form_factors").at("compressed").at("rounds"), 1);
}

TEST_F(PartsProgram, TellsWhatWasMade) {
  const Outcome part = run(job(write_cube(0.5, 1), {"--as-is", "--part", "1/2", "--json"}));
  ASSERT_EQ(part.exit_code, 0) << part.err;
  const Json json = Json::parse(part.out);
  EXPECT_EQ(json.at("patches"), 6);
  EXPECT_EQ(json.at("part").at("number"), 1);
  EXPECT_EQ(json.at("part").at("parts"), 2);
  EXPECT_EQ(json.at("outputs"), Json({result(part_name(1, 2))}));
  make_part(write_cube(0.5, 1), {"--as-is"}, 2, 2);
  const Outcome merged = run(merge(part_names(2), {"--json"}));
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(Json::parse(merged.out).at("parts"), 2);
  EXPECT_EQ(Json::parse(merged.out).at("form_factors").at("pairs").at("facing"), 15);
}

TEST_F(PartsProgram, KilledPartGoesOnAndWhatIsDoneIsNotDoneAgain) {
  const Arguments options = {"--patches", "500", "--part", "2/3", "--resume"};
  const fs::path work_file = result(part_name(2, 3) + ".partial");
  {
    const Running running = start(job(kCornellBox, options));
    std::error_code ignored;
    EXPECT_TRUE(wait_until(
        [&] { return fs::exists(work_file) && fs::file_size(work_file, ignored) > 20'000; }));
    running.send(SIGKILL);
    running.wait();
  }
  EXPECT_EQ(results(), Names{part_name(2, 3) + ".partial"});
  expect_success(job(kCornellBox, options));
  EXPECT_EQ(results(), Names{part_name(2, 3)});
  const std::string resumed = contents(result(part_name(2, 3)));
  const Outcome again = run(job(kCornellBox, options));
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("complete already"), std::string::npos) << again.err;
  fs::remove(result(part_name(2, 3)));
  expect_success(job(kCornellBox, options));
  EXPECT_TRUE(contents(result(part_name(2, 3))) == resumed);
}

TEST_F(PartsProgram, EachWrongSetOfPartsIsOneLine) {
  const std::string cube = write_cube(0.5, 1);
  make_parts(cube, {"--as-is"}, 3);
  expect_error(run(merge({part_name(2, 3)})), 1, "2 are missing: 1, 3");
  expect_error(run(merge({part_name(1, 3), part_name(3, 3)})), 1, "1 is missing: 2");
  fs::copy_file(result(part_name(2, 3)), result("copy.h5"));
  Names doubled = part_names(3);
  doubled.emplace_back("copy.h5");
  expect_error(run(merge(doubled)), 1, "copy.h5: is part 2 of 3, and so is ");

  const Names others = {part_name(1, 3), part_name(2, 3), "g.3-of-3.h5"};
  const auto expect_refused = [&](const std::string& scene, const Arguments& options,
                                  const std::string& words) {
    make_part(scene, options, 3, 3, "g.h5");
    expect_error(run(merge(others)), 1, "g.3-of-3.h5: " + words);
  };
  expect_refused(kCornellBox, {"--patches", "50"}, "is of another scene (cornell-box.json)");
  expect_refused(cube, {"--as-is", "--tolerance", "0.02"}, "was made with --tolerance 0.02, but ");
  expect_refused(cube, {"--as-is", "--seed", "7"}, "was made of other patches or with other");
  expect_refused(cube, {"--patches", "30"}, "was made of other patches or with other options");
  expect_refused(cube, {"--as-is", "--transport", "compressed"}, "has compressed form factors");
  make_part(cube, {"--as-is"}, 3, 4);
  expect_error(run(merge({part_name(1, 3), part_name(3, 4)})), 1, "is one of 4 parts, but ");

  expect_success(job(cube, {"--as-is"}, "whole.h5"));
  expect_error(run(merge({"whole.h5"})), 1, "whole.h5: is no part of form factors");
  std::ofstream(result("notes.h5")) << "somebody's notes";
  expect_error(run(merge({"notes.h5"})), 1, "notes.h5: is not a part of form factors (HDF5)");
  EXPECT_FALSE(fs::exists(result("f.h5")));
}

TEST_F(PartsProgram, OtherVersionsAreRefused) {
  make_parts(write_cube(0.5, 1), {"--as-is"}, 2);
  const std::string first = result(part_name(1, 2));
  const std::string second = result(part_name(2, 2));
  set_attribute(first, "fingerprint", "0123456789abcdef");
  set_attribute(first, "program", "0.0.1");
  expect_error(run(merge(part_names(2))), 1,
               part_name(1, 2) + ": was made by version 0.0.1 of this program, but ");
  set_attribute(second, "fingerprint", "0123456789abcdef");
  set_attribute(second, "program", "0.0.1");
  expect_error(run(merge(part_names(2))), 1,
               "was made by version 0.0.1 of this program, which computes other numbers");
}

TEST_F(PartsProgram, DamageIsTold) {
  make_parts(kCornellBox, {"--patches", "300"}, 2);
  const std::string name = part_name(1, 2);
  const std::string whole = contents(result(name));
  std::string spoilt = whole;
  spoilt[spoilt.size() / 2] ^= 0x10;
  std::ofstream(result(name), std::ios::binary) << spoilt;
  expect_error(run(merge(part_names(2))), 1, name + ": ");
  std::ofstream(result(name), std::ios::binary) << whole.substr(0, whole.size() / 3);
  expect_error(run(merge(part_names(2))), 1, name + ": ");
  EXPECT_EQ(results(), (Names{part_name(1, 2), part_name(2, 2)}));
}

TEST_F(PartsProgram, BadUsageIsOneLine) {
  const std::string cube = write_cube(0.5, 1);
  for (const char* text : {"0/4", "5/4", "1", "1/", "/4", "a/b", "1/2/3", "-1/4", "1/0", "1/1e3",
                           "1/99999999999999999999", "1/9999999"}) {
    SCOPED_TRACE(text);
    expect_error(run(job(cube, {"--part", text})), 2, "--part");
  }
  expect_error(run(job(cube, {"--part", "1/2", "--by", "surface"})), 2, "--part");
  expect_error(run(job(cube, {"--part", "1/2"}, "f.csv")), 2, "--part");
  expect_error(run({"merge", "-o", result("f.h5")}), 2, "PART is required");
  expect_error(run({"merge", result("f.1-of-1.h5")}), 2, "--output");
  make_parts(cube, {"--as-is"}, 1);
  expect_error(run({"merge", result("f.1-of-1.h5"), "-o", result("f.csv")}), 2, "--output");
  expect_error(run({"merge", result("f.1-of-1.h5"), "-o", result("f.1-of-1.h5")}), 1,
               "it is one of the parts");
  expect_error(run({"merge", result("missing.h5"), "-o", result("f.h5")}), 1, "missing.h5");
  EXPECT_EQ(results(), Names{"f.1-of-1.h5"});
}

}  // namespace
