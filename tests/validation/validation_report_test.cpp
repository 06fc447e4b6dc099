/// The helpers of `validate`: ticks, plots, maps, fits, and how a case's end is told.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "apps/validation/plot/axis_ticks.h"
#include "apps/validation/plot/surface_map.h"
#include "apps/validation/plot/svg_plot.h"
#include "apps/validation/plot/svg_text.h"
#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/statistics.h"
#include "apps/validation/report/report.h"

namespace apps::validation {
namespace {

using Scale = Axis::Scale;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(AxisTicks, LinearOnesAreRound) {
  const AxisRange range = make_range(Scale::linear, {0, 0.97});
  EXPECT_EQ(range.low, 0);
  EXPECT_GT(range.high, 0.97);
  ASSERT_EQ(range.ticks.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(range.ticks[k], 0.2 * static_cast<double>(k), 1e-15);
  }
  EXPECT_EQ(tick_text(range.ticks[3], Scale::linear), "0.6");
}

TEST(AxisTicks, LogarithmicOnesArePowersOfTenOrOneTwoFive) {
  const AxisRange wide = make_range(Scale::logarithmic, {3e-9, 2e-3});
  for (const double tick : wide.ticks) {
    EXPECT_NEAR(std::log10(tick), std::round(std::log10(tick)), 1e-12);
  }
  EXPECT_GE(wide.ticks.size(), 3U);
  const AxisRange narrow = make_range(Scale::logarithmic, {90, 1100});
  EXPECT_EQ(narrow.ticks, (std::vector<double>{100, 200, 500, 1000}));
  EXPECT_EQ(tick_text(1e-4, Scale::logarithmic), "10⁻⁴");
  EXPECT_EQ(tick_text(1e-3, Scale::logarithmic), "0.001");
  EXPECT_EQ(tick_text(2e-12, Scale::logarithmic), "2·10⁻¹²");
  EXPECT_EQ(tick_text(200, Scale::logarithmic), "200");
}

TEST(AxisTicks, EveryRangeHoldsItsValues) {
  for (const std::vector<double>& values : std::vector<std::vector<double>>{
           {}, {5}, {0}, {-3, -3}, {1e-300, 1e300}, {-1e6, 2e-6}, {7, NAN, INFINITY}}) {
    for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
      const AxisRange range = make_range(scale, values);
      EXPECT_LT(range.low, range.high);
      for (const double value : values) {
        if (!range.shows(value)) continue;
        EXPECT_GE(range.position(value), 0);
        EXPECT_LE(range.position(value), 1);
      }
      for (const double tick : range.ticks) {
        EXPECT_GE(range.position(tick), -1e-9);
        EXPECT_LE(range.position(tick), 1 + 1e-9);
      }
    }
  }
}

TEST(SvgPlot, DrawsWhatCanBeShown) {
  const Plot plot{"A < B",
                  {"x & y", Scale::logarithmic},
                  {"y"},
                  {{"points", Series::Style::markers, {1, 10, 0, 100}, {1, 2, 3, NAN}},
                   {"line", Series::Style::line, {1, 10, 100}, {3, 2, 1}}}};
  const std::string text = svg(plot);
  EXPECT_EQ(count(text, "<svg"), 1U);
  EXPECT_NE(text.find("<title>A &lt; B</title>"), std::string::npos);
  EXPECT_NE(text.find("x &amp; y"), std::string::npos);
  EXPECT_EQ(count(text, "<circle"), 3U);  // two points that can be shown, one in the legend
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(SvgPlot, BarsAndNothingAtAll) {
  const Plot bars = normal_histogram("histogram", "z", {-7, 0, 0.1, 9});
  EXPECT_GE(count(svg(bars), "<rect"), 40U);
  double share = 0;
  for (const double y : bars.series[0].y) share += y;
  EXPECT_NEAR(share, 1, 1e-12);
  EXPECT_EQ(bars.series[0].y.front(), 0.25);
  EXPECT_EQ(bars.series[0].y.back(), 0.25);
  EXPECT_EQ(count(svg(Plot{"empty", {"x"}, {"y"}, {}}), "<svg"), 1U);
}

TEST(SurfaceMap, ColorsBySign) {
  const auto square = [](std::optional<double> value) {
    return MapPolygon{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, value};
  };
  const SurfaceMap map{
      "map", "difference", 0.1, {{"wall", {square(-1), square(0), square(1), square({})}}}};
  const std::string text = svg(map);
  EXPECT_EQ(count(text, "<polygon"), 4U);
  for (const char* color : {"#2166ac", "#f7f7f7", "#b2182b", "#555"}) {
    EXPECT_NE(text.find(color), std::string::npos) << color;
  }
}

TEST(Statistics, MedianAndOrder) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_NEAR(fitted_order({1, 2, 4}, {3, 12, 48}), 2, 1e-12);
}

TEST(BuiltScenes, IcosphereIsClosedAndRoundOnItsCorners) {
  for (const Facing facing : {Facing::inwards, Facing::outwards}) {
    const std::vector<Polygon> faces = icosphere(2, 3, facing);
    EXPECT_EQ(faces.size(), 320U);
    radiosity::Vec3 sum = radiosity::Vec3::Zero();
    for (const Polygon& face : faces) {
      const radiosity::Vec3 area = radiosity::vector_area(face);
      sum += area;
      EXPECT_EQ(area.dot(face[0]) > 0, facing == Facing::outwards);
      for (const radiosity::Vec3& corner : face) EXPECT_NEAR(corner.norm(), 3, 1e-14);
    }
    EXPECT_LT(sum.norm(), 1e-12);
  }
}

CaseResult no_checks(const Context& /*context*/) { return {}; }
CaseResult nan_check(const Context& /*context*/) {
  CaseResult result;
  result.checks.push_back({"x", std::numeric_limits<double>::quiet_NaN(), 1, ""});
  return result;
}
CaseResult good_check(const Context& /*context*/) {
  CaseResult result;
  result.checks.push_back({"x", 0, 0, "<none>"});
  return result;
}
CaseResult skip(const Context& /*context*/) { throw Skipped("no data"); }
CaseResult broken(const Context& /*context*/) { throw radiosity::SolveError("broken"); }
CaseResult interrupted(const Context& /*context*/) { throw radiosity::Interrupted(); }

TEST(RunCase, TellsHowItEnded) {
  using Status = CaseOutcome::Status;
  const auto status = [](CaseResult (*run)(const Context&)) {
    return run_case({"name", "title", run}, {}).status;
  };
  EXPECT_EQ(status(no_checks), Status::failed);
  EXPECT_EQ(status(nan_check), Status::failed);
  EXPECT_EQ(status(good_check), Status::passed);
  EXPECT_EQ(status(skip), Status::skipped);
  EXPECT_EQ(status(broken), Status::failed);
  EXPECT_EQ(run_case({"name", "title", broken}, {}).message, "broken");
  EXPECT_THROW(run_case({"name", "title", interrupted}, {}), radiosity::Interrupted);
}

TEST(Report, EscapesItsTexts) {
  Report report;
  report.machine = "<machine>";
  report.outcomes.push_back(run_case({"name", "a & b", good_check}, {}));
  const std::string page = report_html(report);
  EXPECT_NE(page.find("&lt;machine&gt;"), std::string::npos);
  EXPECT_NE(page.find("a &amp; b"), std::string::npos);
  EXPECT_NE(page.find("&lt;none&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<none>"), std::string::npos);
}

}  // namespace
}  // namespace apps::validation
