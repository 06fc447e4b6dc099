#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "apps/validation/cases/case.h"
#include "apps/validation/reference/cornell_reference.h"
#include "radiosity/base/geometry.h"
#include "study/study.h"

namespace apps::validation {

using Rows = std::vector<std::size_t>;

constexpr const char* kBands[] = {"red", "green", "blue"};
/// Standard errors that an interval has to either side, and how much of all it shall hold.
constexpr double kSigmas = 2;
constexpr double kCoverage = 0.95;

/// The path traced Cornell box and our solution, per polygon, n x 3, W/m².
struct CornellComparison {
  std::vector<ReferencePolygon> reference;
  Eigen::ArrayXXd expected;
  Eigen::ArrayXXd expected_error;  ///< one standard error
  Eigen::ArrayXXd computed;
  Eigen::ArrayXXd computed_error;  ///< one standard error
  study::Study solved;
  Rows covered;    ///< dark by right
  Rows defective;  ///< dark by mistake
  Rows compared;   ///< all others, but for the light

  /// sqrt(Σ A x²) over the compared polygons, of a value per polygon.
  [[nodiscard]] double area_norm(const Eigen::ArrayXd& values) const;
  /// ‖ΔB‖/‖B‖ in one band, by area.
  [[nodiscard]] double relative_difference(int band) const;
  /// (computed - expected) / combined standard error, of every compared polygon and band.
  [[nodiscard]] std::vector<double> deviations() const;
};

/// Solves the polygons of the reference, divided as the options say.
CornellComparison compare_cornell_box(const Context& context, const study::StudyOptions& options);

/// That intervals hold, and that no light is where none reaches.
void check_coverage(CaseResult& result, const CornellComparison& comparison);
void check_covered(CaseResult& result, const CornellComparison& comparison);

}  // namespace apps::validation
