// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "tests/plugin/fake_colmap.h"

namespace curvix {
namespace {

class EveryCameraModel : public FakeColmap,
                         public testing::WithParamInterface<int> {};

TEST_P(EveryCameraModel, GetsThePosesThatColmapFinds) {
  PosedPointsOptions options;
  options.camera = {*ModelFromId(GetParam()), 640, 480, {}};
  for (int i = NumParams(options.camera.model); i > 0; --i) {
    options.camera.params.push_back(0.01);
  }
  const Eigen::Matrix3d k = [&] {
    Camera numbered = options.camera;
    for (std::size_t i = 0; i < numbered.params.size(); ++i) {
      numbered.params[i] = static_cast<double>(i);
    }
    return PinholeCalibration(numbered);
  }();
  const auto cx = static_cast<std::size_t>(k(0, 2));
  for (std::size_t i = 0; i < cx; ++i) options.camera.params[i] = 500;
  options.camera.params[cx] = 320;
  options.camera.params[cx + 1] = 240;
  if (options.camera.model == CameraModel::kEucm) {
    options.camera.params[cx + 2] = 0.5;
    options.camera.params[cx + 3] = 1;
  }
  const ColmapModel truth = PosedPoints(options);
  model_ = truth;
  DisturbPoses(1, 5, &model_);
  const PoseRefinement result = Solve(truth);
  ASSERT_TRUE(result.model) << result.record.reason;
  EXPECT_GT(MedianShift(AlignedTo(truth, model_), truth), 0.5);
  EXPECT_LT(MedianShift(AlignedTo(truth, *result.model), truth), 1e-6);
  EXPECT_EQ(result.model->cameras[0].camera.params, options.camera.params);
}

INSTANTIATE_TEST_SUITE_P(Ids, EveryCameraModel, testing::Range(0, 17));

}  // namespace
}  // namespace curvix
