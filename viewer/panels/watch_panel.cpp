#include "viewer/panels/watch_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/panels/inks.h"
#include "viewer/panels/iteration_plot.h"

namespace viewer {
namespace {

using radiosity::Method;

void choose_method(Method& chosen) {
  if (!ImGui::BeginCombo("##method", std::string(method_title(chosen)).c_str())) return;
  for (const Method method : radiosity::all_methods()) {
    const std::string title(method_title(method));
    if (ImGui::Selectable(title.c_str(), method == chosen)) chosen = method;
  }
  ImGui::EndCombo();
}

/// Step back, play or hold, step forth, and the slider over all steps.
void draw_controls(Desk& desk, const IterationRecord& record) {
  Look& look = desk.look;
  const int last = static_cast<int>(record.frames.size()) - 1;
  int step = std::min(static_cast<int>(look.step), last);
  if (ImGui::ArrowButton("back", ImGuiDir_Left)) step = std::max(0, step - 1);
  ImGui::SameLine();
  const bool is_playing = desk.watching.is_playing;
  look.step = static_cast<std::size_t>(step);
  if (ImGui::Button(is_playing ? "Hold" : "Play")) {
    if (is_playing) {
      desk.watching.is_playing = false;
    } else {
      play_iteration(desk, desk.watching.speed);
      step = static_cast<int>(look.step);
    }
  }
  ImGui::SameLine();
  if (ImGui::ArrowButton("forth", ImGuiDir_Right)) step = std::min(last, step + 1);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const std::string format = fmt::format("step {}", record.frames[step]->iteration);
  ImGui::SliderInt("##step", &step, 0, last, format.c_str());
  look.step = static_cast<std::size_t>(step);
}

void draw_speed(Watching& watching) {
  auto speed = static_cast<float>(watching.speed);
  const std::string text = fmt::format("{:.2g} steps/s", watching.speed);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 7 * ImGui::GetFontSize());
  if (ImGui::SliderFloat("##speed", &speed, static_cast<float>(kSlowest),
                         static_cast<float>(kFastest), " ",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    watching.speed = speed;
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(text.c_str());
}

/// What the step is, and what it has not done yet.
void draw_step(const Desk& desk, const IterationRecord& record, const IterationFrame& frame) {
  ImGui::PushTextWrapPos(0);
  const std::string text = step_text(record.method, frame.iteration);
  const std::string unshot = fmt::format("{}; unshot: {} % of the emitted power", text,
                                         number_text(100 * frame.unshot_share, 3));
  ImGui::TextUnformatted(unshot.c_str());
  if (frame.shooter) {
    const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
    const std::string& surface = mesh.surface_names[mesh.surface[*frame.shooter]];
    const std::string next =
        fmt::format("shoots next, outlined if seen: patch {} of {}", *frame.shooter, surface);
    ImGui::TextUnformatted(next.c_str());
  }
  if (desk.session.is_iteration_stale()) {
    ImGui::TextColored(kDoubtInk, "%s",
                       "Out of date: of the scene before lamps or materials were changed.");
  }
  ImGui::PopTextWrapPos();
}

}  // namespace

void WatchPanel::draw(Desk& desk, double scale) {
  if (ImGui::CollapsingHeader("Watch", ImGuiTreeNodeFlags_DefaultOpen)) {
    Session& session = desk.session;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 11);
    choose_method(desk.watching.method);
    ImGui::SameLine();
    ImGui::BeginDisabled(session.model().transport == nullptr);
    if (ImGui::Button("Record")) {
      record_iteration(desk, desk.watching.method);
      play_iteration(desk, desk.watching.speed);
    }
    ImGui::EndDisabled();
    const IterationRecord* record = session.iteration();
    if (record == nullptr || record->frames.empty()) {
      ImGui::TextWrapped(
          "Records an iteration from darkness, to step through it; others, to compare.");
    } else {
      draw_record(desk, *record, scale);
    }
  }
  height_ = ImGui::GetCursorPosY() + ImGui::GetStyle().WindowPadding.y;
}

void WatchPanel::draw_record(Desk& desk, const IterationRecord& record, double scale) {
  draw_controls(desk, record);
  draw_speed(desk.watching);
  if (ImGui::RadioButton("light", desk.look.show == Show::watched)) show(desk, "watched");
  ImGui::SameLine();
  if (ImGui::RadioButton("unshot light", desk.look.show == Show::unshot)) show(desk, "unshot");
  ImGui::SameLine();
  ImGui::Checkbox("log work", &desk.watching.is_logarithmic);
  const IterationFrame& frame = *record.frames[std::min(desk.look.step, record.frames.size() - 1)];
  draw_step(desk, record, frame);
  IterationPlot plot{
      .records = {&record}, .mark = frame.work, .is_logarithmic = desk.watching.is_logarithmic};
  if (!desk.session.is_iteration_stale()) {
    for (const auto& other : desk.session.compared()) plot.records.push_back(other.get());
  }
  draw_iteration_plot(plot, scale);
}

}  // namespace viewer
