// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace curvix {
namespace {

using ::testing::ElementsAre;

TEST(RunRecorder, AsksBeforeEachStageAndOnceRefusedNoMore) {
  std::vector<std::string> asked;
  const Progress progress = [&](const std::string& stage, int, int) {
    asked.push_back(stage);
    return stage != "second";
  };
  RunRecorder run(progress);
  EXPECT_TRUE(run.Begin("first"));
  run.End({});
  EXPECT_FALSE(run.cancelled());
  EXPECT_FALSE(run.Begin("second"));
  EXPECT_TRUE(run.cancelled());
  EXPECT_FALSE(run.Begin("third"));
  EXPECT_THAT(asked, ElementsAre("first", "second"));
  EXPECT_EQ(run.TakeReport().stages.size(), 1u);
}

TEST(RunRecorder, BeginsNoStageAfterOneThatWasStopped) {
  const Progress progress = [](const std::string&, int done, int) {
    return done < 3;
  };
  RunRecorder run(progress);
  EXPECT_TRUE(run.Begin("first"));
  EXPECT_FALSE(run.Steps()(3, 10));
  EXPECT_FALSE(run.Begin("second"));
}

TEST(RunRecorder, NeedsNoProgress) {
  const Progress progress;
  RunRecorder run(progress);
  EXPECT_TRUE(run.Begin("first"));
}

}  // namespace
}  // namespace curvix
