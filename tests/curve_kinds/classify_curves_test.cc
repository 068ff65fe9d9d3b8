// SPDX-License-Identifier: BSD-3-Clause
// One straight edge along the world's z axis between surfaces of known
// directions, painted with waves and seen from around.
#include "curve_kinds/classify_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "base/angles.h"
#include "geometry/directions.h"
#include "model/posed_view.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A half-plane that begins at a line parallel to z, or a strip of it.
struct Surface {
  double angle_deg = 0;  // of its direction about z, from +x
  double phase = 0;      // of its paint
  Vector3d start = Vector3d::Zero();
  double width = kInfinity;
};

// Waves in several directions, of 8 to 30 pixels.
double Paint(double across, double along, double phase) {
  return 128 + 40 * std::sin(87 * across + 43 * along + phase) +
         40 * std::sin(151 * across - 113 * along + 2 * phase) +
         30 * std::sin(261 * across + 115 * along + 3 * phase);
}

// The distance along `ray` from `center`, and the paint there; infinite where
// the surface is missed.
std::pair<double, double> Hit(const Surface& surface,
                              const Vector3d& center,
                              const Vector3d& ray) {
  const double angle = surface.angle_deg * kPi / 180;
  const Vector3d across(std::cos(angle), std::sin(angle), 0);
  const Vector3d normal(-std::sin(angle), std::cos(angle), 0);
  const double depth = normal.dot(surface.start - center) / normal.dot(ray);
  const Vector3d at = center + depth * ray - surface.start;
  if (!(depth > 0) || at.dot(across) < 0 || at.dot(across) > surface.width) {
    return {kInfinity, 0};
  }
  return {depth, Paint(at.dot(across), at.z(), surface.phase)};
}

class ClassifyCurvesTest : public ::testing::Test {
 protected:
  // The kind in the middle of the edge, seen by eight views within 35 degrees
  // of -y.
  CurveSample Classified(const std::vector<Surface>& surfaces,
                         double contrast = 1,
                         const std::vector<ScenePoint>& points = {}) {
    std::vector<PosedView> posed;
    for (int i = 0; i < 8; ++i) {
      const double azimuth = (-90 + 10 * (i - 3.5)) * kPi / 180;
      posed.push_back(LookAt(
          {2 * std::cos(azimuth), 2 * std::sin(azimuth), 0.2 * (i % 3) - 0.1},
          Vector3d::Zero()));
    }
    Scene scene = ToScene(posed);
    scene.points = points;
    Random random(1);
    for (std::size_t i = 0; i < posed.size(); ++i) {
      cv::Mat image(800, 800, CV_8U);
      for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
          std::pair<double, double> nearest = {kInfinity, 128};
          for (const Surface& surface : surfaces) {
            nearest = std::min(nearest,
                               Hit(surface,
                                   posed[i].center,
                                   posed[i].Ray({x + 0.5, y + 0.5})));
          }
          image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
              std::lround(std::clamp(128 + contrast * (nearest.second - 128) +
                                         noise_ * random.Normal(),
                                     0.0,
                                     255.0)));
        }
      }
      scene.views[i].image_path =
          folder_.path() / (scene.views[i].name + ".png");
      EXPECT_TRUE(cv::imwrite(scene.views[i].image_path.string(), image));
      scene.views[i].mask_path = bad_mask_;
    }
    return MiddleOf(scene);
  }

  CurveSample MiddleOf(Scene scene) const {
    for (View& view : scene.views) {
      view.cam_from_world.rotation *= turn_.inverse();
    }
    for (ScenePoint& point : scene.points) {
      point.position = turn_ * point.position;
    }
    std::vector<Curve> curves = {CurveAt(0, scene)};
    for (const double x : other_curves_) curves.push_back(CurveAt(x, scene));
    ClassifyCurves(scene, MakePosedViews(scene), 1, &curves, step_done_);
    return curves[0].samples[30];
  }

  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();  // of the world
  double noise_ = 0;                  // of the images, grey levels
  int first_view_ = 0;                // of those that support the curves
  std::vector<double> other_curves_;  // x of curves parallel to the edge
  StepDone step_done_;
  std::filesystem::path bad_mask_;  // of all views; empty: none

 private:
  Curve CurveAt(double x, const Scene& scene) const {
    Curve curve;
    for (int i = -30; i <= 30; ++i) {
      CurveSample& sample = curve.samples.emplace_back();
      sample.position = turn_ * Vector3d(x, 0, 0.004 * i);
      sample.tangent = turn_ * Vector3d::UnitZ();
      for (int v = first_view_; v < static_cast<int>(scene.views.size()); ++v) {
        sample.support.push_back({v, 0});
      }
    }
    return curve;
  }

  const TemporaryFolder folder_;
};

TEST_F(ClassifyCurvesTest, OneSurfaceOnBothSidesIsMarked) {
  const CurveSample sample = Classified({{0, 1}, {180, 2}});
  EXPECT_EQ(sample.kind, CurveKind::kMarking);
  EXPECT_GT(sample.kind_probability, 0.95F);
}

TEST_F(ClassifyCurvesTest, ObliqueSurfaceIsMarked) {
  EXPECT_EQ(Classified({{25, 1}, {205, 2}}).kind, CurveKind::kMarking);
}

TEST_F(ClassifyCurvesTest, SurfacesThatMeetMakeACrease) {
  // Outwards, towards the cameras, and inwards.
  for (const double bend_deg : {50.0, -50.0}) {
    const CurveSample sample = Classified({{bend_deg, 1}, {180 - bend_deg, 2}});
    EXPECT_EQ(sample.kind, CurveKind::kCrease) << bend_deg;
    EXPECT_GT(sample.kind_probability, 0.95F) << bend_deg;
  }
}

TEST_F(ClassifyCurvesTest, NoiseOfTheImagesIsNoDepth) {
  noise_ = 10;
  EXPECT_EQ(Classified({{50, 1}, {130, 2}}, 0.3).kind, CurveKind::kCrease);
  EXPECT_EQ(Classified({{0, 1}, {180, 2}}, 0.3).kind, CurveKind::kMarking);
}

TEST_F(ClassifyCurvesTest, SurfaceThatEndsBeforeAnotherIsABoundary) {
  // A wall one unit behind the edge.
  const CurveSample sample = Classified({{0, 1}, {0, 2, {-9, 1, 0}}});
  EXPECT_EQ(sample.kind, CurveKind::kBoundary);
  EXPECT_GT(sample.kind_probability, 0.95F);
}

TEST_F(ClassifyCurvesTest, FlatStepIsACrease) {
  // A pixel is 0.0025 units. Points far from the edge hardly show the step.
  for (const double depth : {0.005, 0.01}) {
    std::vector<ScenePoint> points;
    for (int i = -9; i <= 9; ++i) {
      if (std::abs(i) < 4) continue;
      points.emplace_back().position = {0.01 * i, i < 0 ? 0 : depth, 0};
    }
    EXPECT_EQ(
        Classified({{180, 1}, {0, 2, {-0.1, depth, 0}}}, 0.1, points).kind,
        CurveKind::kCrease)
        << depth;
    EXPECT_EQ(Classified({{180, 1}, {0, 2}}, 0.1, points).kind,
              CurveKind::kMarking)
        << depth;
  }
  // The other side is behind.
  EXPECT_EQ(Classified({{0, 1}, {180, 2, {0.1, 0.01, 0}}}).kind,
            CurveKind::kCrease);
}

TEST_F(ClassifyCurvesTest, WithoutTextureItIsProbablyACrease) {
  const CurveSample sample = Classified({{50, 1}, {130, 2}}, 0);
  EXPECT_EQ(sample.kind, CurveKind::kCrease);
  EXPECT_LT(sample.kind_probability, 0.95F);
}

TEST_F(ClassifyCurvesTest, PointsTellTheSurfacesWhereThereIsNoTexture) {
  const auto kind_by_points = [&](const std::vector<Surface>& surfaces) {
    std::vector<ScenePoint> points;
    for (const Surface& surface : surfaces) {
      const double angle = surface.angle_deg * kPi / 180;
      for (int i = 0; i < 9; ++i) {
        const double distance = 0.03 + 0.005 * i;
        points.emplace_back().position = {distance * std::cos(angle),
                                          distance * std::sin(angle),
                                          0.02 * (i % 3 - 1)};
      }
    }
    return Classified(surfaces, 0, points).kind;
  };
  EXPECT_EQ(kind_by_points({{0, 1}, {180, 2}}), CurveKind::kMarking);
  EXPECT_EQ(kind_by_points({{50, 1}, {130, 2}}), CurveKind::kCrease);
}

TEST_F(ClassifyCurvesTest, PointsThatOtherViewsSeeDoNotCount) {
  first_view_ = 2;
  const auto kind_by_points_of = [&](const std::vector<int>& views) {
    std::vector<ScenePoint> points;
    for (int i = -9; i <= 9; ++i) {
      if (i == 0) continue;
      ScenePoint& point = points.emplace_back();
      point.position = {0.01 * i, 0, 0};
      point.view_idxs = views;
    }
    return Classified({{50, 1}, {130, 2}}, 0, points).kind;
  };
  EXPECT_EQ(kind_by_points_of({0, 1}), CurveKind::kCrease);
  EXPECT_EQ(kind_by_points_of({3, 4, 5}), CurveKind::kMarking);
}

TEST_F(ClassifyCurvesTest, SurfaceMayEndAtTheNextCurve) {
  // To the right it ends before a wall one unit behind it.
  const double width = 0.01;
  const std::vector<Surface> surfaces = {
      {0, 1, Vector3d::Zero(), width}, {180, 2}, {0, 3, {-9, 1, 0}}};
  EXPECT_EQ(Classified(surfaces).kind, CurveKind::kBoundary);
  other_curves_ = {width};
  EXPECT_EQ(Classified(surfaces).kind, CurveKind::kMarking);
}

TEST_F(ClassifyCurvesTest, StopsAfterAnyCurve) {
  other_curves_ = {0.01, 0.02};
  for (const int last : {1, 2}) {
    int num_done = 0;
    step_done_ = [&](int done, int total) {
      EXPECT_EQ(total, 3);
      num_done = done;
      return done < last;
    };
    Classified({{0, 1}, {180, 2}});
    EXPECT_EQ(num_done, last);
  }
}

TEST_F(ClassifyCurvesTest, WhatFewerThanThreeImagesShowIsUnknown) {
  const std::vector<Surface> surfaces = {{0, 1}, {180, 2}};
  first_view_ = 5;
  EXPECT_EQ(Classified(surfaces).kind, CurveKind::kMarking);
  first_view_ = 6;
  EXPECT_EQ(Classified(surfaces).kind, CurveKind::kUnknown);
}

TEST_F(ClassifyCurvesTest, WithoutImagesTheKindIsUnknown) {
  const CurveSample sample =
      MiddleOf(ToScene({LookAt({0, -2, 0}, Vector3d::Zero()),
                        LookAt({1, -2, 0}, Vector3d::Zero()),
                        LookAt({-1, -2, 0}, Vector3d::Zero())}));
  EXPECT_EQ(sample.kind, CurveKind::kUnknown);
  EXPECT_EQ(sample.kind_probability, 0);
}

TEST_F(ClassifyCurvesTest, AxesOfTheWorldDoNotMatter) {
  // Surfaces between two of the directions that are tried.
  for (const double bend_deg : {8.0, 22.0, 37.0}) {
    const std::vector<Surface> surfaces = {{bend_deg, 1}, {180 - bend_deg, 2}};
    turn_ = Eigen::Quaterniond::Identity();
    const CurveSample before = Classified(surfaces);
    turn_ = RotationBy({0.4, -0.9, 1.3});
    const CurveSample after = Classified(surfaces);
    EXPECT_EQ(after.kind, before.kind) << bend_deg;
    EXPECT_NEAR(after.kind_probability, before.kind_probability, 1e-4)
        << bend_deg;
  }
}

TEST_F(ClassifyCurvesTest, MasksDoNotMatter) {
  bad_mask_ = "missing.png";
  EXPECT_EQ(Classified({{0, 1}, {180, 2}}).kind, CurveKind::kMarking);
}

}  // namespace
}  // namespace curvix
