// SPDX-License-Identifier: BSD-3-Clause
// A photograph as it would be if it had been taken along the normal of a plane.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "drawing/drawing_plane.h"
#include "drawing/sheet.h"

namespace curvix {

// What is in the plane at `depth` and inside `bounds`, drawing units.
struct PictureArea {
  const DrawingPlane& plane;
  double depth = 0;
  Eigen::AlignedBox2d bounds;
};

// Whether the view shows some of the area, from the side of its viewer.
bool ShowsFront(const Scene& scene, const View& view, const PictureArea& area);

// Of the views that show the area from this side, the one that shows most of
// it, times the cosine of the angle at which it looks at it; ties go to the
// first. nullopt: none shows any of it.
std::optional<std::size_t> BestViewOf(const Scene& scene,
                                      const PictureArea& area);

struct RectifiedPhotograph {
  std::string jpeg;
  SheetPicture place;  // without the name of the file
};

// Lens distortion and perspective are taken out for points of the plane; what
// lies before or behind it is displaced. Pixels are as large as those of the
// photograph are in the middle of the area, or larger, so that there are no
// more than 6000 along a side; white where the photograph shows nothing.
// kNotFound, kDataLoss: the image cannot be read.
Result<RectifiedPhotograph> Rectify(const Scene& scene,
                                    std::size_t view_idx,
                                    const PictureArea& area,
                                    int num_threads);

}  // namespace curvix
