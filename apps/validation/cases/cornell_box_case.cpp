#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/validation/cases/cases.h"
#include "apps/validation/cases/cornell_comparison.h"
#include "apps/validation/cases/cornell_map.h"
#include "apps/validation/reference/statistics.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr double kDefaultTolerance = 1e-2;  // the program's default
constexpr double kLargestNorm = 0.01;       // promised of ‖ΔB‖/‖B‖
constexpr double kLargestOfPolygon = 0.1;   // and of |ΔB|/B anywhere
constexpr double kWidestInterval = 3;

/// Mean of |x| / B over the compared polygons.
double mean_relative(const CornellComparison& c, const Eigen::ArrayXd& values, int band) {
  double sum = 0;
  for (const std::size_t i : c.compared) {
    const auto k = static_cast<Index>(i);
    sum += std::abs(values[k]) / c.expected(k, band);
  }
  return sum / static_cast<double>(c.compared.size());
}

constexpr const char* kWhy =
    "Two of the program's stated standard errors (form factors, iteration and patch size) and two "
    "of "
    "the reference.";
constexpr const char* kPromised = "What is promised for default settings.";

void check_band(CaseResult& result, Table& table, const CornellComparison& c, int band) {
  const Eigen::ArrayXd difference = c.computed.col(band) - c.expected.col(band);
  const Eigen::ArrayXd noise = kSigmas * c.expected_error.col(band);
  const Eigen::ArrayXd ours = kSigmas * c.computed_error.col(band);
  result.checks.push_back({fmt::format("{}: ‖ΔB‖/‖B‖, by area", kBands[band]),
                           c.relative_difference(band), kLargestNorm, kPromised});
  result.checks.push_back({fmt::format("{}: mean over the polygons of |ΔB|/B", kBands[band]),
                           mean_relative(c, difference, band),
                           mean_relative(c, noise, band) + mean_relative(c, ours, band), kWhy});
  const std::size_t worst =
      *std::max_element(c.compared.begin(), c.compared.end(), [&](std::size_t a, std::size_t b) {
        const auto relative = [&](std::size_t i) {
          const auto k = static_cast<Index>(i);
          return std::abs(difference[k]) / c.expected(k, band);
        };
        return relative(a) < relative(b);
      });
  const auto k = static_cast<Index>(worst);
  result.checks.push_back({fmt::format("{}: worst polygon, |ΔB|/B", kBands[band]),
                           std::abs(difference[k]) / c.expected(k, band), kLargestOfPolygon,
                           kPromised});
  table.rows.push_back(
      {kBands[band], fmt::format("{:.2f} %", 100 * c.relative_difference(band)),
       fmt::format("{:.2f} %", 100 * mean_relative(c, difference, band)),
       fmt::format("{:.1f} %", 100 * std::abs(difference[k]) / c.expected(k, band)),
       fmt::format("{} ({})", worst, c.reference[worst].surface)});
}

void check_widths(CaseResult& result, Table& table, const CornellComparison& c) {
  double ratios = 1;
  for (int band = 0; band < 3; ++band) {
    std::vector<double> widths;
    std::vector<double> ours;
    std::vector<double> errors;
    for (const std::size_t i : c.compared) {
      const auto k = static_cast<Index>(i);
      widths.push_back(kSigmas * std::hypot(c.computed_error(k, band), c.expected_error(k, band)));
      ours.push_back(kSigmas * c.computed_error(k, band));
      errors.push_back(std::abs(c.computed(k, band) - c.expected(k, band)));
    }
    ratios *= median(ours) / median(errors);
    table.rows.push_back({kBands[band], fmt::format("{:.2e}", median(widths)),
                          fmt::format("{:.2e}", median(ours)),
                          fmt::format("{:.2e}", median(errors)),
                          fmt::format("{:.2f}", median(widths) / median(errors)),
                          fmt::format("{:.2f}", median(ours) / median(errors))});
  }
  result.checks.push_back({"median of 2 σ / median |ΔB|, geometric mean of the bands",
                           std::cbrt(ratios), kWidestInterval,
                           "What is promised: intervals that hold because they are wide would say "
                           "nothing. 2.97 if errors are normal and σ is right. A band by itself "
                           "scatters by 6 % from seed to seed, its median being of neighbours that "
                           "err alike."});
}

void add_notes(CaseResult& result, const CornellComparison& c) {
  for (const std::size_t i : c.defective) {
    result.notes.push_back(fmt::format(
        "Polygon {} ({}) of the reference is left out as defective: its radiosity is exactly 0 in "
        "every band and so is its standard error, though each of its neighbours on the same "
        "surface has at least half of the surface's mean radiosity, {:.3f} in all. We find {:.3f}.",
        i, c.reference[i].surface, surface_radiosity(c.reference, c.reference[i].surface),
        c.computed.row(static_cast<Index>(i)).sum()));
  }
  result.notes.push_back(
      fmt::format("The light's polygons are left out: what they emit is given and would drown the "
                  "rest. {} polygons are compared, in three bands.",
                  c.compared.size()));
}

}  // namespace

CaseResult run_cornell_box(const Context& context) {
  const CornellComparison c = compare_cornell_box(
      context,
      {.patches = {.adaptive = true}, .tolerance = kDefaultTolerance, .seed = context.seed});
  CaseResult result{
      .compared = fmt::format("Radiosity of the Cornell box, {} adaptive patches (tolerance {}), "
                              "averaged over the {} polygons of the reference; and whether the "
                              "program's own error intervals hold.",
                              c.solved.mesh.size(), kDefaultTolerance, c.reference.size()),
      .reference =
          "Path tracing (Mitsuba 3.9.1, unlimited depth), mean outgoing radiance of each "
          "polygon with its standard error, at most 0.3 %: "
          "tests/data/cornell-box/reference-radiosity-8x8.csv. Geometry by the Cornell "
          "Program of Computer Graphics."};
  Table errors{"Differences from the reference",
               {"band", "‖ΔB‖/‖B‖", "mean |ΔB|/B", "worst |ΔB|/B", "polygon"},
               {}};
  for (int band = 0; band < 3; ++band) check_band(result, errors, c, band);
  Table intervals{
      "Intervals, W/m²: 2.97 between the medians if errors are normal and σ is right",
      {"band", "median half width", "median of 2 σ", "median |ΔB|", "ratio", "ratio of 2 σ"},
      {}};
  check_coverage(result, c);
  check_widths(result, intervals, c);
  check_covered(result, c);
  add_notes(result, c);
  result.figures.emplace_back(errors);
  result.figures.emplace_back(intervals);
  result.figures.emplace_back(
      normal_histogram("Differences by combined standard error, all polygons and bands",
                       "ΔB / √(σ² + s²), ends include all beyond", c.deviations()));
  result.figures.emplace_back(difference_map(c.reference, c.computed.matrix(), c.defective));
  return result;
}

}  // namespace apps::validation
