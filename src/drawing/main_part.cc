// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/main_part.h"

#include <Eigen/Core>
#include <algorithm>

namespace curvix {
namespace {

constexpr double kMinGap = 0.3;          // of the longer side of the main part
constexpr double kMaxShareBeyond = 0.1;  // of the length

struct WeightedBox {
  Eigen::AlignedBox2d bounds;
  double length = 0;  // of the curve, nearly
};

// The middle below which `share` of the weight of `boxes` lies.
double MiddleAt(double share,
                int axis,
                double total,
                std::vector<WeightedBox> boxes) {
  const auto middle = [&](const WeightedBox& box) {
    return box.bounds.center()[axis];
  };
  std::sort(boxes.begin(), boxes.end(), [&](const auto& a, const auto& b) {
    return middle(a) < middle(b);
  });
  double below = 0;
  for (const WeightedBox& box : boxes) {
    below += box.length;
    if (below >= share * total) return middle(box);
  }
  return middle(boxes.back());
}

// From `main` on, with what follows without a large gap.
Eigen::AlignedBox2d Grown(Eigen::AlignedBox2d main,
                          const std::vector<WeightedBox>& boxes) {
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    const double gap = kMinGap * main.sizes().maxCoeff();
    for (const WeightedBox& box : boxes) {
      if (main.contains(box.bounds)) continue;
      const Eigen::Array2d apart = (box.bounds.min() - main.max())
                                       .cwiseMax(main.min() - box.bounds.max());
      if ((apart > gap).any()) continue;
      main.extend(box.bounds);
      has_grown = true;
    }
  }
  return main;
}

}  // namespace

Eigen::AlignedBox2d MainBoundsOf(const std::vector<SheetCurve>& curves) {
  std::vector<WeightedBox> boxes;
  double length = 0;
  for (const SheetCurve& curve : curves) {
    const Eigen::AlignedBox2d bounds = BoundsOf({curve});
    boxes.push_back({bounds, bounds.diagonal().norm()});
    length += boxes.back().length;
  }
  if (boxes.empty()) return {};
  // Between the quartiles.
  Eigen::AlignedBox2d main;
  for (int axis = 0; axis < 2; ++axis) {
    main.min()[axis] = MiddleAt(0.25, axis, length, boxes);
    main.max()[axis] = MiddleAt(0.75, axis, length, boxes);
  }
  main = Grown(main, boxes);
  double beyond = 0;
  for (const WeightedBox& box : boxes) {
    if (!main.contains(box.bounds)) beyond += box.length;
  }
  return beyond > kMaxShareBeyond * length ? BoundsOf(curves) : main;
}

}  // namespace curvix
