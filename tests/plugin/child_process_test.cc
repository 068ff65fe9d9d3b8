// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/child_process.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

class ChildProcessTest : public testing::Test {
 protected:
  // A child that runs `commands`.
  ChildProcess Shell(const std::string& commands) {
    return {"/bin/sh",
            {"-c", commands},
            folder_.path(),
            folder_.path() / "log",
            60,
            [] { return true; }};
  }
  std::string Read(const std::string& name) {
    std::ifstream file(folder_.path() / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Whether the process whose number is in the file `name` is gone soon.
  bool IsGone(const std::string& name) {
    const pid_t pid = std::stoi(Read(name));
    for (int i = 0; i < 200; ++i) {
      if (kill(pid, 0) != 0) return true;
      // An orphan that nobody has reaped yet is gone, too.
      std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
      std::string number, command, state;
      if (stat >> number >> command >> state && state == "Z") return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  TemporaryFolder folder_;
};

TEST_F(ChildProcessTest, TakesDownWhatItSaysAndTheExitCode) {
  const auto end = RunChildProcess(Shell("pwd; echo oops >&2; cat; exit 7"));
  ASSERT_TRUE(end.ok()) << end.status().message();
  EXPECT_EQ(end->kind, ChildEnd::Kind::kExited);
  EXPECT_EQ(end->code, 7);
  EXPECT_EQ(Read("log"), folder_.path().string() + "\noops\n");
}

TEST_F(ChildProcessTest, PassesArgumentsWithoutAShell) {
  ChildProcess child = Shell("");
  child.program = "/bin/echo";
  child.arguments = {"$HOME", "a b", "*", "'"};
  ASSERT_TRUE(RunChildProcess(child).ok());
  EXPECT_EQ(Read("log"), "$HOME a b * '\n");
}

TEST_F(ChildProcessTest, HasTheEnvironmentOfThisProcessWithChanges) {
  ASSERT_EQ(setenv("CURVIX_KEPT", "kept", 1), 0);
  ASSERT_EQ(setenv("CURVIX_CHANGED", "before", 1), 0);
  ChildProcess child =
      Shell("env | grep ^CURVIX_CHANGED; echo $CURVIX_KEPT $CURVIX_NEW");
  child.environment = {"CURVIX_CHANGED=after", "CURVIX_NEW=new"};
  ASSERT_TRUE(RunChildProcess(child).ok());
  EXPECT_EQ(Read("log"), "CURVIX_CHANGED=after\nkept new\n");
}

// Even if this process is killed, which runs none of its code.
TEST_F(ChildProcessTest, EndsWithThisProcess) {
  const pid_t parent = fork();
  if (parent == 0) {
    RunChildProcess(Shell("echo $$ > part; mv part pid; exec sleep 60")).ok();
    _exit(0);
  }
  while (Read("pid").empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(parent, SIGKILL);
  ASSERT_EQ(waitpid(parent, nullptr, 0), parent);
  EXPECT_TRUE(IsGone("pid"));
}

TEST_F(ChildProcessTest, TellsTheSignal) {
  const auto end = RunChildProcess(Shell("kill -ABRT $$"));
  ASSERT_TRUE(end.ok());
  EXPECT_EQ(end->kind, ChildEnd::Kind::kKilled);
  EXPECT_EQ(end->code, SIGABRT);
}

TEST_F(ChildProcessTest, EndsTheChildAndItsChildrenAtTheTimeLimit) {
  ChildProcess child =
      Shell("trap '' TERM INT; sleep 600 & echo $! > grandchild; wait");
  child.timeout_s = 0.5;
  const auto end = RunChildProcess(child);
  ASSERT_TRUE(end.ok());
  EXPECT_EQ(end->kind, ChildEnd::Kind::kTimedOut);
  EXPECT_TRUE(IsGone("grandchild"));
}

TEST_F(ChildProcessTest, EndsTheChildWhenAskedTo) {
  ChildProcess child = Shell("echo $$ > child; sleep 600");
  child.keep_going = [&] { return Read("child").empty(); };
  const auto end = RunChildProcess(child);
  ASSERT_TRUE(end.ok());
  EXPECT_EQ(end->kind, ChildEnd::Kind::kStopped);
  EXPECT_TRUE(IsGone("child"));
}

TEST_F(ChildProcessTest, LeavesNothingBehindAChildThatEnds) {
  const auto end = RunChildProcess(Shell("sleep 600 & echo $! > grandchild"));
  ASSERT_TRUE(end.ok());
  EXPECT_EQ(end->kind, ChildEnd::Kind::kExited);
  EXPECT_TRUE(IsGone("grandchild"));
}

TEST_F(ChildProcessTest, SaysWhatCannotBeStarted) {
  ChildProcess child = Shell("");
  child.program = folder_.path() / "nothing";
  const auto end = RunChildProcess(child);
  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.status().code(), StatusCode::kExternalTool);
  EXPECT_THAT(end.status().message(), testing::HasSubstr("nothing"));
}

TEST_F(ChildProcessTest, FindsProgramsOnly) {
  EXPECT_TRUE(FindInPath("sh").is_absolute());
  EXPECT_EQ(FindInPath("no such program"), "");
  EXPECT_TRUE(IsProgram("/bin/sh"));
  EXPECT_FALSE(IsProgram(folder_.path()));
  EXPECT_FALSE(IsProgram(folder_.Write("text", "")));
}

}  // namespace
}  // namespace curvix
