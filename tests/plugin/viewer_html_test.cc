// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/viewer_html.h"

#include <gtest/gtest.h>
#include <cstddef>
#include <string>

namespace curvix {
namespace {

// A scene of two views that see so many points.
Scene TwoViews(std::size_t num_points) {
  Scene scene;
  scene.cameras = {{CameraModel::kPinhole, 640, 480, {500, 500, 320, 240}}};
  scene.views.resize(2);
  scene.views[0].cam_from_world.translation = {0, 0, 3};
  scene.views[1].cam_from_world.translation = {1, 0, 3};
  ScenePoint point;
  point.view_idxs = {0, 1};
  scene.points.assign(num_points, point);
  return scene;
}

std::size_t NumPointsShown(std::size_t num_points) {
  const Scene scene = TwoViews(num_points);
  const CurveSet no_curves;
  const CurvesInMemory curves(no_curves);
  const FittedCurves fitted;
  std::string page;
  EncodeViewerHtml({scene, curves, fitted}, 1, [&](std::string_view bytes) {
    page += bytes;
  });
  const std::string mark = "{\"images\":[";
  const std::size_t start = page.find(mark);
  const std::size_t end = page.find("</script>", start);
  const Json data =
      Json::parse(page.substr(start, page.rfind('}', end) + 1 - start));
  return data["points"].size();
}

TEST(ViewerHtml, ShowsAsManyPointsAsItMay) {
  EXPECT_EQ(NumPointsShown(0), 0U);
  EXPECT_EQ(NumPointsShown(1), 1U);
  EXPECT_EQ(NumPointsShown(kMaxViewerPoints), kMaxViewerPoints);
  EXPECT_EQ(NumPointsShown(kMaxViewerPoints + 1), kMaxViewerPoints / 2 + 1);
  EXPECT_EQ(NumPointsShown(2 * kMaxViewerPoints), kMaxViewerPoints);
}

}  // namespace
}  // namespace curvix
