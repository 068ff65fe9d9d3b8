// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. Gaussian derivative filters.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/gray_image.h"

namespace curvix {

// The Gaussian of standard deviation `sigma` and its first three derivatives
// at x.
std::array<double, 4> GaussianDerivatives(double x, double sigma);

// How far filters reach: beyond it the Gaussian is below 4e-6 of its peak.
int GaussianRadius(double sigma);

// The standard deviation of each component of the gradient that white noise of
// standard deviation 1 causes. With the filter G'(x) G(y) it is the root of
// (integral of G'^2) (integral of G^2) = 1 / (4 sqrt(pi) sigma^3) *
// 1 / (2 sqrt(pi) sigma), that is 1 / (sqrt(8 pi) sigma^2).
double GradientNoiseGain(double sigma_px);

// Derivatives of a smoothed image at single points. Keeps its filters between
// calls: one object per thread.
class ImageDerivatives {
 public:
  // `image` must outlive this object and is not empty; sigma > 0. Filters reach
  // GaussianRadius(), but if `as_published` only 4 sigma from grid points that
  // are pixel centres.
  ImageDerivatives(const GrayImage& image, double sigma_px, bool as_published);

  // Element (a, b) is d^(a + b) I / dy^a dx^b, up to a + b = 3, of the image
  // smoothed by the Gaussian at `position` (pixels, first centre at
  // (0.5, 0.5)). Computed at the 4 x 4 points of the half-pixel grid around the
  // position and interpolated between them by cubic convolution (Keys 1981,
  // a = -0.5). Beyond its border the image continues with its border values.
  Eigen::Matrix4d At(const Eigen::Vector2d& position);

 private:
  // By order of the derivative, 0 to 3.
  using Orders = Eigen::Array4f;
  // The weights of one pixel along one axis.
  struct Weights {
    Orders all;       // from all grid points, as far as the Gaussian reaches
    Orders on_pixel;  // of it, from grid points on pixels
    Orders far;       // of that, from beyond the filters of pixels
    bool is_far = false;  // whether there is any
    int pixel = 0;        // or the nearest inside the image
  };
  using Filter = std::vector<Weights>;
  void SetFilter(double position, int num_pixels, Filter& filter) const;

  const GrayImage& image_;
  int radius_;
  // Gaussian derivatives at every half pixel from the negative to the positive
  // reach of the four grid points; zero beyond the filters' reach.
  std::vector<Orders> table_, far_table_;
  int near_reach_;  // half pixels
  Filter x_, y_;    // of the last call
  std::vector<const Weights*> far_x_;
};

}  // namespace curvix
