// SPDX-License-Identifier: BSD-3-Clause
// Runs that something happens to: they are killed, or lack space, memory or
// rights. After each, the earlier results are there, and the next run succeeds.
//
// CURVIX_FAULT_ROUNDS says how many times each fault strikes; 4 if it is not
// set. tests/end_to_end/faults.sh does it often.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>
#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "gmock/gmock.h"
#include "plugin/base/staged_output.h"
#include "tests/end_to_end/run_program.h"
#include "tests/end_to_end/small_workspace.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/plugin/posed_points.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

using Results = std::map<std::string, std::string>;

int NumRounds() {
  const char* const rounds = std::getenv("CURVIX_FAULT_ROUNDS");
  return rounds == nullptr ? 4 : std::atoi(rounds);
}

// One workspace whose results are there before something happens.
class Faults : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(Run(kOlder).exit_code, 0);
    older_ = CurvesAndMore();
  }

  // What a run that nothing happens to makes of the other option.
  Results NewerResults() const {
    EXPECT_EQ(Run(kNewer).exit_code, 0);
    Results newer = CurvesAndMore();
    EXPECT_NE(newer, older_);
    EXPECT_EQ(Run(kOlder).exit_code, 0);
    EXPECT_EQ(CurvesAndMore(), older_);
    return newer;
  }

  std::string Arguments(const std::string& more) const {
    return "--workspace_path " + Quoted(workspace_.path()) +
           " --clean --num_threads 2 --CurveRefinement.smoothing_px " + more;
  }
  Outcome Run(const std::string& more) const {
    return RunProgram(Arguments(more));
  }
  // Within limits of the shell: "ulimit -f 10".
  Outcome RunWithin(const std::string& limits, const std::string& more) const {
    return RunInShell("{ " + limits + " && exec '" + CURVIX_PROGRAM + "' " +
                      Arguments(more) + "; } 2>&1");
  }

  // The files of the results, without the report and its seconds.
  Results CurvesAndMore() const {
    Results results;
    for (auto& [name, bytes] : Contents(results_)) {
      if (name != "report.json" && !name.starts_with(".unfinished-")) {
        results[name] = bytes;
      }
    }
    return results;
  }

  // Starts a run with kNewer, in silence, and sends it `signal` after
  // `seconds`.
  int Interrupt(int signal, double seconds) const {
    const std::string path = workspace_.path().string();
    const std::vector<const char*> words = {CURVIX_PROGRAM,
                                            "--workspace_path",
                                            path.c_str(),
                                            "--clean",
                                            "--num_threads",
                                            "2",
                                            "--CurveRefinement.smoothing_px",
                                            kNewer,
                                            nullptr};
    posix_spawn_file_actions_t silence;
    posix_spawn_file_actions_init(&silence);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(
          &silence, stream, "/dev/null", O_WRONLY, 0);
    }
    pid_t child = 0;
    EXPECT_EQ(posix_spawn(&child,
                          CURVIX_PROGRAM,
                          &silence,
                          nullptr,
                          const_cast<char* const*>(words.data()),
                          environ),
              0);
    posix_spawn_file_actions_destroy(&silence);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(child, signal);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return status;
  }

  void ExpectOlderResultsAndThenSuccess() const {
    EXPECT_EQ(CurvesAndMore(), older_);
    ExpectSuccess();
  }
  // The next run leaves its results and no trace of others.
  void ExpectSuccess() const {
    const Outcome next = Run(kOlder);
    EXPECT_EQ(next.exit_code, 0) << next.output;
    EXPECT_EQ(CurvesAndMore(), older_);
    for (const auto& [name, bytes] : Contents(results_)) {
      EXPECT_FALSE(name.starts_with(".unfinished-")) << name;
    }
  }

  static constexpr const char* kOlder = "1.5";
  static constexpr const char* kNewer = "4";

  SmallWorkspace workspace_;
  fs::path results_ = workspace_.At("curvix/0");
  Results older_;
};

// Times between nothing and a little more than a run takes.
class RandomTimes {
 public:
  explicit RandomTimes(double duration) : up_to_(0, 1.2 * duration) {}
  double Next() { return up_to_(random_); }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> up_to_;
};

double SecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

TEST_F(Faults, KilledAtAnyTime) {
  const Results newer = NewerResults();
  RandomTimes times(SecondsOf([&] { Run(kOlder); }));
  for (int i = 0; i < NumRounds(); ++i) {
    const double seconds = times.Next();
    SCOPED_TRACE(seconds);
    const int status = Interrupt(SIGKILL, seconds);
    const Results found = CurvesAndMore();
    if (found == newer) {  // even if killed: between the last file and the end
      ASSERT_EQ(Run(kOlder).exit_code, 0);
    } else {
      EXPECT_TRUE(WIFSIGNALED(status)) << "status " << status;
      EXPECT_TRUE(found == older_) << "neither the older nor the newer results";
    }
  }
  ExpectSuccess();
}

TEST_F(Faults, InterruptedAtAnyTime) {
  RandomTimes times(SecondsOf([&] { Run(kOlder); }));
  for (int i = 0; i < NumRounds(); ++i) {
    const double seconds = times.Next();
    SCOPED_TRACE(seconds);
    const int status = Interrupt(SIGINT, seconds);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      ASSERT_EQ(Run(kOlder).exit_code, 0);  // it was done before
      continue;
    }
    // Before the program's first line, the signal ends it by itself.
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 130) << status;
    EXPECT_EQ(CurvesAndMore(), older_);
    for (const auto& [name, bytes] : Contents(results_)) {
      EXPECT_FALSE(name.starts_with(".unfinished-")) << name;
    }
  }
  ExpectSuccess();
}

// No file may be larger than so many blocks of 512 or 1024 bytes.
TEST_F(Faults, NoRoomForFiles) {
  for (const char* blocks : {"0", "1", "20", "60"}) {
    SCOPED_TRACE(blocks);
    const Outcome outcome =
        RunWithin(std::string("ulimit -f ") + blocks, kNewer);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("check the free space of the disk"));
    EXPECT_EQ(CurvesAndMore(), older_);
  }
  ExpectSuccess();
}

TEST_F(Faults, FullDisk) {
  const std::string mount = "mount -t tmpfs -o size=64k tmpfs ";
  const fs::path disk = workspace_.Outside("disk");
  fs::create_directories(disk);
  const std::string in_namespace =
      "unshare --mount sh -c \"" + mount + Quoted(disk) + " && ";
  if (RunInShell(in_namespace + "true\" 2>&1").exit_code != 0) {
    GTEST_SKIP() << "only root may mount a small disk";
  }
  const Outcome outcome = RunInShell(
      in_namespace + "echo mine > " + Quoted(disk / "file") + "; '" +
      CURVIX_PROGRAM + "' " + Arguments(kNewer) + " --output_path " +
      Quoted(disk) + "; echo code \\$?; ls -A " + Quoted(disk) + "\" 2>&1");
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("check the free space of the disk"),
                    HasSubstr("code 3\nfile\n")));
  ExpectOlderResultsAndThenSuccess();
}

TEST_F(Faults, OutputThatCannotBeWritten) {
  const fs::path file = workspace_.Outside("file");
  std::ofstream(file) << "mine";
  for (const std::string& output : {file.string(),
                                    (file / "below").string(),
                                    std::string("/proc/curvix"),
                                    std::string("/dev/null")}) {
    const Outcome outcome = Run(kNewer + (" --output_path '" + output + "'"));
    EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
    EXPECT_THAT(outcome.output,
                AllOf(HasSubstr(output), HasSubstr("--output_path")));
  }
  EXPECT_EQ(Read(file), "mine");
  ExpectOlderResultsAndThenSuccess();
}

TEST_F(Faults, ReadOnlyResults) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(results_, fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = Run(kNewer);
  fs::permissions(results_, fs::perms::owner_all);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  ExpectOlderResultsAndThenSuccess();
}

// From too little to load the program up to nearly enough: it says so, and is
// never ended by a signal.
TEST_F(Faults, TooLittleMemory) {
  const auto needed_kb = [&](const std::string& arguments) {
    int kb = 50000;
    while (RunInShell("ulimit -v " + std::to_string(kb) + " && '" +
                      CURVIX_PROGRAM + "' " + arguments + " >/dev/null 2>&1")
               .exit_code != 0) {
      kb += kb / 8;
      if (kb > 8000000) return 0;
    }
    return kb;
  };
  const int to_start = needed_kb("version");
  if (to_start == 0) GTEST_SKIP() << "the program cannot be limited";
  const int to_run = needed_kb(Arguments(kOlder));
  const int step = std::max(1000, (to_run - to_start) / (2 * NumRounds()));
  for (int kb = to_start; kb < to_run; kb += step) {
    SCOPED_TRACE(kb);
    const Outcome outcome =
        RunWithin("ulimit -v " + std::to_string(kb), kNewer);
    ASSERT_THAT(outcome.exit_code, AnyOf(0, 1, 3)) << outcome.output;
    if (outcome.exit_code == 0) {
      ASSERT_EQ(Run(kOlder).exit_code, 0);
      continue;
    }
    EXPECT_THAT(outcome.output, HasSubstr("ERROR: "));
    EXPECT_EQ(CurvesAndMore(), older_);
  }
  ExpectSuccess();
}

TEST_F(Faults, TwoRunsAtOnce) {
  const auto lock = FolderLock::Take(results_);
  ASSERT_TRUE(lock);
  const Outcome outcome = Run(kNewer);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output,
              HasSubstr("Another run is writing to " + results_.string()));
  EXPECT_EQ(CurvesAndMore(), older_);
}

TEST_F(Faults, ManyRunsAtOnceLeaveTheResultsOfOne) {
  const Results newer = NewerResults();
  std::vector<std::thread> runs;
  std::vector<int> codes(4, -1);
  for (int& code : codes) {
    runs.emplace_back([&] { code = Run(kNewer).exit_code; });
  }
  for (std::thread& run : runs) run.join();
  EXPECT_THAT(codes, testing::Each(AnyOf(0, 3)));
  EXPECT_THAT(codes, testing::Contains(0));
  EXPECT_EQ(CurvesAndMore(), newer);
  ExpectSuccess();
}

// What a `colmap` may do; a run does without it.
class ColmapFaults : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(1);
    workspace_.model.points.clear();
    workspace_.model.images[0].points2D.clear();
    AddPoints(400, 0.3, random, &workspace_.model);
    workspace_.WriteModel();
  }

  Outcome RunWith(const std::string& bundle_adjuster,
                  const std::string& limits = "true") const {
    const fs::path colmap = workspace_.Outside("colmap");
    std::ofstream(colmap)
        << "#!/bin/sh\n[ $1 = help -o \"$2\" = --help ] && exit\n"
        << bundle_adjuster << "\n";
    fs::permissions(colmap, fs::perms::owner_all);
    return RunInShell("{ " + limits + " && exec '" + CURVIX_PROGRAM +
                      "' --workspace_path " + Quoted(workspace_.path()) +
                      " --refiner_timeout_s 1 --colmap_path " + Quoted(colmap) +
                      "; } 2>&1");
  }

  SmallWorkspace workspace_;
};

TEST_F(ColmapFaults, AreSurvived) {
  const std::string fill = "cat /dev/zero > \"$5/cameras.bin\"";
  for (const auto& [does, says, limits] :
       std::vector<std::array<std::string, 3>>{
           {"sleep 600", "not done after", "true"},
           {"kill -SEGV $$", "signal 11", "true"},
           {"exit 7", "exit code 7", "true"},
           {fill, "it ", "ulimit -f 4000"},
           {"cat /dev/zero", "it ", "ulimit -f 4000"},
           {"echo no model > \"$5/cameras.bin\"", "no model", "true"}}) {
    SCOPED_TRACE(does);
    const Outcome outcome = RunWith(does, limits);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output,
        AllOf(HasSubstr("Bundle adjustment is left out"), HasSubstr(says)));
  }
}

// COLMAP may take minutes, and images tell at once that they will not do.
TEST_F(ColmapFaults, ComeAfterImagesThatWillNotDo) {
  const fs::path started = workspace_.Outside("started");
  const auto run = [&] { return RunWith("touch " + Quoted(started)); };
  workspace_.WriteImage(PngOfSize(64, 63));
  const Outcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("is 64 x 63 pixels, but its camera"));
  EXPECT_FALSE(fs::exists(started));
  fs::remove(workspace_.At("images/view_000.png"));  // is skipped
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_TRUE(fs::exists(started));
}

TEST_F(ColmapFaults, WithoutColmapTheRunGoesOn) {
  const Outcome outcome = RunInShell(
      "env -u COLMAP_EXE_PATH PATH=/nowhere '" + std::string(CURVIX_PROGRAM) +
      "' --workspace_path " + Quoted(workspace_.path()) + " 2>&1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("COLMAP is not installed"),
                    HasSubstr("apt install colmap"),
                    HasSubstr("--colmap_path"),
                    HasSubstr("Poses are still refined")));
  EXPECT_TRUE(fs::exists(workspace_.At("curvix/0/curves.ply")));
  EXPECT_FALSE(fs::exists(workspace_.At("curvix/0/bundle_adjuster.log")));
}

}  // namespace
}  // namespace curvix
