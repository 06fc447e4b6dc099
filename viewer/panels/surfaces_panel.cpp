#include "viewer/panels/surfaces_panel.h"

#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "viewer/desk/desk_surfaces.h"
#include "viewer/desk/luminaires.h"
#include "viewer/panels/inks.h"
#include "viewer/panels/mix_widgets.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

constexpr int kMostRows = 12;         // that are seen at once
constexpr std::size_t kFewRows = 60;  // with which all groups are open at first

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

/// In a tree names and sliders need the room of the last one.
void draw_values(const Desk& desk, const SurfaceTotal& total, bool is_tree) {
  const bool is_rough = standing(desk.session).is_rough;
  draw_value(total.area > 0 ? std::optional(total.area) : std::nullopt, false);
  draw_value(total.flux, is_rough);
  if (is_tree) return;
  draw_value(desk.session.is_thermal() ? total.heat : total.irradiance, is_rough);
  if (desk.session.is_thermal()) draw_temperature(total.temperature);
}

/// Shows or hides surfaces; half checked if some of them are hidden.
void draw_shown_box(Desk& desk, std::span<const std::int32_t> surfaces) {
  constexpr int kAll = 3;
  const auto n_hidden = std::count_if(surfaces.begin(), surfaces.end(), [&](std::int32_t surface) {
    return desk.look.hidden.contains(surface);
  });
  const auto n = static_cast<std::ptrdiff_t>(surfaces.size());
  int flags = n_hidden == 0 ? kAll : n_hidden == n ? 0 : 1;
  if (ImGui::CheckboxFlags("##shown", &flags, kAll)) set_shown(desk, surfaces, flags == kAll);
}

bool is_marked(const Desk& desk, std::span<const std::int32_t> surfaces) {
  return std::equal(surfaces.begin(), surfaces.end(), desk.marks.surfaces().begin(),
                    desk.marks.surfaces().end());
}

/// Outlines what was clicked, or what was outlined no more.
void toggle_mark(Desk& desk, std::span<const std::int32_t> surfaces) {
  const bool was_marked = is_marked(desk, surfaces);
  mark_surfaces(desk, was_marked ? std::span<const std::int32_t>() : surfaces);
}

/// With the flux of luminaires.
std::vector<SurfaceGroup> lamps_of(const Desk& desk) {
  std::vector<SurfaceGroup> groups = lamp_groups(desk.session.mix());
  for (SurfaceGroup& group : groups) group.lumens = emitter_lumens(desk, group.index);
  return groups;
}

void draw_buttons(Desk& desk) {
  const auto draw_choice = [&](const char* label, SurfaceListing listing) {
    if (ImGui::RadioButton(label, desk.listing == listing)) desk.listing = listing;
  };
  draw_choice("all", SurfaceListing::surfaces);
  ImGui::BeginDisabled(desk.session.model().scene == nullptr);
  ImGui::SameLine();
  draw_choice("by material", SurfaceListing::materials);
  ImGui::SameLine();
  draw_choice(desk.session.is_thermal() ? "sources" : "lamps", SurfaceListing::lamps);
  ImGui::EndDisabled();
  ImGui::BeginDisabled(desk.marks.surfaces().empty());
  const bool is_one = desk.marks.surfaces().size() < 2;
  if (ImGui::Button(is_one ? "Show it alone" : "Show them alone")) {
    isolate(desk, desk.marks.surfaces());
  }
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(desk.look.hidden.is_empty());
  if (ImGui::Button("Show all")) desk.look.hidden = {};
  ImGui::EndDisabled();
}

}  // namespace

void SurfacesPanel::draw_row(Desk& desk, const SurfaceTotal& total, bool is_inner) {
  const std::span<const std::int32_t> surface(&total.surface, 1);
  ImGui::PushID(total.surface);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  draw_shown_box(desk, surface);
  ImGui::TableNextColumn();
  const bool is_among = desk.marks.contains(total.surface);
  // As far to the right as names of groups are.
  if (is_inner) ImGui::Indent(ImGui::GetTreeNodeToLabelSpacing());
  if (ImGui::Selectable(total.name.c_str(), is_among)) toggle_mark(desk, surface);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s\n%s\n%ld patches", total.name.c_str(), total.material.c_str(),
                      static_cast<long>(total.n_patches));
  }
  if (is_inner) ImGui::Unindent(ImGui::GetTreeNodeToLabelSpacing());
  if (is_mark_new_ && is_marked(desk, surface)) ImGui::SetScrollHereY();
  draw_values(desk, total, is_inner);
  ImGui::PopID();
}

void SurfacesPanel::draw_group(Desk& desk, const SurfaceGroup& group,
                               const std::vector<SurfaceTotal>& totals) {
  const bool is_material = desk.listing == SurfaceListing::materials;
  ImGui::PushID(static_cast<int>(group.index));
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (!group.surfaces.empty()) draw_shown_box(desk, group.surfaces);
  ImGui::TableNextColumn();
  const bool holds_mark = is_mark_new_ && desk.marks.surfaces().size() == 1 &&
                          std::binary_search(group.surfaces.begin(), group.surfaces.end(),
                                             desk.marks.surfaces().front());
  if (holds_mark) ImGui::SetNextItemOpen(true);
  // What is inside is indented in its own column only.
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  if (totals.size() <= kFewRows) flags |= ImGuiTreeNodeFlags_DefaultOpen;
  if (group.surfaces.size() > 1 && is_marked(desk, group.surfaces)) {
    flags |= ImGuiTreeNodeFlags_Selected;
  }
  const bool is_open = ImGui::TreeNodeEx("##group", flags, "%s", group.name.c_str());
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) {
    if (group.lumens) {
      choose_luminaire(desk, first_luminaire(desk, group.index));
    } else {
      toggle_mark(desk, group.surfaces);
    }
  }
  draw_values(desk, group_total(group, totals), true);
  if (is_open) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (is_material) {
      draw_material_color(desk, group.index);
    } else {
      draw_emitter_switch(desk, group.index);
    }
    ImGui::TableNextColumn();
    ImGui::Indent(ImGui::GetTreeNodeToLabelSpacing());
    if (is_material) {
      draw_material_slider(desk, group.index);
    } else {
      draw_emitter_slider(desk, group.index);
    }
    ImGui::Unindent(ImGui::GetTreeNodeToLabelSpacing());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(
        (is_material ? material_text(desk, group.index) : emitter_text(desk, group.index)).c_str());
    for (const SurfaceTotal& total : totals) {
      const bool is_inside =
          std::binary_search(group.surfaces.begin(), group.surfaces.end(), total.surface);
      if (is_inside) draw_row(desk, total, true);
    }
  }
  ImGui::PopID();
}

void SurfacesPanel::draw_table(Desk& desk) {
  const bool is_thermal = desk.session.is_thermal();
  const std::vector<SurfaceTotal>& totals = sorted_totals(desk);
  const bool is_list =
      desk.listing == SurfaceListing::surfaces || desk.session.model().scene == nullptr;
  const std::vector<SurfaceGroup> groups = is_list ? std::vector<SurfaceGroup>()
                                           : desk.listing == SurfaceListing::materials
                                               ? material_groups(*desk.session.model().scene)
                                               : lamps_of(desk);
  const std::size_t n_wanted = is_list ? totals.size() : 2 * groups.size() + totals.size();
  const auto n_rows = static_cast<float>(std::min<std::size_t>(n_wanted, kMostRows));
  const float row = ImGui::GetFrameHeightWithSpacing();
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable;
  const ImVec2 size(0, (n_rows + 1.2F) * row);
  const char* name = !is_list ? "tree" : is_thermal ? "hot list" : "list";
  if (!ImGui::BeginTable(name, !is_list ? 4 : is_thermal ? 6 : 5, kFlags, size)) return;
  const float width = ImGui::GetFontSize();
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("##shown", ImGuiTableColumnFlags_NoSort, 1.4F * width);
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("m²", ImGuiTableColumnFlags_PreferSortDescending, 3.4F * width);
  ImGui::TableSetupColumn(is_thermal ? "W" : "lm", ImGuiTableColumnFlags_PreferSortDescending,
                          3.2F * width);
  if (is_list) {
    ImGui::TableSetupColumn(is_thermal ? "net W" : "lux",
                            ImGuiTableColumnFlags_PreferSortDescending, 3.4F * width);
  }
  if (is_list && is_thermal) {
    ImGui::TableSetupColumn("K", ImGuiTableColumnFlags_PreferSortDescending, 2.4F * width);
  }
  ImGui::TableHeadersRow();
  take_order(desk.surface_order, is_thermal);
  if (is_list) {
    for (const SurfaceTotal& total : totals) draw_row(desk, total, false);
  }
  for (const SurfaceGroup& group : groups) {
    if (!group.surfaces.empty() || group.lumens) draw_group(desk, group, totals);
  }
  ImGui::EndTable();
}

void SurfacesPanel::draw(Desk& desk) {
  ImGui::SetNextItemOpen(desk.is_list_open);
  desk.is_list_open = ImGui::CollapsingHeader("Surfaces");
  is_mark_new_ = marked_ != desk.marks.surfaces();
  marked_ = desk.marks.surfaces();
  if (!desk.is_list_open) return;
  if (!desk.session.is_open()) {
    ImGui::TextDisabled("none");
    return;
  }
  draw_buttons(desk);
  draw_table(desk);
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", desk.listing != SurfaceListing::surfaces ? "Σ A B of what leaves."
                            : desk.session.is_thermal()
                                ? "Σ A B of what leaves, net heat Σ A (B − H)."
                                : "Σ A B of what leaves, mean of what arrives.");
  if (!desk.look.hidden.is_empty()) {
    ImGui::TextDisabled("Hidden surfaces take part in the light all the same.");
  }
  ImGui::PopTextWrapPos();
}

}  // namespace viewer
