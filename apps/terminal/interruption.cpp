#include "apps/terminal/interruption.h"

#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <chrono>

namespace apps {
namespace {

// Stages look at their stop token several times a second; those that cannot get this long.
constexpr auto kGrace = std::chrono::milliseconds(800);
constexpr auto kPoll = std::chrono::milliseconds(20);

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void wait_for_signal() {
  const sigset_t signals = watched_signals();
  int signal = 0;
  sigwait(&signals, &signal);
}

/// Whether a signal arrives within the time given.
bool signal_within(std::chrono::milliseconds time) {
  const sigset_t signals = watched_signals();
  const timespec timeout{0, std::chrono::nanoseconds(time).count()};
  return sigtimedwait(&signals, nullptr, &timeout) > 0;
}

}  // namespace

Interruption::Interruption() {
  // Threads started later inherit the blocked signals, so only the watcher ever gets them.
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::thread([this] { watch(); });
}

Interruption::~Interruption() {
  finished_ = true;
  // Blocked everywhere, it does no more than wake the watcher.
  pthread_kill(watcher_.native_handle(), SIGTERM);  // NOLINT(bugprone-bad-signal-to-kill-thread)
  watcher_.join();
}

void Interruption::advise(const std::string& line) {
  const std::lock_guard lock(telling_);
  message_ = "radiosity: interrupted\nradiosity: " + line + "\n";
}

void Interruption::tell() {
  const std::lock_guard lock(telling_);
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message_.data(), message_.size());
}

void Interruption::watch() {
  wait_for_signal();
  if (finished_) return;
  source_.request_stop();
  for (auto time = kGrace; !signal_within(time) && !writing_.try_lock(); time = kPoll) {
  }
  if (finished_) return;
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, "\n", 1);
  tell();
  ::_exit(kInterruptedExit);
}

}  // namespace apps
