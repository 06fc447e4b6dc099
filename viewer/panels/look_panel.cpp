#include <imgui.h>

#include <string>

#include "viewer/desk/show_info.h"
#include "viewer/desk/shown_scale.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

using radiosity::Index;

/// What a range that fits may span.
constexpr io::ScaleChoice kFits[] = {{.low_percent = 0, .high_percent = 98},
                                     {.low_percent = 0, .high_percent = 100},
                                     {.low_percent = 1, .high_percent = 99},
                                     {.low_percent = 2, .high_percent = 98}};

bool is_banded(const Look& look) {
  if (look.show == Show::quantity) return !radiosity::quantity_info(look.quantity).is_photometric;
  return look.show == Show::direct || look.show == Show::indirect || look.show == Show::unshot ||
         look.show == Show::arriving || look.show == Show::light_path;
}

/// Tells the definition of what is under the mouse.
void draw_definition(const ShowInfo& info) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
  ImGui::TextUnformatted(info.definition.data(), info.definition.data() + info.definition.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void choose_shown(Desk& desk) {
  const radiosity::Bands& bands = desk.session.model().bands;
  const ShowInfo& now = show_info(show_name(desk.look));
  ImGui::SetNextItemWidth(-1);
  // The colour bar tells the unit, too.
  std::string caption = caption_with_unit(now, bands);
  const float room = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetFrameHeight();
  if (ImGui::CalcTextSize(caption.c_str()).x > room) caption = now.caption;
  const bool is_open = ImGui::BeginCombo("##show", caption.c_str(), ImGuiComboFlags_HeightLargest);
  if (!is_open) {
    draw_definition(now);
    return;
  }
  for (const std::string_view group : show_groups()) {
    bool is_named = false;
    for (const ShowName& name : show_names()) {
      const ShowInfo& info = show_info(name.name);
      if (info.group != group || !is_offered(name, desk.session)) continue;
      if (!is_named) ImGui::TextDisabled("%s", std::string(group).c_str());
      is_named = true;
      const std::string label = "  " + caption_with_unit(info, bands);
      if (ImGui::Selectable(label.c_str(), info.name == now.name)) {
        show(desk, std::string(name.name));
      }
      draw_definition(info);
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

void choose_map(Look& look) {
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
  if (!ImGui::BeginCombo("colours", std::string(io::color_map_name(look.map)).c_str())) return;
  for (const io::ColorMap map : io::color_maps()) {
    const std::string name(io::color_map_name(map));
    if (ImGui::Selectable(name.c_str(), map == look.map)) look.map = map;
  }
  ImGui::EndCombo();
}

/// What the bar spans.
void choose_fit(Desk& desk) {
  Look& look = desk.look;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##fit", ("range: " + fit_text(look)).c_str())) return;
  for (const io::ScaleChoice& fit : kFits) {
    Look other = look;
    other.range.reset();
    other.fit = fit;
    const std::string text = fit_text(other);
    if (ImGui::Selectable(text.c_str(), text == fit_text(look))) look = other;
  }
  if (ImGui::Selectable("as given", look.range.has_value()) && desk.legend) {
    look.range = desk.legend->scale;
  }
  ImGui::EndCombo();
}

/// How far apart the labelled values and isolines are.
void choose_spacing(Look& look) {
  double spacing = look.tick_spacing.value_or(0);
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
  ImGui::BeginDisabled(look.logarithmic);
  const bool is_given =
      ImGui::InputDouble("step of values", &spacing, 0, 0, spacing > 0 ? "%.6g" : "auto",
                         ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Between labelled values and isolines; 0: by itself. Enter takes it.");
  }
  ImGui::EndDisabled();
  if (!is_given) return;
  look.tick_spacing = spacing > 0 ? std::optional(spacing) : std::nullopt;
}

void choose_range(Desk& desk) {
  Look& look = desk.look;
  ImGui::Checkbox("logarithmic", &look.logarithmic);
  const std::string note = desk.legend ? scale_note(look, desk.legend->scale) : "";
  if (!note.empty() && note != "logarithmic") {
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", note.c_str());
    ImGui::PopTextWrapPos();
  }
  choose_fit(desk);
  choose_spacing(look);
  if (!look.range) return;
  // As it is shown: a logarithm has no 0.
  const io::ColorScale& shown = desk.legend ? desk.legend->scale : *look.range;
  double low = shown.low;
  double high = shown.high;
  const float width = ImGui::GetFontSize() * 6;
  ImGui::SetNextItemWidth(width);
  bool has_changed = ImGui::InputDouble("##low", &low, 0, 0, "%.6g");
  ImGui::SameLine();
  ImGui::TextUnformatted("to");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(width);
  has_changed |= ImGui::InputDouble("##high", &high, 0, 0, "%.6g");
  if (has_changed && low < high) look.range = io::ColorScale{.low = low, .high = high};
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
    choose_map(look);
    choose_range(desk);
    ImGui::BeginDisabled(!is_smooth(look));
    ImGui::Checkbox("isolines", &look.isolines);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(is_plane(look.show));
    ImGui::Checkbox("outlines", &look.outlines);
    ImGui::EndDisabled();
  }
  ImGui::Checkbox("smooth", &look.smooth);
  ImGui::SameLine();
  ImGui::Checkbox("edges", &look.edges);
  ImGui::Checkbox("hide backs", &look.hide_backs);
}

}  // namespace viewer
