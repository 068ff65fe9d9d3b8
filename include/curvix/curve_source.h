// SPDX-License-Identifier: BSD-3-Clause
// Curves that need not all be in memory.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/status.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace curvix {

// Curves that are looked at one after the other, as often as needed: whoever
// writes or fits them keeps no more than one at a time. For one thread.
class CurveSource {
 public:
  using Visit = std::function<void(std::size_t id, const Curve& curve)>;

  virtual ~CurveSource() = default;

  // How many there are.
  virtual std::size_t size() const = 0;

  // Shows the curves in the order of their ids: 0, 1, ..., size() - 1. If one
  // cannot be read, none follows, and status() says why, from then on.
  virtual void ForEach(const Visit& visit) const = 0;
  virtual Status status() const { return {}; }

  // The 2D edge that `ref`, a support of the curve that is being shown, names.
  virtual Edge2d EdgeOf(const EdgeRef& ref) const = 0;
};

// Curves in memory, which outlive this. Without edge maps (one per view),
// nothing may ask for edges.
class CurvesInMemory : public CurveSource {
 public:
  explicit CurvesInMemory(const CurveSet& curves,
                          const std::vector<EdgeMap>* edge_maps = nullptr)
      : curves_(curves), edge_maps_(edge_maps) {}

  std::size_t size() const override { return curves_.curves.size(); }
  void ForEach(const Visit& visit) const override {
    for (std::size_t id = 0; id < size(); ++id) visit(id, curves_.curves[id]);
  }
  Edge2d EdgeOf(const EdgeRef& ref) const override {
    return edge_maps_->at(static_cast<std::size_t>(ref.view_idx))
        .edges.at(static_cast<std::size_t>(ref.edge_idx));
  }

 private:
  const CurveSet& curves_;
  const std::vector<EdgeMap>* edge_maps_;
};

}  // namespace curvix
