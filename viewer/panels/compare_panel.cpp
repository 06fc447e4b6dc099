#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/pinning.h"
#include "viewer/panels/inks.h"
#include "viewer/panels/panels.h"

namespace viewer {
namespace {

struct Way {
  const char* name;
  Comparison comparison;
};
constexpr std::array kWays = {Way{"off", Comparison::none}, Way{"beside", Comparison::wipe},
                              Way{"difference", Comparison::difference}};

/// What is pinned, and how it is compared.
void draw_pinned(Desk& desk) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", fmt::format("{}, {} patches", desk.pinning.light->standing,
                                        desk.pinning.light->known.model.mesh->size())
                                .c_str());
  ImGui::PopTextWrapPos();
  std::string refusals;
  for (const Way& way : kWays) {
    const std::string refusal = comparison_refusal(desk, way.comparison);
    if (!refusal.empty()) refusals += (refusals.empty() ? "" : "\n") + refusal;
    if (way.comparison != Comparison::none) ImGui::SameLine();
    ImGui::BeginDisabled(!refusal.empty());
    if (ImGui::RadioButton(way.name, desk.look.comparison == way.comparison)) {
      attempt(desk, [&] { compare(desk, way.comparison); });
    }
    ImGui::EndDisabled();
  }
  if (desk.look.comparison != Comparison::none && !is_comparable(desk.look)) {
    refusals = "what is shown is not compared; choose light or a quantity of it above";
  }
  if (refusals.empty()) return;
  ImGui::PushTextWrapPos(0);
  ImGui::TextColored(kDoubtInk, "%s", refusals.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

void draw_compare_panel(Desk& desk) {
  if (!ImGui::CollapsingHeader("Compare", ImGuiTreeNodeFlags_DefaultOpen)) return;
  ImGui::BeginDisabled(desk.session.light() == nullptr);
  if (ImGui::Button(desk.pinning.light ? "Pin anew" : "Pin this light"))
    attempt(desk, [&] { pin(desk); });
  ImGui::EndDisabled();
  if (!desk.pinning.light) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
      ImGui::SetTooltip("keeps the light as it is, to see what changes later");
    }
    return;
  }
  ImGui::SameLine();
  if (ImGui::Button("Unpin")) {
    unpin(desk);
    return;
  }
  draw_pinned(desk);
}

}  // namespace viewer
