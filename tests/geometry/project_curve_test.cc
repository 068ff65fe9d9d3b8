// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/curves.h>
#include <curvix/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace curvix {
namespace {

using ::testing::ElementsAre;

// Two views at the origin that look along z; x = 0 at z = 10 is in the middle
// of the image, one unit is ten pixels.
Scene TwoViews() {
  Scene scene;
  Camera camera;
  camera.model = CameraModel::kPinhole;
  camera.width = camera.height = 600;
  camera.params = {100, 100, 100, 100};
  scene.cameras = {camera};
  scene.views.resize(2);
  return scene;
}

// A sample per unit of x, from 0. Characters say which view supports it.
Curve Line(const std::string& views) {
  Curve curve;
  for (std::size_t i = 0; i < views.size(); ++i) {
    CurveSample sample;
    sample.position = {static_cast<double>(i), 0, 10};
    if (views[i] != '-') sample.support = {{views[i] - '0', 7}};
    curve.samples.push_back(sample);
  }
  return curve;
}

// Where the stretches begin and end, in units of x, and whether they are shown.
std::vector<std::string> Stretches(const Curve& curve) {
  std::vector<std::string> texts;
  for (const ProjectedStretch& s :
       ProjectShownAndHidden(curve, TwoViews(), 0)) {
    const auto unit = [](const Eigen::Vector2d& pixel) {
      return std::to_string(static_cast<int>(pixel.x() / 10 - 9.5));
    };
    texts.push_back(unit(s.pixels.front()) + "-" + unit(s.pixels.back()) +
                    (s.is_shown ? " shown" : ""));
  }
  return texts;
}

TEST(ProjectShownAndHidden, DividesWhereSupportBeginsAndEnds) {
  EXPECT_THAT(Stretches(Line("--000--")),
              ElementsAre("0-2", "2-4 shown", "4-6"));
  EXPECT_THAT(Stretches(Line("0000")), ElementsAre("0-3 shown"));
  EXPECT_THAT(Stretches(Line("1111")), ElementsAre("0-3"));
}

TEST(ProjectShownAndHidden, ShowsGapsOfFewerThanTwentySamples) {
  EXPECT_THAT(Stretches(Line("0" + std::string(19, '-') + "0")),
              ElementsAre("0-20 shown"));
  EXPECT_THAT(Stretches(Line("00" + std::string(20, '-') + "00")),
              ElementsAre("0-1 shown", "1-22", "22-23 shown"));
}

TEST(ProjectShownAndHidden, GoesOnAcrossTheSeamOfClosedCurves) {
  Curve curve = Line("0" + std::string(30, '-') + "0");
  curve.closed = true;
  EXPECT_THAT(Stretches(curve), ElementsAre("0-31", "31-0 shown"));
  curve = Line("--0" + std::string(30, '-') + "0--");
  EXPECT_THAT(Stretches(curve), ElementsAre("0-35"));
  curve.closed = true;
  EXPECT_THAT(Stretches(curve), ElementsAre("0-2 shown", "2-33", "33-0 shown"));
}

TEST(ProjectShownAndHidden, LeavesOutWhatIsOutsideTheImage) {
  Curve curve = Line("000000");
  curve.samples[2].position.z() = -10;
  EXPECT_THAT(Stretches(curve), ElementsAre("0-1 shown", "3-5 shown"));
  curve.samples[4].position.x() = 60;
  EXPECT_THAT(Stretches(curve), ElementsAre("0-1 shown"));
}

TEST(ProjectCurve, GivesAllStretchesInOnePiece) {
  const Scene scene = TwoViews();
  const auto stretches =
      ProjectCurve(Line("--000--"), scene.views[0], scene.cameras[0]);
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_EQ(stretches[0].size(), 7U);
}

}  // namespace
}  // namespace curvix
