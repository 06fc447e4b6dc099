#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/known_factors.h"
#include "apps/validation/reference/own_light.h"
#include "apps/validation/reference/statistics.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr int kFinest = 3;
constexpr double kRho = 0.7;

Scene sphere(int level) {
  Scene scene = empty_scene("sphere");
  scene.closed = true;
  add_surface(scene, "sphere", icosphere(level, 1, Facing::inwards));
  return scene;
}

/// Exitance that varies smoothly over the sphere, from 0 to 2 W/m².
Eigen::VectorXd smooth_exitance(const PatchMesh& mesh) {
  Eigen::VectorXd exitance(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) exitance[i] = 1 + mesh.normal[i].z();
  return exitance;
}

/// How far the facets are from a unit sphere.
struct FacetSize {
  double edge = 0;  ///< longest, m
  double tilt = 0;  ///< largest angle between a normal and the radius to the centroid
};

FacetSize measure_facets(const PatchMesh& mesh) {
  FacetSize facets;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Vec3 radius = -mesh.centroid[i].normalized();
    facets.tilt = std::max(facets.tilt, radius.cross(mesh.normal[i]).norm());
    for (int k = 0; k < 3; ++k) {
      const double edge = (mesh.corner(i, (k + 1) % 3) - mesh.corner(i, k)).norm();
      facets.edge = std::max(facets.edge, edge);
    }
  }
  return facets;
}

struct Facetted {
  double n = 0;  ///< facets
  FacetSize facets;
  double largest = 0;  ///< error of B over the mean of B
  double rms = 0;      ///< the same, root mean square by area
};

Facetted measure(int level, const Context& context) {
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  const study::Study room = study::assemble(
      sphere(level), {.patches = {.as_is = true}, .tolerance = 1e-4, .seed = context.seed},
      {.progress = quiet});
  const Eigen::VectorXd area = areas(room.mesh);
  const Eigen::VectorXd exitance = smooth_exitance(room.mesh);
  const Solution solution =
      solve(*room.transport, exitance, Eigen::MatrixXd::Constant(area.size(), 1, kRho),
            {.on_step = {}, .progress = quiet});
  const double mean = area.dot(exitance) / area.sum();
  const Eigen::VectorXd expected = exitance.array() + kRho / (1 - kRho) * mean;
  const Eigen::VectorXd error = (solution.radiosity.col(0) - expected) * (1 - kRho) / mean;
  Facetted found{static_cast<double>(area.size()), measure_facets(room.mesh)};
  found.largest = error.cwiseAbs().maxCoeff();
  found.rms = std::sqrt(area.dot(error.cwiseAbs2()) / area.sum());
  return found;
}

/// The sphere without the facets above a height, E = 1 W/m² everywhere.
void check_open_sphere(CaseResult& result, const KnownFactor& known, const Context& context) {
  const double rho = known.params.at("rho");
  const double fraction = known.params.at("fraction");
  std::vector<Polygon> faces = icosphere(kFinest, 1, Facing::inwards);
  // A cap of height 2f has the share f of the sphere.
  std::erase_if(faces, [&](const Polygon& face) {
    return (face[0] + face[1] + face[2]).z() / 3 > 1 - 2 * fraction;
  });
  double left = 0;
  double all = 0;
  for (const Polygon& face : faces) left += vector_area(face).norm();
  for (const Polygon& face : icosphere(kFinest, 1, Facing::inwards)) {
    all += vector_area(face).norm();
  }
  Scene scene = empty_scene("open sphere");
  scene.closed = false;
  add_surface(scene, "sphere", faces, {.reflectance = rho, .exitance = 1});
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  const study::Study bowl = study::assemble(
      std::move(scene), {.patches = {.as_is = true}, .tolerance = 1e-4, .seed = context.seed},
      {.progress = quiet});
  const Solution solution = solve_own_light(bowl, {.on_step = {}, .progress = quiet});
  // The opening is as large as the facets that are gone, not quite the share in the file.
  const double expected = 1 / (1 - rho * left / all);
  const FacetSize facets = measure_facets(bowl.mesh);
  result.checks.push_back(
      {fmt::format("sphere with an opening of {:.2f} % of it: largest error of B / B",
                   100 * (1 - left / all)),
       (solution.radiosity.array() / expected - 1).abs().maxCoeff(),
       rho / (1 - rho) * (facets.tilt + 2 * std::pow(facets.edge, 2)),
       "As above, with a field that is B on the facets and 0 in the opening: |B - B̄| ≤ B, hence "
       "ρ/(1-ρ) (t + 2h²)."});
}

}  // namespace

CaseResult run_sphere(const Context& context) {
  CaseResult result{
      .compared =
          "Radiosity inside a sphere of 20 to 1,280 triangles, its exitance growing from 0 "
          "to 2 W/m² from pole to pole, ρ = 0.7; and in a sphere with a round opening.",
      .reference =
          "B = E + ρ/(1-ρ) Ē with the mean Ē over the area: F_ij = A_j/(4πR²) in a sphere "
          "(tests/data/form-factors.json: sphere interior). A sphere of facets is none, so "
          "that the difference has to vanish as the facets get finer. With an opening of the share "
          "f of the sphere, B = E / (1 - ρ(1-f)) for uniform E."};
  Series largest{"largest"};
  Series rms{"root mean square"};
  Series allowed{"allowed for the largest", Series::Style::dashed};
  for (int level = 0; level <= kFinest; ++level) {
    context.progress.check();
    const Facetted found = measure(level, context);
    // |B_i - B̄| / B̄ <= 1 - ρ, from an exitance between 0 and twice its mean.
    const double tolerance = kRho * (found.facets.tilt + 2 * std::pow(found.facets.edge, 2));
    largest.x.push_back(found.n);
    largest.y.push_back(found.largest);
    rms.y.push_back(found.rms);
    allowed.y.push_back(tolerance);
    result.checks.push_back(
        {fmt::format("{} facets: largest error of B / mean B", found.n), found.largest, tolerance,
         "Facets have edges up to h, and normals up to t off the radius to their centroid, as they "
         "are not equilateral; R = 1. Tilting a facet by t changes H by t max|B - B̄| at most; row "
         "i "
         "of F is wrong within two edges by all that is there, (2h)²/4 = h² of the sphere, and by "
         "as "
         "much elsewhere. |B - B̄| ≤ (1-ρ) B̄, and reflection makes of an error of H one of B that "
         "is ρ/(1-ρ) as large: ρ (t + 2h²) in all."});
  }
  rms.x = allowed.x = largest.x;
  const std::vector<double> last_n(rms.x.end() - 3, rms.x.end());
  const std::vector<double> last_rms(rms.y.end() - 3, rms.y.end());
  result.checks.push_back({"order in the number of facets N, root mean square, last three",
                           -fitted_order(last_n, last_rms), 0.5,
                           "Errors are t + h² with t ~ h, and h² ~ 1/N: the order falls from 1 to "
                           "1/2 as N grows.",
                           "", Check::Relation::at_least});
  const std::vector<KnownFactor> known = read_known_factors(context.data);
  check_open_sphere(result, known_factor(known, "spherical cavity with circular opening"), context);
  result.figures.emplace_back(Plot{"Error of B over the mean of B",
                                   {"facets", Axis::Scale::logarithmic},
                                   {"relative error", Axis::Scale::logarithmic},
                                   {largest, rms, allowed}});
  return result;
}

}  // namespace apps::validation
