#include "tests/support/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "tests/support/wait_until.h"

extern char** environ;

namespace radiosity::test {

std::string contents(const fs::path& path) {
  if (!fs::is_regular_file(path)) return "";
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Running::Running(const Arguments& arguments, fs::path folder) : folder_(std::move(folder)) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kCreate = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 1, (folder_ / "stdout").c_str(), kCreate, 0644);
  posix_spawn_file_actions_addopen(&actions, 2, (folder_ / "stderr").c_str(), kCreate, 0644);
  std::vector<char*> argv = {const_cast<char*>("radiosity")};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  const int error = posix_spawn(&pid_, RADIOSITY_PROGRAM, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  EXPECT_EQ(error, 0) << RADIOSITY_PROGRAM << ": " << std::strerror(error);
}

void Running::send(int signal) const { kill(pid_, signal); }

bool Running::has_told(const std::string& words) const {
  return wait_until([&] {
    return contents(folder_ / "stdout").find(words) != std::string::npos ||
           contents(folder_ / "stderr").find(words) != std::string::npos;
  });
}

Outcome Running::wait() const {
  int status = 0;
  waitpid(pid_, &status, 0);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  outcome.out = contents(folder_ / "stdout");
  outcome.err = contents(folder_ / "stderr");
  return outcome;
}

Program::Program() {
  fs::create_directory(folder() / "printed");
  fs::create_directory(folder() / "results");
}

nlohmann::json Program::json_of(Arguments arguments) const {
  arguments.emplace_back("--json");
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json();
}

nlohmann::json Program::solve(Arguments arguments) const {
  arguments.insert(arguments.begin(), "solve");
  return json_of(std::move(arguments));
}

std::vector<std::string> Program::results() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder() / "results")) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string Program::result(const std::string& name) const {
  return (folder() / "results" / name).string();
}

std::string Program::write_file(const std::string& name, const std::string& text) const {
  std::ofstream(folder() / name, std::ios::binary) << text;
  return (folder() / name).string();
}

std::string Program::write_cube(double reflectance, double radiance) const {
  std::ostringstream mtl;
  mtl << "newmtl wall\n";
  mtl << "Kd " << reflectance << ' ' << reflectance << ' ' << reflectance << '\n';
  mtl << "Ke " << radiance << ' ' << radiance << ' ' << radiance << '\n';
  write_file("cube.mtl", mtl.str());
  return write_file("cube.obj",
                    "mtllib cube.mtl\n"
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                    "usemtl wall\n"
                    "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n");
}

std::string without_warnings(const std::string& text) {
  std::istringstream stream(text);
  std::string rest;
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("radiosity: warning: ", 0) != 0) rest += line + '\n';
  }
  return rest;
}

void expect_error(const Outcome& outcome, int exit_code, const std::string& words) {
  const std::string error = without_warnings(outcome.err);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(error.find("radiosity: error: "), 0U) << outcome.err;
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(error.find(words), std::string::npos)
      << "expected '" << words << "' in: " << outcome.err;
}

}  // namespace radiosity::test
