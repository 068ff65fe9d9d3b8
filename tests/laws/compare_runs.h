// SPDX-License-Identifier: BSD-3-Clause
// What must not change curves, and whether it did.
#pragma once

#include <curvix/reconstruct.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace curvix {

inline void ExpectIdentical(const Reconstruction& a, const Reconstruction& b) {
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    ASSERT_EQ(a.edges[i].position, b.edges[i].position);
    ASSERT_EQ(a.edges[i].tangent, b.edges[i].tangent);
    ASSERT_EQ(a.edges[i].support, b.edges[i].support);
    ASSERT_EQ(a.edges[i].sigma, b.edges[i].sigma);
    ASSERT_EQ(a.edges[i].evidence, b.edges[i].evidence);
  }
  ASSERT_EQ(a.curves.curves.size(), b.curves.curves.size());
  for (std::size_t c = 0; c < a.curves.curves.size(); ++c) {
    const Curve& one = a.curves.curves[c];
    const Curve& other = b.curves.curves[c];
    ASSERT_EQ(one.closed, other.closed);
    ASSERT_EQ(one.samples.size(), other.samples.size());
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
      ASSERT_EQ(one.samples[i].position, other.samples[i].position);
      ASSERT_EQ(one.samples[i].tangent, other.samples[i].tangent);
      ASSERT_EQ(one.samples[i].sigma, other.samples[i].sigma);
      ASSERT_EQ(one.samples[i].covariance, other.samples[i].covariance);
      ASSERT_EQ(one.samples[i].support, other.samples[i].support);
    }
  }
}

// The largest distance from a sample of `a` to the nearest sample of `b`.
inline double Deviation(const CurveSet& a, const CurveSet& b) {
  double worst = 0;
  for (const Curve& curve : a.curves) {
    for (const CurveSample& sample : curve.samples) {
      double least = std::numeric_limits<double>::infinity();
      for (const Curve& other : b.curves) {
        for (const CurveSample& candidate : other.samples) {
          least =
              std::min(least, (candidate.position - sample.position).norm());
        }
      }
      worst = std::max(worst, least);
    }
  }
  return worst;
}

inline void ExpectSameSet(const CurveSet& a,
                          const CurveSet& b,
                          double tolerance) {
  EXPECT_EQ(a.curves.size(), b.curves.size());
  EXPECT_LT(Deviation(a, b), tolerance);
  EXPECT_LT(Deviation(b, a), tolerance);
}

// A world that is turned, then `scale` times as large, then moved.
struct OtherWorld {
  Eigen::Quaterniond turn;
  Eigen::Vector3d move;
  double scale;

  Scene Moved(Scene scene) const {
    for (View& view : scene.views) {
      Rigid3& pose = view.cam_from_world;
      pose.rotation = (pose.rotation * turn.conjugate()).normalized();
      pose.translation = scale * pose.translation - pose.rotation * move;
    }
    for (ScenePoint& point : scene.points) {
      point.position = scale * (turn * point.position) + move;
    }
    return scene;
  }
  CurveSet Back(CurveSet curves) const {
    for (Curve& curve : curves.curves) {
      for (CurveSample& sample : curve.samples) {
        sample.position = turn.conjugate() * (sample.position - move) / scale;
      }
    }
    return curves;
  }
};

}  // namespace curvix
