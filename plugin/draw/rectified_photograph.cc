// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/rectified_photograph.h"

#include <curvix/curves.h>
#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/parallel.h"
#include "plugin/base/image_file.h"

namespace curvix {
namespace {

constexpr double kMostPixels = 6000;
constexpr int kJpegQuality = 90;

Eigen::Vector3d InSpace(const PictureArea& area, const Eigen::Vector2d& x) {
  const DrawingPlane& plane = area.plane;
  return plane.origin + x.x() * plane.right + x.y() * plane.up +
         area.depth * plane.depth_axis;
}

// How much of the area the view shows, on a grid.
double ShareShown(const Scene& scene, const View& view, const PictureArea& a) {
  constexpr int kSteps = 16;
  int count = 0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d share = Eigen::Vector2d(i, j) / kSteps;
      const Eigen::Vector2d x =
          a.bounds.min() + share.cwiseProduct(a.bounds.sizes());
      const auto pixel =
          ProjectPoint(InSpace(a, x), view, CameraOf(scene, view));
      count += pixel ? 1 : 0;
    }
  }
  return static_cast<double>(count) / ((kSteps + 1) * (kSteps + 1));
}

// Of a pixel of the view in the middle of the area.
double PixelOnPlane(const Scene& scene,
                    const View& view,
                    const PictureArea& area) {
  const double depth =
      (view.cam_from_world * InSpace(area, area.bounds.center())).z();
  const double focal = PinholeCalibration(CameraOf(scene, view))(0, 0);
  const double least = area.bounds.sizes().maxCoeff() / kMostPixels;
  return std::max(depth / focal, least);
}

}  // namespace

bool ShowsFront(const Scene& scene, const View& view, const PictureArea& area) {
  const Eigen::Vector3d center = view.cam_from_world.Inverse().translation;
  const Eigen::Vector3d ray = center - InSpace(area, area.bounds.center());
  return ray.dot(area.plane.toward) > 0 && ShareShown(scene, view, area) > 0;
}

std::optional<std::size_t> BestViewOf(const Scene& scene,
                                      const PictureArea& area) {
  std::optional<std::size_t> best;
  double most = 0;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const View& view = scene.views[i];
    if (!ShowsFront(scene, view, area)) continue;
    const Eigen::Vector3d look =
        view.cam_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    const double score =
        -look.dot(area.plane.toward) * ShareShown(scene, view, area);
    if (score > most) best = i;
    most = std::max(most, score);
  }
  return best;
}

Result<RectifiedPhotograph> Rectify(const Scene& scene,
                                    std::size_t view_idx,
                                    const PictureArea& area,
                                    int num_threads) {
  const View& view = scene.views[view_idx];
  const Camera& camera = CameraOf(scene, view);
  CURVIX_ASSIGN_OR_RETURN(const cv::Mat image,
                          ReadImage(view.image_path, cv::IMREAD_COLOR));
  RectifiedPhotograph result;
  SheetPicture& place = result.place;
  place.corner = area.bounds.min();
  place.pixel = PixelOnPlane(scene, view, area);
  place.size = (area.bounds.sizes() / place.pixel).array().ceil().cast<int>();
  place.size = place.size.cwiseMax(1);
  const double to_read = static_cast<double>(image.cols) / camera.width;
  cv::Mat2f map(place.size.y(), place.size.x());
  ParallelFor(static_cast<std::size_t>(map.rows), num_threads, [&](auto row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < map.cols; ++x) {
      const Eigen::Vector2d at(x + 0.5, map.rows - y - 0.5);
      const auto pixel = ProjectPoint(
          InSpace(area, place.corner + place.pixel * at), view, camera);
      // OpenCV's first pixel is at 0.
      const Eigen::Vector2d seen =
          pixel ? Eigen::Vector2d(to_read * *pixel - Eigen::Vector2d(0.5, 0.5))
                : Eigen::Vector2d(-1e4, -1e4);
      map(y, x) =
          cv::Vec2f(static_cast<float>(seen.x()), static_cast<float>(seen.y()));
    }
  });
  cv::Mat flat;
  cv::remap(image,
            flat,
            map,
            cv::noArray(),
            cv::INTER_LINEAR,
            cv::BORDER_CONSTANT,
            cv::Scalar(255, 255, 255));
  CURVIX_ASSIGN_OR_RETURN(
      result.jpeg,
      EncodeImage(".jpg", flat, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality}));
  return result;
}

}  // namespace curvix
