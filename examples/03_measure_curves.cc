// SPDX-License-Identifier: BSD-3-Clause
// Reads a result and measures it: how long each curve is, where it points and
// how straight it is.
//
//   03_measure_curves proj/curvix/0/curves.txt
#include <curvix/curvix.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iostream>

namespace {

struct Measures {
  double length = 0;          // world units
  Eigen::Vector3d direction;  // unit; of the line that fits the samples best
  double bend = 0;            // root mean square distance to it, world units
};

Measures Measure(const curvix::Curve& curve) {
  const auto num_samples = static_cast<double>(curve.samples.size());
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const curvix::CurveSample& sample : curve.samples) {
    center += sample.position / num_samples;
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const curvix::CurveSample& sample : curve.samples) {
    const Eigen::Vector3d offset = sample.position - center;
    spread += offset * offset.transpose() / num_samples;
  }
  // Ascending eigenvalues: the last axis is the line, the others leave it.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const double bend = axes.eigenvalues()(0) + axes.eigenvalues()(1);
  return {curvix::Length(curve),
          axes.eigenvectors().col(2),
          std::sqrt(std::max(0.0, bend))};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "Usage: 03_measure_curves <curves.txt, .ply or .obj>\n";
    return 2;
  }
  const auto set = curvix::ReadCurves(argv[1]);
  if (!set.ok()) {
    std::cerr << set.status().message() << '\n';
    return 1;
  }
  std::puts(
      "   id  closed  samples    length   direction                  bend");
  for (std::size_t id = 0; id < set->curves.size(); ++id) {
    const curvix::Curve& curve = set->curves[id];
    const Measures m = Measure(curve);
    std::printf("%5zu  %-6s  %7zu  %8.4f  (%6.3f %6.3f %6.3f)  %7.4f\n",
                id,
                curve.closed ? "yes" : "no",
                curve.samples.size(),
                m.length,
                m.direction.x(),
                m.direction.y(),
                m.direction.z(),
                m.bend);
  }
  return 0;
}
