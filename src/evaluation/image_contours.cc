// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "evaluation/image_contours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace curvix {
namespace {

constexpr double kBlurPx = 1.2;
constexpr float kMinUpperThreshold = 4;  // grey levels per pixel
constexpr int kMinContourPixels = 30;
constexpr double kMinLineLength = 0.02;  // of the diagonal

// From the centre of the first pixel at (0, 0), OpenCV's, to (0.5, 0.5).
const Eigen::Vector2d kHalfPixel(0.5, 0.5);

cv::Mat1b EightBits(const GrayImage& image) {
  cv::Mat1b bytes(image.height, image.width);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      bytes(y, x) = cv::saturate_cast<std::uint8_t>(image.at(x, y));
    }
  }
  return bytes;
}

struct Gradient {
  cv::Mat1f x, y;
  cv::Mat1f magnitude;
};

Gradient FindGradient(const cv::Mat1b& image) {
  constexpr double kSobelSum = 8;
  cv::Mat1b blurred;
  cv::GaussianBlur(image, blurred, {}, kBlurPx);
  Gradient gradient;
  cv::Sobel(blurred, gradient.x, CV_32F, 1, 0, 3, 1 / kSobelSum);
  cv::Sobel(blurred, gradient.y, CV_32F, 0, 1, 3, 1 / kSobelSum);
  cv::magnitude(gradient.x, gradient.y, gradient.magnitude);
  return gradient;
}

float UpperThreshold(const cv::Mat1f& magnitude) {
  std::vector<float> values(magnitude.begin(), magnitude.end());
  const auto tenth =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
  std::nth_element(values.begin(), tenth, values.end());
  return std::max(kMinUpperThreshold, *tenth);
}

// Non-zero: a pixel of an edge.
cv::Mat1b Canny(const Gradient& gradient) {
  constexpr double kScale = 8;  // keeps an eighth of a grey level
  cv::Mat x, y;
  gradient.x.convertTo(x, CV_16S, kScale);
  gradient.y.convertTo(y, CV_16S, kScale);
  const double upper =
      kScale * static_cast<double>(UpperThreshold(gradient.magnitude));
  cv::Mat1b edges;
  cv::Canny(x, y, edges, upper / 2, upper, true);
  return edges;
}

}  // namespace

std::vector<Edge2d> FindContours(const GrayImage& image) {
  const Gradient gradient = FindGradient(EightBits(image));
  cv::Mat1i labels, stats;
  cv::Mat1d centroids;
  cv::connectedComponentsWithStats(
      Canny(gradient), labels, stats, centroids, 8, CV_32S);
  std::vector<Edge2d> contours;
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (label == 0 || stats(label, cv::CC_STAT_AREA) < kMinContourPixels) {
        continue;
      }
      Edge2d pixel;
      pixel.position = Eigen::Vector2d(x, y) + kHalfPixel;
      pixel.angle = std::atan2(gradient.x(y, x), -gradient.y(y, x));
      pixel.strength = gradient.magnitude(y, x);
      contours.push_back(pixel);
    }
  }
  return contours;
}

std::vector<Edge2d> FindLongLines(const GrayImage& image) {
  std::vector<cv::Vec4f> segments;
  cv::createLineSegmentDetector(cv::LSD_REFINE_ADV)
      ->detect(EightBits(image), segments);
  const double min_length =
      kMinLineLength * std::hypot(image.width, image.height);
  std::vector<Edge2d> places;
  for (const cv::Vec4f& s : segments) {
    const Eigen::Vector2d from =
        Eigen::Vector2f(s[0], s[1]).cast<double>() + kHalfPixel;
    const Eigen::Vector2d along =
        Eigen::Vector2f(s[2] - s[0], s[3] - s[1]).cast<double>();
    const double length = along.norm();
    if (length < min_length) continue;
    const int n = static_cast<int>(length);
    for (int i = 0; i < n; ++i) {
      Edge2d place;
      place.position = from + (i + 0.5) / n * along;
      place.angle = static_cast<float>(std::atan2(along.y(), along.x()));
      places.push_back(place);
    }
  }
  return places;
}

}  // namespace curvix
