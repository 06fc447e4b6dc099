#include "viewer/panels/views_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

namespace viewer {

void ViewsPanel::draw(Desk& desk) {
  if (!ImGui::CollapsingHeader("Views")) return;
  if (name_.empty() || name_ == offered_) {  // else another file may have a view of that name
    offered_ = free_view_name(desk.views);
    name_ = offered_;
  }
  ImGui::BeginDisabled(!desk.session.is_open());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 4 * ImGui::GetFontSize());
  const bool has_enter = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if ((ImGui::Button("Keep") || has_enter) && !name_.empty()) {
    save_view(desk.views, name_, desk.camera.camera());
    name_.clear();
  }
  ImGui::EndDisabled();
  std::string used;
  std::string forgotten;
  for (const SavedView& view : desk.views) {
    ImGui::PushID(view.name.c_str());
    if (ImGui::SmallButton("×")) forgotten = view.name;
    ImGui::SameLine();
    if (ImGui::Selectable(view.name.c_str())) used = view.name;
    ImGui::PopID();
  }
  if (!used.empty()) use_view(desk, used);
  if (!forgotten.empty()) forget_view(desk.views, forgotten);
  if (!desk.views.empty()) {
    const bool has_scene = desk.session.model().scene != nullptr;
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled(
        "%s", has_scene ? "Save scene keeps them in the file." : "Kept while this file is open.");
    ImGui::PopTextWrapPos();
  }
}

}  // namespace viewer
