// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Images of a solid, with exact pixel areas.
#include "synthetic/surfaces.h"

#include <algorithm>
#include <array>
#include <optional>

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Look kBackground = {242, 0};

// A square of the image and what its corners show, in the order of
// CornerOffsets().
struct Cell {
  Vector2d origin;  // top left, pixels
  double size;      // pixels
  std::array<Look, 4> corners;
};

const std::array<Vector2d, 4>& CornerOffsets() {
  static const std::array<Vector2d, 4> offsets = {
      Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)};
  return offsets;
}

double MeanGrey(const Cell& cell) {
  double sum = 0;
  for (const Look& corner : cell.corners) sum += corner.grey;
  return sum / 4;
}

bool IsUniform(const Cell& cell) {
  return std::ranges::all_of(cell.corners, [&](const Look& corner) {
    return corner.id == cell.corners[0].id;
  });
}

class Renderer {
 public:
  Renderer(const Solid& solid,
           const Surfaces& surfaces,
           const Camera& camera,
           const Rigid3& cam_from_world)
      : solid_(solid),
        surfaces_(surfaces),
        camera_(camera),
        world_from_cam_(cam_from_world.rotation.conjugate().toRotationMatrix()),
        centre_(cam_from_world.Inverse().translation) {}

  Look At(const Vector2d& pixel) const {
    const std::optional<Vector2d> uv = IdealFromImage(camera_, pixel);
    if (!uv) return kBackground;
    const Ray ray{centre_, world_from_cam_ * uv->homogeneous()};
    const double nearest =
        ray.direction.cross(ray.origin).norm() / ray.direction.norm();
    if (nearest > solid_.radius()) return kBackground;
    const std::optional<Hit> hit = solid_.Trace(ray);
    return hit ? surfaces_.At(ray, *hit) : kBackground;
  }

  // Mean grey value over the cell.
  double Integrate(const Cell& cell, int depth) const {
    constexpr int kMinDepth = 2;
    constexpr int kMaxDepth = 5;
    if (depth >= kMinDepth || (depth == 1 && IsUniform(cell))) {
      if (IsUniform(cell) || depth == kMaxDepth) return MeanGrey(cell);
      if (const auto mean = IntegrateTwoSides(cell)) return *mean;
    }
    const double half = cell.size / 2;
    const auto sample = [&](double x, double y) {
      return At(cell.origin + half * Vector2d(x, y));
    };
    const Look top = sample(1, 0);
    const Look right = sample(2, 1);
    const Look bottom = sample(1, 2);
    const Look left = sample(0, 1);
    const Look middle = sample(1, 1);
    const auto& [c0, c1, c2, c3] = cell.corners;
    const auto quarter = [&](int x, int y, std::array<Look, 4> corners) {
      const Cell part{cell.origin + half * Vector2d(x, y), half, corners};
      return Integrate(part, depth + 1) / 4;
    };
    return quarter(0, 0, {c0, top, middle, left}) +
           quarter(1, 0, {top, c1, right, middle}) +
           quarter(1, 1, {middle, right, c2, bottom}) +
           quarter(0, 1, {left, middle, bottom, c3});
  }

 private:
  // For a cell that one straight border divides: its two parts, weighted by
  // area.
  std::optional<double> IntegrateTwoSides(const Cell& cell) const {
    const std::uint64_t id = cell.corners[0].id;
    int num_changes = 0;
    std::uint64_t other_id = id;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint64_t here = cell.corners[i].id;
      if (here != id && other_id != id && here != other_id) return std::nullopt;
      if (here != id) other_id = here;
      num_changes += here != cell.corners[(i + 1) % 4].id;
    }
    if (num_changes != 2) return std::nullopt;

    std::vector<Vector2d> outline;  // of the part that shows `id`, unit square
    std::array<double, 2> sums = {0, 0};
    std::array<int, 2> counts = {0, 0};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector2d& here = CornerOffsets()[i];
      const Vector2d& next = CornerOffsets()[(i + 1) % 4];
      const bool is_inside = cell.corners[i].id == id;
      sums[is_inside] += cell.corners[i].grey;
      ++counts[is_inside];
      if (is_inside) outline.push_back(here);
      if (cell.corners[i].id == cell.corners[(i + 1) % 4].id) continue;
      const double share = Crossing(cell.origin + cell.size * here,
                                    cell.origin + cell.size * next,
                                    cell.corners[i].id);
      outline.push_back(here + share * (next - here));
    }
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2d& a = outline[i];
      const Vector2d& b = outline[(i + 1) % outline.size()];
      area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return area * sums[1] / counts[1] + (1 - area) * sums[0] / counts[0];
  }

  // The share of the way at which the sample stops showing `from_id`.
  double Crossing(const Vector2d& from,
                  const Vector2d& to,
                  std::uint64_t from_id) const {
    double low = 0;
    double high = 1;
    for (int i = 0; i < 5; ++i) {
      const double middle = (low + high) / 2;
      const bool is_from = At(from + middle * (to - from)).id == from_id;
      (is_from ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  const Solid& solid_;
  const Surfaces& surfaces_;
  const Camera& camera_;
  Eigen::Matrix3d world_from_cam_;
  Vector3d centre_;
};

// Looks at all pixel corners, row-major, (width + 1) x (height + 1).
class CornerGrid {
 public:
  CornerGrid(const Renderer& renderer, int width, int height)
      : width_(width), height_(height) {
    samples_.reserve(static_cast<std::size_t>((width + 1)) *
                     static_cast<std::size_t>(height + 1));
    for (int y = 0; y <= height; ++y) {
      for (int x = 0; x <= width; ++x) {
        samples_.push_back(renderer.At(Vector2d(x, y)));
      }
    }
  }

  Cell PixelCell(int x, int y) const {
    return {Vector2d(x, y),
            1,
            {At(x, y), At(x + 1, y), At(x + 1, y + 1), At(x, y + 1)}};
  }

  // Whether the pixel and the eight around it show one smooth thing.
  bool IsQuiet(int x, int y) const {
    const std::uint64_t id = At(x, y).id;
    for (int row = std::max(0, y - 1); row <= std::min(height_, y + 2); ++row) {
      for (int column = std::max(0, x - 1); column <= std::min(width_, x + 2);
           ++column) {
        if (At(column, row).id != id) return false;
      }
    }
    return true;
  }

 private:
  const Look& At(int x, int y) const {
    return samples_[static_cast<std::size_t>(y) *
                        static_cast<std::size_t>(width_ + 1) +
                    static_cast<std::size_t>(x)];
  }
  int width_;
  int height_;
  std::vector<Look> samples_;
};

}  // namespace

GrayImage Render(const Solid& solid,
                 const Surfaces& surfaces,
                 const Camera& camera,
                 const Rigid3& cam_from_world) {
  const Renderer renderer(solid, surfaces, camera, cam_from_world);
  const CornerGrid corners(renderer, camera.width, camera.height);
  GrayImage image{camera.width, camera.height, {}};
  image.pixels.reserve(static_cast<std::size_t>(camera.width) *
                       static_cast<std::size_t>(camera.height));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Cell cell = corners.PixelCell(x, y);
      const double grey =
          corners.IsQuiet(x, y) ? MeanGrey(cell) : renderer.Integrate(cell, 0);
      image.pixels.push_back(static_cast<float>(std::clamp(grey, 0.0, 255.0)));
    }
  }
  return image;
}

}  // namespace curvix
