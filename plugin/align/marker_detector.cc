// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/marker_detector.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <opencv2/imgproc.hpp>

#ifdef CURVIX_HAS_ARUCO
#if CV_VERSION_MAJOR * 100 + CV_VERSION_MINOR >= 407
#include <opencv2/objdetect/aruco_detector.hpp>
#define CURVIX_ARUCO_IS_CLASS
#else
#include <opencv2/aruco.hpp>
#endif
#endif

namespace curvix {

#ifndef CURVIX_HAS_ARUCO

std::vector<std::string> MarkerDictionaries() { return {}; }

std::vector<SeenMarker> DetectMarkers(const cv::Mat&, const std::string&) {
  return {};
}

#else

namespace {

const std::map<std::string, int>& Dictionaries() {
  static const std::map<std::string, int> dictionaries = {
      {"4x4_50", cv::aruco::DICT_4X4_50},
      {"4x4_100", cv::aruco::DICT_4X4_100},
      {"4x4_250", cv::aruco::DICT_4X4_250},
      {"4x4_1000", cv::aruco::DICT_4X4_1000},
      {"5x5_50", cv::aruco::DICT_5X5_50},
      {"5x5_100", cv::aruco::DICT_5X5_100},
      {"5x5_250", cv::aruco::DICT_5X5_250},
      {"5x5_1000", cv::aruco::DICT_5X5_1000},
      {"6x6_50", cv::aruco::DICT_6X6_50},
      {"6x6_100", cv::aruco::DICT_6X6_100},
      {"6x6_250", cv::aruco::DICT_6X6_250},
      {"6x6_1000", cv::aruco::DICT_6X6_1000},
      {"7x7_50", cv::aruco::DICT_7X7_50},
      {"7x7_100", cv::aruco::DICT_7X7_100},
      {"7x7_250", cv::aruco::DICT_7X7_250},
      {"7x7_1000", cv::aruco::DICT_7X7_1000},
      {"aruco_original", cv::aruco::DICT_ARUCO_ORIGINAL},
      {"apriltag_16h5", cv::aruco::DICT_APRILTAG_16h5},
      {"apriltag_25h9", cv::aruco::DICT_APRILTAG_25h9},
      {"apriltag_36h10", cv::aruco::DICT_APRILTAG_36h10},
      {"apriltag_36h11", cv::aruco::DICT_APRILTAG_36h11}};
  return dictionaries;
}

}  // namespace

std::vector<std::string> MarkerDictionaries() {
  std::vector<std::string> names;
  for (const auto& [name, id] : Dictionaries()) names.push_back(name);
  return names;
}

std::vector<SeenMarker> DetectMarkers(const cv::Mat& image,
                                      const std::string& dictionary) {
  std::vector<std::vector<cv::Point2f> > corners;
  std::vector<int> ids;
  const int dictionary_id = Dictionaries().at(dictionary);
#ifdef CURVIX_ARUCO_IS_CLASS
  cv::aruco::DetectorParameters parameters;
  parameters.cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  const cv::aruco::ArucoDetector detector(
      cv::aruco::getPredefinedDictionary(dictionary_id), parameters);
  detector.detectMarkers(image, corners, ids);
#else
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  cv::aruco::detectMarkers(
      image,
      cv::aruco::getPredefinedDictionary(
          static_cast<cv::aruco::PREDEFINED_DICTIONARY_NAME>(dictionary_id)),
      corners,
      ids,
      parameters);
#endif
  std::vector<SeenMarker> seen;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (std::ranges::count(ids, ids[i]) > 1) continue;
    SeenMarker& marker = seen.emplace_back();
    marker.id = ids[i];
    for (std::size_t k = 0; k < 4; ++k) {
      // OpenCV calls the centre of the first pixel (0, 0).
      marker.corners[k] = {corners[i][k].x + 0.5, corners[i][k].y + 0.5};
    }
  }
  std::ranges::sort(seen, {}, &SeenMarker::id);
  return seen;
}

#endif

}  // namespace curvix
