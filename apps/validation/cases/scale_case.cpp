#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/validation/cases/cases.h"
#include "apps/validation/cases/cornell_comparison.h"
#include "radiosity/operator/compression_report.h"

namespace apps::validation {
namespace {

using namespace radiosity;

constexpr double kAskedOfScale = 1e-2;  // the program's default
constexpr long kFewPatches = 2500;
constexpr long kManyPatches = 10000;
constexpr double kLargestShare = 4.0 / 15;

CornellComparison run_cornell(const Context& context, long n_patches, TransportKind transport) {
  return compare_cornell_box(context, {.patches = {.n_patches = n_patches},
                                       .tolerance = kAskedOfScale,
                                       .seed = context.seed,
                                       .transport = transport});
}

/// ‖x - y‖ / ‖y‖ by area.
double field_difference(const study::Study& study, const Eigen::MatrixXd& x,
                        const Eigen::MatrixXd& y) {
  const Eigen::VectorXd& area = study.transport->area();
  const auto square = [&](const Eigen::MatrixXd& z) {
    return area.dot(z.cwiseAbs2().rowwise().sum());
  };
  return std::sqrt(square(x - y) / square(y));
}

void check_verified(CaseResult& result, Table& table, const CornellComparison& c) {
  const CompressionReport& report = *c.solved.transport->report().compression;
  const Index n = c.solved.mesh.size();
  result.checks.push_back({fmt::format("{} patches: verified error of F B", n),
                           report.verified_error, kAskedOfScale, "What was asked."});
  table.rows.push_back(
      {fmt::format("{}", n), fmt::format("{:.0f}", report.coefficients),
       fmt::format("{:.0f}", report.entries),
       fmt::format("{:.1f}", 1e-6 * static_cast<double>(c.solved.transport->bytes())),
       fmt::format("{:.1e}", report.verified_error)});
}

}  // namespace

CaseResult run_scale(const Context& context) {
  const CornellComparison dense = run_cornell(context, kFewPatches, TransportKind::dense);
  const CornellComparison few = run_cornell(context, kFewPatches, TransportKind::compressed);
  const CornellComparison many = run_cornell(context, kManyPatches, TransportKind::compressed);
  CaseResult result{
      .compared = fmt::format("Radiosity of the Cornell box by compressed operators of {} and {} "
                              "patches (tolerance {}).",
                              few.solved.mesh.size(), many.solved.mesh.size(), kAskedOfScale),
      .reference =
          "The dense operator of the same patches; path tracing, as in the case "
          "cornell-box."};
  Table sizes{"Operators",
              {"patches", "numbers a patch", "form factors a patch", "MB", "verified error"},
              {}};
  check_verified(result, sizes, few);
  check_verified(result, sizes, many);
  const double verified = few.solved.transport->report().compression->verified_error;
  result.checks.push_back(
      {fmt::format("{} patches: ‖ΔB‖/‖B‖ from the dense operator's", few.solved.mesh.size()),
       field_difference(dense.solved, few.solved.solution.radiosity,
                        dense.solved.solution.radiosity),
       verified + kAskedOfScale,
       "The verified error of the one and the tolerance of the other: as most of B is emitted, "
       "and reflectances are below 1, light is off by less than what is gathered."});
  const double ratio =
      static_cast<double>(many.solved.mesh.size()) / static_cast<double>(few.solved.mesh.size());
  result.checks.push_back(
      {fmt::format("memory of {} patches, next to a dense operator's", many.solved.mesh.size()),
       static_cast<double>(many.solved.transport->bytes()) /
           (ratio * ratio * static_cast<double>(dense.solved.transport->bytes())),
       kLargestShare,
       "That of the few patches by the squared ratio of numbers of patches. A fifteenth of it is "
       "promised of 20,000; of half as many a dense one takes a quarter, and a compressed one may "
       "take as much."});
  for (int band = 0; band < 3; ++band) {
    result.checks.push_back({fmt::format("{}: ‖ΔB‖/‖B‖ from path tracing, {} patches", kBands[band],
                                         many.solved.mesh.size()),
                             many.relative_difference(band), kAskedOfScale,
                             "What is promised for default settings."});
  }
  check_coverage(result, many);
  check_covered(result, many);
  result.figures.emplace_back(sizes);
  return result;
}

}  // namespace apps::validation
