#include "viewer/draw/guides.h"

#include <imgui.h>

#include <cmath>
#include <string>

#include "viewer/desk/axes.h"
#include "viewer/draw/planned_picture.h"
#include "viewer/draw/projection.h"

namespace viewer {
namespace {

constexpr ImU32 kOutlineInk = IM_COL32(150, 158, 172, 200);
constexpr ImU32 kAxisPlate = IM_COL32(26, 27, 31, 190);
constexpr float kAxisLength = 26;  // pixels at scale 1, as the others
constexpr float kLabelGap = 8;
constexpr double kShortAxis = 0.3;

ImU32 axis_ink(const ShownAxis& axis) {
  const int alpha = axis.nearness < -0.1 ? 150 : 255;  // those that point away are paler
  if (axis.name == 'x') return IM_COL32(240, 95, 85, alpha);
  if (axis.name == 'y') return IM_COL32(115, 205, 95, alpha);
  return IM_COL32(95, 155, 255, alpha);
}

}  // namespace

void Guides::draw_outlines(const Desk& desk, float scale) {
  const Model& model = desk.session.model();
  if (model.mesh != mesh_) {
    mesh_ = model.mesh;
    outlines_ = std::make_unique<BackOutlines>(*mesh_);
    eye_.reset();
  }
  const radiosity::Vec3 eye = desk.camera.camera().position;
  if (!eye_ || *eye_ != eye) {
    pieces_ = outlines_->of_hidden_backs(eye, *model.visibility);
    eye_ = eye;
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const OutlinePiece& piece : pieces_) {
    if (const auto line = project_piece(desk, piece.from, piece.to)) {
      list.AddLine(line->first, line->second, kOutlineInk, scale);
    }
  }
}

void Guides::draw(const Desk& desk, double scale) {
  if (!desk.session.is_open() || desk.region.width <= 0 || desk.region.height <= 0) return;
  if (!desk.look.back_outlines || !desk.look.hide_backs) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 low(static_cast<float>(desk.region.left), static_cast<float>(desk.region.top));
  list.PushClipRect(low, ImVec2(low.x + static_cast<float>(desk.region.width),
                                low.y + static_cast<float>(desk.region.height)));
  draw_outlines(desk, static_cast<float>(scale));
  list.PopClipRect();
}

void draw_axes(const Desk& desk, double ui_scale) {
  if (!desk.session.is_open() || !desk.look.axes) return;
  const std::optional<Box> box = planned_picture(desk, ui_scale).axes;
  if (!box) return;
  const auto scale = static_cast<float>(ui_scale);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 center(box->left + box->width / 2, box->top + box->height / 2);
  list.AddCircleFilled(center, box->width / 2, kAxisPlate);
  for (const ShownAxis& axis : shown_axes(desk.camera.camera())) {
    const auto at = [&](float length) {
      return ImVec2(center.x + length * scale * static_cast<float>(axis.right),
                    center.y - length * scale * static_cast<float>(axis.up));
    };
    const ImU32 ink = axis_ink(axis);
    list.AddLine(center, at(kAxisLength), ink, 2 * scale);
    const std::string label(1, axis.name);
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    // Beside an axis that points at the eye, or away from it.
    const bool is_short = std::hypot(axis.right, axis.up) < kShortAxis;
    const ImVec2 end = at(is_short ? 0 : kAxisLength + kLabelGap);
    const float aside = is_short ? kLabelGap * scale : 0;
    const ImVec2 place(end.x + aside, end.y + aside);
    if (is_short) list.AddCircleFilled(center, 2.5F * scale, ink);
    list.AddText(ImVec2(place.x - size.x / 2, place.y - size.y / 2), ink, label.c_str());
  }
}

}  // namespace viewer
