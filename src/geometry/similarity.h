// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Similarities of space, and the one that brings two sets of poses of the same
// cameras together. Images do not tell where the world's origin is nor how
// long its unit: every bundle adjustment moves, turns and scales the world.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace curvix {

// b_from_a: x_b = scale * rotation * x_a + translation.
struct Similarity3 {
  double scale = 1;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return scale * (rotation * x) + translation;
  }
  Similarity3 Inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {1 / scale, back, back * -translation / scale};
  }
};

// The pose in b of the camera that has the pose `cam_from_a` in a. Lengths
// seen from the camera change by the scale, its images do not.
Rigid3 MovePose(const Similarity3& b_from_a, const Rigid3& cam_from_a);

// The least squares similarity from the points `from` to the points `to`
// (Umeyama 1991); columns with the same index are of one point. Points on a
// line leave the rotation about it open.
Similarity3 AlignPoints(const Eigen::Matrix3Xd& from,
                        const Eigen::Matrix3Xd& to);

// The similarity that brings the cameras of `from` back to those of `to`; two
// poses with the same index are of one camera. The rotation is the mean of the
// rotations between the cameras: it keeps the images in place where centres
// on a line, or in a small part of space, tell little about it. The scale is
// the one of AlignPoints between the centres, or 1 where they coincide in both
// sets. The translation brings the means of the centres together.
// nullopt: no poses, not finite, or the centres contradict each other (they
// coincide in one of the sets only, or point the other way).
std::optional<Similarity3> AlignPoses(const std::vector<Rigid3>& from,
                                      const std::vector<Rigid3>& to);

}  // namespace curvix
