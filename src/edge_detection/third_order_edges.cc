// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. Sub-pixel edges with third-order orientation.
#include "edge_detection/third_order_edges.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/check.h"
#include "edge_detection/gaussian_derivatives.h"
#include "edge_detection/gradient_rows.h"

namespace curvix {
namespace {

// Three consecutive rows of the half-pixel grid.
using RowWindow = std::array<const GradientRow*, 3>;

// The magnitudes one step along the gradient and one against it, interpolated
// between the two nearest grid points of the ring around point `i` of the
// middle row. `step` is how far away they are, in grid steps.
struct Profile {
  float ahead;
  float behind;
  float step;
};

Profile ProfileAlongGradient(const RowWindow& rows, std::size_t i) {
  const float gx = rows[1]->x[i];
  const float gy = rows[1]->y[i];
  const bool steep = std::abs(gy) > std::abs(gx);
  // Main axis a step of +-1, minor axis a step of `slope` >= 0 times +-1.
  const float slope = steep ? std::abs(gx / gy) : std::abs(gy / gx);
  const int dx = gx < 0 ? -1 : 1;
  const int dy = gy < 0 ? -1 : 1;
  const auto magnitude = [&](int x_step, int y_step) {
    const std::size_t row = static_cast<std::size_t>(1 + y_step);
    return rows[row]->magnitude[i + static_cast<std::size_t>(x_step)];
  };
  const auto interpolated = [&](int sign) {
    const float on_axis =
        steep ? magnitude(0, sign * dy) : magnitude(sign * dx, 0);
    const float on_diagonal = magnitude(sign * dx, sign * dy);
    return on_axis + slope * (on_diagonal - on_axis);
  };
  return {interpolated(1), interpolated(-1), std::sqrt(1 + slope * slope)};
}

// Where the magnitude peaks along the gradient, in grid steps from point `i`;
// nullopt where it does not peak next to this point. Of two equal neighbours
// the one on the bright side counts.
std::optional<float> PeakOffset(const RowWindow& rows, std::size_t i) {
  const float centre = rows[1]->magnitude[i];
  const Profile profile = ProfileAlongGradient(rows, i);
  if (centre <= profile.ahead || centre < profile.behind) return std::nullopt;
  const float curvature = profile.ahead + profile.behind - 2 * centre;
  return profile.step * (profile.behind - profile.ahead) / (2 * curvature);
}

// The gradient of F = g^T H g from the derivatives d(order in y, order in x).
Eigen::Vector2d GradientOfF(const Eigen::Matrix4d& d) {
  const double ix = d(0, 1), iy = d(1, 0);
  const double ixx = d(0, 2), ixy = d(1, 1), iyy = d(2, 0);
  const double ixxx = d(0, 3), ixxy = d(1, 2), ixyy = d(2, 1), iyyy = d(3, 0);
  return {2 * (ix * ixx * ixx + ix * ixy * ixy + iy * ixx * ixy +
               iy * iyy * ixy + ix * iy * ixxy) +
              iy * iy * ixyy + ix * ix * ixxx,
          2 * (iy * iyy * iyy + iy * ixy * ixy + ix * iyy * ixy +
               ix * ixx * ixy + ix * iy * ixyy) +
              ix * ix * ixxy + iy * iy * iyyy};
}

// -I_nnn / I_n along the gradient, n. Of a step blurred by a Gaussian of
// standard deviation w it is 1 / w^2.
double Sharpness(const Eigen::Matrix4d& d, const Eigen::Vector2d& gradient) {
  const double strength = gradient.norm();
  if (strength == 0) return 0;
  const double x = gradient.x() / strength;
  const double y = gradient.y() / strength;
  const double third = x * x * x * d(0, 3) + 3 * x * x * y * d(1, 2) +
                       3 * x * y * y * d(2, 1) + y * y * y * d(3, 0);
  return -third / strength;
}

// Towards the bright side F falls: the edge's normal is -grad F. Where F is
// flat, the gradient of the image stands in.
void OrientEdge(const Eigen::Matrix4d& d, Edge2d& edge) {
  const Eigen::Vector2d gradient(d(0, 1), d(1, 0));
  Eigen::Vector2d normal = -GradientOfF(d);
  if (normal.norm() == 0) normal = gradient;
  if (normal.dot(gradient) < 0) normal = -normal;
  edge.angle = static_cast<float>(std::atan2(-normal.x(), normal.y()));
  edge.strength = static_cast<float>(gradient.norm());
  edge.sharpness = static_cast<float>(Sharpness(d, gradient));
  edge.level = static_cast<float>(d(0, 0));
}

// The edge next to point `i` of the middle row, which is row `grid_row`.
std::optional<Eigen::Vector2d> EdgePosition(const RowWindow& rows,
                                            int grid_row,
                                            std::size_t i) {
  const std::optional<float> offset = PeakOffset(rows, i);
  if (!offset) return std::nullopt;
  const GradientRow& row = *rows[1];
  const double pixels_per_gradient = *offset / (2.0 * row.magnitude[i]);
  return Eigen::Vector2d(
      static_cast<double>(i + 1) / 2 + pixels_per_gradient * row.x[i],
      (grid_row + 1) / 2.0 + pixels_per_gradient * row.y[i]);
}

bool IsInside(const GrayImage& image, const Eigen::Vector2d& p, double border) {
  return p.x() >= border && p.y() >= border && p.x() <= image.width - border &&
         p.y() <= image.height - border;
}

}  // namespace

std::vector<Edge2d> LocateEdges(const GrayImage& image,
                                const EdgeDetectionOptions& options,
                                double min_gradient) {
  std::vector<Edge2d> edges;
  if (image.width < 2 || image.height < 2) return edges;
  GradientRows gradients(image, options.sigma_px);
  std::array<GradientRow, 3> ring;
  gradients.Compute(0, ring[0]);
  gradients.Compute(1, ring[1]);
  for (int j = 1; j + 1 < gradients.grid_height(); ++j) {
    const auto slot = [&](int row) -> GradientRow& {
      return ring[static_cast<std::size_t>(row % 3)];
    };
    gradients.Compute(j + 1, slot(j + 1));
    const RowWindow rows = {&slot(j - 1), &slot(j), &slot(j + 1)};
    const std::vector<float>& magnitude = slot(j).magnitude;
    for (std::size_t i = 1; i + 1 < magnitude.size(); ++i) {
      if (!(magnitude[i] > min_gradient)) continue;
      const std::optional<Eigen::Vector2d> position = EdgePosition(rows, j, i);
      if (!position || !IsInside(image, *position, options.border_px)) continue;
      Edge2d& edge = edges.emplace_back();
      edge.position = *position;
      edge.strength = magnitude[i];
      edge.angle = std::atan2(-slot(j).x[i], slot(j).y[i]);
    }
  }
  return edges;
}

void OrientEdges(const GrayImage& image,
                 const EdgeDetectionOptions& options,
                 std::vector<Edge2d>* edges) {
  ImageDerivatives derivatives(image, options.sigma_px);
  for (Edge2d& edge : *edges) OrientEdge(derivatives.At(edge.position), edge);
}

}  // namespace curvix
