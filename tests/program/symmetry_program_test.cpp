// End-to-end tests of scenes that are a part of a symmetric whole.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

class SymmetryProgram : public Program {
 protected:
  /// A quarter of a box of 2 x 2 x 1 m.
  std::string write_quarter(const std::string& symmetry) const {
    const std::string path = result("quarter.json");
    std::ofstream(path) << R"({"bands": "grey", "materials": {
        "warm": {"emissivity": 0.8, "temperature": 400},
        "cold": {"emissivity": 0.5, "temperature": 300}},
      "surfaces": [
        {"name": "floor", "material": "warm",
         "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]},
        {"name": "ceiling", "material": "cold",
         "polygons": [[[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]]},
        {"name": "wall", "material": "cold",
         "polygons": [[[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]],
                      [[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]]]}],
      "symmetry": )" << symmetry
                        << "}";
    return path;
  }
};

TEST_F(SymmetryProgram, KeepsFormFactorsWithTheirImages) {
  const std::string part = write_quarter(R"({"mirror": ["x=0", "y=0"]})");
  EXPECT_EQ(json_of({"inspect", part}).at("parts"), 4);
  json_of({"form-factors", part, "--patches", "60", "-o", result("F.h5")});
  const Json solved = json_of({"solve", part, "--patches", "60"});
  const Json again = json_of({"solve", part, "--operator", result("F.h5")});
  const double emitted = solved["energy"]["emitted"][0];
  // The part's area only: 1 m² at 400 K, 3 m² at 300 K.
  EXPECT_NEAR(emitted, 5.670374419e-8 * (0.8 * 2.56e10 + 3 * 0.5 * 8.1e9), 1e-6 * emitted);
  for (const Json& energy : {solved["energy"], again["energy"]}) {
    EXPECT_NEAR(energy["absorbed"][0].get<double>(), emitted, 1e-7 * emitted);
  }
  write_quarter(R"({"rotation": {"axis": [0, 0, 1], "folds": 4}})");
  expect_error(run({"solve", part, "--operator", result("F.h5")}), 1, "precision or symmetry");
  EXPECT_NEAR(json_of({"solve", part, "--patches", "60"})["energy"]["absorbed"][0].get<double>(),
              emitted, 1e-7 * emitted);
}

TEST_F(SymmetryProgram, RefusesInOneLine) {
  expect_error(run({"solve", write_quarter(R"({"mirror": ["x=0.25"]})")}), 1,
               "surface 'floor', polygon 0: a mirror plane, through (0.25, 0, 0), cuts it");
  expect_error(run({"solve", write_quarter(R"({"mirror": ["x=0"]})"), "--transport", "compressed"}),
               1, "do not know the scene's symmetry");
  expect_error(run({"solve", write_quarter(R"({"miror": ["x=0"]})")}), 1,
               "did you mean \"mirror\"");
}

}  // namespace
