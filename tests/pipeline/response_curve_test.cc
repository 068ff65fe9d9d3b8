// SPDX-License-Identifier: BSD-3-Clause
// Cameras and renderers turn light into brightness by a curve, which moves the
// edges in all images; not the curves.
#include <curvix/reconstruct.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <utility>
#include <vector>

#include "base/median.h"
#include "synthetic/synthetic_scene.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using Response = std::function<double(double light)>;  // both 0..1

SyntheticScene MakeBlock() {
  SyntheticOptions options;
  options.solid = SyntheticSolid::kBlock;
  options.width = options.height = 320;
  return std::move(MakeSyntheticScene(options)).value();
}

// Half as bright as they are, so that nothing is white.
void WritePictures(const Response& response,
                   const std::filesystem::path& folder,
                   SyntheticScene& made) {
  for (std::size_t i = 0; i < made.images.size(); ++i) {
    SyntheticImage image = made.images[i];
    for (std::uint8_t& value : image.pixels) {
      value = static_cast<std::uint8_t>(
          std::lround(255 * response(0.5 * value / 255)));
    }
    View& view = made.scene.views[i];
    view.image_path = folder / view.name;
    cv::imwrite(
        view.image_path.string(),
        cv::Mat(image.height, image.width, CV_8UC1, image.pixels.data()));
  }
}

double DistanceAcross(const CurveSample& sample,
                      const std::vector<TrueSample>& truth) {
  double nearest = std::numeric_limits<double>::infinity(), across = 0;
  for (const TrueSample& place : truth) {
    const Eigen::Vector3d offset = sample.position - place.position;
    if (offset.norm() >= nearest) continue;
    nearest = offset.norm();
    across = offset.cross(place.tangent).norm();
  }
  return across;
}

// The median distance of the curves from the true ones.
double ErrorUnder(const Response& response) {
  const TemporaryFolder folder;
  SyntheticScene made = MakeBlock();
  WritePictures(response, folder.path(), made);
  const auto result = ReconstructCurves(made.scene, Options());
  EXPECT_TRUE(result.ok()) << result.status().message();
  EXPECT_EQ(result->report.stages.front().name, "detect_edges");
  EXPECT_FALSE(result->report.stages.front().counts.empty());
  std::vector<double> distances;
  for (const Curve& curve : result->curves.curves) {
    for (std::size_t k = 0; k < curve.samples.size(); k += 5) {
      distances.push_back(DistanceAcross(curve.samples[k], made.truth));
    }
  }
  EXPECT_GT(distances.size(), 100);
  return Median(std::move(distances));
}

TEST(ResponseCurve, DoesNotMoveCurves) {
  const double error = ErrorUnder([](double light) { return light; });
  const double with_gamma =
      ErrorUnder([](double light) { return std::pow(light, 1 / 2.2); });
  const double with_shoulder =
      ErrorUnder([](double light) { return 2 * light / (1 + 2 * light); });
  EXPECT_LT(with_gamma, 1.6 * error);
  EXPECT_LT(with_shoulder, 1.6 * error);
}

}  // namespace
}  // namespace curvix
