#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/validation/cases/cases.h"
#include "apps/validation/reference/hemisphere.h"
#include "apps/validation/reference/statistics.h"
#include "io/scene/scene_file.h"
#include "radiosity/solve/solution.h"

namespace apps::validation {

using namespace radiosity;

CaseResult run_hemisphere(const Context& context) {
  const Progress quiet{.report = {}, .stop = context.progress.stop};
  const study::Study room =
      study::assemble(io::read_scene(context.scenes / "furnished-room.json"),
                      {.patches = {.as_is = true}, .seed = context.seed}, {.progress = quiet});
  const Solution solution = solve_own_light(room, {.progress = quiet});
  const std::vector<TwofoldIrradiance> all =
      compare_irradiance(room, solution, {.seed = context.seed});
  CaseResult result{
      .compared = fmt::format("Irradiance in the furnished room ({} patches, {} of them sampled) "
                              "from form factors, H = F B.",
                              room.mesh.size(), all.size()),
      .reference =
          "The rendering equation's other form, H = ∫ B cosθ dω / π over the hemisphere, "
          "with B fetched by 2000 cosine-distributed rays per patch. It shares neither "
          "kernel nor shadows with the form factors, only the patches and their B."};
  Series points{"patches", Series::Style::markers};
  Series equal{"equal", Series::Style::line};
  std::vector<double> deviations;
  double largest = 0;
  for (const TwofoldIrradiance& h : all) {
    points.x.push_back(h.by_area);
    points.y.push_back(h.by_rays);
    const double difference = h.by_rays - h.by_area;
    // Dark on both sides is no deviation.
    deviations.push_back(difference == 0 ? 0 : difference / h.error);
    largest = std::max(largest, std::abs(deviations.back()));
  }
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  equal.x = equal.y = {*low, *high};
  const auto n = static_cast<double>(all.size());
  const auto within = std::count_if(deviations.begin(), deviations.end(),
                                    [](double z) { return std::abs(z) <= 2; });
  result.checks.push_back({"largest |difference| in standard errors", largest, 5,
                           "A normal error exceeds 5 σ once in 1.7 million patches. σ of the rays "
                           "from their own variance or that of B over the form factors, whichever "
                           "is larger, and of the form factors as they state it."});
  result.checks.push_back(
      {"share within two standard errors", static_cast<double>(within) / n,
       0.9545 - 4 * std::sqrt(0.9545 * 0.0455 / n),
       fmt::format("95.45 % of normal errors, less four standard errors of a share of {} patches.",
                   all.size()),
       "", Check::Relation::at_least});
  result.figures.emplace_back(Plot{"Irradiance by both forms, W/m²",
                                   {"form factors", Axis::Scale::logarithmic},
                                   {"rays", Axis::Scale::logarithmic},
                                   {points, equal}});
  result.figures.emplace_back(normal_histogram(
      "Differences by standard error", "difference / σ, ends include all beyond", deviations));
  return result;
}

}  // namespace apps::validation
