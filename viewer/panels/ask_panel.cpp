#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/pinning.h"
#include "viewer/desk/surface_totals.h"
#include "viewer/panels/inks.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/spectrum_plot.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

constexpr std::size_t kMostArrivals = 8;
constexpr radiosity::Index kMostListed = 4;  // bands whose values stand side by side
constexpr ImGuiTableFlags kTable =
    ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH;

void row(const char* what, const std::string& value, const ImVec4& ink = kPlainInk) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what);
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, ink);
  ImGui::TextWrapped("%s", value.c_str());
  ImGui::PopStyleColor();
}

/// "412.3 lux, now −12 %".
std::string pinned_lux_text(const Desk& desk, const PatchFacts& facts,
                            const Eigen::VectorXd& irradiance) {
  const double before = radiosity::luminous_weights(desk.session.model().bands).dot(irradiance);
  const std::string text = number_text(before) + " lux";
  if (!(before > 0)) return text;
  return text + fmt::format(", now {:+.1f} %", 100 * (facts.illuminance / before - 1));
}

/// "W/m²: red, green, blue".
std::string units_text(const radiosity::Bands& bands) {
  std::string text = radiosity::band_unit("W/m²", bands);
  if (bands.count() == 1 || bands.count() > kMostListed) return text;
  const char* separator = ": ";
  for (const std::string& name : radiosity::band_names(bands)) {
    text += std::exchange(separator, ", ") + name;
  }
  return text;
}

/// Of a preview two digits, in a colour of their own.
void draw_light(const Desk& desk, const PatchFacts& facts) {
  const Session& session = desk.session;
  const Standing now = standing(session);
  const auto value = [&](const char* what, const std::string& text) {
    row(what, text, now.is_rough ? kDoubtInk : kPlainInk);
  };
  const auto values = [&](const char* what, const Eigen::VectorXd& numbers) {
    value(what, numbers_text(numbers, now.is_rough));
  };
  values("radiosity B", facts.radiosity);
  const char* unknown = session.is_settled() ? "not known" : "not known yet";
  row("± (2 σ)", facts.error.size() > 0 ? errors_text(2 * facts.error) : unknown);
  values("irradiance H", facts.irradiance);
  const auto pinned = pinned_irradiance(desk);
  if (pinned) row("  pinned", numbers_text(*pinned));
  if (facts.direct.size() > 0) {
    values("  direct", facts.direct);
    values("  indirect", (facts.irradiance - facts.direct).cwiseMax(0));
  }
  values("emitted M", facts.exitance);
  values("net flux B − H", facts.radiosity - facts.irradiance);
  row("in", units_text(session.model().bands));
  row("reflectance ρ", numbers_text(facts.reflectance));
  if (session.is_thermal()) return;
  const std::string mark = now.is_rough ? "≈ " : "";
  const int digits = now.is_rough ? kRoughDigits : kDigits;
  value("illuminance", mark + number_text(facts.illuminance, digits) + " lux");
  if (pinned) row("  pinned", pinned_lux_text(desk, facts, *pinned));
  value("luminance", mark + number_text(facts.luminance, digits) + " cd/m²");
}

/// The same at a step of a recorded iteration, and how much of the solution that is.
void draw_step_light(const Desk& desk, const PatchFacts& facts, const StepFacts& step) {
  row("B so far", numbers_text(step.radiosity));
  const double whole = facts.has_light ? facts.radiosity.sum() : 0;
  if (whole > 0 && !desk.session.is_iteration_stale()) {
    row("of the solution", number_text(100 * step.radiosity.sum() / whole, 3) + " %");
  }
  row("unshot", numbers_text(step.unshot));
  row("in", radiosity::band_unit("W/m²", desk.session.model().bands));
}

void draw_patch(const Desk& desk, const PatchFacts& facts) {
  ImGui::Text("Patch %ld", static_cast<long>(facts.patch));
  const Standing now = standing(desk.session);
  const std::string watched = watched_text(desk.session, desk.look);
  ImGui::PushTextWrapPos(0);
  if (!watched.empty()) {
    ImGui::TextColored(kDoubtInk, "%s", watched.c_str());
  } else if (facts.has_light) {
    ImGui::TextColored(now.is_result ? kPlainInk : kDoubtInk, "%s", now.text.c_str());
  }
  ImGui::PopTextWrapPos();
  if (!ImGui::BeginTable("facts", 2, kTable)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.33F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.67F);
  row("surface", facts.surface);
  if (!facts.material.empty()) row("material", facts.material);
  if (facts.temperature) row("temperature", temperature_text(*facts.temperature));
  row("polygon", std::to_string(facts.polygon));
  row("area", number_text(facts.area) + " m²");
  row("centroid", fmt::format("{}  {}  {} m", number_text(facts.centroid[0]),
                              number_text(facts.centroid[1]), number_text(facts.centroid[2])));
  const auto step = step_facts(desk.session, desk.look);
  if (step) {
    draw_step_light(desk, facts, *step);
  } else if (facts.has_light) {
    draw_light(desk, facts);
  }
  ImGui::EndTable();
  const radiosity::Bands& bands = desk.session.model().bands;
  if (!step && facts.has_light && bands.wavelengths.size() > 1) {
    draw_spectrum_plot(facts, bands);
  }
}

void draw_factors(Desk& desk, const PatchFacts& facts) {
  bool is_shown = desk.look.show == Show::form_factors;
  if (ImGui::Checkbox("form factors over the scene", &is_shown)) {
    show(desk, is_shown ? "form-factors" : first_quantity(desk.domain));
  }
  if (!facts.has_factors) {
    const bool is_found = desk.session.is_settled() && !desk.session.model().factors;
    ImGui::TextDisabled("%s", is_found ? "not known" : "not known yet");
    return;
  }
  ImGui::Text("row sum %.6f   unseen rest %.2g", facts.row_sum, 1 - facts.row_sum);
  if (!ImGui::BeginTable("partners", 4, kTable)) return;
  // Widths that do not wait for the first frame's contents.
  const float width = ImGui::GetFontSize();
  ImGui::TableSetupColumn("patch", ImGuiTableColumnFlags_WidthFixed, 3.5F * width);
  ImGui::TableSetupColumn("surface", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("F", ImGuiTableColumnFlags_WidthFixed, 5 * width);
  ImGui::TableSetupColumn("± σ", ImGuiTableColumnFlags_WidthFixed, 3.5F * width);
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

/// A table of who sends how much.
bool begin_shares(const char* name, const char* who, const char* what) {
  if (!ImGui::BeginTable(name, 3, kTable)) return false;
  ImGui::TableSetupColumn(who, ImGuiTableColumnFlags_WidthStretch);
  const float width = ImGui::GetFontSize();
  ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthFixed, 3.8F * width);
  ImGui::TableSetupColumn(what, ImGuiTableColumnFlags_WidthFixed, 5 * width);
  ImGui::TableHeadersRow();
  return true;
}

void share_row(const std::string& who, double share, const std::string& value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(who.c_str());
  ImGui::TableNextColumn();
  ImGui::Text("%.1f %%", 100 * share);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(value.c_str());
}

std::string mean_text(const Desk& desk, const Eigen::VectorXd& values) {
  const auto& wavelengths = desk.session.model().bands.wavelengths;
  return number_text(radiosity::mean_over_bands(values.transpose(), wavelengths)[0], 3);
}

/// The surfaces that the light arrives from, whoever emitted it.
void draw_arrivals(Desk& desk, const PatchFacts& facts) {
  bool is_shown = desk.look.show == Show::arriving;
  if (ImGui::Checkbox("light sent here, over the scene", &is_shown)) {
    show(desk, is_shown ? "arriving" : first_quantity(desk.domain));
  }
  if (!facts.is_summed) {
    ImGui::TextDisabled("not known yet");
    return;
  }
  if (facts.arrivals.empty()) {
    ImGui::TextDisabled("no light from any surface");
    return;
  }
  if (!begin_shares("arrivals", "comes from", "H, W/m²")) return;
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  const std::size_t n = std::min(kMostArrivals, facts.arrivals.size());
  for (std::size_t k = 0; k < n; ++k) {
    const Arrival& arrival = facts.arrivals[k];
    share_row(mesh.surface_names[arrival.surface], arrival.share,
              mean_text(desk, arrival.irradiance));
  }
  if (n < facts.arrivals.size()) {
    double rest = 1;
    for (std::size_t k = 0; k < n; ++k) rest -= facts.arrivals[k].share;
    share_row(fmt::format("{} others", facts.arrivals.size() - n), std::max(0.0, rest), "");
  }
  ImGui::EndTable();
}

/// The lamps that emitted it, by whatever reflections.
void draw_path(Desk& desk) {
  const bool is_thermal = desk.session.is_thermal();
  ImGui::Checkbox(is_thermal ? "shares of the sources" : "shares of the lamps",
                  &desk.asks_light_path);
  if (!desk.asks_light_path) return;
  bool is_shown = desk.look.show == Show::light_path;
  if (ImGui::Checkbox("importance over the scene", &is_shown)) {
    show(desk, is_shown ? "light-path" : first_quantity(desk.domain));
  }
  if (desk.emitter_shares.empty()) {
    ImGui::TextDisabled("%s", desk.session.is_idle() ? "not known" : "not known yet");
    return;
  }
  if (!begin_shares("shares", is_thermal ? "source" : "lamp", "B, W/m²")) return;
  for (const EmitterShare& share : desk.emitter_shares) {
    share_row(desk.session.mix().emitters[share.emitter].name, share.share,
              mean_text(desk, share.radiosity));
  }
  ImGui::EndTable();
}

/// The tape measure, and what it reads.
void draw_tape(Desk& desk) {
  Tape& tape = desk.tape;
  bool is_in_hand = tape.is_in_hand;
  if (ImGui::Checkbox("tape measure", &is_in_hand)) take_tape(desk, is_in_hand);
  if (tape.is_in_hand && !tape.to) {
    ImGui::TextDisabled("%s", tape.from ? "click the other end" : "click two points");
  }
  const auto difference = tape.difference();
  if (!difference || !ImGui::BeginTable("tape", 2, kTable)) return;
  row("distance", number_text(difference->norm()) + " m");
  row("dx, dy, dz", fmt::format("{}  {}  {} m", number_text(difference->x()),
                                number_text(difference->y()), number_text(difference->z())));
  ImGui::EndTable();
}

struct Key {
  const char* key;
  const char* effect;
};

constexpr Key kKeys[] = {{"left drag", "turn about the point under the mouse"},
                         {"middle drag, Shift + left drag", "shift the scene"},
                         {"right drag", "look around"},
                         {"wheel", "nearer to what is under the mouse, further"},
                         {"W A S D, Q E", "walk, down and up (Shift: faster)"},
                         {"click", "ask a patch"},
                         {"K", "tape measure: click two points"},
                         {"Esc", "put it or the light meter away; ask no patch"},
                         {"F", "fit the scene"},
                         {"C", "the scene's camera"},
                         {"Z", "turn: y or z is up"},
                         {"T", "true colour"},
                         {"I", "illuminance, lux"},
                         {"R", "error of radiosity"},
                         {"X", "form factors of the patch"},
                         {"L", "light sent to the patch"},
                         {"G", "logarithmic scale"},
                         {"M", "smooth or flat patches"},
                         {"N", "patch edges"},
                         {"B", "hide or show backs"},
                         {"P", "pin this light"},
                         {"V", "compare with it: side by side, difference"},
                         {"+ −", "exposure"},
                         {"Space", "pause, go on"},
                         {"Tab", "hide or show the panels"},
                         {"Ctrl+O", "open a file (or drop it here)"},
                         {"Ctrl+P", "save the picture"},
                         {"Ctrl+R", "read the file again"},
                         {"Ctrl++ Ctrl+−", "larger or smaller text"},
                         {"Ctrl+Z, Ctrl+Shift+Z", "undo, redo (lamps, materials)"},
                         {"Enter, Esc", "in dialogs: do it, cancel"},
                         {"?", "this help"}};

}  // namespace

void draw_ask_panel(Desk& desk, const std::function<void()>& draw_deeds) {
  if (!ImGui::CollapsingHeader("Ask", ImGuiTreeNodeFlags_DefaultOpen)) return;
  draw_tape(desk);
  if (!desk.facts) {
    ImGui::TextWrapped("Click a patch: its numbers, what it sees, and where its light comes from.");
    draw_deeds();
    return;
  }
  const PatchFacts facts = *desk.facts;  // a partner that is clicked changes it
  draw_deeds();
  draw_patch(desk, facts);
  if (facts.has_light && facts.has_factors) {
    if (step_facts(desk.session, desk.look)) ImGui::TextDisabled("Of the solution:");
    draw_arrivals(desk, facts);
    draw_path(desk);
  }
  draw_factors(desk, facts);
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
