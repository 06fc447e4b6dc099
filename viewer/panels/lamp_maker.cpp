#include "viewer/panels/lamp_maker.h"

#include <imgui.h>

#include "viewer/desk/desk_surfaces.h"
#include "viewer/panels/attempt.h"

namespace viewer {

void LampMaker::draw(Desk& desk) {
  const auto surface = meant_surface(desk);
  if (!surface || desk.session.is_thermal()) return;
  const std::string& name = desk.session.model().mesh->surface_names[*surface];
  ImGui::TextWrapped("%s", name.c_str());
  ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
  ImGui::InputDouble("lm##lamp", &lumens_, 0, 0, "%.6g");
  ImGui::SameLine();
  if (ImGui::Button("Make this surface a lamp")) {
    attempt(desk, [&] { make_lamp(desk, *surface, lumens_); });
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("All of %s gives so many lumens, evenly and diffusely.", name.c_str());
  }
}

}  // namespace viewer
