#include "viewer/view.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <thread>
#include <utility>

#include "io/base/output_check.h"
#include "io/picture/image_file.h"
#include "radiosity/base/error.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/picture_words.h"
#include "viewer/desk/tour.h"
#include "viewer/draw/backdrop.h"
#include "viewer/draw/comparison_overlay.h"
#include "viewer/draw/grid_overlay.h"
#include "viewer/draw/guides.h"
#include "viewer/draw/luminaire_overlay.h"
#include "viewer/draw/overlay.h"
#include "viewer/draw/painter.h"
#include "viewer/draw/pinned_view.h"
#include "viewer/draw/plane_painter.h"
#include "viewer/draw/window.h"
#include "viewer/panels/input.h"
#include "viewer/panels/panels.h"
#include "viewer/script/script.h"

namespace viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFrameSeconds = 1.0 / 60;
// While something is computed and OpenGL takes the processor's time too.
constexpr double kFrugalFrameSeconds = 1.0 / 36;
constexpr double kIdleSeconds = 0.1;      // between looks at the background while nothing moves
constexpr int kLivelyFrames = 4;          // after each event, until all widgets have settled
constexpr int kFewFrames = 2;             // after news from the background
constexpr int kScreenshotFrames = 3;      // likewise, before a picture of the window
constexpr std::size_t kMostTimes = 4096;  // frames

/// Beside the recent files; empty if there is no place for such things.
std::filesystem::path first_visit_file() {
  const std::filesystem::path recent = RecentFiles::default_file();
  return recent.empty() ? recent : recent.parent_path() / "toured";
}

std::string window_title(const Session& session) {
  if (!session.is_open()) return "radiosity";
  return std::filesystem::path(session.model().path).filename().string() + " - radiosity";
}

/// The window with all that is in it.
class Application final : public ScriptHost {
 public:
  explicit Application(const ViewOptions& options)
      : options_(options),
        window_({.width = options.width, .height = options.height, .scale = options.scale}),
        desk_(options.solving, options.reading),
        panels_(options.solving) {
    desk_.asked_up = options.up;
    desk_.scale = window_.scale();
    desk_.examples.find(options.examples);
    if (options.path) desk_.kept_files.emplace_back(*options.path);
    if (!options.script) return;
    script_.emplace(*options.script);
    desk_.kept_files.push_back(*options.script);
    for (const std::string& output : script_->outputs()) {
      io::check_not_input(output, desk_.kept_files);
      io::check_writable(output);
    }
  }

  // All tasks are asked to end at once, else each would go on until the one before has ended.
  ~Application() {
    window_.hide();
    desk_.session.stop();
  }
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;

  void run() {
    if (options_.path) open(*options_.path);
    while (!window_.is_closing()) {
      if (options_.stop.stop_requested()) throw radiosity::Interrupted();
      if (attend()) draw_frame();
      if (script_) script_->advance(desk_, *this);
      if (has_finished()) return;
    }
  }

  void open(const std::string& path) override { desk_.session.open(path); }
  void resize(int width, int height) override { window_.resize(width, height); }
  [[nodiscard]] std::vector<double> frame_times() const override {
    return {frame_times_.begin(), frame_times_.end()};
  }
  void forget_frame_times() override { frame_times_.clear(); }

 private:
  /// Takes in what has happened, waiting for it if there is nothing to do. Whether there is
  /// something to draw.
  bool attend() {
    if (window_.handle_events(waiting_time())) lively_ = kLivelyFrames;
    for (const std::string& path : window_.take_dropped_files()) open(path);
    if (update(desk_)) lively_ = std::max(lively_, kFewFrames);
    if (painter_.update()) lively_ = std::max(lively_, kFewFrames);
    if (opened_ != desk_.session.versions().file) {
      opened_ = desk_.session.versions().file;
      window_.set_title(window_title(desk_.session));
      if (!is_unattended()) {
        panels_.remember(desk_.session.model().path);
        if (is_first_visit(first_visit_file())) show_tour(desk_, 0);
      }
    }
    // The status line tells how far the work is.
    const bool is_working = (!desk_.session.is_idle() && !desk_.session.is_paused()) ||
                            painter_.is_busy() || is_measuring(desk_);
    return is_hurried() || (window_.is_shown() && is_working);
  }

  void draw_frame() {
    if (desk_.wanted_scale) window_.set_scale(*std::exchange(desk_.wanted_scale, std::nullopt));
    desk_.scale = window_.scale();
    window_.begin_frame();
    const auto start = Clock::now();
    lively_ = std::max(0, lively_ - 1);
    const std::vector<KeyPress> keys = window_.take_keys();
    input_.handle(desk_, panels_, keys, window_.scale());
    panels_.draw(desk_, keys, window_.width(), window_.height(), window_.scale());
    painter_.paint(desk_, view_);
    plane_painter_.paint(desk_, view_);
    SceneView* pinned = pinned_view_.paint(desk_);
    const double split = pinned != nullptr ? drawn_split(desk_) : 0;
    view_.set_region(desk_.region, window_.width(), window_.height(), {.left = split});
    views_ = {&view_};
    if (pinned != nullptr) {
      pinned->set_region(desk_.region, window_.width(), window_.height(), {.right = split});
      views_.push_back(pinned);
    }
    const bool is_frugal =
        window_.is_software() && (!desk_.session.is_idle() || is_measuring(desk_));
    const bool is_dirty = view_.is_dirty() || (pinned != nullptr && pinned->is_dirty());
    const bool is_moving = window_.is_software() && is_dirty && !desk_.screenshot;
    window_.set_antialiased(!is_frugal && !is_moving && painter_.is_exact());
    // It knows patches only.
    const bool has_still = !is_plane(desk_.look.show);
    backdrop_.draw(has_still ? painter_.still() : nullptr, desk_.region);
    guides_.draw(desk_, window_.scale());
    draw_comparison(desk_, window_.scale());
    draw_luminaires(desk_, window_.scale());
    draw_grid_points(desk_, window_.scale());
    draw_overlay(desk_, window_.scale());
    draw_axes(desk_, window_.scale());
    if (desk_.copied) window_.copy(*std::exchange(desk_.copied, std::nullopt));
    finish_frame();
    const auto end = Clock::now();
    frame_times_.push_back(std::chrono::duration<double, std::milli>(end - last_frame_).count());
    if (frame_times_.size() > kMostTimes) frame_times_.pop_front();
    last_frame_ = end;
    const double wanted = is_frugal ? kFrugalFrameSeconds : kFrameSeconds;
    const double left = wanted - std::chrono::duration<double>(end - start).count();
    // Screens without a beat of their own do not need more frames than others.
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
  }

  /// Shows the frame; the second or third one after a screenshot was asked for is written.
  void finish_frame() {
    if (!desk_.screenshot) {
      screenshot_frames_ = 0;
      window_.end_frame(views_);
      return;
    }
    lively_ = kLivelyFrames;
    const bool is_ready = painter_.is_done(desk_) || !desk_.session.is_settled();
    if (++screenshot_frames_ < kScreenshotFrames || !is_ready) {
      window_.end_frame(views_);
      return;
    }
    const io::RgbPicture picture = window_.end_captured_frame(views_);
    const std::string file = *std::exchange(desk_.screenshot, std::nullopt);
    save_screenshot(picture, file);
  }

  void save_screenshot(const io::RgbPicture& picture, const std::string& file) {
    try {
      check_output(desk_, file);
      if (picture.bytes.empty()) throw radiosity::OutputError(file + ": the window has no size");
      io::write_png(file, picture);
      desk_.session.tell("saved " + file);
    } catch (const radiosity::OutputError& error) {
      if (is_unattended()) throw;
      desk_.session.tell_error(error.what());
    }
  }

  [[nodiscard]] bool is_unattended() const { return options_.script || options_.screenshot; }

  /// Whether the next frame is wanted as soon as possible.
  [[nodiscard]] bool is_hurried() const {
    return is_unattended() ||
           (window_.is_shown() && (lively_ > 0 || desk_.watching.is_playing || desk_.screenshot));
  }

  /// Seconds to wait for mouse and keyboard before the next look.
  [[nodiscard]] double waiting_time() const {
    if (is_hurried()) return 0;
    return painter_.is_busy() ? kFrugalFrameSeconds : kIdleSeconds;
  }

  /// Whether the script, and then the screenshot, are done.
  bool has_finished() {
    if (!is_unattended() || (script_ && !script_->has_ended())) return false;
    if (!options_.screenshot) return true;
    if (!script_ && !desk_.session.is_settled()) return false;
    if (!script_ && !is_solved(desk_.session)) fail_unsolved();
    if (!is_last_asked_) desk_.screenshot = options_.screenshot->string();
    return std::exchange(is_last_asked_, true) && !desk_.screenshot;
  }

  /// A picture of the window shall show no preview as if it were the result.
  [[noreturn]] void fail_unsolved() const {
    const auto& messages = desk_.session.messages();
    throw radiosity::SceneError(messages.empty() ? "there is no scene to show"
                                                 : messages.back().text);
  }

  ViewOptions options_;
  Window window_;
  SceneView view_;
  PinnedView pinned_view_;
  std::vector<SceneView*> views_;  // that are drawn
  Backdrop backdrop_;
  Guides guides_;
  Painter painter_;
  PlanePainter plane_painter_;
  Desk desk_;
  Panels panels_;
  Input input_;
  std::optional<Script> script_;
  std::deque<double> frame_times_;  // ms
  Clock::time_point last_frame_ = Clock::now();
  int opened_ = 0;  // Session::Versions::file that the title tells
  int lively_ = kLivelyFrames;
  int screenshot_frames_ = 0;
  bool is_last_asked_ = false;
};

}  // namespace

void view(const ViewOptions& options) { Application(options).run(); }

}  // namespace viewer
