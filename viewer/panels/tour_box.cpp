#include "viewer/panels/tour_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

namespace viewer {
namespace {

constexpr float kWidth = 320;  // at scale 1, as the others
constexpr float kGap = 14;
constexpr ImU32 kHighlight = IM_COL32(255, 190, 60, 255);
constexpr ImGuiWindowFlags kBox = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                  ImGuiWindowFlags_AlwaysAutoResize |
                                  ImGuiWindowFlags_NoFocusOnAppearing;

/// Towards the middle of the window from the target's edge, or in its middle.
void place_box(ImVec2 low, ImVec2 high, float gap) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImVec2 corner((low.x + high.x) / 2, (low.y + high.y) / 2);
  ImVec2 pivot(0.5F, 0.5F);
  if (high.x < screen.x / 2) {
    corner = ImVec2(high.x + gap, low.y + gap);
    pivot = ImVec2(0, 0);
  } else if (low.x > screen.x / 2) {
    corner = ImVec2(low.x - gap, low.y + gap);
    pivot = ImVec2(1, 0);
  } else if (low.y > screen.y / 2) {
    corner = ImVec2((low.x + high.x) / 2, low.y - gap);
    pivot = ImVec2(0.5F, 1);
  }
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, pivot);
}

}  // namespace

void TourBox::scroll_to(const Desk& desk, TourTarget target) {
  if (!desk.tour_step) scrolled_ = -1;
  if (!desk.tour_step || scrolled_ == *desk.tour_step) return;
  if (tour_steps()[static_cast<std::size_t>(*desk.tour_step)].target != target) return;
  scrolled_ = *desk.tour_step;
  ImGui::SetScrollHereY(0);
}

void TourBox::draw(Desk& desk, double scale) {
  if (!desk.tour_step) return;
  const int step = *desk.tour_step;
  const auto n_steps = static_cast<int>(tour_steps().size());
  const TourStep& shown = tour_steps()[static_cast<std::size_t>(step)];
  const auto size = static_cast<float>(scale);
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  Place place{ImVec2(0, 0), screen};  // of what has no room
  if (const auto found = places_.find(shown.target); found != places_.end()) place = found->second;
  places_.clear();
  ImGui::GetForegroundDrawList()->AddRect(place.low, place.high, kHighlight, 0, 0, 3 * size);
  place_box(place.low, place.high, kGap * size);
  const float width = std::min(kWidth * size, screen.x);
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y));
  const std::string title = fmt::format("{} ({} of {})###tour", shown.title, step + 1, n_steps);
  bool is_open = true;
  if (ImGui::Begin(title.c_str(), &is_open, kBox)) {
    ImGui::TextWrapped("%s", shown.text);
    ImGui::BeginDisabled(step == 0);
    if (ImGui::Button("Back")) show_tour(desk, step - 1);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button(step + 1 < n_steps ? "Next" : "Done")) go_on_with_tour(desk);
  }
  ImGui::End();
  if (!is_open) end_tour(desk);
}

bool is_first_visit(const std::filesystem::path& file) {
  std::error_code error;
  if (file.empty() || std::filesystem::exists(file, error)) return false;
  std::filesystem::create_directories(file.parent_path(), error);
  return static_cast<bool>(std::ofstream(file) << "seen\n");
}

}  // namespace viewer
