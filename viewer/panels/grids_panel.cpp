#include "viewer/panels/grids_panel.h"

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

#include "viewer/desk/grids.h"
#include "viewer/panels/attempt.h"
#include "viewer/panels/inks.h"

namespace viewer {
namespace {

const ImVec4 kMetInk(0.45F, 0.9F, 0.5F, 1);

void draw_lines(const char* name, std::span<const GridLine> lines) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (lines.empty() || !ImGui::BeginTable(name, 3, kFlags)) return;
  // A long name is cut rather than what is told of it.
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  for (const GridLine& line : lines) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", line.what.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", line.what.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.value.c_str());
    ImGui::TableNextColumn();
    if (!line.is_met) continue;
    const std::string text = line.required + (*line.is_met ? " met" : " NOT MET");
    ImGui::TextColored(*line.is_met ? kMetInk : kErrorInk, "%s", text.c_str());
  }
  ImGui::EndTable();
}

/// Which of the things that the grid measures is shown, of which lamps.
void choose_quantity(Desk& desk, std::size_t grid) {
  GridChoice choice = desk.look.grid;
  const std::vector<std::string> names = grid_quantities(desk, grid);
  if (names.size() > 1) {
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##quantity", names[choice.quantity].c_str())) {
      for (std::size_t q = 0; q < names.size(); ++q) {
        ImGui::PushID(static_cast<int>(q));
        if (ImGui::Selectable(names[q].c_str(), q == choice.quantity)) choice.quantity = q;
        ImGui::PopID();
      }
      ImGui::EndCombo();
    }
  }
  const auto readings = desk.plan.readings();
  if (readings && readings->measured.has_maintenance) {
    if (ImGui::RadioButton("maintained", choice.is_maintained)) choice.is_maintained = true;
    ImGui::SameLine();
    if (ImGui::RadioButton("new lamps", !choice.is_maintained)) choice.is_maintained = false;
  }
  if (choice != desk.look.grid) attempt(desk, [&] { show_grid(desk, choice); });
}

void draw_grid(Desk& desk, std::size_t grid) {
  const bool is_shown = desk.look.show == Show::grid && desk.look.grid.grid == grid;
  const radiosity::GridPlan& plan = desk.session.model().scene->light_plan.grids[grid];
  ImGui::PushID(static_cast<int>(grid));
  if (ImGui::RadioButton(plan.name.c_str(), is_shown)) {
    attempt(desk, [&] {
      // What is required is required of maintained lamps.
      if (!is_shown) show_grid(desk, {.grid = grid, .is_maintained = true});
    });
  }
  if (is_shown) choose_quantity(desk, grid);
  GridChoice told = {.grid = grid, .is_maintained = true};
  if (is_shown) told = desk.look.grid;
  draw_lines("lines", grid_lines(desk, told));
  ImGui::PopID();
}

}  // namespace

void draw_grids_panel(Desk& desk) {
  if (!has_light_plan(desk.session)) return;
  if (!ImGui::CollapsingHeader("Grids", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const std::string note = grids_note(desk);
  if (!desk.plan.is_wanted()) {
    if (ImGui::Button("Measure them")) desk.plan.set_wanted(true);
  } else if (!note.empty()) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextColored(kDoubtInk, "%s", note.c_str());
    ImGui::PopTextWrapPos();
  }
  if (const std::string met = requirement_text(desk); !met.empty()) {
    ImGui::TextColored(are_requirements_met(desk) ? kMetInk : kErrorInk, "%s", met.c_str());
  }
  const std::size_t n = desk.session.model().scene->light_plan.grids.size();
  for (std::size_t grid = 0; grid < n; ++grid) draw_grid(desk, grid);
  if (desk.look.show == Show::grid) {
    ImGui::Checkbox("isolines##grid", &desk.look.isolines);
    ImGui::SameLine();
    ImGui::Checkbox("numbers##grid", &desk.look.numbers);
  }
  const std::vector<GridLine> observers = observer_lines(desk);
  if (observers.empty()) return;
  ImGui::TextDisabled("Glare (UGR)");
  draw_lines("observers", observers);
}

}  // namespace viewer
