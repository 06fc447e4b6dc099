#include "viewer/panels/mix_widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>

#include "io/picture/tone_mapping.h"
#include "viewer/desk/painting.h"
#include "viewer/panels/attempt.h"

namespace viewer {
namespace {

constexpr const char* kReset = "reset";

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

}  // namespace

void draw_emitter_switch(Desk& desk, std::size_t emitter) {
  Session& session = desk.session;
  bool is_on = session.mix().emitters[emitter].is_on;
  if (!ImGui::Checkbox("##on", &is_on)) return;
  session.begin_mix_step();
  attempt(desk,
          [&] { session.set_emitter(emitter, session.mix().emitters[emitter].scale, is_on); });
}

void draw_emitter_slider(Desk& desk, std::size_t emitter) {
  Session& session = desk.session;
  const Emitter now = session.mix().emitters[emitter];  // a slider changes it
  const Emitter& original = session.original_mix().emitters[emitter];
  const bool is_changed = now.scale != original.scale || now.is_on != original.is_on;
  const Slid slid = draw_slider(session, static_cast<float>(100 * now.scale), 200, is_changed,
                                static_cast<float>(100 * original.scale));
  if (slid.is_reset) {
    session.reset_emitter(emitter);
  } else if (slid.value) {
    attempt(desk, [&] { session.set_emitter(emitter, *slid.value / 100.0, now.is_on); });
  }
}

std::string emitter_text(const Desk& desk, std::size_t emitter) {
  return fmt::format("{:.0f} %", 100 * desk.session.mix().emitters[emitter].scale);
}

void draw_material_color(const Desk& desk, std::size_t material) {
  const Session& session = desk.session;
  const Eigen::MatrixX3f color =
      surface_colors(session.mix().reflectance[material].transpose(), session.model().bands);
  const auto shown = io::srgb_bytes(color.row(0), 1);
  const float side = ImGui::GetFontSize();
  ImGui::ColorButton("##color", ImVec4(shown[0] / 255.0F, shown[1] / 255.0F, shown[2] / 255.0F, 1),
                     ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                     ImVec2(side, side));
}

void draw_material_slider(Desk& desk, std::size_t material) {
  Session& session = desk.session;
  const Eigen::VectorXd now = session.mix().reflectance[material];  // a slider changes it
  const Eigen::VectorXd& original = session.original_mix().reflectance[material];
  const Slid slid = draw_slider(session, static_cast<float>(now.mean()), 1, now != original,
                                static_cast<float>(original.mean()));
  if (slid.is_reset) {
    session.reset_material(material);
  } else if (slid.value) {
    attempt(desk, [&] {
      session.set_reflectance(material, with_mean_reflectance(original, *slid.value));
    });
  }
}

std::string material_text(const Desk& desk, std::size_t material) {
  return fmt::format("ρ {:.3f}", desk.session.mix().reflectance[material].mean());
}

}  // namespace viewer
