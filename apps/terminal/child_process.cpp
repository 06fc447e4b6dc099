#include "apps/terminal/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "radiosity/base/error.h"

namespace apps {
namespace {

/// Exit code of a process whose program could not be started, as shells have it.
constexpr int kNotStarted = 127;

/// Puts an open file in place of a standard stream. Between fork and exec: system calls only.
void replace_stream(int stream, const char* path, int flags) {
  const int file = ::open(path, flags, 0666);
  if (file < 0 || ::dup2(file, stream) < 0) ::_exit(kNotStarted);
  if (file != stream) ::close(file);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::filesystem::path& folder, const std::filesystem::path& out,
                           const std::filesystem::path& err)
    : start_(std::chrono::steady_clock::now()) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<std::string> words{"radiosity"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) {
    throw radiosity::OutputError(
        fmt::format("cannot start another process: {}", std::strerror(errno)));
  }
  if (pid_ > 0) return;
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(kNotStarted);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  replace_stream(STDIN_FILENO, "/dev/null", O_RDONLY);
  replace_stream(STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  replace_stream(STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  if (!folder.empty() && ::chdir(folder.c_str()) != 0) ::_exit(kNotStarted);
  ::execv(program.c_str(), argv.data());
  ::_exit(kNotStarted);
}

ChildProcess::~ChildProcess() {
  if (end_) return;
  kill();
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
}

std::optional<ProcessEnd> ChildProcess::poll() {
  if (end_) return end_;
  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, WNOHANG, &usage) != pid_) return std::nullopt;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  end_ = ProcessEnd{.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
                    .seconds = elapsed.count(),
                    .peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
  return end_;
}

void ChildProcess::stop() const { ::kill(pid_, SIGTERM); }

void ChildProcess::kill() const { ::kill(pid_, SIGKILL); }

}  // namespace apps
