// `radiosity exchange`, as a user would run it.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "radiosity/base/geometry.h"
#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using radiosity::Index;
using Json = nlohmann::json;

class Exchange : public Program {
 protected:
  /// Two unit squares that face each other at distance 1, of emissivities 0.8 and 0.5.
  std::string write_squares(const std::string& bands = "grey") const {
    return write_file("squares.json", R"({"bands": ")" + bands + R"(",
      "materials": {"a": {"emissivity": 0.8, "temperature": 400}, "b": {"emissivity": 0.5}},
      "surfaces": [
        {"name": "hot, below", "material": "a",
         "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]},
        {"name": "cold", "material": "b",
         "polygons": [[[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]]}]})");
  }
};

constexpr double kCoupling = 0.0802503980;
constexpr double kHotToSpace = 0.7069207800;
constexpr double kColdToSpace = 0.4177450985;

/// The number behind the first `words` in a text.
double number_behind(const std::string& text, const std::string& words) {
  const std::size_t place = text.find(words);
  EXPECT_NE(place, std::string::npos) << words << " in " << text;
  return place == std::string::npos ? 0 : std::stod(text.substr(place + words.size()));
}

TEST_F(Exchange, OfOpposedSquaresHasItsClosedForm) {
  const Outcome outcome =
      run({"exchange", write_squares(), "--as-is", "--json", "-o", result("gr.csv"), "-o",
           result("gr.esatan"), "-o", result("gr.sinda"), "-o", result("gr.h5")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_NEAR(json["couplings"][0][1], kCoupling, 1e-8);
  EXPECT_EQ(json["couplings"][0][1], json["couplings"][1][0]);
  EXPECT_NEAR(json["to_space"][0], kHotToSpace, 1e-8);
  EXPECT_NEAR(json["to_space"][1], kColdToSpace, 1e-8);
  EXPECT_NEAR(json["gebhart"][1][0], 0.160500796, 1e-8);

  const std::string csv = contents(result("gr.csv"));
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "from,to,from_node,to_node,coupling,error,gebhart,script_f");
  EXPECT_NEAR(number_behind(csv, "\n\"hot, below\",cold,1,2,"), kCoupling, 1e-8);
  EXPECT_NEAR(number_behind(csv, "\ncold,\"hot, below\",2,1,"), kCoupling, 1e-8);
  EXPECT_NEAR(number_behind(csv, "\ncold,(space),2,99999,"), kColdToSpace, 1e-8);
  EXPECT_EQ(csv.find("(backs)"), std::string::npos);

  const std::string esatan = contents(result("gr.esatan"));
  EXPECT_NE(esatan.find("# 1: hot, below, 1 m2, emissivity 0.8\n"), std::string::npos) << esatan;
  EXPECT_NEAR(number_behind(esatan, "\nGR(1, 2) = "), kCoupling, 1e-8);
  EXPECT_NEAR(number_behind(esatan, "\nGR(1, 99999) = "), kHotToSpace, 1e-8);
  EXPECT_EQ(esatan.find("GR(2, 1)"), std::string::npos);
  EXPECT_NEAR(number_behind(contents(result("gr.sinda")), "\n-1, 1, 2, "), kCoupling, 1e-8);

  const hid_t file = H5Fopen(result("gr.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t set = H5Dopen2(file, "couplings", H5P_DEFAULT);
  double couplings[4] = {};
  EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, couplings), 0);
  H5Dclose(set);
  H5Fclose(file);
  EXPECT_EQ(couplings[1], json["couplings"][0][1].get<double>());
}

/// What flows into a node of Oppenheim's network that is held at 0, where node 1 is held at 1.
double heat_through(const std::string& network, const std::string& into) {
  std::map<std::string, Index> place;
  std::vector<std::tuple<Index, Index, double>> wires;
  std::istringstream lines(network);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "kind,from,to,conductance");
  while (std::getline(lines, line)) {
    std::vector<std::string> fields;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) fields.push_back(word);
    for (int k = 1; k < 3; ++k) place.emplace(fields[k], static_cast<Index>(place.size()));
    wires.emplace_back(place[fields[1]], place[fields[2]], std::min(std::stod(fields[3]), 1e12));
  }
  const auto n = static_cast<Index>(place.size());
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [a, b, conductance] : wires) {
    flow(a, a) += conductance;
    flow(b, b) += conductance;
    flow(a, b) -= conductance;
    flow(b, a) -= conductance;
  }
  Eigen::MatrixXd held = flow;
  Eigen::VectorXd given = Eigen::VectorXd::Zero(n);
  for (const auto& [name, k] : place) {
    if (name[0] != 'E') continue;
    held.row(k).setZero();
    held(k, k) = 1;
    given[k] = name == "E1" ? 1 : 0;
  }
  const Eigen::VectorXd potential = held.partialPivLu().solve(given);
  return -flow.row(place.at(into)).dot(potential);
}

// Surfaces of one patch each have one radiosity, so Oppenheim's network is exact: what flows is
// what the couplings tell. Of black ones, too.
TEST_F(Exchange, NetworkOfOppenheimTellsTheCouplings) {
  const Outcome outcome = run({"exchange", write_squares(), "--as-is", "--quiet", "-o",
                               result("gr.oppenheim"), "-o", result("gr.sinda"), "--positive"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string network = contents(result("gr.oppenheim"));
  EXPECT_NEAR(number_behind(network, "\nsurface,E1,J1,"), 4, 1e-12);
  EXPECT_NEAR(number_behind(network, "\nspace,J1,J2,"), 0.19982490, 1e-8);
  EXPECT_NEAR(heat_through(network, "E2"), kCoupling, 1e-8);
  EXPECT_NEAR(heat_through(network, "E99999"), kHotToSpace, 1e-8);
  EXPECT_NEAR(number_behind(contents(result("gr.sinda")), "\n1, 1, 2, "), kCoupling, 1e-8);

  const std::string cube = write_file("cube.off",
                                      "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n"
                                      "1 1 1\n0 1 1\n4 0 1 2 3\n4 4 7 6 5\n4 0 4 5 1\n4 1 5 6 2\n"
                                      "4 2 6 7 3\n4 3 7 4 0\n");
  const Outcome black = run({"exchange", cube, "--as-is", "--by", "patch", "--quiet", "-o",
                             result("cube.oppenheim"), "-o", result("cube.csv")});
  ASSERT_EQ(black.exit_code, 0) << black.err;
  const std::string csv = contents(result("cube.csv"));
  const double coupling = number_behind(csv, ",1,2,");
  EXPECT_NEAR(heat_through(contents(result("cube.oppenheim")), "E2"), coupling, 1e-8);
}

TEST_F(Exchange, TakesNodesAndSigma) {
  const std::string nodes = write_file("nodes.csv", "surface,node\n\"hot, below\",120\ncold,7\n");
  const Outcome outcome = run({"exchange", write_squares(), "--as-is", "--quiet", "--nodes", nodes,
                               "--space-node", "1000", "--sigma", "-o", result("gr.sinda")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("0.080250398"), std::string::npos) << outcome.out;
  const std::string sinda = contents(result("gr.sinda"));
  EXPECT_NEAR(number_behind(sinda, "\n-1, 120, 7, "), 5.670374419e-8 * kCoupling, 1e-16);
  EXPECT_NEAR(number_behind(sinda, "\n-3, 7, 1000, "), 5.670374419e-8 * kColdToSpace, 1e-16);
}

TEST_F(Exchange, GoesByPatch) {
  const Outcome outcome = run(
      {"exchange", write_cube(0.5, 1), "--patches", "24", "--by", "patch", "--json", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  ASSERT_EQ(json["nodes"].size(), 24U);
  double sum = 0;
  for (const Json& value : json["couplings"][5]) sum += value.get<double>();
  EXPECT_NEAR(sum, json["emitting"][5].get<double>(), 1e-10);
}

TEST_F(Exchange, RefusesWhatMakesNoSense) {
  const std::string squares = write_squares();
  const auto expect_refused = [&](const std::string& nodes, const std::string& words) {
    SCOPED_TRACE(nodes);
    expect_error(run({"exchange", squares, "--as-is", "--quiet", "--nodes",
                      write_file("nodes.csv", nodes), "-o", result("gr.csv")}),
                 1, words);
    EXPECT_TRUE(results().empty());
  };
  expect_refused("cold,7\n", "has no node for surface 'hot, below'");
  expect_refused("cold,7\n\"hot, below\",7\n", "nodes.csv:2: node 7 is there twice");
  expect_refused("cold,7\ncold,8\n", "has a number already");
  expect_refused("surface,node\nwarm,7\n", "nodes.csv:2: the scene has no surface \"warm\"");
  expect_refused("cold,-7\n", "expected a node number above 0");
  expect_refused("cold,7.5\n", "expected a node number above 0");
  expect_refused("cold\n", "expected a surface, a comma and a node number");
  expect_refused("cold,99999\n\"hot, below\",1\n", "both a surface's and space's");
  expect_error(run({"exchange", write_cube(1, 0), "--quiet"}), 1, "no surface emits");
  expect_error(run({"exchange", squares, "-o", result("gr.txt")}), 2, ".esatan");
  expect_error(run({"exchange", squares, "--min-coupling", "2"}), 2, "below 1");
  EXPECT_TRUE(results().empty());
}

}  // namespace
