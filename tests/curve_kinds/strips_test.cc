// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector2i;
using Eigen::Vector3d;

class StripsTest : public ::testing::Test {
 protected:
  StripsTest() {
    for (int i = 0; i < 9; ++i) {
      views_.push_back(LookAt(random_.Uniform(1.5, 2.5) * random_.UnitVector(),
                              0.1 * random_.NormalVector()));
    }
    scene_ = ToScene(views_);
    Camera& camera = scene_.cameras.front();
    camera = {CameraModel::kRadial, 800, 800, {800, 400, 400, -0.1, 0.02}};
    for (std::size_t i = 0; i < views_.size(); ++i) {
      std::vector<std::uint8_t>& pixels = pixels_.emplace_back();
      for (int k = 0; k < 800 * 800; ++k) {
        pixels.push_back(static_cast<std::uint8_t>(random_.Uniform(0, 255)));
      }
    }
  }

  // Seen by all views, in the image or out of it.
  StripPlace RandomPlace() {
    StripPlace place;
    place.position = 0.4 * random_.NormalVector();
    place.tangent = random_.UnitVector();
    place.normal = random_.Across(place.tangent).normalized();
    for (int i = 0; i < 9; ++i) place.views.push_back(i);
    return place;
  }

  // One per view, without tiles yet.
  std::vector<BlurredImage> Plan() const {
    return std::vector<BlurredImage>(views_.size(), BlurredImage(800, 800, 1));
  }

  SurfaceEvidence Compare(const StripPlace& place,
                          const StripViews& chosen,
                          double depth_px,
                          std::vector<BlurredImage> images) const {
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (images[i].IsAskedFor()) images[i].Keep(pixels_[i], 1);
    }
    CurveDistances none;
    none.fill(std::numeric_limits<double>::infinity());
    return CompareStrips(place,
                         chosen,
                         none,
                         DirectionSet().set(),
                         depth_px * chosen.step,
                         scene_,
                         views_,
                         images);
  }

  Random random_{1};
  std::vector<PosedView> views_;
  Scene scene_;
  std::vector<std::vector<std::uint8_t>> pixels_;
};

TEST_F(StripsTest, BoxesHoldAllPixelsOfStrips) {
  int num_compared = 0;
  for (int i = 0; i < 100; ++i) {
    const StripPlace place = RandomPlace();
    std::vector<BlurredImage> some = Plan(), all = Plan();
    const StripViews chosen = ChooseStripViews(place, scene_, views_, some);
    ASSERT_EQ(chosen.boxes.size(), chosen.views.size());
    for (std::size_t k = 0; k < chosen.views.size(); ++k) {
      const auto view = static_cast<std::size_t>(chosen.views[k]);
      some[view].AskFor(chosen.boxes[k]);
      all[view].AskFor({Vector2i(0, 0), Vector2i(799, 799)});
    }
    for (const double depth_px : kDepthsPx) {
      const SurfaceEvidence evidence = Compare(place, chosen, depth_px, all);
      EXPECT_EQ(Compare(place, chosen, depth_px, some).log_bayes,
                evidence.log_bayes);
      num_compared +=
          std::ranges::any_of(evidence.log_bayes.front(),
                              [](float log) { return std::isfinite(log); });
    }
  }
  EXPECT_GT(num_compared, 120);
}

TEST_F(StripsTest, FewViewsAreNotChosen) {
  StripPlace place = RandomPlace();
  place.position.setZero();
  EXPECT_GE(ChooseStripViews(place, scene_, views_, Plan()).views.size(), 3U);
  place.views.resize(2);
  EXPECT_TRUE(ChooseStripViews(place, scene_, views_, Plan()).views.empty());
}

}  // namespace
}  // namespace curvix
