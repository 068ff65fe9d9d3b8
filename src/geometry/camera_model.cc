// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/scene.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/angles.h"
#include "base/check.h"
#include "base/count_text.h"
#include "geometry/distortion.h"

namespace curvix {
namespace {

struct ModelRow {
  std::string_view name;
  int num_params;
};

// In the order of COLMAP's ids.
constexpr std::array<ModelRow, 17> kModels = {
    {{"SIMPLE_PINHOLE", 3},
     {"PINHOLE", 4},
     {"SIMPLE_RADIAL", 4},
     {"RADIAL", 5},
     {"OPENCV", 8},
     {"OPENCV_FISHEYE", 8},
     {"FULL_OPENCV", 12},
     {"FOV", 5},
     {"SIMPLE_RADIAL_FISHEYE", 4},
     {"RADIAL_FISHEYE", 5},
     {"THIN_PRISM_FISHEYE", 12},
     {"RAD_TAN_THIN_PRISM_FISHEYE", 16},
     {"SIMPLE_DIVISION", 4},
     {"DIVISION", 5},
     {"SIMPLE_FISHEYE", 3},
     {"FISHEYE", 4},
     {"EUCM", 6}}};

bool IsKnown(int id) {
  return id >= 0 && id < static_cast<int>(kModels.size());
}

const ModelRow& RowOf(CameraModel model) {
  const int id = static_cast<int>(model);
  CURVIX_CHECK(IsKnown(id), "camera model id " << id);
  return kModels[static_cast<std::size_t>(id)];
}

struct Pinhole {
  Eigen::Array2d focal;
  Eigen::Array2d center;
};

Pinhole PinholeOf(const Camera& camera) {
  CURVIX_CHECK(
      static_cast<int>(camera.params.size()) == NumParams(camera.model),
      ModelName(camera.model)
          << " with " << camera.params.size() << " parameters");
  const double* p = camera.params.data();
  if (NumFocalLengths(camera.model) == 1) return {{p[0], p[0]}, {p[1], p[2]}};
  return {{p[0], p[1]}, {p[2], p[3]}};
}

// A distorted point (x, y) with its Jacobian d(x, y)/d(u, v).
struct Linearized {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;

  // Whether the model is one-to-one here and has not folded over.
  bool Regular() const {
    return point.allFinite() && jacobian.allFinite() &&
           jacobian.determinant() > 0;
  }
};

Linearized Linearize(const Camera& camera, const Eigen::Vector2d& uv) {
  const PlanePoint<Dual2> p = Distort<Dual2>(
      camera,
      {{uv.x(), Eigen::Vector2d::UnitX()}, {uv.y(), Eigen::Vector2d::UnitY()}});
  Linearized result;
  result.point << p.x.value, p.y.value;
  result.jacobian.row(0) = p.x.gradient.transpose();
  result.jacobian.row(1) = p.y.gradient.transpose();
  return result;
}

struct Estimate {
  Eigen::Vector2d uv;
  Linearized at;
  double error_px;
};

Estimate Evaluate(const Camera& camera,
                  const Eigen::Array2d& focal,
                  const Eigen::Vector2d& target,
                  const Eigen::Vector2d& uv) {
  Estimate estimate{uv, Linearize(camera, uv), 0};
  estimate.error_px =
      (focal * (estimate.at.point - target).array()).matrix().norm();
  return estimate;
}

// One Newton step, limited in length and halved until it stays on the regular
// branch and comes closer; nullopt if it never does.
std::optional<Estimate> Step(const Camera& camera,
                             const Eigen::Array2d& focal,
                             const Eigen::Vector2d& target,
                             const Estimate& from) {
  const Eigen::Vector2d newton =
      from.at.jacobian.inverse() * (target - from.at.point);
  const double limit = 0.5 * (from.uv.norm() + 0.5);
  double scale = std::min(1.0, limit / newton.norm());
  for (int halving = 0; halving < 20; ++halving, scale /= 2) {
    const Estimate next =
        Evaluate(camera, focal, target, from.uv + scale * newton);
    if (next.at.Regular() && next.error_px < from.error_px) return next;
  }
  return std::nullopt;
}

// Newton's method from `target` itself or, where the model is not regular
// there, from the nearest regular point on the way to the centre.
std::optional<Estimate> Solve(const Camera& camera,
                              const Eigen::Array2d& focal,
                              const Eigen::Vector2d& target) {
  Estimate best = Evaluate(camera, focal, target, target);
  for (int i = 0; i < 20 && !best.at.Regular(); ++i) {
    best = Evaluate(camera, focal, target, best.uv / 2);
  }
  if (!best.at.Regular()) return std::nullopt;
  constexpr double kGoal_px = 1e-10;
  for (int i = 0; i < 100 && best.error_px > kGoal_px; ++i) {
    const std::optional<Estimate> next = Step(camera, focal, target, best);
    if (!next) break;
    best = *next;
  }
  constexpr double kMaxError_px = 1e-6;
  if (best.error_px > kMaxError_px) return std::nullopt;
  return best;
}

// The sentence that is wrong with the values of the parameters, or empty.
std::string WrongParameter(const Camera& camera) {
  const std::vector<double>& params = camera.params;
  if (!std::ranges::all_of(params, [](double p) { return std::isfinite(p); })) {
    return "a parameter is not a finite number";
  }
  if (!(PinholeOf(camera).focal > 0).all()) {
    return "the focal length is not positive";
  }
  if (camera.model == CameraModel::kFov && std::abs(params[4]) >= kPi) {
    return "omega is not between -pi and pi";
  }
  if (camera.model == CameraModel::kEucm &&
      !(params[4] >= 0 && params[4] <= 1 && params[5] > 0)) {
    return "alpha is not between 0 and 1, or beta is not positive";
  }
  return "";
}

}  // namespace

int NumParams(CameraModel model) { return RowOf(model).num_params; }

std::string_view ModelName(CameraModel model) { return RowOf(model).name; }

std::optional<CameraModel> ModelFromName(std::string_view name) {
  for (std::size_t id = 0; id < kModels.size(); ++id) {
    if (kModels[id].name == name) return static_cast<CameraModel>(id);
  }
  return std::nullopt;
}

std::optional<CameraModel> ModelFromId(int colmap_model_id) {
  if (!IsKnown(colmap_model_id)) return std::nullopt;
  return static_cast<CameraModel>(colmap_model_id);
}

Status Validate(const Camera& camera) {
  const int id = static_cast<int>(camera.model);
  if (!IsKnown(id)) {
    return Status::InvalidArgument("Camera model id " + std::to_string(id) +
                                   " is not known.");
  }
  const std::string name(ModelName(camera.model));
  if (camera.width <= 0 || camera.height <= 0) {
    return Status::InvalidArgument(
        name + " camera of size " + std::to_string(camera.width) + " x " +
        std::to_string(camera.height) + ": width and height must be positive.");
  }
  const std::size_t expected =
      static_cast<std::size_t>(NumParams(camera.model));
  if (camera.params.size() != expected) {
    return Status::InvalidArgument(
        name + " camera with " + Plural(camera.params.size(), "parameter") +
        ": the model has " + std::to_string(expected) + ".");
  }
  const std::string wrong = WrongParameter(camera);
  if (!wrong.empty())
    return Status::InvalidArgument(name + " camera: " + wrong + ".");
  return {};
}

Eigen::Matrix3d PinholeCalibration(const Camera& camera) {
  const Pinhole pinhole = PinholeOf(camera);
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k.topLeftCorner<2, 2>().diagonal() = pinhole.focal.matrix();
  k.topRightCorner<2, 1>() = pinhole.center.matrix();
  return k;
}

bool IsPinhole(const Camera& camera) {
  return camera.model == CameraModel::kPinhole ||
         camera.model == CameraModel::kSimplePinhole;
}

Eigen::Vector2d ImageFromIdeal(const Camera& camera,
                               const Eigen::Vector2d& uv) {
  const Pinhole pinhole = PinholeOf(camera);
  const PlanePoint<double> p = Distort<double>(camera, {uv.x(), uv.y()});
  return pinhole.focal * Eigen::Array2d(p.x, p.y) + pinhole.center;
}

std::optional<Eigen::Vector2d> IdealFromImage(const Camera& camera,
                                              const Eigen::Vector2d& pixel) {
  const double max_radius = std::tan(DegToRad(80));
  const Pinhole pinhole = PinholeOf(camera);
  Eigen::Vector2d uv = (pixel.array() - pinhole.center) / pinhole.focal;
  if (!uv.allFinite()) return std::nullopt;
  if (!IsPinhole(camera)) {
    const std::optional<Estimate> solution = Solve(camera, pinhole.focal, uv);
    if (!solution) return std::nullopt;
    uv = solution->uv;
  }
  if (uv.norm() > max_radius) return std::nullopt;
  return uv;
}

Eigen::Matrix2d ImageFromIdealJacobian(const Camera& camera,
                                       const Eigen::Vector2d& uv) {
  const Pinhole pinhole = PinholeOf(camera);
  return pinhole.focal.matrix().asDiagonal() * Linearize(camera, uv).jacobian;
}

std::optional<Eigen::Vector2d> Project(const Camera& camera,
                                       const Rigid3& cam_from_world,
                                       const Eigen::Vector3d& position) {
  const Eigen::Vector3d x = cam_from_world * position;
  if (!(x.z() > 0)) return std::nullopt;
  const Eigen::Vector2d pixel = ImageFromIdeal(camera, x.hnormalized());
  if (!pixel.allFinite()) return std::nullopt;
  return pixel;
}

}  // namespace curvix
