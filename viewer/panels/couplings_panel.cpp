#include "viewer/panels/couplings_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "viewer/desk/couplings.h"

namespace viewer {
namespace {

constexpr std::size_t kMostCouplings = 12;

void draw_table(const std::vector<Coupling>& all) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("couplings", 3, kFlags)) return;
  ImGui::TableSetupColumn("with", ImGuiTableColumnFlags_WidthStretch, 0.5F);
  ImGui::TableSetupColumn("GR, m²", ImGuiTableColumnFlags_WidthStretch, 0.3F);
  ImGui::TableSetupColumn("share B", ImGuiTableColumnFlags_WidthStretch, 0.25F);
  ImGui::TableHeadersRow();
  const std::size_t n = std::min(all.size(), kMostCouplings);
  for (std::size_t k = 0; k < n; ++k) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(all[k].name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(number_text(all[k].area).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted((number_text(100 * all[k].gebhart, 3) + " %").c_str());
  }
  ImGui::EndTable();
  if (all.size() > n) ImGui::TextDisabled("and %zu smaller ones", all.size() - n);
}

}  // namespace

void draw_couplings_panel(Desk& desk) {
  if (!desk.session.is_thermal()) return;
  bool is_wanted = desk.network.is_wanted();
  if (is_wanted) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
  if (!ImGui::CollapsingHeader("Couplings")) return;
  if (ImGui::Checkbox("find how surfaces exchange heat", &is_wanted)) {
    desk.network.set_wanted(is_wanted);
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(
        "GR_st = Σ ε_i A_i B_ij: surface s gains σ GR_st (T_t⁴ − T_s⁴) from t,\n"
        "reflections and all (Gebhart 1961).");
  }
  const auto surface = asked_surface(desk.session);
  if (!surface) {
    ImGui::TextWrapped("Click a surface: what it is coupled to, the largest first.");
    return;
  }
  const std::vector<std::string>& names = desk.session.model().mesh->surface_names;
  ImGui::TextUnformatted(names[*surface].c_str());
  if (const auto sunlight = absorbed_sunlight(desk.session.model().bands, desk.fluxes, *surface)) {
    ImGui::TextUnformatted(fmt::format("absorbs {} W of sunlight", number_text(*sunlight)).c_str());
  }
  if (!is_wanted) return;
  const std::vector<Coupling> all = couplings(desk.network.network(), names, *surface);
  if (!all.empty()) {
    draw_table(all);
  } else if (desk.network.network() != nullptr) {
    ImGui::TextDisabled("It emits nothing.");
  } else {
    ImGui::TextDisabled(
        "%s", desk.session.is_idle() && !desk.network.is_busy() ? "not known" : "being found");
  }
}

}  // namespace viewer
