#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace apps {

/// Tells on stderr how work goes on: a bar on a terminal, otherwise a plain line every few seconds
/// and at the end of each stage. Also prints warnings, and keeps them for the summary.
class TerminalProgress {
 public:
  enum class Style { none, lines, bar };

  /// A bar if stderr is a terminal, else lines.
  static Style fitting_style();

  explicit TerminalProgress(Style style) : style_(style) {}
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// Work stands at `done` of `total` (0 if unknown), counted in `unit`. The rate counts from the
  /// first report of a stage on; a stage may be gone through again, with less done of another
  /// amount. Callable from any thread.
  void report(std::string_view stage, double done, double total, std::string_view unit);

  /// Prints "radiosity: warning: ..." and keeps the message. Also when the style is `none`.
  void warn(std::string_view message);

  /// All messages so far.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  using Clock = std::chrono::steady_clock;

  void start_stage(std::string_view stage, double done, Clock::time_point now);
  [[nodiscard]] std::string describe(double done, double total, std::string_view unit) const;
  void draw_bar(double done, double total, std::string_view unit);
  void print_line(double done, double total, std::string_view unit) const;
  void clear_bar();

  Style style_;
  std::mutex mutex_;
  std::string stage_;
  Clock::time_point stage_start_;
  double stage_done_ = 0;   ///< as last reported
  double stage_total_ = 0;  ///< likewise
  double stage_base_ = 0;   ///< what was done when the stage started, by an earlier run perhaps
  Clock::time_point last_drawn_;
  bool stage_told_ = false;   ///< the end of the stage has been printed
  bool bar_visible_ = false;  ///< the cursor stands on a line with a bar
  std::vector<std::string> warnings_;
};

/// The message as it may go to the terminal, in one line (io::printable).
std::string one_line(std::string_view message);

}  // namespace apps
