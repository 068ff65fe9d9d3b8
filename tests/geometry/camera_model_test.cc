// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace curvix {
namespace {

using ::testing::HasSubstr;

// 640 x 480 cameras with the distortion of real lenses.
std::vector<Camera> RealisticCameras() {
  using M = CameraModel;
  const auto make = [](M model, std::vector<double> params) {
    return Camera{model, 640, 480, std::move(params)};
  };
  return {
      make(M::kSimplePinhole, {500, 321, 239}),
      make(M::kPinhole, {500, 510, 321, 239}),
      make(M::kSimpleRadial, {500, 321, 239, -0.12}),
      make(M::kSimpleRadial, {500, 321, 239, 0.15}),
      make(M::kRadial, {500, 321, 239, -0.25, 0.08}),
      make(M::kOpenCV, {500, 510, 321, 239, -0.25, 0.08, 1e-3, -2e-3}),
      make(M::kOpenCVFisheye, {300, 305, 321, 239, 0.03, -0.01, 0.004, -0.001}),
      make(M::kFullOpenCV,
           {500, 510, 321, 239, 0.4, -0.1, 1e-3, -2e-3, 0.02, 0.5, 0.1, 0.03}),
      make(M::kFov, {450, 455, 321, 239, 0.9}),
      make(M::kFov, {450, 455, 321, 239, 1e-6}),
      make(M::kFov, {450, 455, 321, 239, 0}),
      make(M::kSimpleRadialFisheye, {300, 321, 239, 0.02}),
      make(M::kRadialFisheye, {300, 321, 239, 0.03, -0.008}),
      make(M::kThinPrismFisheye,
           {300,
            305,
            321,
            239,
            0.03,
            -0.01,
            1e-3,
            -2e-3,
            4e-3,
            -1e-3,
            5e-4,
            -8e-4}),
      make(M::kRadTanThinPrismFisheye,
           {300,
            305,
            321,
            239,
            0.03,
            -0.01,
            4e-3,
            -1e-3,
            2e-4,
            -1e-5,
            1e-3,
            -2e-3,
            5e-4,
            -8e-4,
            3e-4,
            2e-4}),
      make(M::kSimpleDivision, {500, 321, 239, -0.15}),
      make(M::kDivision, {500, 510, 321, 239, 0.1}),
      make(M::kSimpleFisheye, {300, 321, 239}),
      make(M::kFisheye, {300, 305, 321, 239}),
      make(M::kEucm, {320, 325, 321, 239, 0.6, 1.1}),
  };
}

std::string Describe(const Camera& camera) {
  std::string text(ModelName(camera.model));
  for (const double p : camera.params) {
    text.append(" ").append(std::to_string(p));
  }
  return text;
}

TEST(CameraModel, RealisticCamerasCoverAllModelsAndAreValid) {
  std::vector<bool> covered(17, false);
  for (const Camera& camera : RealisticCameras()) {
    EXPECT_TRUE(Validate(camera).ok()) << Validate(camera).message();
    covered[static_cast<std::size_t>(camera.model)] = true;
  }
  EXPECT_EQ(covered, std::vector<bool>(17, true));
}

TEST(CameraModel, NamesIdsAndParameterCountsAreColmaps) {
  const std::vector<int> num_params = {
      3, 4, 4, 5, 8, 8, 12, 5, 4, 5, 12, 16, 4, 5, 3, 4, 6};
  for (int id = 0; id < 17; ++id) {
    const std::optional<CameraModel> model = ModelFromId(id);
    ASSERT_TRUE(model.has_value());
    EXPECT_EQ(static_cast<int>(*model), id);
    EXPECT_EQ(NumParams(*model), num_params[static_cast<std::size_t>(id)]);
    EXPECT_EQ(ModelFromName(ModelName(*model)), model);
  }
  EXPECT_EQ(ModelName(CameraModel::kRadTanThinPrismFisheye),
            "RAD_TAN_THIN_PRISM_FISHEYE");
  EXPECT_EQ(ModelFromName("EQUIRECTANGULAR"), std::nullopt);
  EXPECT_EQ(ModelFromName("pinhole"), std::nullopt);
  EXPECT_EQ(ModelFromId(17), std::nullopt);
  EXPECT_EQ(ModelFromId(-1), std::nullopt);
}

TEST(CameraModel, EveryPixelReturnsFromItsDirection) {
  for (const Camera& camera : RealisticCameras()) {
    for (int x = 0; x <= camera.width; x += 16) {
      for (int y = 0; y <= camera.height; y += 16) {
        const Eigen::Vector2d pixel(x + 0.25, y - 0.125);
        const auto uv = IdealFromImage(camera, pixel);
        ASSERT_TRUE(uv.has_value())
            << Describe(camera) << " at " << x << " " << y;
        ASSERT_LT((ImageFromIdeal(camera, *uv) - pixel).norm(), 1e-8)
            << Describe(camera) << " at " << x << " " << y;
      }
    }
  }
}

TEST(CameraModel, EveryDirectionInTheFieldOfViewReturnsFromItsPixel) {
  for (const Camera& camera : RealisticCameras()) {
    for (double u = -0.6; u <= 0.6; u += 0.1) {
      for (double v = -0.4; v <= 0.4; v += 0.1) {
        const Eigen::Vector2d uv(u, v);
        const auto back = IdealFromImage(camera, ImageFromIdeal(camera, uv));
        ASSERT_TRUE(back.has_value()) << Describe(camera);
        ASSERT_LT((*back - uv).norm(), 1e-11) << Describe(camera);
      }
    }
  }
}

TEST(CameraModel, JacobianIsTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  for (const Camera& camera : RealisticCameras()) {
    for (const Eigen::Vector2d& uv : {Eigen::Vector2d(0, 0),
                                      Eigen::Vector2d(2e-3, 1e-3),
                                      Eigen::Vector2d(1e-2, 0),
                                      Eigen::Vector2d(0.3, -0.2),
                                      Eigen::Vector2d(-0.55, 0.4)}) {
      const Eigen::Matrix2d exact = ImageFromIdealJacobian(camera, uv);
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector2d h = kStep * Eigen::Vector2d::Unit(axis);
        const Eigen::Vector2d difference =
            (ImageFromIdeal(camera, uv + h) - ImageFromIdeal(camera, uv - h)) /
            (2 * kStep);
        EXPECT_LT((exact.col(axis) - difference).norm(), 1e-5)
            << Describe(camera) << " at " << uv.transpose();
      }
    }
  }
}

void ExpectPixel(CameraModel model,
                 const std::vector<double>& params,
                 const Eigen::Vector2d& uv,
                 const Eigen::Vector2d& expected) {
  const Camera camera{model, 100, 100, params};
  EXPECT_LT((ImageFromIdeal(camera, uv) - expected).norm(), 1e-10)
      << ModelName(model) << ": "
      << ImageFromIdeal(camera, uv).transpose().format(17);
}

// By hand at (u, v) = (1, 0.5), where r2 = 1.25, with f = 10 and c = (0, 0).
TEST(CameraModel, PerspectiveModelsGiveTheHandComputedPixel) {
  const Eigen::Vector2d uv(1, 0.5);
  ExpectPixel(CameraModel::kPinhole, {10, 20, 1, 2}, uv, {11, 12});
  ExpectPixel(CameraModel::kSimpleRadial, {10, 0, 0, 0.1}, uv, {11.25, 5.625});
  ExpectPixel(CameraModel::kRadial, {10, 0, 0, 0.1, 0.16}, uv, {13.75, 6.875});
  // Radial 1.125; x: + 2*0.01*0.5 + 0.02*(1.25 + 2) = 0.075;
  // y: + 2*0.02*0.5 + 0.01*(1.25 + 0.5) = 0.0375.
  ExpectPixel(CameraModel::kOpenCV,
              {10, 10, 0, 0, 0.1, 0, 0.01, 0.02},
              uv,
              {12.0, 6.0});
  // Radial (1 + 0.1*1.25 + 0.064*1.953125) / (1 + 0.2*1.25) = 1.25/1.25.
  ExpectPixel(CameraModel::kFullOpenCV,
              {10, 10, 0, 0, 0.1, 0, 0.01, 0.02, 0.064, 0.2, 0, 0},
              uv,
              {10.75, 5.375});
}

TEST(CameraModel, WideModelsGiveTheHandComputedPixel) {
  const double pi = std::numbers::pi;
  const Eigen::Vector2d diagonal(1, 0);  // 45 degrees off the axis
  ExpectPixel(CameraModel::kSimpleFisheye, {10, 0, 0}, diagonal, {2.5 * pi, 0});
  const double t = pi / 4;
  const double t2 = t * t;
  ExpectPixel(
      CameraModel::kOpenCVFisheye,
      {10, 10, 0, 0, 0.1, 0.2, 0.3, 0.4},
      diagonal,
      {10 * t * (1 + t2 * (0.1 + t2 * (0.2 + t2 * (0.3 + t2 * 0.4)))), 0});
  // omega = pi/2: tan(omega/2) = 1, radius atan(2)/(pi/2).
  ExpectPixel(CameraModel::kFov,
              {10, 10, 0, 0, pi / 2},
              diagonal,
              {10 * std::atan(2.0) / (pi / 2), 0});
  // Decentering and prism at (t, 0): p2*3t2 + sx1 t2, p1 t2 + sy1 t2.
  ExpectPixel(CameraModel::kThinPrismFisheye,
              {1, 1, 0, 0, 0, 0, 0.1, 0.2, 0, 0, 0.3, 0.4},
              diagonal,
              {t + 0.9 * t2, 0.5 * t2});
  // q = t (1 + 0.1 t2); x: 3 p0 q2 + s0 q2 + s1 q4, y: p1 q2 + s2 q2 + s3 q4.
  const double q = t * (1 + 0.1 * t2);
  const double q2 = q * q;
  ExpectPixel(
      CameraModel::kRadTanThinPrismFisheye,
      {1, 1, 0, 0, 0.1, 0, 0, 0, 0, 0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06},
      diagonal,
      {q + 0.06 * q2 + 0.04 * q2 * q2, 0.07 * q2 + 0.06 * q2 * q2});
  // The undistorted point of 0.5 is 0.5 / (1 + 0.4 * 0.25) = 1/2.2.
  ExpectPixel(
      CameraModel::kSimpleDivision, {10, 0, 0, 0.4}, {1 / 2.2, 0}, {5, 0});
  // 0.5 sqrt(3 * 1 + 1) + 0.5 = 1.5.
  ExpectPixel(
      CameraModel::kEucm, {10, 10, 0, 0, 0.5, 3}, diagonal, {10 / 1.5, 0});
}

TEST(CameraModel, FovTendsToThePinholeAndIsSmoothAtItsSwitchOver) {
  const Eigen::Vector2d uv(0.5, 0.3);
  const auto at = [&](double omega) {
    return ImageFromIdeal({CameraModel::kFov, 1, 1, {1, 1, 0, 0, omega}}, uv);
  };
  EXPECT_EQ(at(0), uv);
  EXPECT_LT((at(1.9999e-4) - at(2.0001e-4)).norm(), 1e-11);
  // 1 + w2/12 - w2 r2/3 to second order.
  const double factor = 1 + 1e-4 / 12 - 1e-4 * uv.squaredNorm() / 3;
  EXPECT_LT((at(1e-2) - factor * uv).norm(), 1e-8);
}

TEST(CameraModel, PinholeCalibrationHoldsFocalLengthsAndPrincipalPoint) {
  for (const Camera& camera : RealisticCameras()) {
    const Eigen::Matrix3d k = PinholeCalibration(camera);
    EXPECT_EQ(k(0, 2), 321);
    EXPECT_EQ(k(1, 2), 239);
    EXPECT_EQ(k(0, 0), camera.params[0]);
    EXPECT_EQ(k(0, 1), 0);
    EXPECT_EQ(k.row(2), Eigen::RowVector3d(0, 0, 1));
    EXPECT_EQ(
        IsPinhole(camera),
        NumParams(camera.model) <= 4 &&
            ModelName(camera.model).find("PINHOLE") != std::string_view::npos);
  }
}

TEST(CameraModel, PixelsThatNoDirectionReachesHaveNone) {
  // r (1 - 0.3 r2) is at most 0.7027 (r = 1.054); 0.72 and more are beyond.
  const Camera barrel{
      CameraModel::kSimpleRadial, 100, 100, {100, 50, 50, -0.3}};
  EXPECT_TRUE(IdealFromImage(barrel, {50 + 70.0, 50}).has_value());
  for (double radius = 72; radius < 1000; radius *= 1.1) {
    EXPECT_FALSE(IdealFromImage(barrel, {50 + radius, 50}).has_value());
    EXPECT_FALSE(IdealFromImage(barrel, {50, 50 - radius}).has_value());
  }
  // A fisheye's radius is below pi/2.
  const Camera fisheye{CameraModel::kSimpleFisheye, 100, 100, {100, 50, 50}};
  EXPECT_FALSE(IdealFromImage(fisheye, {50 + 158.0, 50}).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(IdealFromImage(fisheye, {nan, 50}).has_value());
}

TEST(CameraModel, FoldedBranchIsNeverReturned) {
  const Camera barrel{
      CameraModel::kSimpleRadial, 100, 100, {100, 50, 50, -0.3}};
  for (double radius = 1; radius < 70; radius += 1) {
    const auto uv = IdealFromImage(barrel, {50 + radius, 50});
    ASSERT_TRUE(uv.has_value());
    EXPECT_GT(uv->x(), 0);
    EXPECT_LT(uv->norm(), 1.0541);
  }
}

TEST(CameraModel, DirectionsBeyondEightyDegreesAreRefused) {
  for (const Camera& camera :
       {Camera{CameraModel::kSimpleFisheye, 100, 100, {100, 50, 50}},
        Camera{CameraModel::kFisheye, 100, 100, {100, 100, 50, 50}},
        Camera{CameraModel::kPinhole, 100, 100, {100, 100, 50, 50}},
        Camera{CameraModel::kEucm, 100, 100, {100, 100, 50, 50, 0.6, 1.1}}}) {
    const auto at = [&](double degrees) {
      const double radius = std::tan(degrees * std::numbers::pi / 180);
      return IdealFromImage(camera, ImageFromIdeal(camera, {0, radius}));
    };
    EXPECT_TRUE(at(79.9).has_value()) << Describe(camera);
    EXPECT_FALSE(at(80.1).has_value()) << Describe(camera);
  }
}

TEST(CameraModel, ValidateSaysWhatIsWrong) {
  const double inf = std::numeric_limits<double>::infinity();
  using M = CameraModel;
  const auto expect = [](const Camera& camera, const std::string& sentence) {
    const Status status = Validate(camera);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << sentence;
    EXPECT_THAT(status.message(), HasSubstr(sentence));
  };
  expect({static_cast<M>(17), 9, 9, {9, 9}}, "id 17 is not known");
  expect({M::kPinhole, 0, 9, {9, 9, 4, 4}}, "size 0 x 9");
  expect({M::kPinhole, 9, -1, {9, 9, 4, 4}}, "size 9 x -1");
  expect({M::kPinhole, 9, 9, {9, 4, 4}}, "with 3 parameters: the model has 4");
  expect({M::kPinhole, 9, 9, {}}, "with 0 parameters");
  expect({M::kOpenCV, 9, 9, {9, 9, 4, 4, inf, 0, 0, 0}}, "not a finite number");
  expect({M::kPinhole, 9, 9, {9, 0, 4, 4}}, "focal length is not positive");
  expect({M::kSimplePinhole, 9, 9, {-9, 4, 4}}, "focal length is not positive");
  expect({M::kFov, 9, 9, {9, 9, 4, 4, 3.2}}, "omega");
  expect({M::kEucm, 9, 9, {9, 9, 4, 4, 1.5, 1}}, "alpha");
  expect({M::kEucm, 9, 9, {9, 9, 4, 4, 0.5, 0}}, "beta");
}

}  // namespace
}  // namespace curvix
