// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/image_file.h"

#include <cstdint>

#include "base/file_io.h"
#include "base/image_header.h"

namespace curvix {

Result<cv::Mat> ReadImage(const std::filesystem::path& path,
                          cv::ImreadModes mode) {
  cv::Mat image;
  try {
    const Result<std::string> file = ReadFile(path);
    if (file.ok() && !file->empty()) {
      std::vector<std::uint8_t> bytes(file->begin(), file->end());
      IgnoreTiffOrientation(&bytes);
      image = cv::imdecode(bytes, mode | cv::IMREAD_IGNORE_ORIENTATION);
    }
  } catch (const cv::Exception& error) {
    return Status::DataLoss(path.string() + ": " + error.what());
  }
  if (image.empty()) {
    return Status::NotFound("Cannot read the image " + path.string() +
                            "; check that it is there and whole.");
  }
  return image;
}

Result<std::string> EncodeImage(const char* extension,
                                const cv::Mat& image,
                                const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  try {
    if (!cv::imencode(extension, image, bytes, parameters)) bytes.clear();
  } catch (const cv::Exception&) {
    bytes.clear();
  }
  if (bytes.empty()) {
    return Status::Internal(std::string("OpenCV cannot write ") + extension);
  }
  return std::string(bytes.begin(), bytes.end());
}

}  // namespace curvix
