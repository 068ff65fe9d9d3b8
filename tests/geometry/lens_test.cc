// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/lens.h"

#include <curvix/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvix {
namespace {

const Camera kRadial{
    CameraModel::kRadial, 1200, 900, {1010, 603, 448, -0.055, 0.012}};
const Camera kOpenCV{CameraModel::kOpenCV,
                     1200,
                     900,
                     {1010, 1020, 603, 448, -0.05, 0.01, 0.001, -0.002}};

TEST(CarryEdge, ComesBack) {
  const ImageEdge edge{{150, 700}, Eigen::Vector2d(0.6, -0.8)};
  const auto there = CarryEdge(edge, kRadial, kOpenCV);
  ASSERT_TRUE(there);
  EXPECT_GT((there->position - edge.position).norm(), 0.5);
  const auto back = CarryEdge(*there, kOpenCV, kRadial);
  ASSERT_TRUE(back);
  EXPECT_LT((back->position - edge.position).norm(), 1e-6);
  EXPECT_LT((back->tangent - edge.tangent).norm(), 1e-8);
}

TEST(EdgeInImage, HasTheTangentOfTheDistortedLine) {
  const ImageEdge edge{{150, 700}, Eigen::Vector2d(0.6, -0.8)};
  const double h = 1e-4;
  const ImageEdge next{edge.position + h * edge.tangent, edge.tangent};
  const ImageEdge seen = EdgeInImage(edge, kOpenCV);
  const Eigen::Vector2d step =
      EdgeInImage(next, kOpenCV).position - seen.position;
  EXPECT_LT((step.normalized() - seen.tangent).norm(), 1e-5);
}

TEST(Lens, MovesThePixelThatItMovesMostByOne) {
  for (const Camera& camera : {kRadial, kOpenCV}) {
    const Lens lens(camera);
    for (int i = 0; i < static_cast<int>(camera.params.size()); ++i) {
      const Camera changed = lens.Changed(0.01 * LensChange::Unit(i));
      double largest = 0;
      for (int y = 0; y <= 4; ++y) {
        for (int x = 0; x <= 4; ++x) {
          const auto ideal =
              IdealFromImage(camera, Eigen::Vector2d(300 * x, 225 * y));
          ASSERT_TRUE(ideal);
          largest = std::max(
              largest,
              (ImageFromIdeal(changed, *ideal) - ImageFromIdeal(camera, *ideal))
                  .norm());
        }
      }
      EXPECT_NEAR(largest, 0.01, 1e-4) << i;
    }
  }
}

TEST(Lens, ChangesTheRatioOfFocalLengthsByOneChangeOnly) {
  const auto ratio = [](const Camera& camera) {
    return camera.params[1] / camera.params[0];
  };
  const Lens lens(kOpenCV);
  ASSERT_EQ(lens.AspectRatioIndex(), 1);
  for (int i = 0; i < 8; ++i) {
    const Camera changed = lens.Changed(5 * LensChange::Unit(i));
    const double difference = std::abs(ratio(changed) - ratio(kOpenCV));
    if (i == 1) {
      EXPECT_GT(difference, 1e-3);
    } else {
      EXPECT_LT(difference, 1e-12) << i;
    }
  }
  EXPECT_FALSE(Lens(kRadial).AspectRatioIndex());
}

TEST(Lens, FindsTheChangeToACamera) {
  for (const Camera& camera : {kRadial, kOpenCV}) {
    const Lens lens(camera);
    LensChange change = LensChange::Zero();
    for (int i = 0; i < static_cast<int>(camera.params.size()); ++i) {
      change[i] = i - 2.5;
    }
    EXPECT_LT((lens.ChangeTo(lens.Changed(change)) - change).norm(), 1e-9);
  }
}

TEST(Lens, LeavesWhatTheModelDoesNotHave) {
  const Lens lens(kRadial);
  EXPECT_EQ(lens.Changed(LensChange::Unit(7)), kRadial);
}

TEST(ShiftOfImage, IsThatOfTheMedianPixelWithoutTheTurn) {
  const Camera camera{CameraModel::kSimplePinhole, 200, 100, {100, 100, 50}};
  Camera turned = camera, longer = camera;
  turned.params[1] += 30;
  EXPECT_NEAR(ShiftOfImage(camera, turned), 0, 1e-12);
  longer.params[0] = 110;
  const double shift_px = ShiftOfImage(camera, longer);
  EXPECT_GT(shift_px, 0.1 * 50);
  EXPECT_LT(shift_px, 0.1 * 100);
}

TEST(WithMoreTerms, IsTheSameCamera) {
  const Camera starts[] = {
      {CameraModel::kSimplePinhole, 640, 480, {500, 320, 240}},
      {CameraModel::kPinhole, 640, 480, {500, 510, 320, 240}},
      {CameraModel::kSimpleFisheye, 640, 480, {300, 320, 240}}};
  for (Camera camera : starts) {
    for (int i = 0; i < 4; ++i) {
      const Camera more = WithMoreTerms(camera);
      ASSERT_TRUE(Validate(more).ok());
      const Eigen::Vector2d ideal(0.3, -0.4);
      EXPECT_LT(
          (ImageFromIdeal(more, ideal) - ImageFromIdeal(camera, ideal)).norm(),
          1e-9);
      camera = more;
    }
    EXPECT_EQ(WithMoreTerms(camera), camera);
  }
}

}  // namespace
}  // namespace curvix
