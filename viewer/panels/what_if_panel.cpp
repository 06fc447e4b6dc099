#include <fmt/format.h>
#include <imgui.h>

#include <optional>
#include <string>

#include "io/picture/tone_mapping.h"
#include "viewer/desk/painting.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

constexpr const char* kReset = "reset";

/// A line of a name, cut if it is too long, and at its end a value.
void draw_label(const std::string& name, const std::string& value) {
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float right = place.x + ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::PushClipRect(place, ImVec2(right - value_width - gap, place.y + ImGui::GetFrameHeight()),
                      true);
  ImGui::TextUnformatted(name.c_str());
  ImGui::PopClipRect();
  ImGui::SameLine();
  ImGui::SetCursorScreenPos(ImVec2(right - value_width, ImGui::GetCursorScreenPos().y));
  ImGui::TextUnformatted(value.c_str());
}

/// A slider whose grab hides no number; `is_changed` offers to reset it. Returns the new value.
std::optional<float> draw_slider(float value, float high, bool is_changed, float original) {
  const float reset_width = ImGui::CalcTextSize(kReset).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(is_changed ? -reset_width - gap : -1);
  constexpr ImGuiSliderFlags kFlags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
  if (ImGui::SliderFloat("##value", &value, 0, high, " ", kFlags)) return value;
  if (!is_changed) return std::nullopt;
  ImGui::SameLine();
  if (ImGui::Button(kReset)) return original;
  return std::nullopt;
}

void draw_emitter(Desk& desk, std::size_t e) {
  const Emitter& emitter = desk.session.mix().emitters[e];
  ImGui::PushID(static_cast<int>(e));
  bool is_on = emitter.is_on;
  double scale = emitter.scale;
  bool has_changed = ImGui::Checkbox("##on", &is_on);
  ImGui::SameLine();
  draw_label(emitter.name, fmt::format("{:.0f} %", 100 * emitter.scale));
  const auto percent = static_cast<float>(100 * emitter.scale);
  if (const auto moved = draw_slider(percent, 200, emitter.scale != 1, 100)) {
    scale = *moved / 100.0;
    has_changed = true;
  }
  if (has_changed) attempt(desk, [&] { desk.session.set_emitter(e, scale, is_on); });
  ImGui::PopID();
}

/// A slider and a patch of colour for one material.
void draw_material(Desk& desk, std::size_t m) {
  const Session& session = desk.session;
  const Eigen::VectorXd& now = session.mix().reflectance[m];
  const Eigen::VectorXd& original = session.original_mix().reflectance[m];
  ImGui::PushID(static_cast<int>(m));
  const Eigen::MatrixX3f color = surface_colors(now.transpose(), session.model().bands);
  const auto shown = io::srgb_bytes(color.row(0), 1);
  const float side = ImGui::GetFontSize();
  ImGui::ColorButton("##color", ImVec4(shown[0] / 255.0F, shown[1] / 255.0F, shown[2] / 255.0F, 1),
                     ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                     ImVec2(side, side));
  ImGui::SameLine();
  draw_label(session.model().scene->materials[m].name, fmt::format("ρ {:.3f}", now.mean()));
  const auto mean = static_cast<float>(now.mean());
  const auto file_mean = static_cast<float>(original.mean());
  if (const auto moved = draw_slider(mean, 1, now != original, file_mean)) {
    const Eigen::VectorXd wanted =
        *moved == file_mean ? original : with_mean_reflectance(original, *moved);
    attempt(desk, [&] { desk.session.set_reflectance(m, wanted); });
  }
  ImGui::PopID();
}

}  // namespace

void draw_what_if_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("What if", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Session& session = desk.session;
  if (!session.model().scene) {
    ImGui::TextWrapped("%s", session.is_open()
                                 ? "Lamps and materials can be changed in scenes, not "
                                   "in result files."
                                 : "Lamps and materials of the scene.");
    return;
  }
  if (ImGui::Button("As in the file")) session.reset_mix();
  ImGui::TextDisabled("%s", session.is_thermal() ? "Sources" : "Lamps");
  for (std::size_t e = 0; e < session.mix().emitters.size(); ++e) draw_emitter(desk, e);
  ImGui::TextDisabled("Materials, mean reflectance");
  for (std::size_t m = 0; m < session.mix().reflectance.size(); ++m) draw_material(desk, m);
}

}  // namespace viewer
