// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/choose_plane.h"

#include <gtest/gtest.h>
#include <cstdint>

#include "tests/support/test_views.h"

namespace curvix {
namespace {

// A wall at y = 0 with images on both sides, of which those at `y` see it.
TEST(ChoosePlanes, LooksAtNodesFromWhereImagesSeeThem) {
  Scene scene = ToScene({LookAt({0.5, -5, 0.5}, {0.5, 0, 0.5}),
                         LookAt({0.5, 5, 0.5}, {0.5, 0, 0.5})});
  scene.views[0].image_id = 1;
  scene.views[1].image_id = 2;
  for (const std::uint32_t image_id : {1u, 2u}) {
    CurvesFile curves;
    curves.fitted.nodes.resize(3);
    curves.fitted.nodes[1].position = {1, 0, 0};
    curves.fitted.nodes[2].position = {0, 0, 1};
    curves.samples = {
        {{{0.05, 0, 0}, {image_id}}, {{0, 9, 9}, {3 - image_id}}}};
    const auto planes = ChoosePlanes("nodes 0 1 2", curves, scene);
    ASSERT_TRUE(planes.ok()) << planes.status().message();
    EXPECT_NEAR(planes->front().toward.y(), image_id == 1 ? -1 : 1, 1e-9);
  }
}

}  // namespace
}  // namespace curvix
