#include "viewer/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "viewer/draw/overlay.h"
#include "viewer/panels/iteration_plot.h"

namespace viewer {
namespace {

constexpr float kLeftWidth = 270;  // at scale 1, as the others
constexpr float kRightWidth = 330;
constexpr float kLeastPicture = 160;
constexpr int kConsoleLines = 3;

// In words, in the order of radiosity::all_methods.
constexpr std::array kMethodNames = {"conjugate gradients", "Jacobi", "Gauss-Seidel",
                                     "Southwell (shooting)", "Chebyshev"};

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void begin_panel(const char* name, float left, float top, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(left, top));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin(name, nullptr, kFixed);
}

std::string status_text(const Desk& desk) {
  const Session& session = desk.session;
  const WorkStatus status = session.status();
  std::string text;
  if (session.is_paused()) text += "paused · ";
  if (status.is_busy) {
    text += status.stage.empty() ? "working" : status.stage;
    if (status.total > 0) text += fmt::format(" {:.0f} %", 100 * status.done / status.total);
    const bool is_preview = session.light() && session.light()->kind == Light::Kind::preview;
    if (is_preview) text += fmt::format(" · unshot {:.1f} %", 100 * session.unshot_share());
  } else if (session.light() != nullptr && session.light()->is_solved()) {
    text += session.light()->kind == Light::Kind::stored ? "result from a file" : "solved";
  } else {
    text += session.is_open() ? "not solved" : "no scene";
  }
  if (session.is_open()) text += fmt::format(" · {} patches", session.model().mesh->size());
  const Light* light = session.light();
  if (light != nullptr && light->solution.residual > 0) {
    text += fmt::format(" · residual {:.1e}", light->solution.residual);
  }
  if (session.seconds_to_solve() > 0)
    text += fmt::format(" · {:.1f} s", session.seconds_to_solve());
  return text;
}

}  // namespace

Panels::Panels(const study::StudyOptions& options)
    : n_patches_(static_cast<int>(options.patches.n_patches.value_or(meshing::kDefaultPatches))),
      is_adaptive_(options.patches.adaptive) {}

bool Panels::is_popup_open() {
  return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void Panels::open(Desk& desk, const std::string& path) {
  recent_.add(path);
  desk.session.open(path);
}

void Panels::choose_file(const Desk& desk) { browser_.open(desk.session.model().path); }

void Panels::draw(Desk& desk, int width, int height, double scale) {
  const auto size = static_cast<float>(scale);
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  float top = 0;
  float left = 0;
  float right = w;
  float bottom = h;
  if (desk.shows_panels) {
    draw_menu(desk);
    top = ImGui::GetFrameHeight();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float status = (kConsoleLines + 1) * line + 14 * size;
    if (h > top + status + kLeastPicture * size) {
      bottom = h - status;
      draw_status(desk, bottom, w, status);
    }
    const bool has_left = w > (kLeftWidth + kLeastPicture) * size;
    const bool has_right = w > (kLeftWidth + kRightWidth + kLeastPicture) * size;
    if (has_left) {
      left = kLeftWidth * size;
      begin_panel("Look and what if", 0, top, left, bottom - top);
      draw_look_panel(desk);
      draw_what_if_panel(desk);
      draw_solve(desk);
      ImGui::End();
    }
    if (has_right) {
      right = w - kRightWidth * size;
      begin_panel("Ask and watch", right, top, w - right, bottom - top);
      draw_ask_panel(desk);
      draw_watch(desk, scale);
      ImGui::End();
    }
  }
  draw_popups(desk, scale);
  if (desk.shows_help) draw_help(desk, scale);
  right -= legend_width(desk, scale);
  desk.region = {.left = static_cast<int>(left),
                 .top = static_cast<int>(top),
                 .width = std::max(0, static_cast<int>(right) - static_cast<int>(left)),
                 .height = std::max(0, static_cast<int>(bottom) - static_cast<int>(top))};
}

void Panels::draw_menu(Desk& desk) {
  if (!ImGui::BeginMainMenuBar()) return;
  if (ImGui::BeginMenu("File")) {
    if (ImGui::MenuItem("Open ...", "Ctrl+O")) choose_file(desk);
    if (ImGui::BeginMenu("Recent", !recent_.paths().empty())) {
      const std::vector<std::string> paths = recent_.paths();
      for (const std::string& path : paths) {
        if (ImGui::MenuItem(path.c_str())) open(desk, path);
      }
      ImGui::EndMenu();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Save picture ...", "Ctrl+P")) begin_save(desk, Save::screenshot);
    if (ImGui::MenuItem("Save result ...", nullptr, false, desk.session.has_result())) {
      begin_save(desk, Save::result);
    }
    const bool has_scene = desk.session.model().scene != nullptr;
    if (ImGui::MenuItem("Save scene ...", nullptr, false, has_scene)) begin_save(desk, Save::scene);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("View")) {
    if (ImGui::MenuItem("Fit", "F")) fit_camera(desk);
    if (ImGui::MenuItem("Scene's camera", "C")) use_scene_camera(desk);
    ImGui::MenuItem("Patch edges", "N", &desk.look.edges);
    ImGui::MenuItem("Smooth", "M", &desk.look.smooth);
    ImGui::MenuItem("Hide backs", "B", &desk.look.hide_backs);
    ImGui::MenuItem("Panels", "Tab", &desk.shows_panels);
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Help")) {
    ImGui::MenuItem("Keys and mouse", "?", &desk.shows_help);
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
}

void Panels::begin_save(const Desk& desk, Save what) {
  save_ = what;
  is_save_due_ = true;
  std::filesystem::path stem = std::filesystem::path(desk.session.model().path).stem();
  if (stem.empty()) stem = "radiosity";
  const char* ending = what == Save::screenshot ? ".png"
                       : what == Save::result   ? ".vtp"
                                                : "-new.json";
  save_path_ = stem.string() + ending;
}

void Panels::draw_popups(Desk& desk, double scale) {
  if (const auto chosen = browser_.draw(scale)) open(desk, *chosen);
  if (is_save_due_) ImGui::OpenPopup("Save");
  is_save_due_ = false;
  ImGui::SetNextWindowSize(ImVec2(static_cast<float>(460 * scale), 0));
  if (!ImGui::BeginPopupModal("Save", nullptr, ImGuiWindowFlags_NoResize)) return;
  const char* what = save_ == Save::screenshot ? "Picture (.png)"
                     : save_ == Save::result   ? "Result (.vtp, .csv or .ply)"
                                               : "Scene with its changes (.json)";
  ImGui::TextUnformatted(what);
  ImGui::SetNextItemWidth(-1);
  const bool is_entered =
      ImGui::InputText("##file", &save_path_, ImGuiInputTextFlags_EnterReturnsTrue);
  const bool is_saved = ImGui::Button("Save") || is_entered;
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGuiKey_Escape);
  if (is_saved) {
    attempt(desk, [&] {
      if (save_ == Save::screenshot) desk.screenshot = save_path_;
      if (save_ == Save::result) save_result(desk, save_path_);
      if (save_ == Save::scene) save_scene(desk, save_path_);
      if (save_ != Save::screenshot) desk.session.tell("saved " + save_path_);
    });
  }
  if (is_saved || is_cancelled) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void Panels::draw_solve(Desk& desk) {
  if (!ImGui::CollapsingHeader("Solve", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Session& session = desk.session;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
  ImGui::InputInt("patches", &n_patches_, 1000, 10000);
  n_patches_ = std::clamp(n_patches_, 1, 10'000'000);
  ImGui::Checkbox("adaptive", &is_adaptive_);
  ImGui::SameLine();
  ImGui::BeginDisabled(session.model().scene == nullptr);
  if (ImGui::Button("Solve again")) {
    study::StudyOptions options = session.options();
    options.patches = {.n_patches = n_patches_, .adaptive = is_adaptive_};
    session.restart(options);
  }
  ImGui::EndDisabled();
  ImGui::BeginDisabled(!session.status().is_busy);
  if (ImGui::Button(session.is_paused() ? "Go on" : "Pause")) {
    session.set_paused(!session.is_paused());
  }
  ImGui::SameLine();
  if (ImGui::Button("Stop")) session.stop();
  ImGui::EndDisabled();
}

void Panels::draw_watch(Desk& desk, double scale) {
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
  if (is_playing_ && ImGui::GetTime() >= next_step_) {
    constexpr double kStepSeconds = 0.25;
    next_step_ = ImGui::GetTime() + kStepSeconds;
    if (step < last)
      ++step;
    else if (record->is_complete)
      is_playing_ = false;
  }
  if (ImGui::ArrowButton("back", ImGuiDir_Left)) step = std::max(0, step - 1);
  ImGui::SameLine();
  if (ImGui::Button(is_playing_ ? "Pause##play" : "Play")) {
    is_playing_ = !is_playing_;
    if (is_playing_ && step == last) step = 0;
  }
  ImGui::SameLine();
  if (ImGui::ArrowButton("forth", ImGuiDir_Right)) step = std::min(last, step + 1);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const std::string format = fmt::format("step {}", record->frames[step]->iteration);
  ImGui::SliderInt("##step", &step, 0, last, format.c_str());
  desk.look.step = static_cast<std::size_t>(step);

  bool is_unshot = desk.look.show == Show::unshot;
  if (ImGui::RadioButton("light", desk.look.show == Show::watched)) show(desk, "watched");
  ImGui::SameLine();
  if (ImGui::RadioButton("unshot light", is_unshot)) show(desk, "unshot");
  ImGui::Text("unshot: %.3g %% of the emitted power", 100 * record->frames[step]->unshot_share);
  draw_iteration_plot(*record, record->frames[step]->iteration, scale);
}

void Panels::draw_status(const Desk& desk, float top, float width, float height) {
  begin_panel("Status", 0, top, width, height);
  const WorkStatus status = desk.session.status();
  if (status.is_busy && status.total > 0) {
    ImGui::ProgressBar(static_cast<float>(status.done / status.total),
                       ImVec2(width / 6, ImGui::GetTextLineHeight()), "");
    ImGui::SameLine();
  }
  ImGui::TextUnformatted(status_text(desk).c_str());
  ImGui::SameLine(width - 7 * ImGui::GetFontSize());
  ImGui::TextDisabled("%.0f frames/s", ImGui::GetIO().Framerate);
  ImGui::BeginChild("console", ImVec2(0, 0), true);
  for (const Message& message : desk.session.messages()) {
    const ImVec4 color =
        message.is_error ? ImVec4(1, 0.45F, 0.4F, 1) : ImVec4(0.75F, 0.75F, 0.75F, 1);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextWrapped("%s", message.text.c_str());
    ImGui::PopStyleColor();
  }
  if (console_length_ != desk.session.versions().messages) ImGui::SetScrollHereY(1);
  console_length_ = desk.session.versions().messages;
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace viewer
