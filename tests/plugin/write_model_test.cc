// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/file_io.h"
#include "colmap/colmap_model.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/export/write_results.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using testing::HasSubstr;

// Two views of the segment from (-0.2, 0, 0) to (0.2, 0, 0), and the edges of
// its five samples, the first of which only one view supports.
struct SegmentInTwoViews {
  SegmentInTwoViews() {
    const std::vector<PosedView> views = {LookAt({0, -4, 1}, {0, 0, 0}),
                                          LookAt({1, -4, -1}, {0, 0, 0})};
    scene = ToScene(views);
    edges.resize(views.size());
    Curve& curve = set.curves.emplace_back();
    for (int i = 0; i < 5; ++i) {
      CurveSample& sample = curve.samples.emplace_back();
      sample.position = {0.1 * (i - 2), 0, 0};
      sample.tangent = {1, 0, 0};
      for (int v = 0; v < (i == 0 ? 1 : 2); ++v) {
        const PosedView& view = views[static_cast<std::size_t>(v)];
        auto& list = edges[static_cast<std::size_t>(v)].edges;
        sample.support.push_back({v, static_cast<int>(list.size())});
        const Eigen::Vector2d at = PixelOf(view, sample.position);
        const Eigen::Vector2d along =
            PixelOf(view, sample.position + Eigen::Vector3d(1e-3, 0, 0)) - at;
        Edge2d& edge = list.emplace_back();
        edge.position = at;
        edge.angle =
            static_cast<decltype(edge.angle)>(std::atan2(along.y(), along.x()));
      }
    }
  }

  Status Write(const CurveSource& curves,
               const std::filesystem::path& path) const {
    const FittedCurves no_fits;
    return WriteFormat(
        {scene, curves, no_fits, nullptr}, {}, 1, "colmap", path);
  }

  Scene scene;
  CurveSet set;
  std::vector<EdgeMap> edges;
};

// As pycurvix gives curves that were read from a file.
class CurvesWithoutEdges : public CurvesInMemory {
 public:
  using CurvesInMemory::CurvesInMemory;
  Edge2d EdgeOf(const EdgeRef&) const override {
    Edge2d edge;
    edge.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    return edge;
  }
};

TEST(WriteModel, SamplesOfTwoViewsArePoints) {
  const SegmentInTwoViews segment;
  const TemporaryFolder folder;
  const Status status =
      segment.Write(CurvesInMemory(segment.set, &segment.edges), folder.path());
  ASSERT_TRUE(status.ok()) << status.message();
  const auto model = ReadColmapModel(folder.path());
  ASSERT_TRUE(model.ok()) << model.status().message();
  ASSERT_EQ(model->points.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const ColmapPoint3D& point = model->points[i];
    EXPECT_EQ(point.position, segment.set.curves[0].samples[i + 1].position);
    EXPECT_LT(point.error, 1e-3);
    EXPECT_EQ(point.track.size(), 2u);
  }
}

TEST(WriteModel, RefusesCurvesWithoutTheirEdges) {
  SegmentInTwoViews segment;
  const TemporaryFolder folder;
  const auto path = folder.path() / "model";
  const auto expect_refused = [&] {
    const Status status = segment.Write(CurvesWithoutEdges(segment.set), path);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(status.message(), HasSubstr("2D edges behind the curves"));
    EXPECT_FALSE(std::filesystem::exists(path));
  };
  expect_refused();
  for (CurveSample& sample : segment.set.curves[0].samples) {
    sample.support.clear();
  }
  expect_refused();
}

TEST(WriteModel, NoCurvesAreAModelOfViews) {
  const SegmentInTwoViews segment;
  const CurveSet none;
  const TemporaryFolder folder;
  ASSERT_TRUE(segment.Write(CurvesWithoutEdges(none), folder.path()).ok());
  const auto model = ReadColmapModel(folder.path());
  ASSERT_TRUE(model.ok()) << model.status().message();
  EXPECT_EQ(model->images.size(), 2u);
  EXPECT_TRUE(model->points.empty());
}

}  // namespace
}  // namespace curvix
