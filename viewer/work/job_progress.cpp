#include "viewer/work/job_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viewer {
namespace {

constexpr std::string_view kFormFactors = "form factors";
constexpr std::string_view kDividing = "dividing";
constexpr std::string_view kRoughFactors = "rough form factors";
// What a stage takes of the time that is left, as a guess. Form factors take most of it.
constexpr double kFormFactorShare = 0.8;
constexpr double kRoughShare = 0.15;
constexpr double kOtherShare = 0.4;
constexpr double kRoundFormFactorShare = 0.12;  // as there may be ten rounds
constexpr double kRoundOtherShare = 0.04;
constexpr double kShortShare = 0.1;  // of those that do not tell how far they are, and dividing
constexpr double kUsual = 10;        // s, in which such a stage is taken to be half done
constexpr double kFirstGuess = 1;    // s, before which the time left is not guessed
constexpr double kLeastDone = 0.02;  // likewise

/// In the words of a person who does not know the program's stages.
std::string stage_name(const std::string& stage) {
  if (stage == "solve") return "light";
  if (stage == kRoughFactors) return "form factors, roughly at first";
  if (stage == "errors") return "errors from the form factors";
  if (stage == kDividing) return "dividing into patches";
  if (stage == "patch size") return "errors from the patches' size";
  return stage.empty() ? "getting ready" : stage;
}

}  // namespace

void JobProgress::begin_stage(const WorkStatus& status, double now) {
  stage_ = status.stage;
  begun_ = now;
  done_ = 0;
  done_before_ = fraction_;
  if (stage_ == kFormFactors) ++round_;
}

void JobProgress::update(const WorkStatus& status, double now) {
  if (!status.is_busy) {
    *this = {};
    return;
  }
  now_ = now;
  is_silent_ = !(status.total > 0);
  double done = is_silent_ ? 0 : std::clamp(status.done / status.total, 0.0, 1.0);
  const bool is_again = !is_silent_ && done < done_ / 2;
  if (!is_busy_ || status.stage != stage_ || is_again) begin_stage(status, now);
  is_busy_ = true;
  // Slower and slower, so that the bar tells that it is alive, and is never full.
  if (is_silent_) done = (now - begun_) / (now - begun_ + kUsual);
  done_ = std::max(done_, done);
  const bool is_long = stage_ == kFormFactors;
  const bool is_rough = stage_ == kRoughFactors;
  const bool is_short = is_silent_ || stage_ == kDividing;
  const double share = is_short      ? kShortShare
                       : has_rounds_ ? (is_long ? kRoundFormFactorShare : kRoundOtherShare)
                       : is_long     ? kFormFactorShare
                       : is_rough    ? kRoughShare
                                     : kOtherShare;
  fraction_ = std::max(fraction_, done_before_ + (1 - done_before_) * share * done_);
}

std::string JobProgress::text() const {
  if (!is_busy_) return "";
  const bool is_in_round = has_rounds_ && round_ > 0;
  std::string text = is_in_round ? fmt::format("round {}: ", round_) : "";
  text += stage_name(stage_);
  const double spent = now_ - begun_;
  if (is_silent_) {
    return spent < kFirstGuess ? text : text + fmt::format(", {} so far", duration_text(spent));
  }
  if (done_ > 0) text += fmt::format(" {:.0f} %", 100 * done_);
  if (spent < kFirstGuess || done_ < kLeastDone || done_ >= 1) return text;
  return text + fmt::format(", about {}{} left", duration_text(spent * (1 - done_) / done_),
                            is_in_round ? " of this round" : "");
}

std::string duration_text(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 3600;
  if (seconds < 10) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 1.5 * kMinute) return fmt::format("{:.0f} s", 5 * std::round(seconds / 5));
  if (seconds < 1.5 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return fmt::format("{:.0f} h", seconds / kHour);
}

}  // namespace viewer
