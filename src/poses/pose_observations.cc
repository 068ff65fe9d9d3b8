// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_observations.h"

#include <curvix/scene.h>
#include <Eigen/Geometry>

#include "geometry/directions.h"

namespace curvix {
namespace {

PoseObservation ObservationOfEdge(const PoseProblem& problem,
                                  std::size_t sample_idx,
                                  const PoseSample::Observation& seen) {
  const auto view_idx = static_cast<std::size_t>(seen.view_idx);
  const View& view = problem.scene.views[view_idx];
  const OccludingContour& contour = problem.samples[sample_idx].contour;
  const Rigid3& pose = view.cam_from_world;
  const Eigen::Vector3d center = pose.Inverse().translation;
  Eigen::Matrix3d moves;
  moves << AxesAcross(contour.axis.tangent), SideSeenFrom(contour, center);
  Eigen::Matrix2d axes;
  axes << -seen.edge.tangent.y(), seen.edge.tangent.x(), 0, 0;
  return {view_idx,
          static_cast<std::size_t>(view.camera_idx),
          sample_idx,
          pose * SeenFrom(contour, center).position,
          pose.rotation.toRotationMatrix() * moves,
          seen.edge.position,
          axes / problem.sigmas_px[view_idx]};
}

PoseObservation ObservationOfPoint(const PoseProblem& problem,
                                   std::size_t point_idx,
                                   const PointSample::Observation& seen) {
  const auto view_idx = static_cast<std::size_t>(seen.view_idx);
  const View& view = problem.scene.views[view_idx];
  return {view_idx,
          static_cast<std::size_t>(view.camera_idx),
          problem.samples.size() + point_idx,
          view.cam_from_world * problem.points[point_idx].position,
          view.cam_from_world.rotation.toRotationMatrix(),
          seen.pixel,
          Eigen::Matrix2d::Identity() / problem.point_sigma_px};
}

}  // namespace

std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem) {
  std::vector<PoseObservation> all;
  for (std::size_t i = 0; i < problem.samples.size(); ++i) {
    for (const auto& seen : problem.samples[i].observations) {
      all.push_back(ObservationOfEdge(problem, i, seen));
    }
  }
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    for (const auto& seen : problem.points[i].observations) {
      all.push_back(ObservationOfPoint(problem, i, seen));
    }
  }
  return all;
}

}  // namespace curvix
