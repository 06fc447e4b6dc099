#include "viewer/panels/input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viewer/desk/luminaires.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/picking.h"
#include "viewer/desk/pinning.h"
#include "viewer/desk/tour.h"
#include "viewer/draw/planned_picture.h"

namespace viewer {
namespace {

constexpr double kTurn = 3.0;          // radian for a drag over the picture's height
constexpr double kClick = 4;           // pixels at scale 1 that a hand may move in a click
constexpr double kZoomStep = 0.88;     // per notch of the wheel
constexpr double kWalk = 0.25;         // of the scene's size per second
constexpr double kFast = 4;            // times as fast with Shift
constexpr double kBarReach = 10;       // pixels around the colour bar, at scale 1
constexpr double kExposureStep = 0.5;  // stops
constexpr double kReach = 0.6;         // lines of text around the line beside pinned light

/// Whether a letter is held down, as ImGui counts keys.
bool is_down(int key) {
#if IMGUI_VERSION_NUM >= 18700
  assert(key >= GLFW_KEY_A && key <= GLFW_KEY_Z);
  return ImGui::IsKeyDown(static_cast<ImGuiKey>(ImGuiKey_A + (key - GLFW_KEY_A)));
#else
  return ImGui::IsKeyDown(key);  // as GLFW does
#endif
}

/// What a letter does for the picture.
void press_letter(Desk& desk, int key) {
  Look& look = desk.look;
  if (key == GLFW_KEY_F) fit_camera(desk);
  if (key == GLFW_KEY_C) use_scene_camera(desk);
  if (key == GLFW_KEY_Z) set_up(desk, desk.up == UpAxis::z ? UpAxis::y : UpAxis::z);
  if (key == GLFW_KEY_T) show(desk, "true-colour");
  if (key == GLFW_KEY_I) show(desk, "illuminance");
  if (key == GLFW_KEY_R) show(desk, "error");
  if (key == GLFW_KEY_X) show(desk, "form-factors");
  if (key == GLFW_KEY_L) show(desk, "arriving");
  if (key == GLFW_KEY_G) look.logarithmic = !look.logarithmic;
  if (key == GLFW_KEY_M) look.smooth = !look.smooth;
  if (key == GLFW_KEY_N) look.edges = !look.edges;
  if (key == GLFW_KEY_B) look.hide_backs = !look.hide_backs;
  if (key == GLFW_KEY_P) attempt(desk, [&] { pin(desk); });
  if (key == GLFW_KEY_V) compare_otherwise(desk);
  if (key == GLFW_KEY_K) take_tape(desk, !desk.tape.is_in_hand);
}

/// Asks the patch or chooses the luminaire at a place of the picture, lays an end of the tape
/// measure there or measures the light.
void click(Desk& desk, double x, double y) {
  if (desk.is_meter_in_hand) {
    add_meter_at(desk, x, y);
  } else if (!desk.tape.is_in_hand) {
    const auto luminaire = luminaire_at(desk, x, y);
    choose_luminaire(desk, luminaire == desk.chosen_luminaire ? std::nullopt : luminaire);
    if (!luminaire) desk.session.select(patch_at(desk, x, y));
  } else if (const auto point = point_at(desk, x, y)) {
    lay(desk.tape, *point);
  }
}

}  // namespace

void Input::handle(Desk& desk, Panels& panels, std::span<const KeyPress> keys, double scale) {
  handle_mouse(desk, scale);
  for (const KeyPress& key : keys) {
    const bool is_function_key = key.key >= GLFW_KEY_F1 && key.key <= GLFW_KEY_F12;
    if (is_function_key) desk.function_key = key.key - GLFW_KEY_F1 + 1;
  }
  if (ImGui::GetIO().WantCaptureKeyboard || Panels::is_popup_open()) return;
  for (const KeyPress& key : keys) press(desk, panels, key);
  // By the letter, since keyboards have them in different places.
  for (const ImWchar letter : ImGui::GetIO().InputQueueCharacters) {
    if (letter == '?') desk.shows_help = !desk.shows_help;
    if (letter == '+') desk.look.stops += kExposureStep;
    if (letter == '-') desk.look.stops -= kExposureStep;
  }
  fly(desk, keys);
}

/// Moves the line beside pinned light with the mouse. Whether the mouse is about that.
bool Input::drag_split(Desk& desk, double x, bool is_over) {
  if (shown_comparison(desk) != Comparison::wipe) return false;
  const double reach = kReach * ImGui::GetFontSize() / desk.region.width;
  const bool is_near = is_over && !is_dragging_ && std::abs(x - desk.pinning.split) < reach;
  if (is_near && ImGui::IsMouseClicked(0)) is_splitting_ = true;
  if (!ImGui::IsMouseDown(0)) is_splitting_ = false;
  if (is_splitting_) set_split(desk, x);
  if (is_near || is_splitting_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  return is_splitting_;
}

bool Input::handle_legend(Desk& desk, double scale) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsMouseDown(0)) held_end_.reset();
  const std::optional<LegendPlan> legend = planned_picture(desk, scale).legend;
  if (!legend) return held_end_.has_value();
  const auto around = static_cast<float>(kBarReach * scale);
  const Box& bar = legend->bar;
  const double position = legend->position(io.MousePos.y);
  const double reach = around / bar.height;
  const bool is_over =
      !io.WantCaptureMouse && !is_dragging_ && io.MousePos.x >= bar.left - around &&
      io.MousePos.x < bar.left + bar.width + around && position > -reach && position < 1 + reach;
  if (is_over || held_end_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  if (is_over && ImGui::IsMouseDoubleClicked(0)) {
    desk.look.range.reset();
    held_end_.reset();
  } else if (is_over && ImGui::IsMouseClicked(0)) {
    held_end_ = {position < 0.5 ? BarEnd::low : BarEnd::high, desk.legend->scale};
  } else if (held_end_ && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    desk.look.range = dragged_scale(held_end_->scale, held_end_->end, position);
  }
  return is_over || held_end_;
}

void Input::handle_mouse(Desk& desk, double scale) {
  const ImGuiIO& io = ImGui::GetIO();
  const Region& region = desk.region;
  if (region.width <= 0 || region.height <= 0) return;
  const double x = (static_cast<double>(io.MousePos.x) - region.left) / region.width;
  const double y = (static_cast<double>(io.MousePos.y) - region.top) / region.height;
  const bool is_at_legend = handle_legend(desk, scale);
  const bool is_over = !io.WantCaptureMouse && !is_at_legend && x >= 0 && x < 1 && y >= 0 && y < 1;
  const bool is_hovering = is_over && !is_dragging_;
  desk.hovered = is_hovering ? patch_at(desk, x, y) : std::nullopt;
  desk.hovered_luminaire = is_hovering ? luminaire_at(desk, x, y) : std::nullopt;
  desk.hovered_reading = is_hovering ? plane_value_at(desk, x, y) : std::nullopt;
  if (is_over && io.MouseWheel != 0) {
    desk.camera.zoom_to(point_towards(desk, x, y), std::pow(kZoomStep, io.MouseWheel));
  }
  if (drag_split(desk, x, is_over)) return;

  const bool is_down = ImGui::IsMouseDown(0) || ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
  const bool went_down =
      ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
  if (went_down) {
    is_dragging_ = is_over;
    dragged_ = 0;
    if (is_over) {
      grabbed_ = point_towards(desk, x, y);
      desk.camera.focus(grabbed_);  // shifted, it stays under the mouse
    }
  }
  if (is_dragging_ && ImGui::IsMouseReleased(0) && dragged_ < kClick * scale && is_over) {
    click(desk, x, y);
  }
  if (!is_down) is_dragging_ = false;
  if (!is_dragging_) return;
  if (went_down) return;  // how the mouse came here is no drag
  dragged_ += std::hypot(io.MouseDelta.x, io.MouseDelta.y);
  if (dragged_ < kClick * scale) return;
  const double right = static_cast<double>(io.MouseDelta.x) / region.height;
  const double up = -static_cast<double>(io.MouseDelta.y) / region.height;
  if (ImGui::IsMouseDown(2) || (ImGui::IsMouseDown(0) && io.KeyShift)) {
    desk.camera.pan(-right, -up);
  } else if (ImGui::IsMouseDown(1)) {
    desk.camera.look_around(kTurn / 2 * right, kTurn / 2 * up);
  } else {
    desk.camera.orbit_about(grabbed_, -kTurn * right, -kTurn * up);
  }
}

void Input::press(Desk& desk, Panels& panels, const KeyPress& key) {
  if (key.has_control) {
    if (key.key == GLFW_KEY_O) panels.choose_file(desk);
    if (key.key == GLFW_KEY_R && desk.session.is_open()) reload(desk);
    if (key.key == GLFW_KEY_EQUAL || key.key == GLFW_KEY_KP_ADD) enlarge(desk, 1);
    if (key.key == GLFW_KEY_MINUS || key.key == GLFW_KEY_KP_SUBTRACT) enlarge(desk, -1);
    if (key.key == GLFW_KEY_P) panels.begin_save(desk, SaveDialog::Kind::picture);
    const bool is_redo = key.key == GLFW_KEY_Y || (key.key == GLFW_KEY_Z && key.has_shift);
    if (is_redo) desk.session.redo_mix();
    if (key.key == GLFW_KEY_Z && !key.has_shift) desk.session.undo_mix();
    return;
  }
  press_letter(desk, key.key);
  if (key.key == GLFW_KEY_TAB) desk.shows_panels = !desk.shows_panels;
  if (key.key == GLFW_KEY_SPACE) desk.session.set_paused(!desk.session.is_paused());
  if (key.key == GLFW_KEY_ESCAPE) {
    if (desk.tour_step) {
      end_tour(desk);
    } else if (desk.shows_help) {
      desk.shows_help = false;
    } else if (desk.is_meter_in_hand) {
      desk.is_meter_in_hand = false;
    } else if (desk.tape.is_in_hand) {
      desk.tape = {};
    } else if (desk.chosen_luminaire) {
      desk.chosen_luminaire.reset();
    } else {
      desk.session.select(std::nullopt);
    }
  }
}

void Input::fly(Desk& desk, std::span<const KeyPress> keys) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!desk.session.is_open() || io.KeyCtrl) return;
  const auto is_wanted = [&](int key) {
    return is_down(key) || std::any_of(keys.begin(), keys.end(),
                                       [&](const KeyPress& press) { return press.key == key; });
  };
  const auto direction = [&](int forth, int back) {
    return (is_wanted(forth) ? 1.0 : 0.0) - (is_wanted(back) ? 1.0 : 0.0);
  };
  const double forward = direction(GLFW_KEY_W, GLFW_KEY_S);
  const double right = direction(GLFW_KEY_D, GLFW_KEY_A);
  const double up = direction(GLFW_KEY_E, GLFW_KEY_Q);
  if (forward == 0 && right == 0 && up == 0) return;
  const double size = desk.session.model().bounds.diagonal().norm();
  const double step = kWalk * size * io.DeltaTime * (io.KeyShift ? kFast : 1);
  desk.camera.fly(step * forward, step * right, step * up);
}

}  // namespace viewer
