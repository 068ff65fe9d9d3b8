// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What Regularize minimises, for Ceres.
#pragma once

#include <Eigen/Core>

#include "geometry/directions.h"

namespace curvix {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Vector3Map = Eigen::Map<const Vector3<T>>;

// A direction that turns about where it was: base + across * (p, q).
struct Chart {
  Eigen::Vector3d base;
  AcrossAxes across;

  explicit Chart(const Eigen::Vector3d& direction)
      : base(direction), across(AxesAcross(direction)) {}
  template <typename T>
  Vector3<T> At(const T* turn) const {
    return base.cast<T>() + across.col(0).cast<T>() * turn[0] +
           across.col(1).cast<T>() * turn[1];
  }
  // Two numbers that are 0 if `v` is along the direction at `turn`.
  template <typename T>
  void Across(const Vector3<T>& v, const T* turn, T weight, T* out) const {
    const T along = base.cast<T>().dot(v);
    for (const int k : {0, 1}) {
      out[k] = weight * (across.col(k).cast<T>().dot(v) - turn[k] * along);
    }
  }
};

struct LineAlongCost {
  Chart direction;
  double weight;

  template <typename T>
  bool operator()(const T* start, const T* end, const T* turn, T* out) const {
    direction.Across<T>(
        Vector3Map<T>(end) - Vector3Map<T>(start), turn, T(weight), out);
    return true;
  }
};

// An arc is its centre, the turn of its normal, and its radius.
struct ArcAlongCost {
  Chart normal;
  Chart direction;
  double weight;

  template <typename T>
  bool operator()(const T* arc, const T* turn, T* out) const {
    direction.Across<T>(normal.At(arc + 3), turn, T(weight), out);
    return true;
  }
};

struct PerpendicularCost {
  Chart first, second;
  double weight;

  template <typename T>
  bool operator()(const T* a, const T* b, T* out) const {
    out[0] = T(weight) * first.At(a).dot(second.At(b));
    return true;
  }
};

// The first three numbers of a point or an arc are its position.
struct OnPlaneCost {
  Chart normal;
  Eigen::Vector3d point;
  double weight;

  template <typename T>
  bool operator()(const T* position,
                  const T* turn,
                  const T* offset,
                  T* out) const {
    out[0] = T(weight) *
             (normal.At(turn).dot(Vector3Map<T>(position) - point.cast<T>()) -
              *offset);
    return true;
  }
};

struct OnAxisCost {
  Chart direction;
  Eigen::Vector3d point;
  double weight;

  template <typename T>
  bool operator()(const T* position,
                  const T* turn,
                  const T* offset,
                  T* out) const {
    const Vector3<T> through =
        point.cast<T>() + direction.across.cast<T>() *
                              Eigen::Map<const Eigen::Matrix<T, 2, 1>>(offset);
    direction.Across<T>(
        Vector3Map<T>(position) - through, turn, T(weight), out);
    return true;
  }
};

struct RadiusCost {
  double weight;

  template <typename T>
  bool operator()(const T* arc, const T* radius, T* out) const {
    out[0] = T(weight) * (arc[5] - *radius);
    return true;
  }
};

struct NodeOnArcCost {
  Chart normal;
  double weight;

  template <typename T>
  bool operator()(const T* node, const T* arc, T* out) const {
    const Vector3<T> axis = normal.At(arc + 3).normalized();
    const Vector3<T> offset = Vector3Map<T>(node) - Vector3Map<T>(arc);
    const T height = axis.dot(offset);
    out[0] = T(weight) * height;
    out[1] = T(weight) * ((offset - height * axis).norm() - arc[5]);
    return true;
  }
};

}  // namespace curvix
