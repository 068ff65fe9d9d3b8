// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/camera_rig.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/angles.h"
#include "geometry/directions.h"
#include "geometry/distortion.h"
#include "synthetic/counter_random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

constexpr double kFocalPerSide = 1.3;

// The least and the largest `distortion` for `model`.
std::pair<double, double> RangeOf(CameraModel model) {
  switch (model) {
    case CameraModel::kPinhole:
    case CameraModel::kSimplePinhole:
    case CameraModel::kFisheye:
    case CameraModel::kSimpleFisheye:
      return {0, 0};
    case CameraModel::kFov:
    case CameraModel::kEucm:
      return {0, 0.9};
    default:
      return {-0.5, 0.5};
  }
}

std::vector<Vector3d> InImage(const Rigid3& cam_from_world,
                              const Camera& camera,
                              const std::vector<Vector3d>& points) {
  std::vector<Vector3d> inside;
  for (const Vector3d& x : points) {
    const auto pixel = Project(camera, cam_from_world, x);
    if (pixel && pixel->x() >= 0 && pixel->x() <= camera.width &&
        pixel->y() >= 0 && pixel->y() <= camera.height) {
      inside.push_back(x);
    }
  }
  return inside;
}

double RmsMove(const Rigid3& from,
               const Rigid3& to,
               const Camera& camera,
               const std::vector<Vector3d>& points) {
  double sum = 0;
  for (const Vector3d& x : points) {
    const Eigen::Vector2d before =
        ImageFromIdeal(camera, (from * x).hnormalized());
    const Eigen::Vector2d after =
        ImageFromIdeal(camera, (to * x).hnormalized());
    sum += (after - before).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace

Result<Camera> MakeCamera(const SyntheticOptions& options) {
  const CameraModel model = options.camera_model;
  const std::string name(ModelName(model));
  const auto [min, max] = RangeOf(model);
  if (!(options.distortion >= min && options.distortion <= max)) {
    return Status::InvalidArgument(
        "distortion is " + std::to_string(options.distortion) +
        (max == 0 ? "; it must be 0, as " + name + " has no radial coefficient"
                  : "; with " + name + " it must be between " +
                        std::to_string(min) + " and " + std::to_string(max)));
  }
  Camera camera{model, options.width, options.height, {}};
  camera.params.assign(static_cast<std::size_t>(NumParams(model)), 0.0);
  const double focal = kFocalPerSide * std::min(options.width, options.height);
  std::size_t next = 0;
  camera.params[next++] = focal;
  if (NumFocalLengths(model) == 2) camera.params[next++] = focal;
  camera.params[next++] = options.width / 2.0;
  camera.params[next++] = options.height / 2.0;
  if (next < camera.params.size()) camera.params[next++] = options.distortion;
  if (model == CameraModel::kEucm) camera.params[next] = 1;  // beta
  CURVIX_RETURN_IF_ERROR(Validate(camera));
  return camera;
}

Rigid3 LookingAt(const Vector3d& centre, const Vector3d& target, double roll) {
  const Vector3d forward = (target - centre).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d world_from_cam;
  world_from_cam << right, forward.cross(right), forward;
  const Eigen::AngleAxisd turn(roll, Vector3d::UnitZ());
  Rigid3 pose;
  pose.rotation =
      Eigen::Quaterniond(turn * world_from_cam.transpose()).normalized();
  pose.translation = -(pose.rotation * centre);
  return pose;
}

std::vector<Rigid3> MakePoses(int num_views,
                              double radius,
                              std::uint64_t seed) {
  const double lowest = std::sin(DegToRad(-30));
  const double highest = std::sin(DegToRad(70));
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  const double first_azimuth = 2 * kPi * Uniform(Mix(seed, 0));
  std::vector<Rigid3> poses;
  for (int i = 0; i < num_views; ++i) {
    const std::uint64_t view_seed =
        Mix(seed, static_cast<std::uint64_t>(i + 1));
    const double height = lowest + (highest - lowest) * (i + 0.5) / num_views;
    const double width = std::sqrt(1 - height * height);
    const double azimuth = first_azimuth + golden_angle * i;
    const Vector3d direction(
        width * std::cos(azimuth), width * std::sin(azimuth), height);
    const double roll = DegToRad(40) * (Uniform(Mix(view_seed, 0)) - 0.5);
    const double share = 0.85 + 0.13 * Uniform(Mix(view_seed, 1));
    // tan(half angle of the ball) = share / 2 / focal length in sides.
    const double tangent = share / 2 / kFocalPerSide;
    const double distance = radius * std::sqrt(1 + 1 / (tangent * tangent));
    poses.push_back(LookingAt(distance * direction, {0, 0, 0}, roll));
  }
  return poses;
}

Rigid3 Disturbed(const Rigid3& cam_from_world,
                 const Camera& camera,
                 const std::vector<Vector3d>& points,
                 double rms_px,
                 std::uint64_t seed) {
  const std::vector<Vector3d> inside = InImage(cam_from_world, camera, points);
  if (rms_px == 0 || inside.empty()) return cam_from_world;
  const double distance = cam_from_world.translation.norm();
  Vector3d turn, shift;  // in the frame of the camera
  for (int axis = 0; axis < 3; ++axis) {
    const auto counter = static_cast<std::uint64_t>(2 * axis);
    turn[axis] = Gaussian(seed, counter);
    shift[axis] = distance * Gaussian(seed, counter + 1);
  }
  const auto moved = [&](double factor) {
    return Rigid3{RotationBy(factor * turn), factor * shift} * cam_from_world;
  };
  // The move is close to linear in the factor: a few corrections suffice.
  double factor = 1e-3 * rms_px / kFocalPerSide / camera.width;
  for (int i = 0; i < 5; ++i) {
    factor *= rms_px / RmsMove(cam_from_world, moved(factor), camera, inside);
  }
  return moved(factor);
}

}  // namespace curvix
