#include "viewer/panels/console_panel.h"

#include <imgui.h>

#include <cmath>

#include "viewer/panels/inks.h"

namespace viewer {
namespace {

constexpr float kFrame = 14;  // pixels around the lines, at scale 1
constexpr int kManyLines = 12;
constexpr const char* kMoreLines = "More lines";
constexpr const char* kFewerLines = "Fewer lines";
constexpr float kButtonWidth = 6;  // heights of text

/// What a person may do about a message.
void draw_button(Desk& desk, const Message& message, bool has_own_line) {
  if (!has_own_line) ImGui::SameLine();
  if (message.is_about_openings) {
    if (ImGui::SmallButton("Show them")) show(desk, "unseen");
  } else if (ImGui::SmallButton("Reload")) {
    reload(desk);
  }
}

void draw_messages(Desk& desk) {
  const Message* before = nullptr;
  for (const Message& message : desk.session.messages()) {
    // What follows is about the file that is open.
    if (before != nullptr && before->is_past && !message.is_past) ImGui::Separator();
    before = &message;
    const ImVec4 plain = message.is_past ? kPastInk : kPlainInk;
    ImGui::PushStyleColor(ImGuiCol_Text, message.is_error && !message.is_past ? kErrorInk : plain);
    // A line that can be clicked has a button at its end, one that is longer below it.
    const bool has_button =
        (message.is_about_openings || message.is_about_file) && !message.is_past;
    const bool is_long = ImGui::CalcTextSize(message.text.c_str()).x >
                         ImGui::GetContentRegionAvail().x - kButtonWidth * ImGui::GetFontSize();
    ImGui::TextWrapped("%s", message.text.c_str());
    ImGui::PopStyleColor();
    if (has_button) draw_button(desk, message, is_long);
  }
}

}  // namespace

float ConsolePanel::height(const Desk& desk, double scale) {
  const auto n_lines = static_cast<float>(desk.console_lines);
  return n_lines * ImGui::GetTextLineHeightWithSpacing() + kFrame * static_cast<float>(scale);
}

void ConsolePanel::draw_edge(Desk& desk) {
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 cursor = ImGui::GetCursorScreenPos();
  const float thickness = ImGui::GetStyle().WindowPadding.y;
  ImGui::SetCursorScreenPos(corner);
  ImGui::InvisibleButton("edge", ImVec2(ImGui::GetWindowWidth(), thickness));
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  }
  if (ImGui::IsItemActive()) {
    const float bottom = corner.y + ImGui::GetWindowHeight();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    // One line is the status.
    const float n_lines = (bottom - ImGui::GetMousePos().y - 2 * thickness) / line - 1;
    set_console_lines(desk, static_cast<int>(std::lround(n_lines)));
  }
  ImGui::SetCursorScreenPos(cursor);
}

float ConsolePanel::buttons_width() {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = 0;
  for (const char* label : {kFewerLines, "Copy", "Clear"}) {
    width += ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
  }
  return width;
}

void ConsolePanel::draw_buttons(Desk& desk) {
  const bool is_long = desk.console_lines > kConsoleLines;
  ImGui::SameLine(ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x - buttons_width());
  if (ImGui::SmallButton(is_long ? kFewerLines : kMoreLines)) {
    set_console_lines(desk, is_long ? kConsoleLines : kManyLines);
  }
  ImGui::BeginDisabled(desk.session.messages().empty());
  ImGui::SameLine();
  if (ImGui::SmallButton("Copy")) desk.copied = messages_text(desk.session);
  ImGui::SameLine();
  if (ImGui::SmallButton("Clear")) desk.session.clear_messages();
  ImGui::EndDisabled();
}

void ConsolePanel::draw(Desk& desk) {
  ImGui::BeginChild("console", ImVec2(0, 0), true);
  draw_messages(desk);
  if (length_ != desk.session.versions().messages) ImGui::SetScrollHereY(1);
  length_ = desk.session.versions().messages;
  ImGui::EndChild();
}

}  // namespace viewer
