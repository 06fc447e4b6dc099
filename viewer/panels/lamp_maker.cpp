#include "viewer/panels/lamp_maker.h"

#include <imgui.h>

#include "viewer/desk/couplings.h"
#include "viewer/panels/attempt.h"

namespace viewer {

void LampMaker::draw(Desk& desk) {
  const auto surface = asked_surface(desk.session);
  if (!surface || !desk.session.model().scene || desk.session.is_thermal()) return;
  ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
  ImGui::InputDouble("lm##lamp", &lumens_, 0, 0, "%.6g");
  ImGui::SameLine();
  if (ImGui::Button("Make this surface a lamp")) {
    attempt(desk, [&] { desk.session.make_lamp(*surface, lumens_); });
  }
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("All of %s gives so many lumens, evenly and diffusely.",
                      desk.session.model().mesh->surface_names[*surface].c_str());
  }
}

}  // namespace viewer
