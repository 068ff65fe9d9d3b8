// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace curvix {
namespace {

namespace fs = std::filesystem;

constexpr auto kPollInterval = std::chrono::milliseconds(20);
constexpr mode_t kLogMode = 0644;

// That of this process, with `changes`.
std::vector<std::string> Environment(const std::vector<std::string>& changes) {
  std::vector<std::string> variables = changes;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string variable = *entry;
    const std::string name = variable.substr(0, variable.find('=') + 1);
    if (std::none_of(changes.begin(), changes.end(), [&](const auto& change) {
          return change.starts_with(name);
        })) {
      variables.push_back(variable);
    }
  }
  return variables;
}

// What posix_spawn is told; cleans up after itself.
class SpawnSetup {
 public:
  explicit SpawnSetup(const ChildProcess& child) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    const std::string log = child.log_path.string();
    const std::string folder = child.folder.string();
    Check(posix_spawn_file_actions_addopen(
        &actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0));
    Check(posix_spawn_file_actions_addopen(&actions_,
                                           STDOUT_FILENO,
                                           log.c_str(),
                                           O_WRONLY | O_CREAT | O_TRUNC,
                                           kLogMode));
    Check(posix_spawn_file_actions_adddup2(
        &actions_, STDOUT_FILENO, STDERR_FILENO));
    Check(posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str()));
    sigset_t defaults;
    sigemptyset(&defaults);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) {
      sigaddset(&defaults, signal);
    }
    Check(posix_spawnattr_setsigdefault(&attributes_, &defaults));
    Check(posix_spawnattr_setpgroup(&attributes_, 0));
    Check(posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF));
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;

  // 0, or the error of the first step that failed.
  int error() const { return error_; }

  int Spawn(const ChildProcess& child, pid_t* pid) const {
    std::vector<std::string> words = {child.program.string()};
    words.insert(words.end(), child.arguments.begin(), child.arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::vector<std::string> variables = Environment(child.environment);
    std::vector<char*> envp;
    for (std::string& variable : variables) envp.push_back(variable.data());
    envp.push_back(nullptr);
    return posix_spawn(
        pid, argv[0], &actions_, &attributes_, argv.data(), envp.data());
  }

 private:
  void Check(int error) {
    if (error_ == 0) error_ = error;
  }

  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
  int error_ = 0;
};

bool HasExited(pid_t pid) {
  siginfo_t info = {};
  const int options = WEXITED | WNOHANG | WNOWAIT;
  const int failed = waitid(P_PID, static_cast<id_t>(pid), &info, options);
  return failed == 0 ? info.si_pid == pid : errno != EINTR;
}

// Waits for the child's own end, which is kExited, or says why not to.
ChildEnd::Kind Wait(pid_t pid, const ChildProcess& child) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  while (!HasExited(pid)) {
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    if (elapsed.count() > child.timeout_s) return ChildEnd::Kind::kTimedOut;
    if (!child.keep_going()) return ChildEnd::Kind::kStopped;
    std::this_thread::sleep_for(kPollInterval);
  }
  return ChildEnd::Kind::kExited;
}

}  // namespace

Result<ChildEnd> RunChildProcess(const ChildProcess& child) {
  const SpawnSetup setup(child);
  pid_t pid = 0;
  int error = setup.error();
  if (error == 0) error = setup.Spawn(child, &pid);
  if (error != 0) {
    return Status(StatusCode::kExternalTool,
                  "cannot start " + child.program.string() + " (" +
                      std::generic_category().message(error) + ")");
  }
  ChildEnd end{Wait(pid, child), 0};
  // Before the child is reaped: until then its number is that of no other
  // group.
  kill(-pid, SIGKILL);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (end.kind != ChildEnd::Kind::kExited) return end;
  if (WIFSIGNALED(status)) {
    return ChildEnd{ChildEnd::Kind::kKilled, WTERMSIG(status)};
  }
  return ChildEnd{ChildEnd::Kind::kExited, WEXITSTATUS(status)};
}

bool IsProgram(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

fs::path FindInPath(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path program = fs::absolute(fs::path(folder) / name);
    if (IsProgram(program)) return program;
  }
  return {};
}

}  // namespace curvix
