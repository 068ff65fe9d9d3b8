// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <curvix/camera_model.h>

#include <algorithm>
#include <random>
#include <string>

#include "plugin/colmap_model.h"

namespace curvix {

// A valid model with a camera of every type, ids with gaps, names with spaces
// and sub-folders, images without 2D points, and tracks of all lengths. Sorted
// by id, as ReadColmapModel returns it.
inline ColmapModel RandomModel(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  ColmapModel model;
  for (int id = 0; id < 17; ++id) {
    ColmapCamera& item = model.cameras.emplace_back();
    item.camera_id = static_cast<std::uint32_t>(3 * id + 1);
    item.camera = {*ModelFromId(id), 640 + id, 480, {}};
    const auto size = static_cast<std::size_t>(NumParams(item.camera.model));
    item.camera.params.assign(size, 0.1);
    for (double& p : item.camera.params) p += 0.01 * unit(random);
    for (std::size_t i = 0; i < 3; ++i) item.camera.params[i] += 300;
  }
  const std::string names[] = {"", "left/", "a b/", "deep/er/", "\xC3\xA9/"};
  for (std::uint32_t i = 0; i < 20; ++i) {
    ColmapImage& image = model.images.emplace_back();
    image.image_id = 2 + 5 * i;
    image.camera_id = model.cameras[i % 17].camera_id;
    image.name = names[i % 5] + "view " + std::to_string(100 - i) + ".jpg";
    image.cam_from_world.rotation =
        Eigen::Quaterniond(
            unit(random), unit(random), unit(random), unit(random) + 1e-3)
            .normalized();
    for (double& t : image.cam_from_world.translation) t = 10 * unit(random);
    for (std::uint32_t k = 0; k < 7 * (i % 4); ++k) {
      image.points2D.push_back(
          {300 * unit(random), 1e5 * unit(random), k % 3 ? k : kNoPoint3D});
    }
  }
  for (std::uint64_t i = 0; i < 30; ++i) {
    ColmapPoint3D& point = model.points.emplace_back();
    point.point3D_id = i * i * 1000000007ull;
    for (double& x : point.position) x = 1e3 * unit(random);
    point.rgb = {static_cast<std::uint8_t>(i), 255, 0};
    point.error = i == 0 ? -1 : std::abs(unit(random));
    for (std::uint64_t k = 0; k < (i == 29 ? 5000 : i % 6); ++k) {
      point.track.push_back({static_cast<std::uint32_t>(2 + 5 * (k % 20)),
                             static_cast<std::uint32_t>(k)});
    }
  }
  return model;
}

}  // namespace curvix
