// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/main_part.h"

#include <algorithm>
#include <cstddef>

namespace curvix {
namespace {

constexpr double kMinGap = 0.3;          // of what the main part takes
constexpr double kMaxShareBeyond = 0.1;  // of the length

// What one curve takes of one axis of the drawing.
struct Extent {
  double low = 0;
  double high = 0;
  double weight = 0;
};

double Middle(const Extent& extent) { return (extent.low + extent.high) / 2; }

// From the quartiles of the middles on, what follows without a large gap.
Extent MainExtent(std::vector<Extent> extents) {
  std::sort(extents.begin(), extents.end(), [](const auto& a, const auto& b) {
    return Middle(a) < Middle(b);
  });
  double total = 0;
  for (const Extent& extent : extents) total += extent.weight;
  double below = 0;
  Extent main = {Middle(extents.front()), Middle(extents.back())};
  for (const Extent& extent : extents) {
    if (below <= total / 4) main.low = Middle(extent);
    below += extent.weight;
    if (below <= 3 * total / 4) main.high = Middle(extent);
  }
  main.high = std::max(main.low, main.high);
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    const double gap = kMinGap * (main.high - main.low);
    for (const Extent& extent : extents) {
      if (extent.low > main.high + gap || extent.high < main.low - gap)
        continue;
      if (extent.low >= main.low && extent.high <= main.high) continue;
      main.low = std::min(main.low, extent.low);
      main.high = std::max(main.high, extent.high);
      has_grown = true;
    }
  }
  return main;
}

}  // namespace

Eigen::AlignedBox2d MainBoundsOf(const std::vector<SheetCurve>& curves) {
  const Eigen::AlignedBox2d all = BoundsOf(curves);
  if (all.isEmpty()) return all;
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const SheetCurve& curve : curves) boxes.push_back(BoundsOf({curve}));
  Eigen::AlignedBox2d main = all;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<Extent> extents;
    for (const Eigen::AlignedBox2d& box : boxes) {
      extents.push_back(
          {box.min()[axis], box.max()[axis], box.diagonal().norm()});
    }
    const Extent extent = MainExtent(std::move(extents));
    main.min()[axis] = extent.low;
    main.max()[axis] = extent.high;
  }
  double length = 0;
  double beyond = 0;
  for (const Eigen::AlignedBox2d& box : boxes) {
    length += box.diagonal().norm();
    if (!main.contains(box)) beyond += box.diagonal().norm();
  }
  return beyond > kMaxShareBeyond * length ? all : main;
}

}  // namespace curvix
