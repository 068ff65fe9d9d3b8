// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/moved_curves.h"

namespace curvix {
namespace {

Eigen::Matrix3d MoveCovariance(const Similarity3& b_from_a,
                               const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d m =
      b_from_a.scale * b_from_a.rotation.toRotationMatrix();
  const Eigen::Matrix3d moved = m * covariance * m.transpose();
  return (moved + moved.transpose()) / 2;
}

void MoveFit(const Similarity3& b_from_a, CurveFit& fit) {
  const auto vector = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return b_from_a.scale * (b_from_a.rotation * v);
  };
  fit.start = b_from_a * fit.start;
  fit.end = b_from_a * fit.end;
  fit.start_covariance = MoveCovariance(b_from_a, fit.start_covariance);
  fit.end_covariance = MoveCovariance(b_from_a, fit.end_covariance);
  if (fit.kind == FitKind::kArc || fit.kind == FitKind::kEllipse) {
    fit.center = b_from_a * fit.center;
    fit.major = vector(fit.major);
    fit.minor = vector(fit.minor);
  }
  const Eigen::Matrix3d turn = b_from_a.rotation.toRotationMatrix();
  Eigen::Matrix<double, 7, 7> arc = Eigen::Matrix<double, 7, 7>::Zero();
  arc.topLeftCorner<3, 3>() = b_from_a.scale * turn;
  arc.block<3, 3>(3, 3) = turn;
  arc(6, 6) = b_from_a.scale;
  fit.arc_covariance = arc * fit.arc_covariance * arc.transpose();
  for (Eigen::Vector3d& point : fit.control_points) point = b_from_a * point;
  for (double* length :
       {&fit.rms_residual, &fit.max_residual, &fit.sigma, &fit.radius_sigma}) {
    *length *= b_from_a.scale;
  }
}

void MoveGroup(const Similarity3& b_from_a, FitGroup& group) {
  group.direction = b_from_a.rotation * group.direction;
  group.point = b_from_a * group.point;
  group.radius *= b_from_a.scale;
  if (group.kind != GroupKind::kParallel) group.sigma *= b_from_a.scale;
}

}  // namespace

Curve MoveCurve(const Similarity3& b_from_a, Curve curve) {
  for (CurveSample& sample : curve.samples) {
    sample.position = b_from_a * sample.position;
    sample.tangent = b_from_a.rotation * sample.tangent;
    sample.sigma *= b_from_a.scale;
    sample.covariance = MoveCovariance(b_from_a, sample.covariance);
  }
  return curve;
}

FittedCurves MoveFits(const Similarity3& b_from_a, FittedCurves fitted) {
  for (FittedCurve& curve : fitted.curves) {
    for (CurveFit& fit : curve.fits) MoveFit(b_from_a, fit);
  }
  for (CurveNode& node : fitted.nodes) {
    node.position = b_from_a * node.position;
    node.covariance = MoveCovariance(b_from_a, node.covariance);
  }
  for (FitGroup& group : fitted.structure.groups) MoveGroup(b_from_a, group);
  return fitted;
}

Scene MoveScene(const Similarity3& b_from_a, Scene scene) {
  for (View& view : scene.views) {
    view.cam_from_world = MovePose(b_from_a, view.cam_from_world);
  }
  for (ScenePoint& point : scene.points) {
    point.position = b_from_a * point.position;
  }
  return scene;
}

}  // namespace curvix
