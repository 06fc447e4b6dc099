#include "viewer/panels/watch_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "viewer/panels/iteration_plot.h"

namespace viewer {
namespace {

// In words, in the order of radiosity::all_methods.
constexpr std::array kMethodNames = {"conjugate gradients", "Jacobi", "Gauss-Seidel",
                                     "Southwell (shooting)", "Chebyshev"};

}  // namespace

int WatchPanel::next_step(int step, int last, bool is_complete) {
  constexpr double kStepSeconds = 0.25;
  if (!is_playing_ || ImGui::GetTime() < next_step_) return step;
  next_step_ = ImGui::GetTime() + kStepSeconds;
  if (step < last) return step + 1;
  if (is_complete) is_playing_ = false;
  return step;
}

int WatchPanel::draw_controls(int step, int last, int iteration) {
  if (ImGui::ArrowButton("back", ImGuiDir_Left)) step = std::max(0, step - 1);
  ImGui::SameLine();
  if (ImGui::Button(is_playing_ ? "Hold" : "Play")) {
    is_playing_ = !is_playing_;
    if (is_playing_ && step == last) step = 0;
  }
  ImGui::SameLine();
  if (ImGui::ArrowButton("forth", ImGuiDir_Right)) step = std::min(last, step + 1);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const std::string format = fmt::format("step {}", iteration);
  ImGui::SliderInt("##step", &step, 0, last, format.c_str());
  return step;
}

void WatchPanel::draw(Desk& desk, double scale) {
  if (!ImGui::CollapsingHeader("Watch", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Session& session = desk.session;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 11);
  ImGui::Combo("##method", &method_, kMethodNames.data(), static_cast<int>(kMethodNames.size()));
  ImGui::SameLine();
  ImGui::BeginDisabled(session.model().transport == nullptr);
  if (ImGui::Button("Record")) {
    session.record_iteration(radiosity::all_methods()[static_cast<std::size_t>(method_)]);
    desk.look.step = 0;
    if (desk.look.show != Show::unshot) show(desk, "watched");
    is_playing_ = true;
    next_step_ = 0;
  }
  ImGui::EndDisabled();
  const IterationRecord* record = session.iteration();
  if (record == nullptr || record->frames.empty()) {
    ImGui::TextWrapped("Records an iteration from darkness, to step through it.");
    return;
  }
  const int last = static_cast<int>(record->frames.size()) - 1;
  int step = std::min(static_cast<int>(desk.look.step), last);
  step = next_step(step, last, record->is_complete);
  step = draw_controls(step, last, record->frames[step]->iteration);
  desk.look.step = static_cast<std::size_t>(step);
  if (ImGui::RadioButton("light", desk.look.show == Show::watched)) show(desk, "watched");
  ImGui::SameLine();
  if (ImGui::RadioButton("unshot light", desk.look.show == Show::unshot)) show(desk, "unshot");
  ImGui::Text("unshot: %.3g %% of the emitted power", 100 * record->frames[step]->unshot_share);
  draw_iteration_plot(*record, record->frames[step]->iteration, scale);
}

}  // namespace viewer
