// SPDX-License-Identifier: BSD-3-Clause
// Your own edge detector and your own poses, without COLMAP and without images.
//
// The stand-in for your data is a helix of wire, seen by twelve cameras around
// it. Replace MyScene() and MyEdges(); the rest stays.
#include <curvix/curvix.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979;

// Twelve pinhole cameras on a circle around the z axis, looking at the origin.
curvix::Scene MyScene() {
  curvix::Scene scene;
  curvix::Camera camera;
  camera.model = curvix::CameraModel::kPinhole;
  camera.width = camera.height = 600;
  camera.params = {700, 700, 300, 300};  // fx fy cx cy
  scene.cameras = {camera};

  for (int i = 0; i < 12; ++i) {
    const double turn = 2 * kPi * i / 12;
    const Eigen::Vector3d center(4 * std::cos(turn), 4 * std::sin(turn), 2);
    // The axes of the camera in the world: x right, y down, z forward.
    Eigen::Matrix3d cam_from_world;
    const Eigen::Vector3d forward = -center.normalized();
    const Eigen::Vector3d right =
        forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    cam_from_world << right.transpose(), forward.cross(right).transpose(),
        forward.transpose();

    curvix::View view;
    view.name = "view_" + std::to_string(100 + i);  // sorted by name
    view.image_id = static_cast<std::uint32_t>(i + 1);
    view.camera_idx = 0;
    view.cam_from_world.rotation = cam_from_world;
    view.cam_from_world.translation = -cam_from_world * center;
    scene.views.push_back(view);
  }
  return scene;
}

// One and a half turns around the z axis.
Eigen::Vector3d Helix(double angle) {
  return {std::cos(angle), std::sin(angle), 0.1 * angle};
}
constexpr double kHelixEnd = 3 * kPi;

// The edges of one view: positions in pixels of the ideal (undistorted)
// pinhole, the centre of the top-left pixel at (0.5, 0.5), and the angle of the
// tangent, from +x towards +y. Each knows its neighbours along its contour.
curvix::EdgeMap MyEdges(const curvix::Scene& scene, const curvix::View& view) {
  const curvix::Camera& camera = curvix::CameraOf(scene, view);
  const auto pixel = [&](double angle) {
    const Eigen::Vector3d x = view.cam_from_world * Helix(angle);
    return curvix::ImageFromIdeal(camera, x.hnormalized());
  };

  curvix::EdgeMap map;
  for (double angle = 0; angle < kHelixEnd;) {
    const Eigen::Vector2d tangent = (pixel(angle + 1e-6) - pixel(angle)) / 1e-6;
    curvix::Edge2d edge;
    edge.position = pixel(angle);
    edge.angle = static_cast<float>(std::atan2(tangent.y(), tangent.x()));
    edge.strength = 50;
    map.edges.push_back(edge);
    angle += 0.5 / tangent.norm();  // half a pixel further
  }

  const auto num_edges = static_cast<std::int32_t>(map.edges.size());
  for (std::int32_t i = 0; i < num_edges; ++i) {
    curvix::EdgeNeighbors neighbors;
    if (i > 0) neighbors.previous = i - 1;
    if (i + 1 < num_edges) neighbors.next = i + 1;
    map.neighbors.push_back(neighbors);
  }
  return map;
}

}  // namespace

int main() {
  const curvix::Scene scene = MyScene();
  std::vector<curvix::EdgeMap> edge_maps;
  for (const curvix::View& view : scene.views) {
    edge_maps.push_back(MyEdges(scene, view));
  }

  const auto result =
      curvix::ReconstructCurves(scene, edge_maps, curvix::Options());
  if (!result.ok()) {
    std::cerr << result.status().message() << '\n';
    return 1;
  }
  if (result->curves.curves.empty()) {
    std::cerr << "No curves: " << result->report.why_empty << '\n';
    return 1;
  }

  double length = 0;
  for (const curvix::Curve& curve : result->curves.curves) {
    length += curvix::Length(curve);
  }
  std::cout << "curves: " << result->curves.curves.size() << '\n'
            << "length: " << length << '\n'
            << "truth:  " << kHelixEnd * std::hypot(1.0, 0.1) << '\n';

  const curvix::Status written =
      curvix::WriteCurves("helix.ply", result->curves, scene);
  if (!written.ok()) {
    std::cerr << written.message() << '\n';
    return 1;
  }
  std::cout << "Wrote helix.ply\n";
  return 0;
}
