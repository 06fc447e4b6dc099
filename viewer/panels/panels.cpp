#include "viewer/panels/panels.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "viewer/panels/couplings_panel.h"
#include "viewer/panels/grids_panel.h"
#include "viewer/panels/status_line.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

constexpr float kLeftWidth = 270;  // at scale 1, as the others
constexpr float kRightWidth = 330;
constexpr float kWatchHeight = 100;   // before it has been drawn
constexpr float kWatchShare = 0.65F;  // of the column, at most
constexpr float kLeastPicture = 160;

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

void begin_panel(const char* name, float left, float top, float width, float height) {
  ImGui::SetNextWindowPos(ImVec2(left, top));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin(name, nullptr, kFixed);
}

}  // namespace

Panels::Panels(const study::StudyOptions& options)
    : n_patches_(static_cast<int>(options.patches.n_patches.value_or(meshing::kDefaultPatches))),
      is_adaptive_(options.patches.adaptive) {}

bool Panels::is_popup_open() {
  return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void Panels::draw(Desk& desk, std::span<const KeyPress> keys, int width, int height, double scale) {
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
    // As much as leaves a picture.
    const float most = h - top - kLeastPicture * size;
    const float status = std::min(line + ConsolePanel::height(desk, scale), most);
    if (status > 3 * line) {
      bottom = h - status;
      draw_status(desk, bottom, w, status);
    }
    const bool has_left = w > (kLeftWidth + kLeastPicture) * size;
    is_narrow_ = !has_left;
    const bool has_right = w > (kLeftWidth + kRightWidth + kLeastPicture) * size;
    // In a narrow window they come over the picture when they are called.
    if (has_left || is_called_) {
      begin_panel("Look and what if", 0, top, std::min(kLeftWidth * size, w), bottom - top);
      if (has_left) left = kLeftWidth * size;
      draw_scene_panel(desk);
      views_.draw(desk);
      draw_part(desk, TourTarget::look, [&] { draw_look_panel(desk); });
      draw_compare_panel(desk);
      draw_grids_panel(desk);
      daylight_.draw(desk);
      if (measure_.draw(desk)) begin_save(desk, SaveDialog::Kind::readings);
      if (!has_right) {  // here, rather than nowhere
        draw_ask(desk);
        watch_.draw(desk, scale);
      }
      draw_solve(desk);
      draw_part(desk, TourTarget::what_if, [&] { draw_what_if_panel(desk); });
      ImGui::End();
    }
    if (has_right) {
      right = w - kRightWidth * size;
      // Of its own height, so that the plot stays in sight whatever is asked.
      const float wanted = watch_.height() > 0 ? watch_.height() : kWatchHeight * size;
      const float watch_top = bottom - std::min(wanted, kWatchShare * (bottom - top));
      begin_panel("Ask", right, top, w - right, watch_top - top);
      draw_ask(desk);
      ImGui::End();
      begin_panel("Watch", right, watch_top, w - right, bottom - watch_top);
      watch_.draw(desk, scale);
      ImGui::End();
    }
  }
  desk.region = {.left = static_cast<int>(left),
                 .top = static_cast<int>(top),
                 .width = std::max(0, static_cast<int>(right) - static_cast<int>(left)),
                 .height = std::max(0, static_cast<int>(bottom) - static_cast<int>(top))};
  tour_.place(TourTarget::picture, ImVec2(left, top), ImVec2(right, bottom));
  if (bottom < h) tour_.place(TourTarget::console, ImVec2(0, bottom), ImVec2(w, h));
  gallery_.draw(desk, scale);
  const DialogKeys dialog = dialog_keys(keys);
  if (const auto chosen = browser_.draw(dialog, scale)) desk.session.open(*chosen);
  save_.draw(desk, dialog, scale);
  if (desk.shows_help) draw_help(desk, scale);
  tour_.draw(desk, scale);
}

template <typename Draw>
void Panels::draw_part(const Desk& desk, TourTarget target, const Draw& draw) {
  const float top = ImGui::GetCursorScreenPos().y;
  tour_.scroll_to(desk, target);
  draw();
  // Of it what the panel shows.
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  const float bottom = ImGui::GetCursorScreenPos().y;
  tour_.place(target, ImVec2(corner.x, std::clamp(top, corner.y, corner.y + size.y)),
              ImVec2(corner.x + size.x, std::clamp(bottom, corner.y, corner.y + size.y)));
}

void Panels::draw_ask(Desk& desk) {
  surfaces_.draw(desk);
  draw_part(desk, TourTarget::ask, [&] { draw_ask_panel(desk, [&] { lamp_maker_.draw(desk); }); });
  if (desk.session.is_thermal()) draw_heat_panel(desk);
  draw_couplings_panel(desk);
}

void Panels::draw_file_menu(Desk& desk) {
  if (!ImGui::BeginMenu("File")) return;
  if (ImGui::MenuItem("Open ...", "Ctrl+O")) choose_file(desk);
  if (ImGui::BeginMenu("Recent", !recent_.paths().empty())) {
    const std::vector<std::string> paths = recent_.paths();
    for (const std::string& path : paths) {
      if (ImGui::MenuItem(path.c_str())) desk.session.open(path);
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("Examples", !desk.examples.list().empty())) {
    for (const Example& example : desk.examples.list()) {
      if (ImGui::MenuItem(example.name.c_str())) desk.session.open(example.path);
    }
    ImGui::EndMenu();
  }
  if (ImGui::MenuItem("Reload", "Ctrl+R", false, desk.session.is_open())) reload(desk);
  ImGui::Separator();
  if (ImGui::MenuItem("Save picture ...", "Ctrl+P")) begin_save(desk, SaveDialog::Kind::picture);
  if (ImGui::MenuItem("Save result ...", nullptr, false, desk.session.has_result())) {
    begin_save(desk, SaveDialog::Kind::result);
  }
  const bool has_scene = desk.session.model().scene != nullptr;
  if (ImGui::MenuItem("Save scene ...", nullptr, false, has_scene)) {
    begin_save(desk, SaveDialog::Kind::scene);
  }
  ImGui::EndMenu();
}

void Panels::draw_menu(Desk& desk) {
  if (!ImGui::BeginMainMenuBar()) return;
  draw_file_menu(desk);
  if (ImGui::BeginMenu("Edit")) {
    const MixHistory& history = desk.session.mix_history();
    if (ImGui::MenuItem("Undo change of the scene", "Ctrl+Z", false, history.can_undo())) {
      desk.session.undo_mix();
    }
    if (ImGui::MenuItem("Redo", "Ctrl+Shift+Z", false, history.can_redo())) {
      desk.session.redo_mix();
    }
    ImGui::Separator();
    const bool has_messages = !desk.session.messages().empty();
    if (ImGui::MenuItem("Copy messages", nullptr, false, has_messages)) {
      desk.copied = messages_text(desk.session);
    }
    if (ImGui::MenuItem("Clear messages", nullptr, false, has_messages)) {
      desk.session.clear_messages();
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu("View")) {
    if (ImGui::MenuItem("Fit", "F")) fit_camera(desk);
    if (ImGui::MenuItem("Scene's camera", "C")) use_scene_camera(desk);
    if (ImGui::MenuItem("z is up", "Z", desk.up == UpAxis::z)) {
      set_up(desk, desk.up == UpAxis::z ? UpAxis::y : UpAxis::z);
    }
    ImGui::MenuItem("Patch edges", "N", &desk.look.edges);
    ImGui::MenuItem("Smooth", "M", &desk.look.smooth);
    ImGui::MenuItem("Hide backs", "B", &desk.look.hide_backs);
    ImGui::MenuItem("Outlines of hidden backs", nullptr, &desk.look.back_outlines,
                    desk.look.hide_backs);
    ImGui::MenuItem("Axes", nullptr, &desk.look.axes);
    const bool has_luminaires = !desk.luminaires.empty();
    ImGui::MenuItem("Luminaires", nullptr, &desk.look.luminaires, has_luminaires);
    ImGui::MenuItem("Polar curves", nullptr, &desk.look.polar_curves,
                    has_luminaires && desk.look.luminaires);
    if (ImGui::MenuItem("Larger text", "Ctrl++")) enlarge(desk, 1);
    if (ImGui::MenuItem("Smaller text", "Ctrl+-")) enlarge(desk, -1);
    ImGui::MenuItem("Panels", "Tab", &desk.shows_panels);
    ImGui::EndMenu();
  }
  if (is_narrow_) ImGui::MenuItem("Panels", nullptr, &is_called_);
  if (ImGui::BeginMenu("Help")) {
    if (ImGui::MenuItem("Tour")) show_tour(desk, 0);
    ImGui::MenuItem("Keys and mouse", "?", &desk.shows_help);
    ImGui::EndMenu();
  }
  ImGui::EndMainMenuBar();
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
  // What was asked is no measure of what has become of it: the patches' size counts, too.
  for (const std::string& text : {accuracy_text(session), asked_text(session)}) {
    if (!text.empty()) ImGui::TextWrapped("%s", text.c_str());
  }
}

void Panels::draw_status(Desk& desk, float top, float width, float height) {
  begin_panel("Status", 0, top, width, height);
  ConsolePanel::draw_edge(desk);
  draw_status_line(desk);
  console_.draw(desk);
  ImGui::End();
}

}  // namespace viewer
