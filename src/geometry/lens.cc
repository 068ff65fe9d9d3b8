// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/lens.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/median.h"
#include "geometry/distortion.h"

namespace curvix {
namespace {

constexpr int kGridSteps = 4;  // of the image, where changes are measured
constexpr double kSmallChange = 1e-6;

std::vector<Eigen::Vector2d> IdealGrid(const Camera& camera) {
  std::vector<Eigen::Vector2d> grid;
  for (int y = 0; y <= kGridSteps; ++y) {
    for (int x = 0; x <= kGridSteps; ++x) {
      const Eigen::Vector2d pixel(camera.width * x / double{kGridSteps},
                                  camera.height * y / double{kGridSteps});
      if (const auto ideal = IdealFromImage(camera, pixel)) {
        grid.push_back(*ideal);
      }
    }
  }
  return grid;
}

// What a model is a special case of.
constexpr std::array<std::pair<CameraModel, CameraModel>, 7> kMoreTerms = {
    {{CameraModel::kSimplePinhole, CameraModel::kSimpleRadial},
     {CameraModel::kSimpleRadial, CameraModel::kRadial},
     {CameraModel::kPinhole, CameraModel::kOpenCV},
     {CameraModel::kRadial, CameraModel::kOpenCV},
     {CameraModel::kSimpleFisheye, CameraModel::kSimpleRadialFisheye},
     {CameraModel::kSimpleRadialFisheye, CameraModel::kRadialFisheye},
     {CameraModel::kRadialFisheye, CameraModel::kOpenCVFisheye}}};

// One parameter changed. The second focal length keeps its ratio to the first.
Camera WithStep(Camera camera, int param_idx, double step) {
  std::vector<double>& params = camera.params;
  if (param_idx == 0 && NumFocalLengths(camera.model) == 2) {
    params[1] *= 1 + step / params[0];
  }
  params[static_cast<std::size_t>(param_idx)] += step;
  return camera;
}

}  // namespace

Eigen::Matrix<double, 2, 3> PixelJacobian(
    const Eigen::Matrix2d& pixel_from_ideal, const Eigen::Vector3d& x) {
  Eigen::Matrix<double, 2, 3> scaled;
  scaled << 1, 0, -x.x() / x.z(), 0, 1, -x.y() / x.z();
  return pixel_from_ideal * scaled / x.z();
}

Eigen::Matrix<double, 2, 3> PixelJacobian(const Camera& camera,
                                          const Eigen::Vector3d& x) {
  return PixelJacobian(ImageFromIdealJacobian(camera, x.hnormalized()), x);
}

ImageEdge EdgeInImage(const ImageEdge& ideal, const Camera& camera) {
  if (IsPinhole(camera)) return ideal;
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  const Eigen::Array2d focal = calibration.diagonal().head<2>();
  const Eigen::Vector2d uv =
      (ideal.position - calibration.topRightCorner<2, 1>()).array() / focal;
  return {ImageFromIdeal(camera, uv),
          (ImageFromIdealJacobian(camera, uv) *
           (ideal.tangent.array() / focal).matrix())
              .normalized()};
}

std::optional<ImageEdge> EdgeInIdealImage(const ImageEdge& in_image,
                                          const Camera& camera) {
  if (IsPinhole(camera)) return in_image;
  const auto uv = IdealFromImage(camera, in_image.position);
  if (!uv) return std::nullopt;
  const Eigen::Matrix2d image_from_ideal = ImageFromIdealJacobian(camera, *uv);
  if (!(image_from_ideal.determinant() > 0)) return std::nullopt;
  const Eigen::Matrix3d calibration = PinholeCalibration(camera);
  return ImageEdge{(calibration * uv->homogeneous()).head<2>(),
                   (calibration.topLeftCorner<2, 2>() *
                    image_from_ideal.inverse() * in_image.tangent)
                       .normalized()};
}

std::optional<ImageEdge> CarryEdge(const ImageEdge& edge,
                                   const Camera& from,
                                   const Camera& to) {
  if (from == to) return edge;
  return EdgeInIdealImage(EdgeInImage(edge, from), to);
}

Lens::Lens(const Camera& start) : start_(start) {
  const std::vector<Eigen::Vector2d> grid = IdealGrid(start);
  for (int i = 0; i < num_used(); ++i) {
    const Camera changed = WithStep(start, i, kSmallChange);
    double largest_px = 0;
    for (const Eigen::Vector2d& ideal : grid) {
      const Eigen::Vector2d shift =
          ImageFromIdeal(changed, ideal) - ImageFromIdeal(start, ideal);
      largest_px = std::max(largest_px, shift.norm());
    }
    if (largest_px > 0) units_[i] = kSmallChange / largest_px;
  }
}

int Lens::num_used() const {
  return std::min(static_cast<int>(start_.params.size()),
                  static_cast<int>(LensChange::SizeAtCompileTime));
}

std::optional<Eigen::Index> Lens::AspectRatioIndex() const {
  if (NumFocalLengths(start_.model) == 1) return std::nullopt;
  return 1;
}

Camera Lens::Changed(const LensChange& change) const {
  Camera camera = start_;
  for (int i = 0; i < num_used(); ++i) {
    camera = WithStep(std::move(camera), i, units_[i] * change[i]);
  }
  return camera;
}

LensChange Lens::ChangeTo(const Camera& camera) const {
  LensChange change = LensChange::Zero();
  Camera changed = start_;
  for (int i = 0; i < num_used(); ++i) {
    if (!(units_[i] > 0)) continue;
    const auto k = static_cast<std::size_t>(i);
    const double step = camera.params[k] - changed.params[k];
    change[i] = step / units_[i];
    changed = WithStep(std::move(changed), i, step);
  }
  return change;
}

double ShiftOfImage(const Camera& from, const Camera& to) {
  constexpr int kSteps = 10;
  const Eigen::Vector2d size(from.width, from.height);
  const auto shift_at = [&](const Eigen::Vector2d& pixel) {
    const auto ideal = IdealFromImage(from, pixel);
    return ideal ? Eigen::Vector2d(ImageFromIdeal(to, *ideal) - pixel)
                 : Eigen::Vector2d(0, 0);
  };
  const Eigen::Vector2d middle = shift_at(size / 2);
  std::vector<double> shifts;
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      const Eigen::Vector2d pixel =
          Eigen::Array2d(x, y) / kSteps * size.array();
      shifts.push_back((shift_at(pixel) - middle).norm());
    }
  }
  return MedianOrNan(std::move(shifts));
}

Camera WithMoreTerms(const Camera& camera) {
  Camera more = camera;
  for (const auto& [model, general] : kMoreTerms) {
    if (model != camera.model) continue;
    more.model = general;
    if (NumFocalLengths(general) > NumFocalLengths(model)) {
      more.params.insert(more.params.begin(), camera.params[0]);
    }
    more.params.resize(static_cast<std::size_t>(NumParams(general)), 0);
  }
  return more;
}

}  // namespace curvix
