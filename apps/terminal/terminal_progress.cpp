#include "apps/terminal/terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "io/base/printable.h"

namespace apps {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr int kBarWidth = 24;
constexpr double kFirstRate = 0.2;  // s; before that, rate and time left mean little

std::string with_prefix(double value) {
  constexpr std::array<const char*, 5> kPrefixes = {"", "k", "M", "G", "T"};
  std::size_t k = 0;
  for (; value >= 1000 && k + 1 < kPrefixes.size(); ++k) value /= 1000;
  return fmt::format("{:.3g} {}", value, kPrefixes[k]);
}

std::string as_time(double time) {
  const auto seconds = static_cast<long>(std::ceil(time));
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{} min {:02} s", seconds / 60, seconds % 60);
  return fmt::format("{} h {:02} min", seconds / 3600, seconds / 60 % 60);
}

}  // namespace

std::string one_line(std::string_view message) { return io::printable(message); }

TerminalProgress::Style TerminalProgress::fitting_style() {
  return ::isatty(STDERR_FILENO) != 0 ? Style::bar : Style::lines;
}

TerminalProgress::~TerminalProgress() { clear_bar(); }

void TerminalProgress::report(std::string_view stage, double done, double total,
                              std::string_view unit) {
  if (style_ == Style::none) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  // The same stage begins anew, with another amount of work or once all of it was done.
  const bool is_anew = done < stage_done_ && (total != stage_total_ || stage_told_);
  if (stage != stage_ || is_anew) start_stage(stage, done, now);
  stage_done_ = done;
  stage_total_ = total;
  const bool ended = total > 0 && done >= total;
  if (ended && stage_told_) return;
  const auto interval = style_ == Style::bar ? Clock::duration(kRedrawInterval) : kLineInterval;
  if (!ended && now - last_drawn_ < interval) return;
  last_drawn_ = now;
  stage_told_ = ended;
  if (style_ == Style::bar) {
    draw_bar(done, total, unit);
  } else {
    print_line(done, total, unit);
  }
}

void TerminalProgress::warn(std::string_view message) {
  const std::lock_guard lock(mutex_);
  clear_bar();
  warnings_.push_back(one_line(message));
  fmt::print(stderr, "radiosity: warning: {}\n", warnings_.back());
}

/// "45 %, 1.2 Mpairs/s, 12 s left"
std::string TerminalProgress::describe(double done, double total, std::string_view unit) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - stage_start_).count();
  std::string text;
  if (total > 0) text += fmt::format("{:.0f} %", 100 * std::min(done / total, 1.0));
  const double rate = seconds > kFirstRate ? (done - stage_base_) / seconds : 0;
  if (rate > 0) text += fmt::format("{}{}{}/s", text.empty() ? "" : ", ", with_prefix(rate), unit);
  if (rate > 0 && total > done) {
    text += fmt::format(", {} left", as_time((total - done) / rate));
  } else if (total > 0 && done >= total) {
    text += fmt::format(", took {:.2f} s", seconds);
  }
  return text;
}

void TerminalProgress::start_stage(std::string_view stage, double done, Clock::time_point now) {
  if (stage_told_ && bar_visible_) {
    // The finished bar of the stage before stays on the screen.
    fmt::print(stderr, "\n");
    bar_visible_ = false;
  }
  stage_ = stage;
  stage_start_ = now;
  stage_base_ = done;
  // A bar shows at once; a line only after some time, or when the stage has ended.
  last_drawn_ = style_ == Style::bar ? now - kRedrawInterval : now;
  stage_told_ = false;
}

void TerminalProgress::draw_bar(double done, double total, std::string_view unit) {
  const double share = total > 0 ? std::clamp(done / total, 0.0, 1.0) : 0;
  const auto filled = static_cast<int>(share * kBarWidth);
  fmt::print(stderr, "\r\x1b[K{:<14} [{:#<{}}{:.<{}}] {}", stage_, "", filled, "",
             kBarWidth - filled, describe(done, total, unit));
  std::fflush(stderr);
  bar_visible_ = true;
}

void TerminalProgress::print_line(double done, double total, std::string_view unit) const {
  fmt::print(stderr, "radiosity: {}: {}\n", stage_, describe(done, total, unit));
}

void TerminalProgress::clear_bar() {
  if (!bar_visible_) return;
  fmt::print(stderr, "{}", stage_told_ ? "\n" : "\r\x1b[K");
  std::fflush(stderr);
  bar_visible_ = false;
}

}  // namespace apps
