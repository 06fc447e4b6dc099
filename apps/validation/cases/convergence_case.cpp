#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/own_light.h"
#include "apps/validation/reference/statistics.h"
#include "io/scene/scene_file.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {
namespace {

using namespace radiosity;

/// A scene and how fine its patches get.
struct MeshedRoom {
  const char* file;
  const char* name;
  std::vector<double> edges;   ///< longest patch edges, m
  double reference_edge;       ///< of the solution that the others are compared with, m
  std::vector<long> adaptive;  ///< numbers of patches that fit the light
  double least_order;          ///< asked of the others
  const char* why;             ///< that order
};

constexpr const char* kAdaptive = "adaptive";
constexpr double kUnreached = 1e-9;  // relative error at which refinement would end by itself
constexpr double kCurveTolerance =
    1e-3;  // of the form factors: well below what discretisation leaves

std::vector<MeshedRoom> rooms() {
  // All lengths of the L-room are whole metres, so that these patches are nested; none is larger
  // than the lamp.
  return {{"l-room.json",
           "L-room",
           {1, 1. / 2, 1. / 3},
           1. / 6,
           {300, 1000, 3000},
           0.8,
           "Constant patches follow a smooth field to order 1; 0.2 less is granted, since shadows "
           "have edges that coarse patches do not resolve."},
          {"cornell-box.json",
           "Cornell box",
           {0.28, 0.14, 0.07},
           0.035,
           {300, 600, 1000},
           0.5,
           "Constant patches follow a field with jumps that run across them to order 1/2. Here "
           "shadows are narrower than all but the finest patches, so that they look like jumps; "
           "order 1 would need patches that are finer still."}};
}

struct Run {
  study::Study assembly;
  Solution solution{};
  double seconds = 0;  ///< wall time
};

Run run(const Scene& scene, const study::StudyOptions& options, const Context& context) {
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  const auto start = std::chrono::steady_clock::now();
  Run result{.assembly = study::assemble(scene, options, {.progress = quiet})};
  result.solution = solve_own_light(result.assembly, {.progress = quiet});
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Run run_uniform(const Scene& scene, double max_edge, const Context& context) {
  return run(
      scene,
      {.patches = {.max_edge = max_edge}, .tolerance = kCurveTolerance, .seed = context.seed},
      context);
}

/// The same with patches that fit the light, about so many.
Run run_adaptive(const Scene& scene, long n_patches, const Context& context) {
  return run(scene,
             {.patches = {.n_patches = n_patches, .adaptive = true},
              .tolerance = kUnreached,
              .factor_tolerance = kCurveTolerance,
              .seed = context.seed},
             context);
}

bool contains(const PatchMesh& mesh, Index i, const Vec3& point) {
  const double slack = 1e-9 * std::sqrt(mesh.area[i]);
  for (int k = 0; k < mesh.n_corners(i); ++k) {
    const Vec3& a = mesh.corner(i, k);
    const Vec3 edge = mesh.corner(i, (k + 1) % mesh.n_corners(i)) - a;
    if (mesh.normal[i].dot(edge.cross(point - a)) < -slack * edge.norm()) return false;
  }
  return true;
}

/// The patch of the coarser mesh that a patch of the finer one has its centroid in.
std::vector<Index> parents(const PatchMesh& fine, const PatchMesh& coarse) {
  std::vector<Index> result(fine.size(), -1);
  Index first = 0;  // patches come in the order of their polygons
  for (Index i = 0; i < fine.size(); ++i) {
    while (coarse.polygon[first] < fine.polygon[i]) ++first;
    for (Index j = first; j < coarse.size() && coarse.polygon[j] == fine.polygon[i]; ++j) {
      if (coarse.surface[j] == fine.surface[i] && contains(coarse, j, fine.centroid[i])) {
        result[i] = j;
        break;
      }
    }
    if (result[i] < 0) throw MeshError(fmt::format("patch {} has no coarser one", i));
  }
  return result;
}

struct Distance {
  double fields = 0;  ///< of the two piecewise constant fields
  double means = 0;   ///< of the coarse patches' values from the mean of the fine ones in them
};

/// Relative distances by area, bands together; the lamp left out, whose light is given.
Distance distance(const Run& coarse, const Run& fine) {
  const PatchMesh& mesh = fine.assembly.mesh;
  const std::vector<Index> parent = parents(mesh, coarse.assembly.mesh);
  const Eigen::MatrixXd& b = fine.solution.radiosity;
  const Index n = coarse.assembly.mesh.size();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, b.cols());
  Eigen::VectorXd covered = Eigen::VectorXd::Zero(n);
  double difference = 0;
  double norm = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (fine.solution.exitance.row(i).maxCoeff() > 0) continue;
    difference +=
        mesh.area[i] * (coarse.solution.radiosity.row(parent[i]) - b.row(i)).squaredNorm();
    norm += mesh.area[i] * b.row(i).squaredNorm();
    sums.row(parent[i]) += mesh.area[i] * b.row(i);
    covered[parent[i]] += mesh.area[i];
  }
  double of_means = 0;
  for (Index j = 0; j < n; ++j) {
    if (covered[j] == 0) continue;
    of_means +=
        covered[j] * (coarse.solution.radiosity.row(j) - sums.row(j) / covered[j]).squaredNorm();
  }
  return {std::sqrt(difference / norm), std::sqrt(of_means / norm)};
}

/// Order p of the error C h^p whose square, less that of the reference, was measured:
/// d(h)² = C² (h^2p - h_ref^2p), as the field's means on nested patches are its best approximation.
/// Found by repeating the fit with the errors that it implies.
double order_beside_reference(const MeshedRoom& room, const std::vector<double>& distances) {
  double p = 1;
  for (int step = 0; step < 50; ++step) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < distances.size(); ++k) {
      const double ratio = room.reference_edge / room.edges[k];
      errors.push_back(distances[k] / std::sqrt(1 - std::pow(ratio, 2 * p)));
    }
    p = fitted_order(room.edges, errors);
  }
  return p;
}

/// Errors of one scene, as curves over the number of patches and over time.
struct Curves {
  Series field;
  Series means;
  Series time;
};

Curves empty_curves(const std::string& name) {
  return {{name + ": field"}, {name + ": means"}, {name}};
}

void add_run(Curves& curves, Table& table, const std::string& name, const std::string& kind,
             const Run& run, const Run& reference) {
  const Distance d = distance(run, reference);
  const bool is_nested = kind != kAdaptive;  // else the means over patches are not known
  const auto n = static_cast<double>(run.assembly.mesh.size());
  curves.field.x.push_back(n);
  curves.field.y.push_back(d.fields);
  if (is_nested) {
    curves.means.x.push_back(n);
    curves.means.y.push_back(d.means);
  }
  curves.time.x.push_back(run.seconds);
  curves.time.y.push_back(d.fields);
  table.rows.push_back({name, kind, fmt::format("{}", n), fmt::format("{:.2e}", d.fields),
                        is_nested ? fmt::format("{:.2e}", d.means) : "",
                        fmt::format("{:.2f}", run.seconds)});
}

std::string edge_text(double edge) { return fmt::format("{:.4g} mm", 1000 * edge); }

std::vector<Curves> measure(const MeshedRoom& room, CaseResult& result, Table& table,
                            const Context& context) {
  const std::string name = room.name;
  const Scene scene = io::read_scene(context.scenes / room.file);
  const Run reference = run_uniform(scene, room.reference_edge, context);
  Curves uniform = empty_curves(name + ", uniform");
  for (const double edge : room.edges) {
    context.progress.check();
    add_run(uniform, table, name, edge_text(edge), run_uniform(scene, edge, context), reference);
  }
  Curves adaptive = empty_curves(name + ", adaptive");
  for (const long n_patches : room.adaptive) {
    context.progress.check();
    add_run(adaptive, table, name, kAdaptive, run_adaptive(scene, n_patches, context), reference);
  }
  table.rows.push_back({name, edge_text(room.reference_edge),
                        fmt::format("{}", reference.assembly.mesh.size()), "reference", "",
                        fmt::format("{:.2f}", reference.seconds)});
  result.checks.push_back(
      {fmt::format("{}: order of the uniform field's error in the patch edge h", name),
       order_beside_reference(room, uniform.field.y), room.least_order, room.why, "",
       Check::Relation::at_least});
  return {std::move(uniform), std::move(adaptive)};
}

}  // namespace

CaseResult run_convergence(const Context& context) {
  CaseResult result{
      .compared =
          "Radiosity on ever finer patches, uniform and adaptive, each of constant radiosity, as "
          "a field over the surfaces, the lamp left out.",
      .reference =
          "Our own solution on patches half as large as the finest. Its own error is "
          "reckoned with: where patches are nested, the square of a coarse field's error is "
          "that of its distance from the finer field and that of the finer field's error "
          "together, so that the order p is fitted to d² = C² (h^2p - h_ref^2p)."};
  Table table{
      "Refinement",
      {"scene", "longest edge", "patches", "error of the field", "of patch means", "seconds"},
      {}};
  Plot times{"Distance of the field from the reference and time",
             {"seconds", Axis::Scale::logarithmic},
             {"relative error, by area", Axis::Scale::logarithmic},
             {}};
  for (const MeshedRoom& room : rooms()) {
    Plot errors{fmt::format("{}: distance from the reference and number of patches", room.name),
                {"patches", Axis::Scale::logarithmic},
                {"relative error, by area", Axis::Scale::logarithmic},
                {}};
    for (Curves& curves : measure(room, result, table, context)) {
      errors.series.push_back(std::move(curves.field));
      if (!curves.means.x.empty()) errors.series.push_back(std::move(curves.means));
      times.series.push_back(std::move(curves.time));
    }
    result.figures.emplace_back(std::move(errors));
  }
  result.notes.emplace_back(
      "An order of 0.8 is asked of the L-room only, on patches no larger than its lamp. Patches of "
      "280 to 70 mm of the Cornell box do not reach it.");
  result.notes.emplace_back(
      "Adaptive patches are no part of the reference's, and finer in places: their distance holds "
      "the error of the reference, too, and is an upper limit of theirs, about. Nothing is asked "
      "of them here.");
  result.figures.emplace_back(times);
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation
