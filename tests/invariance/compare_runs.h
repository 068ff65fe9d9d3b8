// SPDX-License-Identifier: BSD-3-Clause
// What must not change curves, and whether it did.
#pragma once

#include <curvix/reconstruct.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

namespace curvix {

inline void ExpectIdentical(const std::vector<Edge3d>& a,
                            const std::vector<Edge3d>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].position, b[i].position);
    ASSERT_EQ(a[i].tangent, b[i].tangent);
    ASSERT_EQ(a[i].support, b[i].support);
    ASSERT_EQ(a[i].sigma, b[i].sigma);
    ASSERT_EQ(a[i].evidence, b[i].evidence);
  }
}

inline void ExpectIdentical(const Curve& a, const Curve& b) {
  ASSERT_EQ(a.closed, b.closed);
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    ASSERT_EQ(a.samples[i].position, b.samples[i].position);
    ASSERT_EQ(a.samples[i].tangent, b.samples[i].tangent);
    ASSERT_EQ(a.samples[i].sigma, b.samples[i].sigma);
    ASSERT_EQ(a.samples[i].covariance, b.samples[i].covariance);
    ASSERT_EQ(a.samples[i].support, b.samples[i].support);
  }
}

inline void ExpectIdentical(const Reconstruction& a, const Reconstruction& b) {
  ExpectIdentical(a.edges, b.edges);
  ASSERT_EQ(a.curves.curves.size(), b.curves.curves.size());
  for (std::size_t c = 0; c < a.curves.curves.size(); ++c) {
    ExpectIdentical(a.curves.curves[c], b.curves.curves[c]);
  }
}

inline double DistanceToSegment(const Eigen::Vector3d& place,
                                const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  const double length2 = along.squaredNorm();
  const double t =
      length2 > 0 ? std::clamp((place - from).dot(along) / length2, 0.0, 1.0)
                  : 0;
  return (place - from - t * along).norm();
}

inline double DistanceToCurves(const Eigen::Vector3d& place,
                               const CurveSet& curves) {
  double least = std::numeric_limits<double>::infinity();
  for (const Curve& curve : curves.curves) {
    const std::size_t size = curve.samples.size();
    for (std::size_t k = 0; k < size; ++k) {
      const bool is_last = k + 1 == size && !curve.closed;
      least =
          std::min(least,
                   DistanceToSegment(
                       place,
                       curve.samples[k].position,
                       curve.samples[is_last ? k : (k + 1) % size].position));
    }
  }
  return least;
}

// The largest distance from a sample of `a` to the nearest curve of `b`.
inline double Deviation(const CurveSet& a, const CurveSet& b) {
  double worst = 0;
  for (const Curve& curve : a.curves) {
    for (const CurveSample& sample : curve.samples) {
      worst = std::max(worst, DistanceToCurves(sample.position, b));
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
