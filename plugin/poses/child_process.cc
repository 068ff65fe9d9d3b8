// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <thread>

#include "colmap/files.h"

#ifdef __linux__
#include <sys/prctl.h>
#endif

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
    if (std::ranges::none_of(changes, [&](const auto& change) {
          return change.starts_with(name);
        })) {
      variables.push_back(variable);
    }
  }
  return variables;
}

// The words with a null pointer at the end; they must outlive it.
std::vector<char*> Pointers(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// What is made before the fork: after it, memory may not be asked for.
struct Prepared {
  explicit Prepared(const ChildProcess& child)
      : words{child.program.string()},
        variables(Environment(child.environment)),
        log(child.log_path.string()),
        folder(child.folder.string()) {
    words.insert(words.end(), child.arguments.begin(), child.arguments.end());
    argv = Pointers(words);
    envp = Pointers(variables);
  }
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  std::vector<std::string> words, variables;
  std::string log, folder;
  std::vector<char*> argv, envp;
};

// Opens `path` as the file `number`.
bool OpenAs(int number, const char* path, int flags) {
  const int file = open(path, flags, kLogMode);
  if (file < 0 || file == number) return file == number;
  const bool is_done = dup2(file, number) == number;
  close(file);
  return is_done;
}

// Lets the kernel end this process, `parent`'s child, when that ends, however
// it does; elsewhere than on Linux it then goes on.
bool EndWith([[maybe_unused]] pid_t parent) {
#ifdef __linux__
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) return false;
  if (getppid() != parent) _exit(EXIT_FAILURE);  // it has ended before
#endif
  return true;
}

// The child after the fork; comes back only with errno set.
void BecomeProgram(const Prepared& prepared, pid_t parent) {
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) {
    std::signal(signal, SIG_DFL);
  }
  if (setpgid(0, 0) != 0 || !EndWith(parent) ||
      !OpenAs(STDIN_FILENO, "/dev/null", O_RDONLY) ||
      !OpenAs(
          STDOUT_FILENO, prepared.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC) ||
      dup2(STDOUT_FILENO, STDERR_FILENO) < 0 ||
      chdir(prepared.folder.c_str()) != 0) {
    return;
  }
  execve(prepared.argv[0], prepared.argv.data(), prepared.envp.data());
}

// The error of the child, which it writes before it ends; 0 if the program has
// taken its place, which closes the pipe.
int ErrorOfChild(int pipe_end) {
  int error = 0;
  ssize_t size = 0;
  do {
    size = read(pipe_end, &error, sizeof(error));
  } while (size < 0 && errno == EINTR);
  return size == sizeof(error) ? error : 0;
}

// 0 or an error.
int Start(const ChildProcess& child, pid_t* pid) {
  const Prepared prepared(child);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return errno;
  const pid_t parent = getpid();
  *pid = fork();
  if (*pid == 0) {
    BecomeProgram(prepared, parent);
    const int error = errno;
    [[maybe_unused]] const auto written = write(ends[1], &error, sizeof(error));
    _exit(EXIT_FAILURE);
  }
  const int fork_error = errno;
  close(ends[1]);
  const int error = *pid < 0 ? fork_error : ErrorOfChild(ends[0]);
  close(ends[0]);
  if (*pid > 0 && error != 0) waitpid(*pid, nullptr, 0);
  return error;
}

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
  pid_t pid = 0;
  const int error = Start(child, &pid);
  if (error != 0) {
    return Status::ExternalTool("cannot start " + child.program.string() +
                                " (" + std::generic_category().message(error) +
                                ")");
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
  return IsFile(path) && access(path.c_str(), X_OK) == 0;
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
