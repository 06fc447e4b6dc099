#include "viewer/panels/status_line.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "viewer/desk/status_parts.h"
#include "viewer/panels/console_panel.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

constexpr float kMostButtons = 0.25F;  // of the width
constexpr float kHoveredShare = 0.4F;  // of what buttons leave
constexpr float kMostHovered = 22;     // heights of text
constexpr float kBarShare = 0.3F;      // of what is left for the status

/// As many parts as there is room for, the first one in any case.
std::string fitting_text(const std::vector<std::string>& parts, float room) {
  std::string text = parts.front();
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const std::string longer = text + " · " + parts[k];
    if (ImGui::CalcTextSize(longer.c_str()).x > room) break;
    text = longer;
  }
  return text;
}

/// Draws a text, cut where its room ends.
void draw_cut(const std::string& text, float room) {
  const ImVec2 place = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(place, ImVec2(place.x + room, place.y + ImGui::GetFrameHeight()), true);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopClipRect();
}

void draw_tooltip(const Session& session) {
  const std::string accuracy = accuracy_text(session);
  if (accuracy.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
  ImGui::TextUnformatted(
      "Two standard errors of the radiosity over its size (energy norm), of the band that is "
      "worst: "
      "by form factors, iteration and the patches' size.");
  if (const std::string asked = asked_text(session); !asked.empty()) {
    ImGui::TextUnformatted(asked.c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

void draw_status_line(Desk& desk) {
  const Session& session = desk.session;
  const float width = ImGui::GetContentRegionAvail().x;
  const float left = ImGui::GetCursorPosX();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const bool has_buttons = ConsolePanel::buttons_width() < kMostButtons * width;
  const float room = width - gap - (has_buttons ? ConsolePanel::buttons_width() : 0);
  const float hovered_room = std::min(kHoveredShare * room, kMostHovered * ImGui::GetFontSize());
  float status_room = room - hovered_room - gap;
  if (session.status().is_busy) {
    const float bar = std::min(width / 6, kBarShare * status_room);
    ImGui::ProgressBar(static_cast<float>(session.job().fraction()),
                       ImVec2(bar, ImGui::GetTextLineHeight()), "");
    ImGui::SameLine();
    status_room -= bar + gap;
  }
  draw_cut(fitting_text(status_parts(session), status_room), status_room);
  draw_tooltip(session);
  if (const std::string hovered = hovered_text(desk); !hovered.empty()) {
    ImGui::SameLine(left + room - hovered_room);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    draw_cut(hovered, hovered_room);
    ImGui::PopStyleColor();
  }
  if (has_buttons) ConsolePanel::draw_buttons(desk);
}

}  // namespace viewer
