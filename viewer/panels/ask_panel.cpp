#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

constexpr ImGuiTableFlags kTable =
    ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;

void row(const char* what, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what);
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", value.c_str());
}

void draw_light(const Desk& desk, const PatchFacts& facts) {
  const std::string unit = radiosity::band_unit("W/m²", desk.session.model().bands);
  row("radiosity B", numbers_text(facts.radiosity));
  row("± (2 σ)", facts.error.size() > 0 ? numbers_text(2 * facts.error) : "not known (yet)");
  row("irradiance H", numbers_text(facts.irradiance));
  if (facts.direct.size() > 0) {
    row("  direct", numbers_text(facts.direct));
    const Eigen::VectorXd indirect = (facts.irradiance - facts.direct).cwiseMax(0);
    row("  indirect", numbers_text(indirect));
  }
  row("emitted M", numbers_text(facts.exitance));
  row("net flux B − H", numbers_text(facts.radiosity - facts.irradiance));
  row("in", unit);
  row("reflectance ρ", numbers_text(facts.reflectance));
  row("illuminance", fmt::format("{:.4g} lux", facts.illuminance));
  row("luminance", fmt::format("{:.4g} cd/m²", facts.luminance));
}

void draw_patch(const Desk& desk, const PatchFacts& facts) {
  ImGui::Text("Patch %ld", static_cast<long>(facts.patch));
  if (!ImGui::BeginTable("facts", 2, kTable)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.36F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.64F);
  row("surface", facts.surface);
  if (!facts.material.empty()) row("material", facts.material);
  row("polygon", std::to_string(facts.polygon));
  row("area", fmt::format("{:.4g} m²", facts.area));
  row("centroid", fmt::format("{:.4g}  {:.4g}  {:.4g} m", facts.centroid[0], facts.centroid[1],
                              facts.centroid[2]));
  if (facts.has_light) draw_light(desk, facts);
  ImGui::EndTable();
}

void draw_factors(Desk& desk, const PatchFacts& facts) {
  bool is_shown = desk.look.show == Show::form_factors;
  if (ImGui::Checkbox("form factors over the scene", &is_shown)) {
    show(desk, is_shown ? "form-factors" : "true-colour");
  }
  if (!facts.has_factors) {
    ImGui::TextDisabled("not known (yet)");
    return;
  }
  ImGui::Text("row sum %.6f   unseen rest %.2g", facts.row_sum, 1 - facts.row_sum);
  if (!ImGui::BeginTable("partners", 4, kTable)) return;
  ImGui::TableSetupColumn("patch");
  ImGui::TableSetupColumn("surface");
  ImGui::TableSetupColumn("F");
  ImGui::TableSetupColumn("± σ");
  ImGui::TableHeadersRow();
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  std::optional<radiosity::Index> chosen;
  for (const Partner& partner : facts.partners) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const std::string label = std::to_string(partner.patch);
    if (ImGui::Selectable(label.c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
      chosen = partner.patch;
    }
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(mesh.surface_names[mesh.surface[partner.patch]].c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%.4g", partner.factor);
    ImGui::TableNextColumn();
    if (partner.error > 0) {
      ImGui::Text("%.1g", partner.error);
    } else {
      ImGui::TextDisabled("exact");
    }
  }
  ImGui::EndTable();
  if (chosen) desk.session.select(*chosen);
}

void draw_path(Desk& desk) {
  ImGui::Checkbox("where does the light come from?", &desk.asks_light_path);
  if (!desk.asks_light_path) return;
  bool is_shown = desk.look.show == Show::light_path;
  if (ImGui::Checkbox("light path over the scene", &is_shown)) {
    show(desk, is_shown ? "light-path" : "true-colour");
  }
  if (desk.emitter_shares.empty()) {
    ImGui::TextDisabled("not known (yet)");
    return;
  }
  if (!ImGui::BeginTable("shares", 3, kTable)) return;
  ImGui::TableSetupColumn("lamp");
  ImGui::TableSetupColumn("share");
  ImGui::TableSetupColumn("of B, W/m²");
  ImGui::TableHeadersRow();
  for (const EmitterShare& share : desk.emitter_shares) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(desk.session.mix().emitters[share.emitter].name.c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%.1f %%", 100 * share.share);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(numbers_text(share.radiosity).c_str());
  }
  ImGui::EndTable();
}

struct Key {
  const char* key;
  const char* effect;
};

constexpr Key kKeys[] = {{"left drag", "turn the scene"},
                         {"middle drag, Shift + left drag", "shift the scene"},
                         {"right drag", "look around"},
                         {"wheel", "nearer, further"},
                         {"W A S D, Q E", "walk, down and up (Shift: faster)"},
                         {"click", "ask a patch"},
                         {"Esc", "ask no patch"},
                         {"F", "fit the scene"},
                         {"C", "the scene's camera"},
                         {"T", "true colour"},
                         {"I", "illuminance, lux"},
                         {"R", "error of radiosity"},
                         {"X", "form factors of the patch"},
                         {"L", "light path of the patch"},
                         {"G", "logarithmic scale"},
                         {"M", "smooth or flat patches"},
                         {"N", "patch edges"},
                         {"B", "hide or show backs"},
                         {"+ −", "exposure"},
                         {"Space", "pause, go on"},
                         {"Tab", "hide or show the panels"},
                         {"Ctrl+O", "open a file (or drop it here)"},
                         {"Ctrl+P", "save the picture"},
                         {"?", "this help"}};

}  // namespace

void draw_ask_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("Ask", ImGuiTreeNodeFlags_DefaultOpen)) return;
  if (!desk.facts) {
    ImGui::TextWrapped("Click a patch: its numbers, what it sees, and where its light comes from.");
    return;
  }
  const PatchFacts facts = *desk.facts;  // a partner that is clicked changes it
  draw_patch(desk, facts);
  draw_factors(desk, facts);
  draw_path(desk);
}

void draw_help(Desk& desk, double scale) {
  const auto size = static_cast<float>(scale);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(screen.x / 2, screen.y / 2), ImGuiCond_Appearing,
                          ImVec2(0.5F, 0.5F));
  ImGui::SetNextWindowSize(ImVec2(460 * size, 0));
  if (ImGui::Begin("Keys and mouse", &desk.shows_help, ImGuiWindowFlags_NoCollapse)) {
    if (ImGui::BeginTable("keys", 2, kTable)) {
      for (const Key& key : kKeys) row(key.key, key.effect);
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace viewer
