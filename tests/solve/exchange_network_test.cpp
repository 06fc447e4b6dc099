// Radiative couplings: closed forms of two-surface enclosures, and the laws of all others.
#include "radiosity/solve/exchange_network.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/make_dense_transport.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr double kRounding = 1e-10;

struct Room {
  PatchMesh mesh;
  std::unique_ptr<Transport> transport;
};

Room room_of(PatchMesh mesh, const TransportOptions& options) {
  const Visibility visibility(mesh);
  std::unique_ptr<Transport> transport = make_dense_transport(mesh, visibility, options);
  return {std::move(mesh), std::move(transport)};
}

/// A box within one, each of them a node: node 0 is the inner one.
Room nested_boxes() {
  return room_of(test::box_in_box(4, 2), {.tolerance = 1e-4, .closed = Closed::yes});
}

std::vector<std::int32_t> boxes_of(const PatchMesh& mesh) {
  const Box3 all = bounds(mesh);
  std::vector<std::int32_t> node;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Vec3 place = (mesh.centroid[i] - all.center()).cwiseQuotient(0.5 * all.sizes());
    node.push_back(place.cwiseAbs().maxCoeff() > 1 - 1e-9 ? 1 : 0);
  }
  return node;
}

Eigen::VectorXd by_node(const std::vector<std::int32_t>& node, const std::vector<double>& values) {
  Eigen::VectorXd result(static_cast<Index>(node.size()));
  for (std::size_t i = 0; i < node.size(); ++i) result[static_cast<Index>(i)] = values[node[i]];
  return result;
}

// A convex body in an enclosure is not uniformly lit by its walls, so a network of two nodes is not
// the textbook's 1 / (1 / (A1 ε1) + (1 - ε2) / (A2 ε2)), but it is where both are black, or where
// the inner one is taken face by face; all laws hold in any case.
TEST(ExchangeNetwork, OfBlackBoxesIsTheirExchangeArea) {
  const Room room = nested_boxes();
  const auto node = boxes_of(room.mesh);
  const ExchangeNetwork network =
      exchange_network(*room.transport, Eigen::VectorXd::Ones(room.mesh.size()), node, 2);
  EXPECT_EQ(network.couplings(0, 0), 0);  // it is convex
  EXPECT_NEAR(network.couplings(0, 1), network.area[0], kRounding * network.area[0]);
  EXPECT_NEAR(network.couplings(1, 1), network.area[1] - network.area[0],
              kRounding * network.area[1]);
  EXPECT_EQ(network.emitting, network.area);
  EXPECT_EQ(network.to_space, Eigen::VectorXd::Zero(2));
  EXPECT_EQ(network.to_backs, Eigen::VectorXd::Zero(2));
}

// In a cube of one emissivity each face absorbs of the opposite one, of its neighbours and of
// itself what the three unknowns of its symmetry say. (View3D prints .045455 .090873 .090918 for
// script-F of ε = 0.5.)
TEST(ExchangeNetwork, OfACubeHasItsClosedForm) {
  PatchMesh cube;
  test::add_box(cube, Vec3(0, 0, 0), Vec3(1, 1, 1), 1, test::Facing::inwards);
  ASSERT_EQ(cube.size(), 6);
  std::vector<std::int32_t> node(6);
  for (int k = 0; k < 6; ++k) node[k] = k;
  const Room room = room_of(cube, {.tolerance = 1e-6, .closed = Closed::yes});
  const double opposite = 0.19982489569838748;
  const double beside = (1 - opposite) / 4;
  constexpr double kEmissivity = 0.5;
  const ExchangeNetwork network =
      exchange_network(*room.transport, Eigen::VectorXd::Constant(6, kEmissivity), node, 6);
  Eigen::MatrixXd factors(6, 6);
  for (int s = 0; s < 6; ++s) {
    for (int t = 0; t < 6; ++t) {
      const double dot = cube.normal[s].dot(cube.normal[t]);
      factors(s, t) = dot > 0.5 ? 0 : dot < -0.5 ? opposite : beside;
    }
  }
  // B = (I - F R)^-1 F E by Neumann's series, whose terms fall by 1/2.
  Eigen::MatrixXd term = kEmissivity * factors;
  Eigen::MatrixXd gebhart = term;
  for (int k = 0; k < 60; ++k) {
    term = (1 - kEmissivity) * factors * term;
    gebhart += term;
  }
  EXPECT_LE((network.gebhart() - gebhart).cwiseAbs().maxCoeff(), 1e-7);
  for (int t = 0; t < 6; ++t) {
    const double dot = cube.normal[0].dot(cube.normal[t]);
    const double printed = dot > 0.5 ? 0.0909091 : dot < -0.5 ? 0.18174583 : 0.18183627;
    EXPECT_NEAR(network.gebhart()(0, t), printed, 1e-7);
    EXPECT_NEAR(network.script_f()(0, t), kEmissivity * printed, 1e-7);
  }
}

// Two squares see space: what they exchange is a closed form, and so is what they lose.
TEST(ExchangeNetwork, TellsWhatGoesToSpace) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/opposed-squares.json");
  const Room room = room_of(meshing::make_patches(scene), {.tolerance = 1e-6});
  ASSERT_EQ(room.mesh.size(), 2);
  const Eigen::VectorXd emissivity = Eigen::Vector2d(0.8, 0.5);
  const ExchangeNetwork network = exchange_network(*room.transport, emissivity, {0, 1}, 2);
  const double scale = room.mesh.area[0];  // the squares are as far apart as they are long
  EXPECT_NEAR(network.couplings(0, 1), 0.0802503980 * scale, 1e-8 * scale);
  EXPECT_NEAR(network.to_space[0], 0.7069207800 * scale, 1e-8 * scale);
  EXPECT_NEAR(network.to_space[1], 0.4177450985 * scale, 1e-8 * scale);
  EXPECT_NEAR(network.gebhart()(0, 0), 0.016036027, 1e-8);
  EXPECT_NEAR(network.gebhart()(1, 0), 0.160500796, 1e-8);
}

// Rows sum to what is emitted, couplings are symmetric, and zero emissivity couples to nothing.
TEST(ExchangeNetwork, KeepsPowerWhateverTheSurfaces) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/l-room.json");
  const Room room = room_of(meshing::make_patches(scene, {.n_patches = 200}), {.tolerance = 1e-2});
  const auto n = static_cast<Index>(room.mesh.surface_names.size());
  std::vector<double> emissivities;
  for (Index s = 0; s < n; ++s)
    emissivities.push_back(s == 1 ? 0 : 0.1 + 0.4 * static_cast<double>(s % 3));
  const ExchangeNetwork network = exchange_network(
      *room.transport, by_node(room.mesh.surface, emissivities), room.mesh.surface, n);
  EXPECT_EQ(network.couplings, network.couplings.transpose());
  EXPECT_LE(network.asymmetry, kRounding);
  EXPECT_LE(network.error_bound, 1e-12);
  EXPECT_GE(network.couplings.minCoeff(), 0);
  EXPECT_EQ(network.couplings.row(1).maxCoeff(), 0);
  const Eigen::VectorXd sums =
      network.couplings.rowwise().sum() + network.to_space + network.to_backs;
  for (Index s = 0; s < n; ++s) {
    EXPECT_NEAR(sums[s], network.emitting[s], kRounding * network.area[s]) << s;
    EXPECT_NEAR(network.emitting[s], emissivities[s] * network.area[s], kRounding);
  }
}

// Heats of a network are those of the light at the same temperatures.
TEST(ExchangeNetwork, GivesTheHeatsOfASolve) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/thermal-enclosure.json");
  const Room room = room_of(meshing::make_patches(scene, {.n_patches = 300}), {.tolerance = 1e-2});
  const auto n = static_cast<Index>(room.mesh.surface_names.size());
  const Eigen::MatrixXd rho = reflectance(scene, room.mesh);
  const Eigen::MatrixXd emitted = exitance(scene, room.mesh);
  const Solution solution = solve(*room.transport, emitted, rho, {.tolerance = 1e-12});
  const Eigen::VectorXd emissivity = 1 - rho.col(0).array();
  const ExchangeNetwork network =
      exchange_network(*room.transport, emissivity, room.mesh.surface, n);
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd black = Eigen::VectorXd::Zero(n);  // σ T⁴
  for (Index i = 0; i < room.mesh.size(); ++i) {
    const std::int32_t s = room.mesh.surface[i];
    heat[s] += room.mesh.area[i] * solution.net_flux()(i, 0);
    if (emissivity[i] > 0) black[s] = emitted(i, 0) / emissivity[i];
  }
  const double size = heat.cwiseAbs().maxCoeff();
  for (Index s = 0; s < n; ++s) {
    double lost = (network.to_space[s] + network.to_backs[s]) * black[s];
    for (Index t = 0; t < n; ++t) lost += network.couplings(s, t) * (black[s] - black[t]);
    EXPECT_NEAR(lost, heat[s], 1e-9 * size) << room.mesh.surface_names[s];
  }
}

// Errors are those that other samples show.
TEST(ExchangeNetwork, TellsItsErrors) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/furnished-room.json");
  const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = 500});
  const Visibility visibility(mesh);
  const auto n = static_cast<Index>(mesh.surface_names.size());
  const Eigen::VectorXd emissivity = Eigen::VectorXd::Constant(mesh.size(), 0.7);
  std::vector<ExchangeNetwork> networks;
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto transport =
        make_dense_transport(mesh, visibility, {.tolerance = 3e-2, .seed = seed});
    networks.push_back(exchange_network(*transport, emissivity, mesh.surface, n));
  }
  Index n_within = 0;
  Index n_pairs = 0;
  double ratio = 0;
  for (Index s = 0; s < n; ++s) {
    for (Index t = 0; t <= s; ++t) {
      const double off = std::abs(networks[0].couplings(s, t) - networks[1].couplings(s, t));
      const double error = std::hypot(networks[0].error(s, t), networks[1].error(s, t));
      const double rounding = kRounding * networks[0].couplings(s, t);
      ++n_pairs;
      n_within += off <= 2 * error + rounding ? 1 : 0;
      ratio += error > 0 ? off / error : 0;
    }
  }
  EXPECT_GE(static_cast<double>(n_within), 0.95 * static_cast<double>(n_pairs));
  EXPECT_GT(ratio / static_cast<double>(n_pairs), 0.02);  // nor are they far too large
}

TEST(ExchangeNetwork, KeepsPowerWithoutItsSmallCouplings) {
  const Scene scene = io::read_scene(RADIOSITY_SCENES "/l-room.json");
  const Room room = room_of(meshing::make_patches(scene, {.n_patches = 200}), {.tolerance = 1e-2});
  const auto n = static_cast<Index>(room.mesh.surface_names.size());
  ExchangeNetwork network = exchange_network(
      *room.transport, Eigen::VectorXd::Constant(room.mesh.size(), 0.6), room.mesh.surface, n);
  const ExchangeNetwork whole = network;
  EXPECT_EQ(drop_small_couplings(network, 1e-12), 0);
  EXPECT_EQ(network.couplings, whole.couplings);
  const std::int64_t n_dropped = drop_small_couplings(network, 0.05);
  EXPECT_GT(n_dropped, 0);
  EXPECT_EQ((network.couplings.array() == 0).count() - (whole.couplings.array() == 0).count(),
            2 * n_dropped);
  EXPECT_EQ(network.couplings, network.couplings.transpose());
  EXPECT_EQ(network.couplings.diagonal(), whole.couplings.diagonal());
  const Eigen::VectorXd sums = network.couplings.rowwise().sum();
  for (Index s = 0; s < n; ++s) {
    EXPECT_NEAR(sums[s] + network.to_space[s] + network.to_backs[s], whole.emitting[s],
                kRounding * whole.area[s]);
  }
}

TEST(ExchangeNetwork, RefusesWhatDoesNotFit) {
  const Room room = nested_boxes();
  const auto node = boxes_of(room.mesh);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(room.mesh.size());
  EXPECT_THROW((void)exchange_network(*room.transport, ones.head(3), node, 2), SolveError);
  EXPECT_THROW((void)exchange_network(*room.transport, 2 * ones, node, 2), SolveError);
  EXPECT_THROW((void)exchange_network(*room.transport, -ones, node, 2), SolveError);
  EXPECT_THROW((void)exchange_network(*room.transport, ones, node, 1), SolveError);
  EXPECT_THROW((void)exchange_network(*room.transport, std::nan("") * ones, node, 2), SolveError);
}

}  // namespace
}  // namespace radiosity
