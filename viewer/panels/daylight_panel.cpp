#include "viewer/panels/daylight_panel.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "viewer/desk/daylight.h"
#include "viewer/panels/attempt.h"

namespace viewer {
namespace {

constexpr double kDegree = radiosity::kPi / 180;
constexpr float kLowestSun = 1;  // degrees above the horizon

void draw_sun(Desk& desk, SunPlace place) {
  auto azimuth = static_cast<float>(place.azimuth / kDegree);
  auto elevation = static_cast<float>(place.elevation / kDegree);
  const float label = ImGui::CalcTextSize("elevation").x + ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(-label);
  bool is_moved = ImGui::SliderFloat("azimuth", &azimuth, 0, 360, "%.0f°");
  bool is_step = ImGui::IsItemActivated();
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("From north by east. North is +y where z is up, -z where y is.");
  }
  ImGui::SetNextItemWidth(-label);
  is_moved |= ImGui::SliderFloat("elevation", &elevation, kLowestSun, 90, "%.0f°");
  is_step |= ImGui::IsItemActivated();
  if (is_step) desk.session.begin_mix_step();
  if (!is_moved) return;
  attempt(desk, [&] { set_sun_place(desk, {azimuth * kDegree, elevation * kDegree}); });
}

void draw_sky(Desk& desk) {
  const auto type = sky_type(desk);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##sky", type ? sky_type_name(*type) : "as measured (Perez)")) {
    for (int k = 1; k <= 16; ++k) {
      if (!ImGui::Selectable(sky_type_name(k), type == k)) continue;
      desk.session.begin_mix_step();
      attempt(desk, [&] { set_sky_type(desk, k); });
    }
    ImGui::EndCombo();
  }
  if (const auto lux = sky_illuminance(desk)) {
    ImGui::TextUnformatted(("sky: " + number_text(*lux) + " lux outdoors (E_h)").c_str());
  }
}

}  // namespace

void DaylightPanel::draw_time(Desk& desk) {
  if (!ImGui::TreeNode("by place and time")) return;
  const float width = ImGui::GetFontSize() * 5;
  const auto field = [&](const char* label, double& value) {
    ImGui::SetNextItemWidth(width);
    ImGui::InputDouble(label, &value, 0, 0, "%.4g");
  };
  field("latitude, ° north", latitude_);
  field("longitude, ° east", longitude_);
  ImGui::SetNextItemWidth(width);
  ImGui::InputInt("month", &month_);
  ImGui::SetNextItemWidth(width);
  ImGui::InputInt("day", &day_);
  month_ = std::clamp(month_, 1, 12);
  day_ = std::clamp(day_, 1, 31);
  field("hour, UTC", hour_);
  if (ImGui::Button("Put the sun there")) {
    desk.session.begin_mix_step();
    attempt(desk, [&] {
      set_sun_time(desk, {.latitude = latitude_ * kDegree,
                          .longitude = longitude_ * kDegree,
                          .month = month_,
                          .day = day_,
                          .hour = hour_});
    });
  }
  ImGui::TreePop();
}

void DaylightPanel::draw(Desk& desk) {
  const auto place = sun_place(desk);
  if (!place) return;
  if (!ImGui::CollapsingHeader("Sun and sky", ImGuiTreeNodeFlags_DefaultOpen)) return;
  draw_sun(desk, *place);
  draw_time(desk);
  if (desk.session.mix().sky) draw_sky(desk);
  if (ImGui::SmallButton("As in the file##daylight")) desk.session.reset_daylight();
}

}  // namespace viewer
