#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
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

/// What a hand did to a slider.
struct Slid {
  std::optional<float> value;
  bool is_reset = false;
};

/// A mark below the slider that was drawn last, at the file's value.
void draw_file_mark(float value, float high) {
  const ImVec2 low_corner = ImGui::GetItemRectMin();
  const ImVec2 high_corner = ImGui::GetItemRectMax();
  const ImGuiStyle& style = ImGui::GetStyle();
  // As ImGui has it: the middle of the grab goes from half a grab within either end.
  constexpr float kInset = 2;
  const float inset = kInset + style.GrabMinSize / 2;
  const float width = high_corner.x - low_corner.x - 2 * inset;
  const float x = low_corner.x + inset + width * std::min(value / high, 1.F);
  const float y = high_corner.y;
  const float side = 0.28F * ImGui::GetFontSize();
  ImGui::GetWindowDrawList()->AddTriangleFilled(ImVec2(x, y - side), ImVec2(x + side / 2, y),
                                                ImVec2(x - side / 2, y),
                                                ImGui::GetColorU32(ImGuiCol_Text));
}

/// A slider whose grab hides no number, with a mark at the file's value; `is_changed` offers to
/// reset it. Each time that a hand takes it is a step to undo.
Slid draw_slider(Session& session, float value, float high, bool is_changed, float original) {
  const float reset_width = ImGui::CalcTextSize(kReset).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  // Always as wide, so that it stays where it is under the mouse.
  ImGui::SetNextItemWidth(-reset_width - gap);
  constexpr ImGuiSliderFlags kFlags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
  Slid slid;
  if (ImGui::SliderFloat("##value", &value, 0, high, " ", kFlags)) slid.value = value;
  if (ImGui::IsItemActivated()) session.begin_mix_step();
  draw_file_mark(original, high);
  if (!is_changed) return slid;
  ImGui::SameLine();
  slid.is_reset = ImGui::Button(kReset);
  return slid;
}

void draw_emitter(Desk& desk, std::size_t e) {
  Session& session = desk.session;
  const Emitter& emitter = session.mix().emitters[e];
  const Emitter& original = session.original_mix().emitters[e];
  ImGui::PushID(static_cast<int>(e));
  bool is_on = emitter.is_on;
  double scale = emitter.scale;
  bool has_changed = ImGui::Checkbox("##on", &is_on);
  if (has_changed) session.begin_mix_step();
  ImGui::SameLine();
  draw_label(emitter.name, fmt::format("{:.0f} %", 100 * emitter.scale));
  const auto percent = static_cast<float>(100 * emitter.scale);
  const bool is_changed = emitter.scale != original.scale || emitter.is_on != original.is_on;
  const auto file_percent = static_cast<float>(100 * original.scale);
  const Slid slid = draw_slider(session, percent, 200, is_changed, file_percent);
  if (slid.value) {
    scale = *slid.value / 100.0;
    has_changed = true;
  }
  if (slid.is_reset) {
    session.reset_emitter(e);
  } else if (has_changed) {
    attempt(desk, [&] { session.set_emitter(e, scale, is_on); });
  }
  ImGui::PopID();
}

/// A slider and a patch of colour for one material.
void draw_material(Desk& desk, std::size_t m) {
  Session& session = desk.session;
  const Eigen::VectorXd now = session.mix().reflectance[m];  // a slider changes it
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
  const Slid slid = draw_slider(session, mean, 1, now != original, file_mean);
  if (slid.is_reset) {
    session.reset_material(m);
  } else if (slid.value) {
    attempt(desk,
            [&] { session.set_reflectance(m, with_mean_reflectance(original, *slid.value)); });
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
                                 : "No scene is open. Its lamps can be switched and dimmed "
                                   "here, and its materials changed.");
    return;
  }
  if (ImGui::Button("As in the file")) session.reset_mix();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session.mix_history().can_undo());
  if (ImGui::Button("Undo")) session.undo_mix();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session.mix_history().can_redo());
  if (ImGui::Button("Redo")) session.redo_mix();
  ImGui::EndDisabled();
  ImGui::TextDisabled("%s", session.is_thermal() ? "Sources" : "Lamps");
  // Else the first lamp and the first material would be one to ImGui, and move together.
  ImGui::PushID("lamps");
  for (std::size_t e = 0; e < session.mix().emitters.size(); ++e) draw_emitter(desk, e);
  ImGui::PopID();
  ImGui::TextDisabled("Materials, mean reflectance");
  ImGui::PushID("materials");
  for (std::size_t m = 0; m < session.mix().reflectance.size(); ++m) draw_material(desk, m);
  ImGui::PopID();
}

}  // namespace viewer
