// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/small_images.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <variant>

#include "base/parallel.h"
#include "io/curve_style.h"
#include "plugin/base/image_file.h"
#include "plugin/export/spread.h"

namespace curvix {
namespace {

struct Place {
  Eigen::Vector3d center;
  Eigen::Vector3d direction;
};

std::vector<Place> PlacesOf(const Scene& scene) {
  std::vector<Place> places;
  double largest = 0;
  for (const View& view : scene.views) {
    const Rigid3 world_from_cam = view.cam_from_world.Inverse();
    places.push_back({world_from_cam.translation,
                      world_from_cam.rotation * Eigen::Vector3d::UnitZ()});
    largest = std::max(largest,
                       (places.back().center - places.front().center).norm());
  }
  for (Place& place : places) place.center /= largest > 0 ? largest : 1;
  return places;
}

}  // namespace

std::vector<int> SpreadViews(const Scene& scene, int count) {
  const std::vector<Place> places = PlacesOf(scene);
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (places[i].center - places[j].center).norm() +
           (places[i].direction - places[j].direction).norm();
  };
  std::vector<int> chosen;
  for (const std::size_t i :
       SpreadOut(places.size(), static_cast<std::size_t>(count), distance)) {
    chosen.push_back(static_cast<int>(i));
  }
  std::ranges::sort(chosen);
  return chosen;
}

namespace {

// In OpenCV's order of colours and 8 bits.
cv::Mat PhotoOf(const ImageInMemory& image) {
  const int depth = image.values.index() == 0 ? CV_8U : CV_16U;
  const void* const values = std::visit(
      [](const auto& pointer) -> const void* { return pointer.get(); },
      image.values);
  // OpenCV has no matrices that only read.
  const cv::Mat given(image.height,
                      image.width,
                      CV_MAKETYPE(depth, image.num_channels),
                      const_cast<void*>(values));
  cv::Mat bytes, photo;
  given.convertTo(bytes, CV_8U, depth == CV_8U ? 1 : 1 / 257.0);
  cv::cvtColor(bytes,
               photo,
               image.num_channels == 1   ? cv::COLOR_GRAY2BGR
               : image.num_channels == 3 ? cv::COLOR_RGB2BGR
                                         : cv::COLOR_RGBA2BGR);
  return photo;
}

Result<cv::Mat> ReadPhoto(const View& view, cv::ImreadModes mode) {
  if (view.image) return PhotoOf(*view.image);
  return ReadImage(view.image_path, mode);
}

// OpenCV reads JPEG at a fraction of its size in a fraction of the time.
cv::ImreadModes ReadMode(double reduction) {
  if (reduction >= 8) return cv::IMREAD_REDUCED_COLOR_8;
  if (reduction >= 4) return cv::IMREAD_REDUCED_COLOR_4;
  if (reduction >= 2) return cv::IMREAD_REDUCED_COLOR_2;
  return cv::IMREAD_COLOR;
}

// Where each pixel of the small pinhole image is in an image of `size`.
cv::Mat2f PinholeMap(const Camera& camera, cv::Size small, cv::Size size) {
  const Eigen::Matrix3d inverse = PinholeCalibration(camera).inverse();
  const double to_full = static_cast<double>(camera.width) / small.width;
  const double to_read = static_cast<double>(size.width) / camera.width;
  cv::Mat2f map(small);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const Eigen::Vector3d pixel(to_full * (x + 0.5), to_full * (y + 0.5), 1);
      const Eigen::Vector2d seen =
          to_read * ImageFromIdeal(camera, (inverse * pixel).hnormalized());
      // OpenCV's first pixel is at 0.
      map(y, x) = seen.allFinite()
                      ? cv::Vec2f(static_cast<float>(seen.x() - 0.5),
                                  static_cast<float>(seen.y() - 0.5))
                      : cv::Vec2f(-1e4F, -1e4F);
    }
  }
  return map;
}

Result<std::string> SmallPinholeJpeg(const View& view,
                                     const Camera& camera,
                                     int max_size_px) {
  constexpr int kQuality = 80;
  const double reduction = std::max(
      1.0,
      static_cast<double>(std::max(camera.width, camera.height)) / max_size_px);
  CURVIX_ASSIGN_OR_RETURN(cv::Mat photo, ReadPhoto(view, ReadMode(reduction)));
  const auto shrunk = [&](int full) {
    return std::max(1, static_cast<int>(std::lround(full / reduction)));
  };
  const cv::Size small(shrunk(camera.width), shrunk(camera.height));
  cv::Mat image;
  if (IsPinhole(camera)) {
    cv::resize(photo, image, small, 0, 0, cv::INTER_AREA);
  } else {
    // Twice the size at first, so that sampling leaves no pixel out.
    if (photo.cols > 2 * small.width) {
      cv::resize(photo,
                 photo,
                 {2 * small.width, 2 * small.height},
                 0,
                 0,
                 cv::INTER_AREA);
    }
    cv::remap(photo,
              image,
              PinholeMap(camera, small, photo.size()),
              cv::noArray(),
              cv::INTER_LINEAR);
  }
  return EncodeImage(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, kQuality});
}

cv::Scalar Color(std::size_t curve_id) {
  const auto [red, green, blue] = CurveColor(curve_id);
  return {static_cast<double>(blue),
          static_cast<double>(green),
          static_cast<double>(red)};
}

void DrawLine(const std::vector<Eigen::Vector2d>& line,
              const cv::Scalar& color,
              int width,
              cv::Mat* image) {
  constexpr int kSubpixelBits = 4;
  const auto in_subpixels = [](double pixel) {
    return static_cast<int>(std::lround((pixel - 0.5) * (1 << kSubpixelBits)));
  };
  std::vector<cv::Point> points;
  for (const Eigen::Vector2d& p : line) {
    points.emplace_back(in_subpixels(p.x()), in_subpixels(p.y()));
  }
  cv::polylines(
      *image, points, false, color, width, cv::LINE_AA, kSubpixelBits);
}

}  // namespace

std::vector<std::string> SmallPinholeJpegs(const Scene& scene,
                                           const std::vector<int>& view_idxs,
                                           int max_size_px,
                                           int num_threads) {
  std::vector<std::string> jpegs(view_idxs.size());
  ParallelFor(jpegs.size(), num_threads, [&](std::size_t i) {
    const View& view = scene.views[static_cast<std::size_t>(view_idxs[i])];
    Result<std::string> jpeg =
        SmallPinholeJpeg(view, CameraOf(scene, view), max_size_px);
    if (jpeg.ok()) jpegs[i] = *std::move(jpeg);
  });
  return jpegs;
}

Result<std::string> OverlayPng(const CurveSource& curves,
                               const Scene& scene,
                               int view_idx) {
  constexpr double kPhotoShare = 0.55;  // the rest is white
  constexpr double kPaleShare = 0.4;    // of a colour, the rest is white
  const View& view = scene.views[static_cast<std::size_t>(view_idx)];
  CURVIX_ASSIGN_OR_RETURN(cv::Mat photo, ReadPhoto(view, cv::IMREAD_COLOR));
  photo.convertTo(photo, -1, kPhotoShare, 255 * (1 - kPhotoShare));
  const int width = std::max(2, std::max(photo.cols, photo.rows) / 500);
  // What is shown comes last, over all that may be hidden.
  for (const bool is_shown : {false, true}) {
    curves.ForEach([&](std::size_t id, const Curve& curve) {
      const cv::Scalar pale =
          kPaleShare * Color(id) + cv::Scalar::all(255 * (1 - kPaleShare));
      for (const ProjectedStretch& stretch :
           ProjectShownAndHidden(curve, scene, view_idx)) {
        if (stretch.is_shown != is_shown) continue;
        DrawLine(stretch.pixels,
                 is_shown ? Color(id) : pale,
                 is_shown ? width : width / 2,
                 &photo);
      }
    });
  }
  return EncodeImage(".png", photo);
}

}  // namespace curvix
