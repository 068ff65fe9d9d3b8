// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "base/file_io.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/export/write_results.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using testing::HasSubstr;

// One curve, again and again.
class RepeatedCurve : public CurveSource {
 public:
  RepeatedCurve(std::size_t num_samples, std::size_t size) : size_(size) {
    CurveSample sample;
    sample.kind = CurveKind::kCrease;
    curve_.samples.assign(num_samples, sample);
  }

  std::size_t size() const override { return size_; }
  void ForEach(const Visit& visit) const override {
    for (std::size_t id = 0; id < size_; ++id) visit(id, curve_);
  }
  Edge2d EdgeOf(const EdgeRef&) const override { return {}; }

 private:
  Curve curve_;
  std::size_t size_;
};

Status WritePly(const CurveSource& curves,
                const WorldAlignment* alignment,
                const std::filesystem::path& path) {
  const Scene scene;
  const FittedCurves fitted;
  return WriteFormat({scene, curves, fitted, alignment}, {}, 1, "ply", path);
}

TEST(WritePly, TellsOfTheFrame) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "curves.ply";
  const WorldAlignment alignment;
  ASSERT_TRUE(WritePly(RepeatedCurve(2, 3), nullptr, path).ok());
  EXPECT_THAT(*ReadFile(path), HasSubstr("the COLMAP model"));
  ASSERT_TRUE(WritePly(RepeatedCurve(2, 3), &alignment, path).ok());
  EXPECT_THAT(*ReadFile(path), HasSubstr("those of alignment.json\n"));
}

TEST(WritePly, WhatCannotBeWrittenLeavesTheFileAsItWas) {
  const TemporaryFolder folder;
  const auto path = folder.Write("curves.ply", "old");
  const WorldAlignment alignment;
  const std::vector<const WorldAlignment*> frames = {&alignment, nullptr};
  for (const WorldAlignment* frame : frames) {
    // More vertices than PLY can number.
    const Status status = WritePly(RepeatedCurve(65536, 32769), frame, path);
    EXPECT_EQ(status.code(), StatusCode::kUnsupported);
    EXPECT_EQ(*ReadFile(path), "old");
  }
}

}  // namespace
}  // namespace curvix
