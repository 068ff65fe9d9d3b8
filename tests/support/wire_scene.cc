// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/wire_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

constexpr double kTruthStep = 0.01;

double DistanceToSegment(const Eigen::Vector3d& x,
                         const Eigen::Vector3d& from,
                         const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0 ? std::clamp((x - from).dot(along) / length2, 0.0, 1.0) : 0;
  return (from + share * along - x).norm();
}

// The distance of x from the true curve, to second order in the step.
double DistanceToTruth(const Eigen::Vector3d& x, const TestCurve& curve) {
  double best_s = 0;
  double least = std::numeric_limits<double>::infinity();
  for (double s = 0; s <= curve.length; s += kTruthStep) {
    const double distance = (curve.position(s) - x).norm();
    if (distance < least) {
      least = distance;
      best_s = s;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double along = curve.tangent(best_s).dot(x - curve.position(best_s));
    best_s += along;
    if (!curve.closed) best_s = std::clamp(best_s, 0.0, curve.length);
  }
  return (curve.position(best_s) - x).norm();
}

}  // namespace

WireScene MakeWireScene(std::vector<TestCurve> truth, int num_views) {
  Random random(20);
  std::vector<PosedView> views;
  for (int i = 0; i < num_views; ++i) {
    const double turn = 6.283 * (i + random.Uniform(-0.3, 0.3)) / num_views;
    const double height = (i % 3 - 1) * 2.2 + random.Uniform(-0.5, 0.5);
    PosedView view =
        LookAt({5.5 * std::cos(turn), 5.5 * std::sin(turn), height},
               0.1 * random.UnitVector());
    view.calibration.topRows<2>() /= 2;
    view.width /= 2;
    view.height /= 2;
    views.push_back(view);
  }
  WireScene made;
  made.scene = ToScene(views);
  made.edge_maps = ExactEdgeMaps(truth, views, 30);
  made.truth = std::move(truth);
  return made;
}

std::vector<TestCurve> CubeAndCircle() {
  std::vector<TestCurve> curves = CubeCurves();
  curves.push_back(CircleCurve({0.1, 0, 0.05}, 0.6));
  return curves;
}

double DistanceToCurves(const CurveSet& curves, const Eigen::Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Curve& curve : curves.curves) {
    const auto& samples = curve.samples;
    for (std::size_t i = curve.closed ? 0 : 1; i < samples.size(); ++i) {
      const auto& previous = samples[i == 0 ? samples.size() - 1 : i - 1];
      least = std::min(
          least, DistanceToSegment(x, previous.position, samples[i].position));
    }
  }
  return least;
}

WireAgreement Compare(const CurveSet& curves,
                      const std::vector<TestCurve>& truth,
                      double tolerance) {
  WireAgreement agreement;
  double length = 0;
  int samples = 0, accurate = 0;
  for (const Curve& curve : curves.curves) {
    length += Length(curve);
    for (const CurveSample& sample : curve.samples) {
      double least = std::numeric_limits<double>::infinity();
      for (const TestCurve& true_curve : truth) {
        least = std::min(least, DistanceToTruth(sample.position, true_curve));
      }
      agreement.worst_distance = std::max(agreement.worst_distance, least);
      ++samples;
      if (least <= tolerance) ++accurate;
    }
  }
  double true_length = 0;
  int places = 0, found = 0;
  for (const TestCurve& curve : truth) {
    true_length += curve.length;
    for (double s = 0; s <= curve.length; s += kTruthStep) {
      ++places;
      if (DistanceToCurves(curves, curve.position(s)) <= tolerance) ++found;
    }
  }
  agreement.accurate = static_cast<double>(accurate) / std::max(samples, 1);
  agreement.found = static_cast<double>(found) / places;
  agreement.length_ratio = length / true_length;
  return agreement;
}

}  // namespace curvix
