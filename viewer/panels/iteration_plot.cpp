#include "viewer/panels/iteration_plot.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "viewer/desk/patch_facts.h"

namespace viewer {
namespace {

constexpr ImU32 kInk = IM_COL32(210, 210, 210, 255);
constexpr ImU32 kGrid = IM_COL32(70, 72, 78, 255);
constexpr ImU32 kMark = IM_COL32(255, 170, 40, 255);
constexpr int kMostDecades = 12;
constexpr float kHeight = 190;  // at scale 1

/// A method keeps its colour, whichever is stepped through.
ImU32 color_of(radiosity::Method method) {
  constexpr std::array<ImU32, 5> kColors = {
      IM_COL32(90, 190, 255, 255), IM_COL32(255, 130, 120, 255), IM_COL32(150, 220, 110, 255),
      IM_COL32(220, 160, 255, 255), IM_COL32(240, 220, 110, 255)};
  return kColors[static_cast<std::size_t>(method) % kColors.size()];
}

bool is_drawn(double bound) { return bound > 0 && std::isfinite(bound); }

/// The decades of the bounds, and the work that they cost.
struct Axes {
  int low = 0;
  int high = 1;
  double first = 0;  ///< products at the left edge; 0 if the axis is linear
  double last = 1;
  ImVec2 top_left;
  ImVec2 bottom_right;

  [[nodiscard]] float x(double work) const {
    const double share =
        first > 0 ? std::log(std::max(work, first) / first) / std::log(last / first) : work / last;
    return top_left.x +
           static_cast<float>(std::clamp(share, 0.0, 1.0)) * (bottom_right.x - top_left.x);
  }
  [[nodiscard]] float y(double bound) const {
    const double share = (std::log10(bound) - low) / (high - low);
    return bottom_right.y -
           static_cast<float>(std::clamp(share, 0.0, 1.0)) * (bottom_right.y - top_left.y);
  }
};

/// Whether there is anything to draw.
bool fit(Axes& axes, const IterationPlot& plot) {
  double highest = 0;
  double lowest = INFINITY;
  double least_work = INFINITY;
  double most_work = 0;
  for (const IterationRecord* record : plot.records) {
    for (std::size_t k = 0; k < record->work.size(); ++k) {
      if (!is_drawn(record->bounds[k])) continue;
      highest = std::max(highest, record->bounds[k]);
      lowest = std::min(lowest, record->bounds[k]);
      if (record->work[k] > 0) least_work = std::min(least_work, record->work[k]);
      most_work = std::max(most_work, record->work[k]);
    }
  }
  if (!(highest > 0)) return false;
  axes.high = static_cast<int>(std::ceil(std::log10(highest)));
  axes.low = std::max(std::min(static_cast<int>(std::floor(std::log10(lowest))), axes.high - 1),
                      axes.high - kMostDecades);
  axes.last = most_work > 0 ? most_work : 1;
  axes.first = plot.is_logarithmic && least_work < axes.last ? least_work : 0;
  return true;
}

void draw_curve(ImDrawList& list, const Axes& axes, const IterationRecord& record, float width) {
  std::vector<ImVec2> curve;
  for (std::size_t k = 0; k < record.work.size(); ++k) {
    if (!is_drawn(record.bounds[k])) continue;
    // A point for each pixel is enough: Southwell has thousands of steps.
    const ImVec2 point(axes.x(record.work[k]), axes.y(record.bounds[k]));
    if (curve.empty() || point.x >= curve.back().x + 1 || k + 1 == record.work.size()) {
      curve.push_back(point);
    }
  }
  list.AddPolyline(curve.data(), static_cast<int>(curve.size()), color_of(record.method), 0, width);
}

/// In the corner that falling curves leave free: of a logarithmic axis, on which they fall late,
/// the lower left one.
void draw_names(ImDrawList& list, const Axes& axes, const IterationPlot& plot) {
  const bool is_low = axes.first > 0;
  const float line = ImGui::GetTextLineHeight();
  float y = axes.top_left.y;
  if (is_low) y = axes.bottom_right.y - line * static_cast<float>(plot.records.size());
  for (const IterationRecord* record : plot.records) {
    const std::string name(method_title(record->method));
    const float right = axes.bottom_right.x - ImGui::CalcTextSize(name.c_str()).x;
    list.AddText(ImVec2(is_low ? axes.top_left.x + line / 2 : right, y), color_of(record->method),
                 name.c_str());
    y += line;
  }
}

void draw_work_axis(ImDrawList& list, const Axes& axes, float below) {
  const float y = axes.bottom_right.y + below;
  const std::string first = number_text(axes.first, 1);
  const std::string last = number_text(axes.last, 3);
  const std::string what = "work in products F B";
  const float middle =
      (axes.top_left.x + axes.bottom_right.x - ImGui::CalcTextSize(what.c_str()).x) / 2;
  list.AddText(ImVec2(axes.top_left.x, y), kInk, first.c_str());
  list.AddText(ImVec2(middle, y), kInk, what.c_str());
  list.AddText(ImVec2(axes.bottom_right.x - ImGui::CalcTextSize(last.c_str()).x, y), kInk,
               last.c_str());
}

}  // namespace

void draw_iteration_plot(const IterationPlot& plot, double scale) {
  const auto size = static_cast<float>(scale);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 extent(ImGui::GetContentRegionAvail().x, kHeight * size);
  ImGui::Dummy(extent);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight();
  list.AddText(corner, kInk, "bound on the relative error");
  Axes axes;
  axes.top_left =
      ImVec2(corner.x + ImGui::CalcTextSize("1e-10").x + 6 * size, corner.y + 1.4F * line);
  axes.bottom_right = ImVec2(corner.x + extent.x - 8 * size, corner.y + extent.y - 1.3F * line);
  if (!fit(axes, plot)) return;
  const int every = axes.high - axes.low > 6 ? 2 : 1;
  for (int decade = axes.low; decade <= axes.high; decade += every) {
    const float y = axes.y(std::pow(10.0, decade));
    list.AddLine(ImVec2(axes.top_left.x, y), ImVec2(axes.bottom_right.x, y), kGrid);
    list.AddText(ImVec2(corner.x, y - line / 2), kInk, fmt::format("1e{}", decade).c_str());
  }
  const float mark = axes.x(plot.mark);
  list.AddLine(ImVec2(mark, axes.top_left.y), ImVec2(mark, axes.bottom_right.y), kMark,
               1.5F * size);
  for (std::size_t k = plot.records.size(); k-- > 0;) {
    draw_curve(list, axes, *plot.records[k], (k == 0 ? 2.F : 1.2F) * size);
  }
  draw_names(list, axes, plot);
  draw_work_axis(list, axes, 2 * size);
}

}  // namespace viewer
