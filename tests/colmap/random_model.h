// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <curvix/scene.h>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "colmap/colmap_model.h"

namespace curvix {

inline double PlusMinusOne(std::mt19937& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

inline ColmapCamera RandomCamera(int model_id, std::mt19937& random) {
  ColmapCamera item;
  item.camera_id = static_cast<std::uint32_t>(3 * model_id + 1);
  item.camera = {*ModelFromId(model_id), 640 + model_id, 480, {}};
  const auto size = static_cast<std::size_t>(NumParams(item.camera.model));
  item.camera.params.assign(size, 0.1);
  for (double& p : item.camera.params) p += 0.01 * PlusMinusOne(random);
  for (std::size_t i = 0; i < 3; ++i) item.camera.params[i] += 300;
  return item;
}

inline ColmapImage RandomImage(std::uint32_t i, std::mt19937& random) {
  const std::string folders[] = {"", "left/", "a b/", "deep/er/", "\xC3\xA9/"};
  ColmapImage image;
  image.image_id = 2 + 5 * i;
  image.name = folders[i % 5] + "view " + std::to_string(100 - i) + ".jpg";
  Rigid3& pose = image.cam_from_world;
  for (double& q : pose.rotation.coeffs()) q = PlusMinusOne(random);
  pose.rotation.normalize();
  for (double& t : pose.translation) t = 10 * PlusMinusOne(random);
  for (std::uint32_t k = 0; k < 7 * (i % 4); ++k) {
    image.points2D.push_back({300 * PlusMinusOne(random),
                              1e5 * PlusMinusOne(random),
                              k % 3 ? k : kNoPoint3D});
  }
  return image;
}

inline ColmapPoint3D RandomPoint3D(std::uint64_t i,
                                   std::uint64_t track_length,
                                   std::mt19937& random) {
  ColmapPoint3D point;
  point.point3D_id = i * i * 1000000007ull;
  for (double& x : point.position) x = 1e3 * PlusMinusOne(random);
  point.rgb = {static_cast<std::uint8_t>(i), 255, 0};
  point.error = i == 0 ? -1 : std::abs(PlusMinusOne(random));
  for (std::uint64_t k = 0; k < track_length; ++k) {
    point.track.push_back({static_cast<std::uint32_t>(2 + 5 * (k % 20)),
                           static_cast<std::uint32_t>(k)});
  }
  return point;
}

// A valid model with a camera of every type, ids with gaps, names with spaces
// and sub-folders, images without 2D points, and tracks of all lengths. Sorted
// by id, as ReadColmapModel returns it.
inline ColmapModel RandomModel(unsigned seed) {
  std::mt19937 random(seed);
  ColmapModel model;
  for (int id = 0; id < 17; ++id) {
    model.cameras.push_back(RandomCamera(id, random));
  }
  for (std::uint32_t i = 0; i < 20; ++i) {
    model.images.push_back(RandomImage(i, random));
    model.images.back().camera_id = model.cameras[i % 17].camera_id;
  }
  for (std::uint64_t i = 0; i < 30; ++i) {
    model.points.push_back(RandomPoint3D(i, i == 29 ? 5000 : i % 6, random));
  }
  return model;
}

}  // namespace curvix
