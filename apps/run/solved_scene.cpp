#include "apps/run/solved_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/run/row_check.h"
#include "apps/terminal/output_files.h"
#include "io/picture/false_color.h"
#include "io/picture/image_file.h"
#include "io/scene/scene_file.h"
#include "meshing/inspect/inspect.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/make_transport.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/picture/gathered_picture.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solve.h"

namespace apps {
namespace {

using namespace radiosity;

double polygon_area(const Scene& scene, Index i) {
  std::vector<Vec3> corners;
  for (const auto vertex : scene.polygon(i)) corners.push_back(scene.vertices[vertex]);
  return vector_area(corners).norm();
}

/// A number of patches that will be reached, known before the patches are made.
Index least_patches(const Scene& scene, const meshing::PatchOptions& options) {
  Index least = scene.n_polygons();
  if (!options.least_edge) least = std::max<Index>(least, options.n_patches.value_or(0));
  if (options.max_edge) {
    double area = 0;
    for (Index i = 0; i < scene.n_polygons(); ++i) area += polygon_area(scene, i);
    // The largest patch whose edges are no longer than L is the square L².
    const double squares = area / (*options.max_edge * *options.max_edge);
    least = std::max(least, static_cast<Index>(std::min(squares, 1e9)));
  }
  return least;
}

/// Makes the patches, but refuses first what would not fit into memory.
PatchMesh make_affordable_patches(const Scene& scene, const ComputeOptions& compute,
                                  const MemoryChecks& checks, const Progress& progress,
                                  TerminalProgress& terminal) {
  const meshing::PatchOptions options = meshing::make_patch_options({.max_edge = compute.max_edge,
                                                                     .n_patches = compute.n_patches,
                                                                     .as_is = compute.as_is,
                                                                     .adaptive = compute.adaptive},
                                                                    scene, progress);
  checks.expected(least_patches(scene, options), scene.n_polygons());
  warn_of_findings(scene, terminal);
  PatchMesh mesh = meshing::make_patches(scene, options);
  if (!compute.as_is) {
    if (const auto uncut = meshing::uncut_warning(mesh)) terminal.warn(*uncut);
  }
  checks.made(mesh.size(), scene.n_polygons());
  return mesh;
}

void check_dense(Index n_patches, Index n_polygons) { check_memory(n_patches, n_polygons); }

MemoryChecks dense_checks() { return {check_dense, check_dense}; }

Solution solve_scene(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                     const SolveOptions& options, TerminalProgress& terminal) {
  const Eigen::MatrixXd emitted = exitance(scene, mesh);
  if (emitted.isZero(0)) {
    terminal.warn("no surface emits light: the radiosity is zero everywhere");
  }
  Solution solution = solve(transport, emitted, reflectance(scene, mesh), options);
  if (!solution.converged) {
    terminal.warn(
        fmt::format("the iteration has not converged: its error may be {:.1e}, {:.1e} "
                    "was asked for; try --method cg",
                    solution.error_bound, options.tolerance));
  }
  return solution;
}

TransportOptions transport_options(const Scene& scene, const ComputeOptions& compute,
                                   const Progress& progress) {
  return {.tolerance = compute.tolerance,
          .closed = closed_choice(compute.closed, scene.closed),
          .seed = compute.seed,
          .progress = progress};
}

void check_rows(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                const ComputeOptions& compute) {
  refuse_excess(scene, mesh, transport.report(), compute.tolerance,
                [&](Index row) { return transport.row_error(row); });
}

std::unique_ptr<Transport> make_scene_transport(const Scene& scene, const PatchMesh& mesh,
                                                const Visibility& visibility,
                                                const ComputeOptions& compute,
                                                const Progress& progress,
                                                TerminalProgress& terminal) {
  auto transport = make_transport(mesh, visibility, transport_options(scene, compute, progress));
  check_rows(scene, mesh, *transport, compute);
  warn_of_open_rows(transport->report(), terminal);
  return transport;
}

meshing::AdaptiveMesh refine_scene(const Scene& scene, const ComputeOptions& compute,
                                   const Progress& progress, TerminalProgress& terminal) {
  const meshing::AdaptiveOptions options{
      .tolerance = compute.tolerance,
      .max_patches = compute.n_patches.value_or(meshing::kMostAdaptivePatches),
      .transport = transport_options(scene, compute, progress),
      .progress = progress};
  meshing::AdaptiveMesh result = meshing::make_adaptive_patches(scene, options);
  check_rows(scene, result.mesh, *result.transport, compute);
  warn_of_open_rows(result.transport->report(), terminal);
  if (!result.refinement.is_accurate) {
    terminal.warn(
        fmt::format("the patches ({}) are spent: the error of the radiosity is about "
                    "{:.2g}, {:.2g} was asked for (--patches N allows more)",
                    result.mesh.size(), result.refinement.error, options.tolerance));
  }
  return result;
}

DiscretisationError estimate_discretisation(const PatchMesh& mesh, const Transport& transport,
                                            const Solution& solution, const Progress& progress,
                                            TerminalProgress& terminal) {
  DiscretisationError result = discretisation_error(mesh, transport, solution, progress);
  if (result.n_unknown == mesh.size() && !solution.reflectance.isZero(0)) {
    terminal.warn(
        "each surface has one patch only, so how far their size makes the result wrong is not "
        "known and not in the errors given; --patches N makes more");
  }
  return result;
}

SolveOptions solve_options(Method method, double tolerance, const Progress& progress) {
  SolveOptions options;
  options.method = method;
  // The iteration shall add nothing to the error of the form factors; digits cost it little.
  options.tolerance = std::min(1e-8, 1e-3 * tolerance);
  options.progress = progress;
  return options;
}

void refuse_empty(const Image& image) {
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](float a) { return a == 0; })) {
    throw SceneError(
        "the picture would be empty: what the camera sees is smaller than a pixel; come closer, or "
        "use more pixels or --samples");
  }
}

ShownScale write_false_color_picture(const std::string& path, const SolvedScene& solved,
                                     const PictureOptions& options, const Camera& camera,
                                     const RenderOptions& render_options,
                                     Interruption& interruption) {
  const QuantityField field =
      make_field(*quantity_named(*options.false_color.quantity), solved.mesh, solved.solution,
                 solved.scene.bands, options.photometry.efficacy_or_default());
  const ShownQuantity shown = shown_quantity(field, solved.scene.bands, options.false_color);
  const Image image =
      render_values(solved.mesh, solved.visibility, shown.values, camera, render_options);
  render_options.progress.check();
  refuse_empty(image);
  const auto lock = interruption.hold();
  const io::ColorScale scale = io::write_false_color(path, image, shown.options);
  return {std::string(field.info.name), field.unit, scale};
}

Image draw(const SolvedScene& solved, const Camera& camera, bool gathers,
           const RenderOptions& options) {
  const Solution& solution = solved.solution;
  if (!gathers) {
    return render(solved.mesh, solved.visibility, solution.radiosity, camera, options);
  }
  const FinalGather gather(solved.mesh, solution.radiosity);
  return render_gathered(gather, solved.visibility, {solution.exitance, solution.reflectance},
                         camera, options);
}

}  // namespace

PatchedScene::PatchedScene(const CommonOptions& common, const ComputeOptions& compute,
                           const MemoryChecks& checks, const Progress& progress,
                           TerminalProgress& terminal)
    : PatchedScene(read_checked_scene(common, progress, terminal), compute, checks, progress,
                   terminal) {}

PatchedScene::PatchedScene(Scene read_scene, const ComputeOptions& compute,
                           const MemoryChecks& checks, const Progress& progress,
                           TerminalProgress& terminal)
    : scene(std::move(read_scene)),
      mesh(make_affordable_patches(scene, compute, checks, progress, terminal)),
      visibility(mesh) {}

AssembledScene::AssembledScene(const CommonOptions& common, const ComputeOptions& compute,
                               const Progress& progress, TerminalProgress& terminal,
                               const PatchCheck& check)
    : AssembledScene(read_checked_scene(common, progress, terminal), compute, progress, terminal,
                     check) {}

AssembledScene::AssembledScene(Scene read_scene, const ComputeOptions& compute,
                               const Progress& progress, TerminalProgress& terminal,
                               const PatchCheck& check)
    : PatchedScene(std::move(read_scene), compute, dense_checks(), progress, terminal) {
  if (check) check(*this);
  if (!compute.adaptive) {
    transport = make_scene_transport(scene, mesh, visibility, compute, progress, terminal);
    return;
  }
  meshing::AdaptiveMesh adaptive = refine_scene(scene, compute, progress, terminal);
  mesh = std::move(adaptive.mesh);
  visibility = std::move(adaptive.visibility);
  transport = std::move(adaptive.transport);
  refinement = adaptive.refinement;
}

SolvedScene::SolvedScene(const CommonOptions& common, const ComputeOptions& compute, Method method,
                         const Progress& progress, TerminalProgress& terminal,
                         const PatchCheck& check)
    : AssembledScene(common, compute, progress, terminal, check),
      solution(solve_scene(scene, mesh, *transport,
                           solve_options(method, compute.tolerance, progress), terminal)) {
  discretisation = estimate_discretisation(mesh, *transport, solution, progress, terminal);
  solution = with_discretisation_error(std::move(solution), discretisation);
}

TerminalProgress::Style terminal_style(const CommonOptions& common) {
  return common.quiet ? TerminalProgress::Style::none : TerminalProgress::fitting_style();
}

Scene read_scene_warning(const CommonOptions& common, const Progress& progress,
                         TerminalProgress& terminal) {
  Scene scene = io::read_scene(common.scene, {.unit = common.unit,
                                              .precision = common.precision,
                                              .strict = common.strict,
                                              .progress = progress});
  check_against_inputs(common.outputs, scene.files);
  for (const std::string& warning : scene.warnings) terminal.warn(warning);
  return scene;
}

Scene read_checked_scene(const CommonOptions& common, const Progress& progress,
                         TerminalProgress& terminal) {
  Scene scene = read_scene_warning(common, progress, terminal);
  if (scene.n_polygons() == 0) {
    throw SceneError(fmt::format("{}: the scene has no polygons", common.scene));
  }
  return scene;
}

void warn_of_findings(const Scene& scene, TerminalProgress& terminal) {
  for (const std::string& message : meshing::serious_findings(scene)) terminal.warn(message);
}

void warn_of_open_rows(const AssemblyReport& report, TerminalProgress& terminal) {
  if (report.open_rows == 0) return;
  terminal.warn(
      fmt::format("the scene is taken as closed, but {} of {} patches see an opening; "
                  "their form factors stay as they are (--closed no leaves all so)",
                  report.open_rows, report.row_sums.size()));
}

Progress shown_progress(TerminalProgress& terminal, const Interruption& interruption) {
  return {
      .report = [&terminal](std::string_view stage, double done, double total,
                            std::string_view unit) { terminal.report(stage, done, total, unit); },
      .stop = interruption.token()};
}

std::optional<ShownScale> write_picture(const std::string& path, const SolvedScene& solved,
                                        const PictureOptions& options, const Progress& progress,
                                        Interruption& interruption) {
  const Camera camera = choose_camera(solved.scene, solved.mesh, options.camera).camera;
  RenderOptions render_options = options.render;
  render_options.progress = progress;
  if (options.false_color.quantity) {
    return write_false_color_picture(path, solved, options, camera, render_options, interruption);
  }
  const Image image = draw(solved, camera, options.gather, render_options);
  progress.check();
  refuse_empty(image);
  io::ImageOptions image_options = options.image;
  image_options.wavelengths = solved.scene.bands.wavelengths;
  const auto lock = interruption.hold();
  io::write_image(path, image, image_options);
  return std::nullopt;
}

}  // namespace apps
