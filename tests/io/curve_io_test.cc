// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/curve_io.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/file_io.h"
#include "io/curve_style.h"
#include "tests/io/test_curves.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

TEST(CurveIo, ExtensionChoosesTheFormat) {
  const TemporaryFolder folder;
  const CurveSet curves = MakeTestCurves();
  const Scene scene = MakeTestScene();
  for (const char* name :
       {"a.ply", "a.obj", "a.txt", "b.PLY", "b.OBJ", "b.Txt"}) {
    const auto path = folder.path() / name;
    ASSERT_TRUE(WriteCurves(path, curves, scene).ok());
    const auto read = ReadCurves(path, scene);
    ASSERT_TRUE(read.ok()) << read.status().message();
    ExpectSameGeometry(*read, curves, 2e-7, 0.2);
  }
  ASSERT_TRUE(WriteCurves(folder.path() / "a.pcd", curves, scene).ok());
  EXPECT_EQ(ReadFile(folder.path() / "a.pcd")->substr(0, 6), "# .PCD");
  ASSERT_TRUE(WriteEdges(folder.path() / "e.ply", {}).ok());
  EXPECT_EQ(ReadFile(folder.path() / "e.ply")->substr(0, 4), "ply\n");
}

TEST(CurveIo, OtherExtensionsAreRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.stl";
  EXPECT_EQ(WriteCurves(path, CurveSet(), {}).code(),
            StatusCode::kInvalidArgument);
  EXPECT_EQ(WriteEdges(path, {}).code(), StatusCode::kInvalidArgument);
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(WriteFileAtomically(path, "solid").ok());
  EXPECT_EQ(ReadCurves(path, {}).status().code(), StatusCode::kInvalidArgument);
}

TEST(CurveIo, MessagesNameTheFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "broken.ply";
  EXPECT_EQ(ReadCurves(path, {}).status().code(), StatusCode::kNotFound);
  ASSERT_TRUE(WriteFileAtomically(path, "ply\nformat ascii 1.0\n").ok());
  const Status status = ReadCurves(path, {}).status();
  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_THAT(status.message(), HasSubstr("broken.ply: the PLY header"));
}

// Curves of which the second cannot be read.
class BrokenCurves : public CurvesInMemory {
 public:
  using CurvesInMemory::CurvesInMemory;
  void ForEach(const Visit& visit) const override {
    CurvesInMemory::ForEach([&](std::size_t id, const Curve& curve) {
      if (id == 0) visit(id, curve);
    });
  }
  Status status() const override {
    return {StatusCode::kDataLoss, "half of it is gone"};
  }
};

TEST(CurveIo, WritesNothingOfCurvesThatCannotBeRead) {
  const TemporaryFolder folder;
  const CurveSet set = MakeTestCurves();
  const BrokenCurves curves(set);
  for (const char* name : {"ply", "obj", "pcd", "txt", "vtp", "glb"}) {
    const Status status = WriteCurves(
        folder.path() / (std::string("a.") + name), curves, MakeTestScene());
    EXPECT_EQ(status.message(), "half of it is gone") << name;
  }
  EXPECT_FALSE(
      WriteProjection(folder.path() / "a.svg", curves, MakeTestScene(), 0)
          .ok());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CurveIo, WritesNothingOfCurvesThatNoFormatCanHold) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  using Damage = std::function<void(Curve&)>;
  const std::vector<std::pair<Damage, std::string>> cases = {
      {[](Curve& c) { c.samples.resize(1); }, "curve 1 has 1 sample, "},
      {[](Curve& c) { c.samples.clear(); }, "curve 1 has 0 samples, "},
      {[](Curve& c) { c.samples[1].position.y() = kNan; },
       "sample 1 of curve 1 has a position"},
      {[](Curve& c) { c.samples[0].position.z() = -kInf; },
       "sample 0 of curve 1 has a position"},
      {[](Curve& c) { c.samples[0].position.x() = 1e39; }, "too large"},
      {[](Curve& c) { c.samples[0].tangent.x() = kNan; }, "a tangent"},
      {[](Curve& c) { c.samples[0].sigma = kInf; }, "a sigma"}};
  const TemporaryFolder folder;
  for (const auto& [damage, sentence] : cases) {
    CurveSet curves = MakeTestCurves();
    ASSERT_GT(curves.curves.size(), 2u);
    damage(curves.curves[1]);
    for (const char* name : {"ply", "obj", "pcd", "txt", "vtp", "glb"}) {
      const Status status = WriteCurves(
          folder.path() / (std::string("a.") + name), curves, MakeTestScene());
      EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << name;
      EXPECT_THAT(status.message(), HasSubstr(sentence)) << name;
    }
    EXPECT_FALSE(
        WriteProjection(
            folder.path() / "a.svg", CurvesInMemory(curves), MakeTestScene(), 0)
            .ok());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteProjection, RefusesViewsThatAreNotThere) {
  const TemporaryFolder folder;
  const CurveSet curves = MakeTestCurves();
  for (const int view_idx : {-1, 3}) {
    const Status status = WriteProjection(folder.path() / "a.svg",
                                          CurvesInMemory(curves),
                                          MakeTestScene(),
                                          view_idx);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CurveStyle, NeighbouringIdsLookDifferent) {
  const auto distance = [](const Rgb& a, const Rgb& b) {
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]);
    return sum;
  };
  for (std::size_t id = 0; id < 300; ++id) {
    for (std::size_t other = id + 1; other <= id + 4; ++other) {
      EXPECT_GT(distance(CurveColor(id), CurveColor(other)), 60) << id;
    }
  }
}

TEST(CurveStyle, ConfidenceGrowsWithSupportAndStaysBelowOne) {
  EXPECT_EQ(Confidence(0), 0);
  EXPECT_EQ(Confidence(4), 0.5f);
  EXPECT_LT(Confidence(8), Confidence(9));
  EXPECT_LT(Confidence(1000), 1);
}

}  // namespace
}  // namespace curvix
