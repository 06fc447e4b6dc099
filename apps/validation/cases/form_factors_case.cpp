#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/validation/cases/cases.h"
#include "apps/validation/cases/factor_comparisons.h"

namespace apps::validation {
namespace {

/// What is asked of a group of comparisons, and why.
struct Group {
  FactorKind kind;
  const char* what;
  double tolerance;  ///< relative; 0: each has its own
  const char* derivation;
};

constexpr Group kGroups[] = {
    {FactorKind::polygons, "unobstructed polygons, both directions: max relative error", 1e-9,
     "What the program promises. The kernel aims at 1e-11; contour integrals of touching polygons "
     "lose a digit or two to cancellation."},
    {FactorKind::point, "element to rectangle: relative error", 1e-13,
     "Lambert's formula: some tens of operations, each with a rounding of 1.1e-16, and angles "
     "that are of order 1."},
    {FactorKind::occluded, "partly hidden, of polygons: max relative error", kOccludedTolerance,
     "The relative error that the form factors were asked for, with no closure correction."},
    {FactorKind::body, "behind a body of 80 facets: max of error / (4 σ + 1e-9)", 0,
     "σ is the standard error that the program itself states for this form factor, asked for 1e-3; "
     "a normal error exceeds 4 σ in one of 16,000 cases. 1e-9 for the pairs that are proved to see "
     "each other."},
    {FactorKind::curved, "round shapes from facets: max of error / allowed error", 0,
     "Facets of edge h leave errors in powers of h². Two extrapolations to h = 0, from edges 4h, "
     "2h and from 2h, h, are off by terms in h⁴, the first one by 16 times as much: how far they "
     "are apart is what is allowed, and 1e-9."},
};

double strain(const FactorComparison& c) {
  return std::abs(c.computed / c.expected - 1) / c.tolerance;
}

}  // namespace

CaseResult run_form_factors(const Context& context) {
  CaseResult result{.compared =
                        "Form factors: polygons that see each other, touching at edges and corners "
                        "included; polygons partly hidden by others; facetted cylinders, cones and "
                        "spheres, extrapolated to the round shape.",
                    .reference =
                        "Closed forms, worked out to 30 digits with mpmath, in "
                        "tests/data/form-factors.json, every entry of which is listed below."};
  FactorComparisons all = compare_factors(context);
  Table table{"Every comparison", {"", "computed", "closed form", "relative error", "asked"}, {}};
  Plot plot{"Relative errors",
            {"comparison, in the order of the table"},
            {"relative error", Axis::Scale::logarithmic},
            {}};
  Series asked{"asked", Series::Style::dashed};
  double index = 0;
  for (const Group& group : kGroups) {
    Series errors{group.what, Series::Style::markers};
    errors.label = errors.label.substr(0, errors.label.find(':'));
    double worst = 0;
    for (FactorComparison& c : all.comparisons) {
      if (c.kind != group.kind) continue;
      if (group.tolerance > 0) c.tolerance = group.tolerance;
      const double error = std::abs(c.computed / c.expected - 1);
      // A NaN must not get lost in a maximum.
      const double figure = group.tolerance > 0 ? error : strain(c);
      worst = std::isnan(worst) || figure <= worst ? worst : figure;
      errors.x.push_back(++index);
      errors.y.push_back(std::max(error, 1e-17));
      asked.x.push_back(index);
      asked.y.push_back(c.tolerance);
      table.rows.push_back({c.name, fmt::format("{:.12g}", c.computed),
                            fmt::format("{:.12g}", c.expected), fmt::format("{:.1e}", error),
                            fmt::format("{:.1e}", c.tolerance)});
    }
    if (errors.x.empty()) continue;
    result.checks.push_back(
        {group.what, worst, group.tolerance > 0 ? group.tolerance : 1, group.derivation});
    plot.series.push_back(errors);
    asked.x.push_back(index);
    asked.y.push_back(std::numeric_limits<double>::quiet_NaN());  // lifts the pen
  }
  plot.series.push_back(asked);
  for (std::string& note : all.left_out) result.notes.push_back(std::move(note));
  result.notes.emplace_back("Errors below 1e-17 are drawn at 1e-17.");
  result.figures.emplace_back(plot);
  result.figures.emplace_back(table);
  return result;
}

}  // namespace apps::validation
