#include "viewer/panels/iteration_plot.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace viewer {
namespace {

constexpr ImU32 kInk = IM_COL32(210, 210, 210, 255);
constexpr ImU32 kGrid = IM_COL32(70, 72, 78, 255);
constexpr ImU32 kCurve = IM_COL32(90, 190, 255, 255);
constexpr ImU32 kMark = IM_COL32(255, 170, 40, 255);
constexpr int kMostDecades = 12;

}  // namespace

void draw_iteration_plot(const IterationRecord& record, int iteration, double scale) {
  const auto size = static_cast<float>(scale);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 extent(ImGui::GetContentRegionAvail().x, 190 * size);
  ImGui::Dummy(extent);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight();
  const float left = corner.x + ImGui::CalcTextSize("1e-10").x + 6 * size;
  const float right = corner.x + extent.x - 8 * size;
  const float top = corner.y + 1.4F * line;
  const float bottom = corner.y + extent.y - 1.3F * line;
  const std::string title =
      fmt::format("{}: bound on the relative error", method_name(record.method));
  list.AddText(corner, kInk, title.c_str());

  double highest = 0;
  double lowest = INFINITY;
  for (const double bound : record.bounds) {
    if (!(bound > 0) || !std::isfinite(bound)) continue;
    highest = std::max(highest, bound);
    lowest = std::min(lowest, bound);
  }
  if (!(highest > 0) || record.steps.empty()) return;
  const int high = static_cast<int>(std::ceil(std::log10(highest)));
  const int low = std::max(std::min(static_cast<int>(std::floor(std::log10(lowest))), high - 1),
                           high - kMostDecades);
  const double last = std::max(record.steps.back(), 1.0);
  const auto x_of = [&](double step) {
    return left + static_cast<float>(step / last) * (right - left);
  };
  const auto y_of = [&](double bound) {
    const double share = (std::log10(bound) - low) / (high - low);
    return bottom - static_cast<float>(std::clamp(share, 0.0, 1.0)) * (bottom - top);
  };
  const int every = high - low > 6 ? 2 : 1;
  for (int decade = low; decade <= high; decade += every) {
    const float y = y_of(std::pow(10.0, decade));
    list.AddLine(ImVec2(left, y), ImVec2(right, y), kGrid);
    list.AddText(ImVec2(corner.x, y - line / 2), kInk, fmt::format("1e{}", decade).c_str());
  }
  std::vector<ImVec2> curve;
  for (std::size_t k = 0; k < record.steps.size(); ++k) {
    if (!(record.bounds[k] > 0) || !std::isfinite(record.bounds[k])) continue;
    // A point for each pixel is enough: Southwell has thousands of steps.
    const ImVec2 point(x_of(record.steps[k]), y_of(record.bounds[k]));
    if (curve.empty() || point.x >= curve.back().x + 1 || k + 1 == record.steps.size()) {
      curve.push_back(point);
    }
  }
  list.AddPolyline(curve.data(), static_cast<int>(curve.size()), kCurve, 0, 1.5F * size);
  const float mark = x_of(std::min<double>(iteration, last));
  list.AddLine(ImVec2(mark, top), ImVec2(mark, bottom), kMark, 1.5F * size);
  list.AddText(ImVec2(left, bottom + 2 * size), kInk, "0");
  const std::string end = fmt::format("{:.0f} steps", last);
  list.AddText(ImVec2(right - ImGui::CalcTextSize(end.c_str()).x, bottom + 2 * size), kInk,
               end.c_str());
}

}  // namespace viewer
