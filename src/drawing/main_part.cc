// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What a drawing is of, without what lies far away.
#include "drawing/sheet.h"

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

// Of one axis, what the curves take without a break: the run with most length.
// Ties: the lowest.
Eigen::Vector2d HeaviestRun(int axis, std::vector<WeightedBox> boxes) {
  std::ranges::sort(boxes, {}, [&](const WeightedBox& box) {
    return box.bounds.min()[axis];
  });
  Eigen::Vector2d heaviest, run;
  double most = -1;
  double length = -1;
  for (const WeightedBox& box : boxes) {
    const double low = box.bounds.min()[axis];
    const double high = box.bounds.max()[axis];
    if (length < 0 || low > run.y()) {
      run = {low, high};
      length = 0;
    }
    run.y() = std::max(run.y(), high);
    length += box.length;
    if (length > most) {
      most = length;
      heaviest = run;
    }
  }
  return heaviest;
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
  Eigen::AlignedBox2d main;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d run = HeaviestRun(axis, boxes);
    main.min()[axis] = run.x();
    main.max()[axis] = run.y();
  }
  main = Grown(main, boxes);
  double beyond = 0;
  for (const WeightedBox& box : boxes) {
    if (!main.contains(box.bounds)) beyond += box.length;
  }
  return beyond > kMaxShareBeyond * length ? BoundsOf(curves) : main;
}

}  // namespace curvix
