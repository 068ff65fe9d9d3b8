// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "base/median.h"
#include "colmap/colmap_model.h"

namespace curvix {

struct PosedPointsOptions {
  std::size_t num_views = 12;
  std::size_t num_points = 400;
  double noise_px = 0.3;
  Camera camera = {CameraModel::kPinhole, 640, 480, {500, 510, 320, 240}};
  unsigned seed = 1;
};

// Adds points within 0.7 of the origin, each seen by about half of the views.
// The points are exact, the 2D points are not.
inline void AddPoints(std::size_t num_points,
                      double noise_px,
                      std::mt19937& random,
                      ColmapModel* model) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(-1, 1);
  const Camera& camera = model->cameras.front().camera;
  for (std::size_t i = 0; i < num_points; ++i) {
    ColmapPoint3D point;
    point.point3D_id = 5 + 2 * i;
    for (double& x : point.position) x = unit(random) * 0.7;
    for (ColmapImage& image : model->images) {
      const auto pixel = Project(camera, image.cam_from_world, point.position);
      const double dx = noise_px * normal(random);
      const double dy = noise_px * normal(random);
      if (unit(random) < 0 || !pixel) continue;
      point.track.push_back(
          {image.image_id, static_cast<std::uint32_t>(image.points2D.size())});
      image.points2D.push_back(
          {pixel->x() + dx, pixel->y() + dy, point.point3D_id});
    }
    model->points.push_back(std::move(point));
  }
}

// Views around a ball of points at the origin, three units away from it, each
// point seen by some six of them. The poses and points are exact, the 2D points
// are not. Ids have gaps.
inline ColmapModel PosedPoints(const PosedPointsOptions& options) {
  std::mt19937 random(options.seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  ColmapModel model;
  model.cameras.push_back({7, options.camera});
  for (std::size_t i = 0; i < options.num_views; ++i) {
    const double angle =
        6.28 * static_cast<double>(i) / static_cast<double>(options.num_views);
    ColmapImage image;
    image.image_id = static_cast<std::uint32_t>(10 + 3 * i);
    image.camera_id = 7;
    image.name = "view " + std::to_string(i) + ".png";
    const Eigen::AngleAxisd around(angle, Eigen::Vector3d::UnitY());
    const Eigen::AngleAxisd down(0.2 * unit(random), Eigen::Vector3d::UnitX());
    image.cam_from_world.rotation = Eigen::Quaterniond(down * around);
    image.cam_from_world.translation = {0, 0, 3};
    model.images.push_back(std::move(image));
  }
  AddPoints(options.num_points, options.noise_px, random, &model);
  return model;
}

// Turns and shifts each camera by what moves its picture by about `px`.
inline void DisturbPoses(double px, unsigned seed, ColmapModel* model) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, px / 2);
  const double focal_px = model->cameras.front().camera.params[0];
  for (ColmapImage& image : model->images) {
    const double distance = image.cam_from_world.translation.norm();
    Eigen::Vector3d turn;
    Rigid3 motion;
    for (double& x : turn) x = normal(random) / focal_px;
    for (double& x : motion.translation) {
      x = normal(random) * distance / focal_px;
    }
    if (px > 0) {
      motion.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized());
    }
    image.cam_from_world = motion * image.cam_from_world;
  }
}

inline std::vector<Rigid3> PosesOf(const ColmapModel& model) {
  std::vector<Rigid3> poses;
  for (const ColmapImage& image : model.images) {
    poses.push_back(image.cam_from_world);
  }
  return poses;
}

// The median over views and points of how far the projections with the poses
// of `model` are from those with the poses of `truth`, pixels.
inline double MedianShift(const ColmapModel& model, const ColmapModel& truth) {
  std::vector<double> shifts;
  const Camera& camera = truth.cameras.front().camera;
  for (std::size_t i = 0; i < truth.images.size(); ++i) {
    for (const ColmapPoint3D& point : truth.points) {
      const auto a =
          Project(camera, model.images[i].cam_from_world, point.position);
      const auto b =
          Project(camera, truth.images[i].cam_from_world, point.position);
      if (a && b) shifts.push_back((*a - *b).norm());
    }
  }
  return MedianOrNan(shifts);
}

}  // namespace curvix
