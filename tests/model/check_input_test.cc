// SPDX-License-Identifier: BSD-3-Clause
#include "model/check_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/test_views.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class CheckInput : public ::testing::Test {
 protected:
  void ExpectSceneRefused(const std::function<void(Scene&)>& spoil,
                          const std::string& why) const {
    Scene scene = wires_.scene;
    spoil(scene);
    const Status status = CheckScene(scene);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(status.message(), HasSubstr(why));
  }

  void ExpectMapsRefused(
      const std::function<void(std::vector<EdgeMap>&)>& spoil,
      const std::string& why) const {
    std::vector<EdgeMap> maps = wires_.edge_maps;
    spoil(maps);
    const Status status = CheckEdgeMaps(wires_.scene, maps);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_THAT(status.message(), HasSubstr(why));
  }

  const WireScene wires_ = MakeWireScene({CubeCurves()[0]}, 4);
};

TEST_F(CheckInput, TakesSoundInput) {
  EXPECT_TRUE(CheckScene(wires_.scene).ok());
  EXPECT_TRUE(CheckEdgeMaps(wires_.scene, wires_.edge_maps).ok());
  EXPECT_TRUE(CheckEdgeMaps(wires_.scene, std::vector<EdgeMap>(4)).ok());
}

TEST_F(CheckInput, NeedsThreeViews) {
  ExpectSceneRefused([](Scene& s) { s.views.resize(2); },
                     "at least three views, and there are 2");
  ExpectSceneRefused([](Scene& s) { s = Scene(); }, "there are 0");
}

TEST_F(CheckInput, NeedsACameraForEveryView) {
  for (const int camera_idx : {-1, 4}) {
    ExpectSceneRefused([&](Scene& s) { s.views[1].camera_idx = camera_idx; },
                       "View view_001 has camera index " +
                           std::to_string(camera_idx) +
                           ", but there are 4 cameras");
  }
}

TEST_F(CheckInput, NeedsCamerasThatAreCameras) {
  ExpectSceneRefused([](Scene& s) { s.cameras[2].width = 0; }, "");
  ExpectSceneRefused([](Scene& s) { s.cameras[2].params.pop_back(); }, "");
  ExpectSceneRefused([](Scene& s) { s.cameras[2].params[0] = kNan; }, "");
}

TEST_F(CheckInput, NeedsRigidPoses) {
  const std::string why = "The pose of view view_002 is no rigid motion";
  ExpectSceneRefused(
      [](Scene& s) { s.views[2].cam_from_world.translation.y() = kNan; }, why);
  ExpectSceneRefused(
      [](Scene& s) { s.views[2].cam_from_world.rotation.w() = INFINITY; }, why);
  ExpectSceneRefused(
      [](Scene& s) { s.views[2].cam_from_world.rotation.coeffs() *= 2; }, why);
  ExpectSceneRefused(
      [](Scene& s) { s.views[2].cam_from_world.rotation.coeffs().setZero(); },
      why);
}

TEST_F(CheckInput, NeedsPointsOfViewsThatAreThere) {
  for (const int view_idx : {-1, 4}) {
    ExpectSceneRefused(
        [&](Scene& s) {
          s.points.push_back({{0, 0, 0}, {0, view_idx}, {}});
        },
        "sparse point");
  }
  ExpectSceneRefused(
      [](Scene& s) {
        s.points.push_back({{0, kNan, 0}, {0}, {}});
      },
      "sparse point");
  ExpectSceneRefused(
      [](Scene& s) {
        s.points.push_back({{0, 0, 0}, {0, 1}, {{5, 5}}});
      },
      "if it has pixels, one per view");
}

TEST_F(CheckInput, NeedsOneMapPerView) {
  ExpectMapsRefused([](auto& maps) { maps.pop_back(); },
                    "There are 3 edge maps for 4 views");
  ExpectMapsRefused([](auto& maps) { maps.clear(); },
                    "There are 0 edge maps for 4 views");
}

TEST_F(CheckInput, NeedsSoundEdges) {
  const std::string why = "The edges of view view_001 are not sound";
  ExpectMapsRefused([](auto& maps) { maps[1].neighbors.pop_back(); }, why);
  ExpectMapsRefused([](auto& maps) { maps[1].edges[3].position.x() = kNan; },
                    why);
  ExpectMapsRefused([](auto& maps) { maps[1].edges[3].position.y() = 1e30; },
                    why);
  ExpectMapsRefused([](auto& maps) { maps[1].edges[3].angle = NAN; }, why);
  ExpectMapsRefused([](auto& maps) { maps[1].neighbors[3].next = -1; }, why);
  ExpectMapsRefused(
      [](auto& maps) {
        maps[1].neighbors[3].previous =
            static_cast<std::int32_t>(maps[1].edges.size());
      },
      why);
}

TEST_F(CheckInput, NeedsNumbersOfEdgesThatAreFinite) {
  const std::function<void(Edge2d&)> spoils[] = {
      [](Edge2d& e) { e.sharpness = static_cast<float>(kNan); },
      [](Edge2d& e) { e.strength = static_cast<float>(kNan); },
      [](Edge2d& e) { e.strength = -1; },
      [](Edge2d& e) { e.level = Eigen::half(static_cast<float>(kNan)); },
      [](Edge2d& e) { e.fine_px = Eigen::half(static_cast<float>(kNan)); }};
  for (const auto& spoil : spoils) {
    ExpectMapsRefused(
        [&](std::vector<EdgeMap>& maps) { spoil(maps[1].edges[0]); },
        "finite numbers");
  }
}

}  // namespace
}  // namespace curvix
