// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's detector of markers, which has moved between its versions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace curvix {

// Names of the dictionaries: "4x4_50", "apriltag_36h11" and so on. Empty if
// this build's OpenCV finds no markers.
std::vector<std::string> MarkerDictionaries();

struct SeenMarker {
  int id = 0;
  // Clockwise from the top left one of the marker; pixels of the image.
  std::array<Eigen::Vector2d, 4> corners;
};

// Of a grey image of 8 bits; `dictionary` is one of MarkerDictionaries().
// Ascending by id; a marker that is there twice is left out.
std::vector<SeenMarker> DetectMarkers(const cv::Mat& image,
                                      const std::string& dictionary);

}  // namespace curvix
