#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>

#include "io/picture/color_bar.h"
#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/surface_totals.h"
#include "viewer/panels/inks.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

constexpr std::array kUnits = {"m", "cm", "mm", "um", "km", "in", "ft"};
// What people light is larger than a hand and smaller than a town.
constexpr double kSmallest = 0.02;  // m
constexpr double kLargest = 500;

void draw_size(const Desk& desk) {
  const radiosity::Vec3 size = desk.session.model().bounds.sizes();
  const std::string text = fmt::format("{} × {} × {} m", io::tick_label(size.x()),
                                       io::tick_label(size.y()), io::tick_label(size.z()));
  const bool is_odd = size.maxCoeff() > kLargest || size.maxCoeff() < kSmallest;
  if (is_odd && desk.session.model().scene) {
    ImGui::TextColored(kDoubtInk, "%s: is the unit right?", text.c_str());
  } else {
    ImGui::TextUnformatted(text.c_str());
  }
}

void choose_unit(Desk& desk) {
  const Model& model = desk.session.model();
  const std::string now = model.unit.value_or("as in the file");
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  ImGui::BeginDisabled(!model.scene);
  if (ImGui::BeginCombo("unit", now.c_str())) {
    for (const char* unit : kUnits) {
      if (ImGui::Selectable(unit, now == unit)) attempt(desk, [&] { set_unit(desk, unit); });
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
}

}  // namespace

void draw_scene_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("Scene", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!desk.session.is_open()) {
    ImGui::TextDisabled("none");
    return;
  }
  ImGui::PushTextWrapPos(0);
  draw_size(desk);
  ImGui::PopTextWrapPos();
  choose_unit(desk);
  for (const UpAxis axis : {UpAxis::y, UpAxis::z}) {
    const std::string label = up_name(axis) + " is up";
    if (ImGui::RadioButton(label.c_str(), desk.up == axis)) set_up(desk, axis);
    if (axis == UpAxis::y) ImGui::SameLine();
  }
}

void draw_heat_panel(const Desk& desk) {
  if (!ImGui::CollapsingHeader("Net heat by surface", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const Light* light = desk.session.light();
  if (light == nullptr || !ImGui::BeginTable("heat", 4, ImGuiTableFlags_RowBg)) return;
  const float width = ImGui::GetFontSize();
  ImGui::TableSetupColumn("surface", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("K", ImGuiTableColumnFlags_WidthFixed, 3.5F * width);
  ImGui::TableSetupColumn("°C", ImGuiTableColumnFlags_WidthFixed, 3.8F * width);
  ImGui::TableSetupColumn("net W", ImGuiTableColumnFlags_WidthFixed, 4.5F * width);
  ImGui::TableHeadersRow();
  for (std::size_t s = 0; s < desk.fluxes.size(); ++s) {
    const auto& flux = desk.fluxes[s];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(flux.surface.c_str());
    const auto temperature = surface_temperature(desk.session, static_cast<std::int32_t>(s));
    ImGui::TableNextColumn();
    if (temperature) ImGui::Text("%.1f", *temperature);
    ImGui::TableNextColumn();
    if (temperature) ImGui::Text("%.1f", celsius(*temperature));
    ImGui::TableNextColumn();
    const Eigen::VectorXd heat = Eigen::VectorXd::Constant(1, flux.heat);
    ImGui::TextUnformatted(numbers_text(heat, light->kind == Light::Kind::preview).c_str());
  }
  ImGui::EndTable();
}

}  // namespace viewer
