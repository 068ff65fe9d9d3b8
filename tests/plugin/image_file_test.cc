// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/image_file.h"

#include <gtest/gtest.h>
#include <string>

#include "base/file_io.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

TEST(ImageFile, WhatIsEncodedIsReadBack) {
  const TemporaryFolder folder;
  const cv::Mat1b image = (cv::Mat1b(2, 3) << 0, 50, 100, 150, 200, 250);
  const Result<std::string> png = EncodeImage(".png", image);
  ASSERT_TRUE(png.ok()) << png.status().message();
  const auto path = folder.path() / "image.png";
  ASSERT_TRUE(WriteFileAtomically(path, *png).ok());
  const Result<cv::Mat> read = ReadImage(path, cv::IMREAD_GRAYSCALE);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(cv::norm(*read, image), 0);
}

TEST(ImageFile, TiffsAreNotTurned) {
  const TemporaryFolder folder;
  const cv::Mat1b image = (cv::Mat1b(2, 3) << 0, 50, 100, 150, 200, 250);
  std::string tiff = EncodeImage(".tiff", image).value();
  // The number of channels, which is 1 if it is not said, becomes the
  // orientation, the tag 274: the first row is the right side.
  const std::size_t at = tiff.find(std::string("\x15\1\3\0\1\0\0\0\1", 9));
  ASSERT_NE(at, tiff.npos);
  tiff[at] = 0x12;
  tiff[at + 8] = 6;
  const auto path = folder.path() / "image.tiff";
  ASSERT_TRUE(WriteFileAtomically(path, tiff).ok());
  ASSERT_EQ(cv::imread(path.string()).rows, 3) << "OpenCV turns it";
  const Result<cv::Mat> read = ReadImage(path, cv::IMREAD_GRAYSCALE);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->size(), image.size());
  EXPECT_EQ(cv::norm(*read, image), 0);
}

TEST(ImageFile, SaysWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      ReadImage(folder.path() / "gone.png", cv::IMREAD_COLOR).status().code(),
      StatusCode::kNotFound);
}

TEST(ImageFile, ImagesBeyondTheLimitOfOpenCvAreErrors) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "huge.pgm";
  ASSERT_TRUE(WriteFileAtomically(path, "P5 40000 40000 255\n").ok());
  EXPECT_EQ(ReadImage(path, cv::IMREAD_COLOR).status().code(),
            StatusCode::kDataLoss);
}

TEST(ImageFile, UnknownFormatsAreErrors) {
  EXPECT_EQ(EncodeImage(".nothing", cv::Mat1b(2, 2, uchar{0})).status().code(),
            StatusCode::kInternal);
}

}  // namespace
}  // namespace curvix
