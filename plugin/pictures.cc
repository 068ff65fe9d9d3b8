// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/pictures.h"

#include <curvix/camera_model.h>
#include <curvix/curve_style.h>
#include <curvix/parallel.h>
#include <curvix/project_curve.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace curvix {
namespace {

Result<cv::Mat> ReadPhoto(const View& view, int flags) {
  cv::Mat photo;
  try {
    photo = cv::imread(view.image_path.string(),
                       flags | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    return Status(StatusCode::kDataLoss,
                  view.image_path.string() + ": " + error.what());
  }
  if (photo.empty()) {
    return Status(StatusCode::kNotFound,
                  "Cannot read the image " + view.image_path.string() +
                      "; check that it is there and whole.");
  }
  return photo;
}

// OpenCV reads JPEG at a fraction of its size in a fraction of the time.
int ReadFlags(double reduction) {
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

Result<std::string> Encode(const char* extension,
                           const cv::Mat& image,
                           const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(extension, image, bytes, parameters)) {
    return Status(StatusCode::kInternal,
                  std::string("OpenCV cannot write ") + extension);
  }
  return std::string(bytes.begin(), bytes.end());
}

Result<std::string> SmallPinholeJpeg(const View& view,
                                     const Camera& camera,
                                     int max_size_px) {
  constexpr int kQuality = 80;
  const double reduction = std::max(
      1.0,
      static_cast<double>(std::max(camera.width, camera.height)) / max_size_px);
  Result<cv::Mat> photo = ReadPhoto(view, ReadFlags(reduction));
  if (!photo.ok()) return photo.status();
  const auto shrunk = [&](int full) {
    return std::max(1, static_cast<int>(std::lround(full / reduction)));
  };
  const cv::Size small(shrunk(camera.width), shrunk(camera.height));
  cv::Mat image;
  if (IsPinhole(camera)) {
    cv::resize(*photo, image, small, 0, 0, cv::INTER_AREA);
  } else {
    // Twice the size at first, so that sampling leaves no pixel out.
    if (photo->cols > 2 * small.width) {
      cv::resize(*photo,
                 *photo,
                 {2 * small.width, 2 * small.height},
                 0,
                 0,
                 cv::INTER_AREA);
    }
    cv::remap(*photo,
              image,
              PinholeMap(camera, small, photo->size()),
              cv::noArray(),
              cv::INTER_LINEAR);
  }
  return Encode(".jpg", image, {cv::IMWRITE_JPEG_QUALITY, kQuality});
}

}  // namespace

std::vector<std::string> SmallPinholeJpegs(const Scene& scene,
                                           const std::vector<int>& view_idxs,
                                           int max_size_px,
                                           int num_threads) {
  std::vector<std::string> jpegs(view_idxs.size());
  ParallelFor(jpegs.size(), num_threads, [&](std::size_t i) {
    const View& view = scene.views[static_cast<std::size_t>(view_idxs[i])];
    Result<std::string> jpeg = SmallPinholeJpeg(
        view,
        scene.cameras[static_cast<std::size_t>(view.camera_idx)],
        max_size_px);
    if (jpeg.ok()) jpegs[i] = *std::move(jpeg);
  });
  return jpegs;
}

Result<std::string> OverlayPng(const CurveSource& curves,
                               const View& view,
                               const Camera& camera) {
  constexpr double kPhotoShare = 0.55;  // the rest is white
  constexpr int kSubpixelBits = 4;
  Result<cv::Mat> photo = ReadPhoto(view, cv::IMREAD_COLOR);
  if (!photo.ok()) return photo.status();
  photo->convertTo(*photo, -1, kPhotoShare, 255 * (1 - kPhotoShare));
  const int width = std::max(2, std::max(camera.width, camera.height) / 500);
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    const auto [red, green, blue] = CurveColor(id);
    for (const auto& stretch : ProjectCurve(curve, view, camera)) {
      std::vector<cv::Point> line;
      for (const Eigen::Vector2d& p : stretch) {
        line.emplace_back(
            static_cast<int>(std::lround((p.x() - 0.5) * (1 << kSubpixelBits))),
            static_cast<int>(
                std::lround((p.y() - 0.5) * (1 << kSubpixelBits))));
      }
      cv::polylines(*photo,
                    line,
                    false,
                    cv::Scalar(blue, green, red),
                    width,
                    cv::LINE_AA,
                    kSubpixelBits);
    }
  });
  return Encode(".png", *photo, {});
}

}  // namespace curvix
