#include "viewer/draw/comparison_overlay.h"

#include <imgui.h>

#include <cmath>
#include "viewer/desk/picture_words.h"
#include "viewer/desk/pinning.h"
#include "viewer/draw/planned_picture.h"

namespace viewer {
namespace {

constexpr ImU32 kLine = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kLineShadow = IM_COL32(0, 0, 0, 160);
constexpr ImU32 kHandle = IM_COL32(26, 27, 31, 235);
constexpr ImU32 kLabel = IM_COL32(170, 175, 180, 255);
constexpr float kHandleRadius = 13;  // pixels at scale 1

void draw_handle(ImDrawList& list, ImVec2 center, float scale) {
  const float radius = kHandleRadius * scale;
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

}  // namespace

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
  const PicturePlan plan = planned_picture(desk, scale);
  const bool is_behind =
      plan.legend && x > plan.legend->box.left - kHandleRadius * size;  // of the colour bar
  draw_handle(list, ImVec2(x, ((is_behind ? plan.legend->box.bottom() : top) + bottom) / 2), size);
  // Left of the line, where the light of now has its own.
  if (plan.pinned) draw_plate(list, *plan.pinned, kLabel, picture_words(desk).pinned, size);
}

}  // namespace viewer
