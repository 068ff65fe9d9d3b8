// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "base/file_io.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/export/write_results.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using testing::HasSubstr;

// A line from the origin to (1.5, 0, 0).
std::string StepOfALine(const WorldAlignment* alignment) {
  const Scene scene;
  const CurveSet curves;
  FittedCurves fitted;
  CurveFit line;
  line.end = {1.5, 0, 0};
  fitted.curves.push_back({{line}});
  const TemporaryFolder folder;
  const auto path = folder.path() / "curves.step";
  const Status status = WriteFormat(
      {scene, CurvesInMemory(curves), fitted, alignment}, {}, 1, "step", path);
  EXPECT_TRUE(status.ok()) << status.message();
  return *ReadFile(path);
}

TEST(WriteStep, IsInMillimetresWhereTheUnitIsKnown) {
  WorldAlignment alignment;
  alignment.unit = "m";
  EXPECT_THAT(StepOfALine(&alignment), HasSubstr("(1500.,0.,0.)"));
  alignment.unit = "cm";
  EXPECT_THAT(StepOfALine(&alignment), HasSubstr("(15.,0.,0.)"));
  for (const char* unit : {"mm", "cubits", ""}) {
    alignment.unit = unit;
    EXPECT_THAT(StepOfALine(&alignment), HasSubstr("(1.5,0.,0.)"));
  }
  EXPECT_THAT(StepOfALine(nullptr), HasSubstr("(1.5,0.,0.)"));
}

}  // namespace
}  // namespace curvix
