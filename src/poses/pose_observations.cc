// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_observations.h"

#include <curvix/scene.h>
#include <Eigen/Geometry>
#include <cstddef>
#include <utility>

#include "geometry/directions.h"

namespace curvix {
namespace {

constexpr double kLensStepPx = 0.01;  // of numerical derivatives

Eigen::Vector3d CenterOf(const Rigid3& cam_from_world) {
  return cam_from_world.Inverse().translation;
}

PoseObservation ObservationOfEdge(const View& view,
                                  const OccludingContour& contour,
                                  const ImageEdge& edge,
                                  double sigma_px) {
  const Rigid3& pose = view.cam_from_world;
  const Eigen::Vector3d center = CenterOf(pose);
  Eigen::Matrix3d moves;
  moves << AxesAcross(contour.axis.tangent), SideSeenFrom(contour, center);
  return {pose * SeenFrom(contour, center).position,
          pose.rotation.toRotationMatrix() * moves,
          Eigen::Vector2d(-edge.tangent.y(), edge.tangent.x()) / sigma_px,
          edge.position,
          static_cast<std::size_t>(view.camera_idx)};
}

PoseObservation ObservationOfPoint(const View& view,
                                   const PointSample& point,
                                   const Eigen::Vector2d& pixel,
                                   const Eigen::Vector2d& direction) {
  return {view.cam_from_world * point.position,
          view.cam_from_world.rotation.toRotationMatrix(),
          direction,
          pixel,
          static_cast<std::size_t>(view.camera_idx)};
}

}  // namespace

EquationOwners OwnersOf(const PoseProblem& problem) {
  std::vector<EquationOwners::Owner> owners;
  for (std::size_t i = 0; i < problem.samples.size(); ++i) {
    for (const PoseSample::Observation& seen :
         problem.samples[i].observations) {
      owners.push_back({static_cast<std::size_t>(seen.view_idx), i});
    }
  }
  const std::size_t num_samples = problem.samples.size();
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    for (const PointSample::Observation& seen :
         problem.points[i].observations) {
      const auto view_idx = static_cast<std::size_t>(seen.view_idx);
      owners.insert(owners.end(), 2, {view_idx, num_samples + i});
    }
  }
  std::vector<std::size_t> camera_of_view;
  for (const View& view : problem.scene.views) {
    camera_of_view.push_back(static_cast<std::size_t>(view.camera_idx));
  }
  return {std::move(owners),
          std::move(camera_of_view),
          num_samples + problem.points.size()};
}

std::vector<PoseObservation> ObservationsOf(const PoseProblem& problem) {
  const auto view_of = [&](const auto& seen) -> const View& {
    return problem.scene.views[static_cast<std::size_t>(seen.view_idx)];
  };
  std::vector<PoseObservation> all;
  for (const PoseSample& sample : problem.samples) {
    for (const PoseSample::Observation& seen : sample.observations) {
      const double sigma_px =
          problem.sigmas_px[static_cast<std::size_t>(seen.view_idx)];
      all.push_back(ObservationOfEdge(
          view_of(seen), sample.contour, seen.edge, sigma_px));
    }
  }
  for (const PointSample& point : problem.points) {
    for (const PointSample::Observation& seen : point.observations) {
      for (const int axis : {0, 1}) {
        all.push_back(ObservationOfPoint(
            view_of(seen),
            point,
            seen.pixel,
            Eigen::Vector2d::Unit(axis) / problem.point_sigma_px));
      }
    }
  }
  return all;
}

CameraState::CameraState(const Lens& lens,
                         const LensChange& change,
                         bool has_derivatives)
    : camera_(lens.Changed(change)) {
  for (Eigen::Index i = 0; has_derivatives && i < change.size(); ++i) {
    const LensChange step = kLensStepPx * LensChange::Unit(i);
    around_.push_back(lens.Changed(change - step));
    around_.push_back(lens.Changed(change + step));
  }
}

LensChange CameraState::Derivatives(const Eigen::Vector2d& direction,
                                    const Eigen::Vector2d& ideal) const {
  LensChange result;
  for (std::size_t i = 0; 2 * i < around_.size(); ++i) {
    const Eigen::Vector2d difference =
        ImageFromIdeal(around_[2 * i + 1], ideal) -
        ImageFromIdeal(around_[2 * i], ideal);
    result[static_cast<Eigen::Index>(i)] =
        direction.dot(difference) / (2 * kLensStepPx);
  }
  return result;
}

}  // namespace curvix
