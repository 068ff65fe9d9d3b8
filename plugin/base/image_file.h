// SPDX-License-Identifier: BSD-3-Clause
// Images from files and into bytes, by OpenCV, without its exceptions.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace curvix {

// As cv::imread() does, without turning it by its EXIF orientation, which poses
// do not know. kNotFound: there is no image that OpenCV can read; kDataLoss: it
// refuses to read it, say because it is too large.
Result<cv::Mat> ReadImage(const std::filesystem::path& path,
                          cv::ImreadModes mode);

// The bytes of a file with this extension, ".jpg" or ".png". kInternal: OpenCV
// cannot write it.
Result<std::string> EncodeImage(const char* extension,
                                const cv::Mat& image,
                                const std::vector<int>& parameters = {});

}  // namespace curvix
