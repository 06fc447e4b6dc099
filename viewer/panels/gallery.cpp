#include "viewer/panels/gallery.h"

#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "viewer/desk/tour.h"
#include "viewer/panels/inks.h"

namespace viewer {
namespace {

constexpr float kCardWidth = 180;  // at scale 1
constexpr int kDescriptionLines = 2;

constexpr ImGuiWindowFlags kPage = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Text within a box, as many whole lines of it as fit.
void draw_text(ImVec2 corner, ImVec2 size, ImGuiCol ink, const std::string& text) {
  const ImVec4 clip(corner.x, corner.y, corner.x + size.x, corner.y + size.y);
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), corner,
                                      ImGui::GetColorU32(ink), text.c_str(), nullptr, size.x,
                                      &clip);
}

}  // namespace

bool Gallery::draw_card(const Example& example, std::size_t k, double scale) {
  const float width = kCardWidth * static_cast<float>(scale);
  const float picture_height = width * kExampleHeight / kExampleWidth;
  const float line = ImGui::GetTextLineHeight();
  const float gap = 0.3F * line;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = picture_height + 2 * gap + (1 + kDescriptionLines) * line;
  ImGui::PushID(static_cast<int>(k));
  const bool is_clicked = ImGui::InvisibleButton("card", ImVec2(width, height));
  ImGui::PopID();
  const bool is_hovered = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 picture_end(corner.x + width, corner.y + picture_height);
  if (example.picture) {
    list.AddImage(textures_[k].of(example.picture), corner, picture_end);
  } else {
    list.AddRectFilled(corner, picture_end, ImGui::GetColorU32(ImGuiCol_FrameBg));
  }
  if (is_hovered) {
    list.AddRect(corner, picture_end, ImGui::GetColorU32(ImGuiCol_ButtonHovered), 0, 0,
                 2 * static_cast<float>(scale));
  }
  const float name_top = picture_end.y + gap;
  draw_text(ImVec2(corner.x, name_top), ImVec2(width, line), ImGuiCol_Text, example.name);
  draw_text(ImVec2(corner.x, name_top + line + gap), ImVec2(width, kDescriptionLines * line),
            ImGuiCol_TextDisabled, example.description);
  if (is_hovered && !example.description.empty()) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(1.6F * width);
    ImGui::TextUnformatted(example.description.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  return is_clicked;
}

void Gallery::draw(Desk& desk, double scale) {
  const bool is_empty = !desk.session.is_open() && !desk.session.status().is_busy;
  if (!is_empty) desk.examples.stop();
  if (!is_empty || desk.examples.list().empty() || desk.region.width <= 0) return;
  desk.examples.look();
  const std::vector<Example>& list = desk.examples.list();
  if (textures_.size() < list.size()) textures_.resize(list.size());
  const Region& region = desk.region;
  ImGui::SetNextWindowPos(ImVec2(static_cast<float>(region.left), static_cast<float>(region.top)));
  ImGui::SetNextWindowSize(
      ImVec2(static_cast<float>(region.width), static_cast<float>(region.height)));
  const float margin = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(margin, margin));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(margin, margin));
  // (NoDecoration has no scroll bar, which small windows need.)
  ImGui::Begin("Examples", nullptr, kPage & ~ImGuiWindowFlags_NoScrollbar);
  ImGui::TextWrapped("Drop a scene or result file here, press Ctrl+O, or begin with an example:");
  const float card = kCardWidth * static_cast<float>(scale);
  const float available = ImGui::GetContentRegionAvail().x;
  const int n_columns = std::max(1, static_cast<int>((available + margin) / (card + margin)));
  std::optional<std::string> chosen;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (k % static_cast<std::size_t>(n_columns) != 0) ImGui::SameLine();
    if (draw_card(list[k], k, scale)) chosen = list[k].path;
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  if (chosen) desk.session.open(*chosen);
}

}  // namespace viewer
