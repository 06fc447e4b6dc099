#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "io/picture/tone_mapping.h"
#include "viewer/draw/painter.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

using radiosity::Index;

/// What can be shown, in words.
std::string caption(const ShowName& name) {
  std::string text(name.name);
  std::replace(text.begin(), text.end(), '-', ' ');
  if (name.show == Show::quantity && name.quantity == radiosity::Quantity::illuminance) {
    return "illuminance (lux)";
  }
  return text;
}

bool is_banded(const Look& look) {
  if (look.show == Show::quantity) return !radiosity::quantity_info(look.quantity).is_photometric;
  return look.show == Show::direct || look.show == Show::indirect || look.show == Show::unshot ||
         look.show == Show::light_path;
}

void choose_shown(Desk& desk) {
  const std::string now(show_name(desk.look));
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##show", caption(*show_named(now)).c_str(),
                         ImGuiComboFlags_HeightLarge)) {
    return;
  }
  for (const ShowName& name : show_names()) {
    if (ImGui::Selectable(caption(name).c_str(), name.name == now)) {
      show(desk, std::string(name.name));
    }
  }
  ImGui::EndCombo();
}

void choose_band(Desk& desk) {
  const radiosity::Bands& bands = desk.session.model().bands;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##band", band_title(bands, desk.look.band).c_str())) return;
  if (ImGui::Selectable(band_title(bands, {}).c_str(), !desk.look.band)) desk.look.band.reset();
  for (Index b = 0; b < bands.count(); ++b) {
    ImGui::PushID(static_cast<int>(b));
    if (ImGui::Selectable(band_title(bands, b).c_str(), desk.look.band == b)) desk.look.band = b;
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void choose_range(Desk& desk) {
  Look& look = desk.look;
  ImGui::Checkbox("logarithmic", &look.logarithmic);
  bool is_automatic = !look.range;
  ImGui::SameLine();
  if (ImGui::Checkbox("fit range", &is_automatic)) {
    look.range.reset();
    if (!is_automatic && desk.legend) look.range = desk.legend->scale;
  }
  if (!look.range) return;
  double low = look.range->low;
  double high = look.range->high;
  const float width = ImGui::GetFontSize() * 6;
  ImGui::SetNextItemWidth(width);
  bool has_changed = ImGui::InputDouble("##low", &low, 0, 0, "%.4g");
  ImGui::SameLine();
  ImGui::TextUnformatted("to");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(width);
  has_changed |= ImGui::InputDouble("##high", &high, 0, 0, "%.4g");
  if (has_changed && low < high) look.range = io::ColorScale{.low = low, .high = high};
}

/// Sliders for one emitter.
void draw_emitter(Desk& desk, std::size_t e) {
  const Emitter& emitter = desk.session.mix().emitters[e];
  ImGui::PushID(static_cast<int>(e));
  bool is_on = emitter.is_on;
  auto percent = static_cast<float>(100 * emitter.scale);
  bool has_changed = ImGui::Checkbox(emitter.name.c_str(), &is_on);
  ImGui::SetNextItemWidth(-1);
  has_changed |= ImGui::SliderFloat("##scale", &percent, 0, 200, "%.0f %%");
  if (has_changed) {
    const double scale = std::max(0.0F, percent) / 100.0;
    attempt(desk, [&] { desk.session.set_emitter(e, scale, is_on); });
  }
  ImGui::PopID();
}

/// A slider and a patch of colour for one material.
void draw_material(Desk& desk, std::size_t m) {
  const Session& session = desk.session;
  const Eigen::VectorXd& now = session.mix().reflectance[m];
  const Eigen::VectorXd& original = session.original_mix().reflectance[m];
  ImGui::PushID(static_cast<int>(m));
  const Eigen::MatrixX3f color =
      display_colors(now.transpose(), session.model().bands).cwiseMax(0.F).cwiseMin(1.F);
  const auto shown = io::srgb_bytes(color.row(0), 1);
  ImGui::ColorButton("##color", ImVec4(shown[0] / 255.0F, shown[1] / 255.0F, shown[2] / 255.0F, 1),
                     ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoBorder,
                     ImVec2(ImGui::GetFontSize(), ImGui::GetFontSize()));
  ImGui::SameLine();
  ImGui::TextUnformatted(session.model().scene->materials[m].name.c_str());
  ImGui::SetNextItemWidth(-1);
  auto mean = static_cast<float>(now.mean());
  if (ImGui::SliderFloat("##reflectance", &mean, 0, 1, "mean reflectance %.3f",
                         ImGuiSliderFlags_AlwaysClamp)) {
    attempt(desk, [&] { desk.session.set_reflectance(m, with_mean_reflectance(original, mean)); });
  }
  ImGui::PopID();
}

}  // namespace

void draw_look_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Look& look = desk.look;
  choose_shown(desk);
  if (look.show == Show::true_color || look.show == Show::watched) {
    auto stops = static_cast<float>(look.stops);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 4 * ImGui::GetFontSize());
    if (ImGui::SliderFloat("##stops", &stops, -8, 8, "exposure %+.1f stops")) look.stops = stops;
    ImGui::SameLine();
    if (ImGui::Button("Auto")) {
      look.stops = 0;
      desk.is_exposure_due = true;
    }
  } else {
    if (is_banded(look) && desk.session.model().bands.count() > 1) choose_band(desk);
    choose_range(desk);
  }
  ImGui::Checkbox("smooth", &look.smooth);
  ImGui::SameLine();
  ImGui::Checkbox("edges", &look.edges);
  ImGui::SameLine();
  ImGui::Checkbox("hide backs", &look.hide_backs);
}

void draw_what_if_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("What if", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Session& session = desk.session;
  if (!session.model().scene) {
    ImGui::TextWrapped("Lamps and materials can be changed in scenes, not in result files.");
    return;
  }
  if (ImGui::Button("As in the file")) session.reset_mix();
  ImGui::TextDisabled("Lamps");
  for (std::size_t e = 0; e < session.mix().emitters.size(); ++e) draw_emitter(desk, e);
  ImGui::TextDisabled("Materials");
  for (std::size_t m = 0; m < session.mix().reflectance.size(); ++m) draw_material(desk, m);
}

}  // namespace viewer
