#include "viewer/draw/luminaire_overlay.h"

#include <imgui.h>

#include <algorithm>
#include <span>

#include "viewer/desk/luminaire_shape.h"
#include "viewer/desk/luminaires.h"
#include "viewer/draw/planned_picture.h"
#include "viewer/draw/projection.h"

namespace viewer {
namespace {

using radiosity::Vec3;

constexpr ImU32 kLampInk = IM_COL32(255, 235, 120, 255);
constexpr ImU32 kDarkLampInk = IM_COL32(150, 150, 150, 255);  // it is off
constexpr ImU32 kCurveInk = IM_COL32(255, 215, 60, 220);
constexpr ImU32 kCrossCurveInk = IM_COL32(110, 200, 255, 220);
constexpr ImU32 kSolidInk = IM_COL32(255, 235, 120, 90);
constexpr ImU32 kLampShadow = IM_COL32(0, 0, 0, 170);
constexpr float kMarkRadius = 4;  // pixels at scale 1

void draw_curve(const Desk& desk, ImDrawList& list, std::span<const Vec3> curve, ImU32 ink,
                float width) {
  for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
    const auto piece = project_piece(desk, curve[k], curve[k + 1]);
    if (piece) list.AddLine(piece->first, piece->second, ink, width);
  }
}

void draw_mark(const Desk& desk, ImDrawList& list, std::size_t k, const LuminaireShape& shape,
               float scale) {
  const Emitter& emitter = desk.session.mix().emitters[desk.luminaires[k].emitter];
  const ImU32 ink = emitter.factor() > 0 ? kLampInk : kDarkLampInk;
  draw_curve(desk, list, shape.opening, kLampShadow, 3 * scale);
  draw_curve(desk, list, shape.opening, ink, 1.5F * scale);
  const Vec3 end = 0.5 * (shape.aim[0] + shape.aim[1]);
  if (const auto aim = project_piece(desk, shape.aim[0], end)) {
    list.AddLine(aim->first, aim->second, kLampShadow, 3.5F * scale);
    list.AddLine(aim->first, aim->second, ink, 1.5F * scale);
  }
  const auto place = project(desk, shape.aim[0]);
  if (!place) return;
  const bool is_hovered = desk.hovered_luminaire == k;
  const float radius = (is_hovered ? 1.5F : 1) * kMarkRadius * scale;
  list.AddCircleFilled(*place, radius + scale, kLampShadow);
  list.AddCircleFilled(*place, radius, ink);
}

void draw_name(const Desk& desk, ImDrawList& list, std::size_t k, float scale) {
  const auto place = project(desk, desk.session.model().scene->luminaires[k].position);
  if (!place) return;
  const std::string text = luminaire_text(desk.luminaires[k], desk.session.mix());
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const PicturePlan plan = planned_picture(desk, scale);
  const auto left = static_cast<float>(desk.region.left);
  float right = left + static_cast<float>(desk.region.width);
  if (plan.legend && plan.legend->box.top < place->y) right = plan.legend->box.left;
  const float top = plan.badge ? plan.badge->bottom() : static_cast<float>(desk.region.top);
  const float x = std::max(left + 4, std::min(place->x + 10 * scale, right - size.x - 4));
  const float y = std::max(top + 4, place->y - 1.5F * size.y);
  list.AddRectFilled(ImVec2(x - 3, y), ImVec2(x + size.x + 3, y + size.y), kLampShadow, 2);
  list.AddText(ImVec2(x, y), kLampInk, text.c_str());
}

}  // namespace

void draw_luminaires(const Desk& desk, double scale) {
  const radiosity::Scene* scene = desk.session.model().scene.get();
  const bool are_known = scene != nullptr && desk.luminaires.size() == scene->luminaires.size();
  if (!desk.look.luminaires || !are_known || desk.luminaires.empty()) return;
  const auto size = static_cast<float>(scale);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 low(static_cast<float>(desk.region.left), static_cast<float>(desk.region.top));
  list.PushClipRect(low, ImVec2(low.x + static_cast<float>(desk.region.width),
                                low.y + static_cast<float>(desk.region.height)));
  const double length = luminaire_size(desk.session);
  for (std::size_t k = 0; k < scene->luminaires.size(); ++k) {
    const bool is_chosen = desk.chosen_luminaire == k;
    if (!is_chosen && !is_luminaire_seen(desk, k)) continue;
    const radiosity::Luminaire& luminaire = scene->luminaires[k];
    const LuminaireShape shape = luminaire_shape(
        luminaire, scene->photometries[luminaire.photometry], is_chosen ? 2 * length : length,
        is_chosen ? LuminaireDetail::solid : LuminaireDetail::curves);
    for (const auto& curve : shape.solid) draw_curve(desk, list, curve, kSolidInk, size);
    if (is_chosen || desk.look.polar_curves) {
      draw_curve(desk, list, shape.planes[0], kCurveInk, 2 * size);
      draw_curve(desk, list, shape.planes[1], kCrossCurveInk, 1.5F * size);
    }
    draw_mark(desk, list, k, shape, size);
  }
  if (desk.chosen_luminaire) draw_name(desk, list, *desk.chosen_luminaire, size);
  list.PopClipRect();
}

}  // namespace viewer
