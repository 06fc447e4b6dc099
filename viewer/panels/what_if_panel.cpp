#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "viewer/desk/luminaires.h"
#include "viewer/panels/mix_widgets.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

/// A name that chooses the luminaire which it is of, and tells more about it.
void draw_luminaire_name(Desk& desk, std::size_t e, float width) {
  const auto luminaire = first_luminaire(desk, e);
  const std::string& name = desk.session.mix().emitters[e].name;
  if (!luminaire || *luminaire >= desk.luminaires.size()) {
    ImGui::TextUnformatted(name.c_str());
    return;
  }
  const bool is_chosen = desk.chosen_luminaire == luminaire;
  if (ImGui::Selectable(name.c_str(), is_chosen, 0, ImVec2(width, 0))) {
    choose_luminaire(desk, is_chosen ? std::nullopt : luminaire);
  }
  if (!ImGui::IsItemHovered()) return;
  const std::size_t n = desk.session.mix().emitters[e].luminaires.size();
  const std::string more = n > 1 ? fmt::format("\nand {} more", n - 1) : "";
  ImGui::SetTooltip(
      "%s", (luminaire_text(desk.luminaires[*luminaire], desk.session.mix()) + more).c_str());
}

/// A line of a name, cut if it is too long, and at its end a value.
template <typename DrawName>
void draw_label(const DrawName& draw_name, const std::string& value) {
  const float value_width = ImGui::CalcTextSize(value.c_str()).x;
  const ImVec2 place = ImGui::GetCursorScreenPos();
  const float right = place.x + ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::PushClipRect(place, ImVec2(right - value_width - gap, place.y + ImGui::GetFrameHeight()),
                      true);
  draw_name(right - value_width - gap - place.x);
  ImGui::PopClipRect();
  ImGui::SameLine();
  ImGui::SetCursorScreenPos(ImVec2(right - value_width, ImGui::GetCursorScreenPos().y));
  ImGui::TextUnformatted(value.c_str());
}

void draw_emitter(Desk& desk, std::size_t e) {
  ImGui::PushID(static_cast<int>(e));
  draw_emitter_switch(desk, e);
  ImGui::SameLine();
  const auto lumens = emitter_lumens(desk, e);
  const std::string flux = lumens ? lumens_text(*lumens) + ", " : "";
  const bool is_off = lumens && !desk.session.mix().emitters[e].is_on;
  draw_label([&](float width) { draw_luminaire_name(desk, e, width); },
             is_off ? "off" : flux + emitter_text(desk, e));
  draw_emitter_slider(desk, e);
  ImGui::PopID();
}

void draw_material(Desk& desk, std::size_t m) {
  ImGui::PushID(static_cast<int>(m));
  draw_material_color(desk, m);
  ImGui::SameLine();
  const std::string& name = desk.session.model().scene->materials[m].name;
  draw_label([&](float) { ImGui::TextUnformatted(name.c_str()); }, material_text(desk, m));
  draw_material_slider(desk, m);
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
