// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/third_order_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/wide_vectors.h"
#include "edge_detection/gaussian_derivatives.h"

namespace curvix {
namespace {

// Three consecutive rows of the grid.
using RowWindow = std::array<const GradientRow*, 3>;

// Edges nearer to the border of the image are dropped. Pixels.
constexpr double kBorderPx = 4;
// Longest Newton step.
constexpr double kMaxStepPx = 0.3;
constexpr float kNoPeak = std::numeric_limits<float>::infinity();

// Sets offsets[i], for points [begin, end) of the middle row, to where the
// magnitude peaks along the gradient, in grid steps from point i: on a parabola
// through the magnitude there and where the gradient's line meets the ring of
// grid points around it, interpolated between the two nearest. kNoPeak where
// the magnitude does not peak next to this point, or not above `min_gradient`.
// Of two equal neighbours the one on the bright side counts. All neighbours are
// read and then chosen from, so that the loop has no branches and is
// vectorised.
CURVIX_WIDE_VECTORS
void FindPeaks(const RowWindow& rows,
               float min_gradient,
               std::size_t begin,
               std::size_t end,
               float* offsets) {
  const float* x = rows[1]->x.data();
  const float* y = rows[1]->y.data();
  const float* above = rows[0]->magnitude.data();
  const float* magnitude = rows[1]->magnitude.data();
  const float* below = rows[2]->magnitude.data();
  for (std::size_t i = begin; i < end; ++i) {
    const float gx = x[i], gy = y[i];
    const bool is_steep = std::abs(gy) > std::abs(gx);
    const float main = is_steep ? gy : gx;
    const float minor = is_steep ? gx : gy;
    // Steps along the minor axis for one along the main axis.
    const float slope = std::abs(minor / main);
    // Whether the gradient's line goes from below left to above right.
    const bool is_rising = (gx < 0) != (gy < 0);
    const float up_left = above[i - 1], up = above[i], up_right = above[i + 1];
    const float left = magnitude[i - 1], right = magnitude[i + 1];
    const float down_left = below[i - 1], down = below[i];
    const float down_right = below[i + 1];
    // Before the point: above it or, along a row, on its left.
    const float axis_before = is_steep ? up : left;
    const float axis_after = is_steep ? down : right;
    const float rising_before = is_steep ? up_right : down_left;
    const float rising_after = is_steep ? down_left : up_right;
    const float diagonal_before = is_rising ? rising_before : up_left;
    const float diagonal_after = is_rising ? rising_after : down_right;
    const float before = axis_before + slope * (diagonal_before - axis_before);
    const float after = axis_after + slope * (diagonal_after - axis_after);
    const float ahead = main < 0 ? before : after;
    const float behind = main < 0 ? after : before;
    const float centre = magnitude[i];
    const float step = std::sqrt(1 + slope * slope);
    const float curvature = ahead + behind - 2 * centre;
    const float offset = step * (behind - ahead) / (2 * curvature);
    const bool is_peak =
        (centre > min_gradient) & (centre > ahead) & (centre >= behind);
    offsets[i] = is_peak ? offset : kNoPeak;
  }
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

// I_nn and I_nnn, the derivatives along the unit vector n.
double SecondAlong(const Eigen::Matrix4d& d, const Eigen::Vector2d& n) {
  const double x = n.x(), y = n.y();
  return x * x * d(0, 2) + 2 * x * y * d(1, 1) + y * y * d(2, 0);
}
double ThirdAlong(const Eigen::Matrix4d& d, const Eigen::Vector2d& n) {
  const double x = n.x(), y = n.y();
  return x * x * x * d(0, 3) + 3 * x * x * y * d(1, 2) +
         3 * x * y * y * d(2, 1) + y * y * y * d(3, 0);
}

// Along the gradient, -I_nnn / I_n. Of a step blurred by a Gaussian of standard
// deviation w it is 1 / w^2.
double Sharpness(const Eigen::Matrix4d& d) {
  const Eigen::Vector2d gradient(d(0, 1), d(1, 0));
  const double strength = gradient.norm();
  return strength > 0 ? -ThirdAlong(d, gradient / strength) / strength : 0;
}

// From where the derivatives are `d` to where I_nn = 0 along the gradient.
Eigen::Vector2d StepToPeak(const Eigen::Matrix4d& d) {
  const Eigen::Vector2d n = Eigen::Vector2d(d(0, 1), d(1, 0)).normalized();
  const double third = ThirdAlong(d, n);
  if (!(third < 0)) return Eigen::Vector2d::Zero();
  return std::clamp(-SecondAlong(d, n) / third, -kMaxStepPx, kMaxStepPx) * n;
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
  edge.sharpness = static_cast<float>(Sharpness(d));
  edge.level = static_cast<Eigen::half>(d(0, 0));
}

bool IsOffBorder(const GrayImage& image, const Eigen::Vector2d& p) {
  return p.x() >= kBorderPx && p.y() >= kBorderPx &&
         p.x() <= image.width - kBorderPx && p.y() <= image.height - kBorderPx;
}

// Finds the edges of an image row by row. Three rows of gradients are kept, and
// they are computed only where the image is steep.
class EdgeLocator {
 public:
  EdgeLocator(const GrayImage& image,
              const DetectionScale& scale,
              double min_gradient)
      : image_(image),
        min_gradient_(RoundedDown(min_gradient)),
        gradients_(image, scale),
        tiles_(image, gradients_.reach_px(), MaxFlatSpan(min_gradient)),
        offsets_(static_cast<std::size_t>(gradients_.grid_width())) {}

  std::vector<LocatedEdge> Locate() {
    // Enough for foliage. What is not used stays virtual.
    edges_.reserve(image_.pixels.size() / 2);
    ComputeRow(0);
    ComputeRow(1);
    for (int j = 1; j + 1 < gradients_.grid_height(); ++j) {
      ComputeRow(j + 1);
      for (const PixelRun& run : tiles_.Runs(j / gradients_.samples_per_px()))
        LocateInRun(j, run);
    }
    return std::move(edges_);
  }

 private:
  // The largest number of type float up to `value`: x > value is the same for
  // all x of that type.
  static float RoundedDown(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) <= value
               ? rounded
               : std::nextafter(rounded, -1.f);
  }

  // Pixels that span this much have no gradient above `min_gradient`, however
  // sums are rounded.
  float MaxFlatSpan(double min_gradient) const {
    constexpr double kRounding = 1e-3;
    return static_cast<float>((min_gradient - kRounding) /
                              gradients_.max_gain());
  }

  GradientRow& Row(int grid_row) {
    return ring_[static_cast<std::size_t>(grid_row % 3)];
  }

  // Where row `grid_row` or one beside it is steep, and a pixel further.
  void ComputeRow(int grid_row) {
    const int n = gradients_.samples_per_px();
    const int first = std::max(grid_row - 1, 0) / n;
    const int last = std::min((grid_row + 1) / n, image_.height - 1);
    const auto compute = [&](const PixelRun& run) {
      gradients_.Compute(
          grid_row,
          {std::max(run.begin - 1, 0), std::min(run.end + 1, image_.width)},
          Row(grid_row));
    };
    for (const PixelRun& run : tiles_.Runs(first)) compute(run);
    if (&tiles_.Runs(last) == &tiles_.Runs(first)) return;
    for (const PixelRun& run : tiles_.Runs(last)) compute(run);
  }

  void LocateInRun(int grid_row, const PixelRun& run) {
    const RowWindow rows = {
        &Row(grid_row - 1), &Row(grid_row), &Row(grid_row + 1)};
    const auto n = static_cast<std::size_t>(gradients_.samples_per_px());
    const std::size_t begin =
        std::max<std::size_t>(n * static_cast<std::size_t>(run.begin), 1);
    const std::size_t end =
        std::min(n * static_cast<std::size_t>(run.end), offsets_.size() - 1);
    FindPeaks(rows, min_gradient_, begin, end, offsets_.data());
    for (std::size_t i = begin; i < end; ++i) {
      if (offsets_[i] != kNoPeak) AddEdge(*rows[1], grid_row, i);
    }
  }

  // The edge next to point `i` of row `grid_row`, which has a peak there.
  void AddEdge(const GradientRow& row, int grid_row, std::size_t i) {
    const double n = gradients_.samples_per_px();
    const double pixels_per_gradient = offsets_[i] / (n * row.magnitude[i]);
    const Eigen::Vector2d position(
        static_cast<double>(i) / n + 0.5 + pixels_per_gradient * row.x[i],
        grid_row / n + 0.5 + pixels_per_gradient * row.y[i]);
    if (!IsOffBorder(image_, position)) return;
    edges_.push_back({position, {row.x[i], row.y[i]}});
  }

  const GrayImage& image_;
  float min_gradient_;
  GradientRows gradients_;
  SteepTiles tiles_;
  std::array<GradientRow, 3> ring_;  // row j is at j % 3
  std::vector<float> offsets_;       // of the peaks of one row
  std::vector<LocatedEdge> edges_;
};

}  // namespace

std::vector<LocatedEdge> LocateEdges(const GrayImage& image,
                                     const DetectionScale& scale,
                                     double min_gradient) {
  if (image.width < 2 || image.height < 2) return {};
  return EdgeLocator(image, scale, min_gradient).Locate();
}

std::vector<Edge2d> AcrossGradients(const std::vector<LocatedEdge>& edges) {
  std::vector<Edge2d> across(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    across[i].position = edges[i].position;
    across[i].strength = edges[i].strength();
    across[i].crowding = Eigen::half(edges[i].crowding);
    across[i].angle = std::atan2(-edges[i].gradient.x(), edges[i].gradient.y());
  }
  return across;
}

void OrientEdges(const GrayImage& image,
                 double sigma_px,
                 bool refine,
                 std::vector<Edge2d>* edges) {
  const bool as_published = !refine;
  ImageDerivatives derivatives(image, sigma_px, as_published);
  for (Edge2d& edge : *edges) {
    const Eigen::Matrix4d d = derivatives.At(edge.position);
    OrientEdge(d, edge);
    if (refine) edge.position += StepToPeak(d);
  }
}

}  // namespace curvix
