// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Edges through lenses, and changes of lenses.
#pragma once

#include <curvix/scene.h>

#include <Eigen/Core>
#include <optional>

#include "geometry/edge_geometry.h"

namespace curvix {

// d pixel / d x for a point at `x` in the camera's frame, x.z() > 0, where
// d pixel / d (x / z) is `pixel_from_ideal`.
Eigen::Matrix<double, 2, 3> PixelJacobian(
    const Eigen::Matrix2d& pixel_from_ideal, const Eigen::Vector3d& x);
Eigen::Matrix<double, 2, 3> PixelJacobian(const Camera& camera,
                                          const Eigen::Vector3d& x);

// An edge of the camera's ideal pinhole in its photographs.
ImageEdge EdgeInImage(const ImageEdge& ideal, const Camera& camera);

// An edge of the camera's photographs in its ideal pinhole; nothing where the
// camera cannot be inverted or mirrors the image.
std::optional<ImageEdge> EdgeInIdealImage(const ImageEdge& in_image,
                                          const Camera& camera);

// An edge of the ideal pinhole of `from` in that of `to`, in the same
// photograph; nothing as above.
std::optional<ImageEdge> CarryEdge(const ImageEdge& edge,
                                   const Camera& from,
                                   const Camera& to);

// Of the first eight parameters of a camera model, in COLMAP's order; of
// models with fewer the rest is not used.
using LensChange = Eigen::Matrix<double, 8, 1>;

// A camera around `start`, by changes of its parameters. Each is measured by
// what it does to the image: 1 moves the pixel that it moves most by 1 px. Of
// two focal lengths, the first changes both and the second their ratio.
class Lens {
 public:
  // `start` must be valid.
  explicit Lens(const Camera& start);

  // How many of the changes are used.
  int num_used() const;

  Camera Changed(const LensChange& change) const;

  // The change that makes `camera`, which has the model of `start`, of it.
  LensChange ChangeTo(const Camera& camera) const;

  // Which change is that of the ratio of the focal lengths, if there are two.
  std::optional<Eigen::Index> AspectRatioIndex() const;

 private:
  Camera start_;
  LensChange units_ = LensChange::Zero();  // parameter per px
};

// By how much pixels shift from one camera to the other, once both look the
// same way at the middle of the image: the median over the image, which has the
// same size in both.
double ShiftOfImage(const Camera& from, const Camera& to);

// The same camera by the next of COLMAP's models that has all of its terms and
// more: SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV; PINHOLE, OPENCV; or
// SIMPLE_FISHEYE, SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE, OPENCV_FISHEYE. As it
// is, if there is none.
Camera WithMoreTerms(const Camera& camera);

}  // namespace curvix
