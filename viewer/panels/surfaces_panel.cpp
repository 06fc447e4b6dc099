#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "viewer/desk/desk_surfaces.h"
#include "viewer/panels/inks.h"
#include "viewer/panels/panels.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

constexpr int kMostRows = 12;  // that are seen at once

void take_order(TotalOrder& order, bool is_thermal) {
  ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs == nullptr || !specs->SpecsDirty || specs->SpecsCount == 0) return;
  specs->SpecsDirty = false;
  const TotalColumn last = is_thermal ? TotalColumn::heat : TotalColumn::irradiance;
  constexpr TotalColumn kNone = TotalColumn::name;
  const TotalColumn columns[] = {
      kNone, TotalColumn::name,       TotalColumn::area, TotalColumn::flux,
      last,  TotalColumn::temperature};
  order.column = columns[specs->Specs[0].ColumnIndex];
  order.is_falling = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
}

void draw_value(const std::optional<double>& value, bool is_rough) {
  ImGui::TableNextColumn();
  if (!value) return;
  ImGui::PushStyleColor(ImGuiCol_Text, is_rough ? kDoubtInk : kPlainInk);
  ImGui::TextUnformatted(number_text(*value, is_rough ? kRoughDigits : 3).c_str());
  ImGui::PopStyleColor();
}

void draw_temperature(const std::optional<double>& temperature) {
  ImGui::TableNextColumn();
  if (!temperature) return;
  ImGui::Text("%.0f", *temperature);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", temperature_text(*temperature).c_str());
}

void draw_row(Desk& desk, const SurfaceTotal& total, bool is_rough) {
  ImGui::PushID(total.surface);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  bool is_shown = !desk.look.hidden.contains(total.surface);
  if (ImGui::Checkbox("##shown", &is_shown)) set_shown(desk, total.surface, is_shown);
  ImGui::TableNextColumn();
  const bool is_marked = desk.marked_surface == total.surface;
  if (ImGui::Selectable(total.name.c_str(), is_marked)) {
    mark_surface(desk, is_marked ? std::nullopt : std::optional(total.surface));
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s\n%s\n%ld patches", total.name.c_str(), total.material.c_str(),
                      static_cast<long>(total.n_patches));
  }
  draw_value(total.area, false);
  draw_value(total.flux, is_rough);
  draw_value(desk.session.is_thermal() ? total.heat : total.irradiance, is_rough);
  if (desk.session.is_thermal()) draw_temperature(total.temperature);
  ImGui::PopID();
}

void draw_table(Desk& desk) {
  const bool is_thermal = desk.session.is_thermal();
  const std::vector<SurfaceTotal>& totals = sorted_totals(desk);
  const auto n_rows = static_cast<float>(std::min<std::size_t>(totals.size(), kMostRows));
  const float row = ImGui::GetFrameHeightWithSpacing();
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable;
  if (!ImGui::BeginTable(is_thermal ? "hot surfaces" : "surfaces", is_thermal ? 6 : 5, kFlags,
                         ImVec2(0, (n_rows + 1.2F) * row)))
    return;
  const float width = ImGui::GetFontSize();
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("##shown", ImGuiTableColumnFlags_NoSort, 1.4F * width);
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("m²", ImGuiTableColumnFlags_PreferSortDescending, 3.2F * width);
  ImGui::TableSetupColumn(is_thermal ? "W" : "lm", ImGuiTableColumnFlags_PreferSortDescending,
                          3.2F * width);
  ImGui::TableSetupColumn(is_thermal ? "net W" : "lux", ImGuiTableColumnFlags_PreferSortDescending,
                          3.4F * width);
  if (is_thermal) {
    ImGui::TableSetupColumn("K", ImGuiTableColumnFlags_PreferSortDescending, 2.4F * width);
  }
  ImGui::TableHeadersRow();
  take_order(desk.surface_order, is_thermal);
  const bool is_rough = standing(desk.session).is_rough;
  for (const SurfaceTotal& total : totals) draw_row(desk, total, is_rough);
  ImGui::EndTable();
}

}  // namespace

void draw_surfaces_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("Surfaces")) return;
  if (!desk.session.is_open()) {
    ImGui::TextDisabled("none");
    return;
  }
  ImGui::BeginDisabled(!desk.marked_surface);
  if (ImGui::Button("Show it alone") && desk.marked_surface) isolate(desk, *desk.marked_surface);
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(desk.look.hidden.is_empty());
  if (ImGui::Button("Show all")) desk.look.hidden = {};
  ImGui::EndDisabled();
  draw_table(desk);
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", desk.session.is_thermal()
                                ? "Σ A B of what leaves, net heat Σ A (B − H)."
                                : "Σ A B of what leaves, mean of what arrives.");
  if (!desk.look.hidden.is_empty()) {
    ImGui::TextDisabled("Hidden surfaces take part in the light all the same.");
  }
  ImGui::PopTextWrapPos();
}

}  // namespace viewer
