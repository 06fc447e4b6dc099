#include "apps/validation/cases/cornell_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/validation/reference/own_light.h"
#include "io/scene/scene_file.h"

namespace apps::validation {
namespace {

using namespace radiosity;

void sort_polygons(CornellComparison& c) {
  c.defective = defective_polygons(c.reference);
  for (std::size_t i = 0; i < c.reference.size(); ++i) {
    const bool is_defective =
        std::find(c.defective.begin(), c.defective.end(), i) != c.defective.end();
    if (c.reference[i].surface == "light" || is_defective) continue;
    (c.reference[i].radiosity.maxCoeff() == 0 ? c.covered : c.compared).push_back(i);
  }
}

}  // namespace

double CornellComparison::area_norm(const Eigen::ArrayXd& values) const {
  double sum = 0;
  for (const std::size_t i : compared) {
    sum += reference[i].area * std::pow(values[static_cast<Index>(i)], 2);
  }
  return std::sqrt(sum);
}

double CornellComparison::relative_difference(int band) const {
  return area_norm(computed.col(band) - expected.col(band)) / area_norm(expected.col(band));
}

std::vector<double> CornellComparison::deviations() const {
  std::vector<double> list;
  for (const std::size_t i : compared) {
    const auto k = static_cast<Index>(i);
    for (int band = 0; band < 3; ++band) {
      list.push_back((computed(k, band) - expected(k, band)) /
                     std::hypot(computed_error(k, band), expected_error(k, band)));
    }
  }
  return list;
}

CornellComparison compare_cornell_box(const Context& context, const study::StudyOptions& options) {
  const std::vector<ReferencePolygon> reference = read_cornell_reference(context.data);
  const auto n = static_cast<Index>(reference.size());
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  Scene scene = io::read_scene(context.data / "cornell-box" / "patches-8x8.obj", {.unit = "mm"});
  if (scene.n_polygons() != n) {
    throw SceneError(
        fmt::format("the reference has {} polygons, patches-8x8.obj {}", n, scene.n_polygons()));
  }
  CornellComparison c{.reference = reference,
                      .expected = Eigen::ArrayXXd(n, 3),
                      .expected_error = Eigen::ArrayXXd(n, 3),
                      .computed = {},
                      .computed_error = {},
                      .solved = study::run(std::move(scene), options, {.progress = quiet}),
                      .covered = {},
                      .defective = {},
                      .compared = {}};
  for (Index i = 0; i < n; ++i) {
    c.expected.row(i) = reference[i].radiosity;
    c.expected_error.row(i) = reference[i].standard_error;
  }
  c.computed = polygon_means(c.solved.mesh, c.solved.solution.radiosity, n);
  // Patches of one polygon err alike: the error of their mean is the mean of their errors.
  c.computed_error = polygon_means(c.solved.mesh, c.solved.solution.radiosity_error, n);
  sort_polygons(c);
  return c;
}

void check_coverage(CaseResult& result, const CornellComparison& c) {
  const std::vector<double> all = c.deviations();
  const auto within =
      std::count_if(all.begin(), all.end(), [](double z) { return std::abs(z) <= kSigmas; });
  result.checks.push_back(
      {"share of polygons and bands with |ΔB| ≤ 2 √(σ² + s²)",
       static_cast<double>(within) / static_cast<double>(all.size()), kCoverage,
       "σ is the standard error that the program states (radiosity_error: form factors, iteration "
       "and patch size), s the standard error of the reference: two standard errors "
       "hold 95 % of normal errors.",
       "", Check::Relation::at_least});
}

void check_covered(CaseResult& result, const CornellComparison& c) {
  double largest = 0;
  for (const std::size_t i : c.covered) {
    largest = std::max(largest, c.computed.row(static_cast<Index>(i)).abs().maxCoeff());
  }
  result.checks.push_back(
      {fmt::format("{} floor polygons under the blocks: largest B", c.covered.size()), largest, 0,
       "No light reaches them: they must be exactly 0, as in the reference.", "W/m²"});
}

}  // namespace apps::validation
