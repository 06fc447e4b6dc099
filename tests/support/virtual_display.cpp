#include "tests/support/virtual_display.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

extern char** environ;

namespace radiosity::test {

VirtualDisplay::VirtualDisplay() {
  std::array<int, 2> channel{};
  if (pipe(channel.data()) != 0) return;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, channel[1], 3);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  // With -displayfd the server looks for a free number by itself and tells which; with -noreset it
  // does not begin anew, and refuse who comes meanwhile, whenever the last program has gone.
  std::array<const char*, 10> arguments = {"Xvfb",     "-displayfd",   "3",         "-screen",
                                           "0",        "1600x1200x24", "-nolisten", "tcp",
                                           "-noreset", nullptr};
  const int error =
      posix_spawnp(&pid_, "Xvfb", &actions, nullptr, const_cast<char**>(arguments.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(channel[1]);
  if (error == 0) {
    for (char letter = 0; read(channel[0], &letter, 1) == 1 && letter != '\n';) name_ += letter;
    if (!name_.empty()) {
      name_ = ":" + name_;
      setenv("DISPLAY", name_.c_str(), 1);
    }
  } else {
    pid_ = -1;
  }
  ::close(channel[0]);
}

VirtualDisplay::~VirtualDisplay() {
  if (pid_ <= 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
  unsetenv("DISPLAY");
}

}  // namespace radiosity::test
