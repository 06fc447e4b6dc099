#include "viewer/draw/comparison_overlay.h"

#include <imgui.h>

#include <cmath>
#include <string>

#include "viewer/desk/pinning.h"

namespace viewer {
namespace {

constexpr ImU32 kLine = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kLineShadow = IM_COL32(0, 0, 0, 160);
constexpr ImU32 kHandle = IM_COL32(26, 27, 31, 235);
constexpr ImU32 kLabel = IM_COL32(170, 175, 180, 255);

void draw_handle(ImDrawList& list, ImVec2 center, float scale) {
  const float radius = 13 * scale;
  list.AddCircleFilled(center, radius, kHandle);
  list.AddCircle(center, radius, kLine, 0, 1.5F * scale);
  const float near = 3 * scale;
  const float far = 8 * scale;
  const float half = 4 * scale;
  for (const float side : {-1.F, 1.F}) {
    list.AddTriangleFilled(ImVec2(center.x + side * far, center.y),
                           ImVec2(center.x + side * near, center.y - half),
                           ImVec2(center.x + side * near, center.y + half), kLine);
  }
}

/// Left of the line, where the light of now has its own.
void draw_pinned_label(const Desk& desk, ImDrawList& list, float right, float scale) {
  const std::string text = "pinned: " + desk.pinning.light->standing;
  const auto left = static_cast<float>(desk.region.left) + 12 * scale;
  const float width = right - left - 12 * scale;
  if (width < 2 * ImGui::GetFontSize()) return;
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  const float top = static_cast<float>(desk.region.top) + 10 * scale;
  list.AddRectFilled(ImVec2(left - 6 * scale, top - 4 * scale),
                     ImVec2(left + extent.x + 6 * scale, top + extent.y + 4 * scale), kHandle,
                     4 * scale);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImVec2(left, top), kLabel, text.c_str(),
               nullptr, width);
}

}  // namespace

double drawn_split(const Desk& desk) {
  if (desk.region.width <= 0) return desk.pinning.split;
  return std::round(desk.pinning.split * desk.region.width) / desk.region.width;
}

void draw_comparison(const Desk& desk, double scale) {
  if (shown_comparison(desk) != Comparison::wipe || desk.region.width <= 0) return;
  const auto size = static_cast<float>(scale);
  const auto top = static_cast<float>(desk.region.top);
  const auto bottom = top + static_cast<float>(desk.region.height);
  const auto x =
      static_cast<float>(desk.region.left + std::round(desk.pinning.split * desk.region.width));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddLine(ImVec2(x, top), ImVec2(x, bottom), kLineShadow, 4 * size);
  list.AddLine(ImVec2(x, top), ImVec2(x, bottom), kLine, 1.5F * size);
  draw_handle(list, ImVec2(x, (top + bottom) / 2), size);
  draw_pinned_label(desk, list, x, size);
}

}  // namespace viewer
