// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/progress.h"

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <sstream>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace curvix {
namespace {

using testing::HasSubstr;
using testing::Not;

// A printer with a clock in the test's hand.
class ProgressTest : public testing::Test {
 protected:
  ProgressPrinter Printer(bool is_terminal) {
    return {stream_, is_terminal, [this] { return now_; }};
  }
  std::ptrdiff_t NumDraws() const {
    const std::string text = stream_.str();
    return std::count(text.begin(), text.end(), '[') -
           std::count(text.begin(), text.end(), '\033');
  }

  std::ostringstream stream_;
  double now_ = 100;
};

TEST_F(ProgressTest, PlainOutputIsOneLineAStage) {
  {
    ProgressPrinter printer = Printer(false);
    for (int done = 0; done <= 50; ++done) {
      EXPECT_TRUE(printer.Update("detect_edges", done, 50));
      now_ += 0.062;
    }
    printer.Finish("50 views, 171 204 edges");
    printer.Update("hypothesise", 0, 10);
    now_ += 2;
    printer.Update("connect", 1, 1);
    now_ += 1;
  }
  EXPECT_EQ(stream_.str(),
            "Detect edges ... 50 views, 171 204 edges, 3.2 s\n"
            "Hypothesise ... 2.0 s\n"
            "Connect ... \n");
}

TEST_F(ProgressTest, TheBarIsRedrawnAtMostTenTimesASecond) {
  ProgressPrinter printer = Printer(true);
  for (int done = 0; done < 1000; ++done) {
    printer.Update("stage", done, 1000);
    now_ += 0.002;
  }
  EXPECT_GE(NumDraws(), 18);
  EXPECT_LE(NumDraws(), 21);
}

TEST_F(ProgressTest, TheBarForetellsTheRemainingTime) {
  ProgressPrinter printer = Printer(true);
  printer.Update("stage", 0, 4);
  EXPECT_THAT(stream_.str(), Not(HasSubstr("left")));
  now_ += 10;
  printer.Update("stage", 1, 4);
  EXPECT_THAT(stream_.str(), HasSubstr("1/4, 30.0 s left"));
}

TEST_F(ProgressTest, AStageOfUnknownLengthHasNoBar) {
  ProgressPrinter printer = Printer(true);
  printer.Update("read_model", 0, 0);
  EXPECT_THAT(stream_.str(), HasSubstr("Read model"));
  EXPECT_EQ(NumDraws(), 0);
}

TEST_F(ProgressTest, TheFinishedLineReplacesTheBar) {
  ProgressPrinter printer = Printer(true);
  printer.Update("stage", 5, 4);  // beyond the end
  now_ += 1;
  printer.Finish("4 views");
  EXPECT_THAT(stream_.str(),
              testing::EndsWith("\r\033[KStage ... 4 views, 1.0 s\n"));
  printer.Finish("nothing is open");
  EXPECT_THAT(stream_.str(), Not(HasSubstr("nothing")));
}

TEST_F(ProgressTest, NotesAreLinesOfTheirOwn) {
  for (const bool is_terminal : {true, false}) {
    stream_.str("");
    ProgressPrinter printer = Printer(is_terminal);
    printer.Update("stage", 0, 4);
    printer.Note("two images are missing");
    EXPECT_THAT(stream_.str(),
                testing::ContainsRegex("[\nK]two images are missing\n"));
  }
}

// In a process of its own, since there is no way back.
TEST_F(ProgressTest, InterruptsAskToStop) {
  const auto asks_to_stop = [&] {
    ProgressPrinter printer = Printer(false);
    const bool went_on = printer.Update("stage", 0, 4);
    CatchSignals();
    std::raise(SIGINT);
    return went_on && IsInterrupted() && !printer.Update("stage", 1, 4);
  };
  EXPECT_EXIT(
      std::_Exit(asks_to_stop() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace curvix
