// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/load_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Bytes = std::vector<char>;

Camera CameraOfSize(const ImageSize& size) {
  Camera camera;
  camera.width = size.width;
  camera.height = size.height;
  return camera;
}

class LoadGrayImageTest : public ::testing::Test {
 protected:
  fs::path Written(const std::string& name, const cv::Mat& image) const {
    fs::path path = folder_.path() / name;
    EXPECT_TRUE(cv::imwrite(path.string(), image));
    return path;
  }
  fs::path Written(const std::string& name, const Bytes& bytes) const {
    fs::path path = folder_.path() / name;
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }

  const TemporaryFolder folder_;
  const Camera camera_ = CameraOfSize({80, 60});
};

Bytes Contents(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Noisy, so that compressed files are long.
cv::Mat Texture(int type) {
  cv::Mat image(60, 80, type);
  cv::RNG generator(5);
  generator.fill(image, cv::RNG::UNIFORM, 0, 255);
  return image;
}

// The image in the file as that of a view whose camera has this size.
Result<GrayImage> Loaded(const fs::path& path, const ImageSize& size) {
  View view;
  view.image_path = path;
  return LoadGrayImage(view, CameraOfSize(size));
}

// Whose camera has the size of the image, if it can be told.
Result<GrayImage> Loaded(const fs::path& path) {
  const Result<ImageSize> size = ReadImageSize(path);
  return Loaded(path, size.ok() ? *size : ImageSize());
}

StatusCode CodeOf(const fs::path& path) {
  const Result<GrayImage> image = Loaded(path);
  EXPECT_THAT(image.status().message(), HasSubstr(path.filename().string()));
  return image.status().code();
}

TEST_F(LoadGrayImageTest, KeepsGrey) {
  cv::Mat image(2, 3, CV_8UC1);
  for (int i = 0; i < 6; ++i) {
    image.at<std::uint8_t>(i / 3, i % 3) = static_cast<std::uint8_t>(40 * i);
  }
  const Result<GrayImage> gray = Loaded(Written("a b.png", image));
  ASSERT_TRUE(gray.ok()) << gray.status().message();
  EXPECT_EQ(gray->width, 3);
  EXPECT_EQ(gray->height, 2);
  EXPECT_EQ(gray->pixels, (std::vector<float>{0, 40, 80, 120, 160, 200}));
}

TEST_F(LoadGrayImageTest, WeighsColoursAndKeepsFractions) {
  cv::Mat image(1, 3, CV_8UC3);
  image.at<cv::Vec3b>(0, 0) = {0, 0, 101};
  image.at<cv::Vec3b>(0, 1) = {0, 101, 0};
  image.at<cv::Vec3b>(0, 2) = {101, 0, 0};
  const Result<GrayImage> gray = Loaded(Written("rgb.png", image));
  ASSERT_TRUE(gray.ok());
  EXPECT_NEAR(gray->at(0, 0), 0.299 * 101, 1e-4);
  EXPECT_NEAR(gray->at(1, 0), 0.587 * 101, 1e-4);
  EXPECT_NEAR(gray->at(2, 0), 0.114 * 101, 1e-4);
}

TEST_F(LoadGrayImageTest, CompositesAlphaOverBlack) {
  cv::Mat image(1, 3, CV_8UC4);
  image.at<cv::Vec4b>(0, 0) = {200, 200, 200, 255};
  image.at<cv::Vec4b>(0, 1) = {200, 200, 200, 51};
  image.at<cv::Vec4b>(0, 2) = {200, 200, 200, 0};
  const Result<GrayImage> gray = Loaded(Written("rgba.png", image));
  ASSERT_TRUE(gray.ok());
  EXPECT_NEAR(gray->at(0, 0), 200, 1e-4);
  EXPECT_NEAR(gray->at(1, 0), 40, 1e-4);
  EXPECT_EQ(gray->at(2, 0), 0);
}

TEST_F(LoadGrayImageTest, ScalesSixteenBits) {
  cv::Mat gray16(1, 2, CV_16UC1);
  gray16.at<std::uint16_t>(0, 0) = 65535;
  gray16.at<std::uint16_t>(0, 1) = 1000;
  cv::Mat rgba16(1, 1, CV_16UC4);
  rgba16.at<cv::Vec4w>(0, 0) = {1000, 1000, 1000, 13107};
  const Result<GrayImage> gray = Loaded(Written("g.png", gray16));
  const Result<GrayImage> rgba = Loaded(Written("c.png", rgba16));
  ASSERT_TRUE(gray.ok() && rgba.ok());
  EXPECT_NEAR(gray->at(0, 0), 255, 1e-4);
  EXPECT_NEAR(gray->at(1, 0), 1000 / 257.0, 1e-4);
  EXPECT_NEAR(rgba->at(0, 0), 1000 / 257.0 / 5, 1e-4);
}

// A view with the values of an image of OpenCV in memory, in this library's
// order of colours, and no file.
template <typename T>
View InMemory(const cv::Mat& image) {
  const cv::Mat flat = image.reshape(1);
  const auto values =
      std::make_shared<std::vector<T>>(flat.begin<T>(), flat.end<T>());
  const auto num_channels = static_cast<std::size_t>(image.channels());
  for (std::size_t i = 0; num_channels > 1 && i < values->size();
       i += num_channels) {
    std::swap((*values)[i], (*values)[i + 2]);
  }
  View view;
  view.name = "a.png";
  view.image = {image.cols,
                image.rows,
                image.channels(),
                std::shared_ptr<const T[]>(values, values->data())};
  return view;
}

TEST_F(LoadGrayImageTest, ImagesInMemoryAreAsTheirFiles) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC4}) {
    const cv::Mat image = Texture(type);
    const Result<GrayImage> expected = Loaded(Written("a.png", image));
    const View view = image.depth() == CV_8U ? InMemory<std::uint8_t>(image)
                                             : InMemory<std::uint16_t>(image);
    const Result<GrayImage> gray = LoadGrayImage(view, camera_);
    ASSERT_TRUE(expected.ok() && gray.ok()) << gray.status().message();
    EXPECT_EQ(gray->pixels, expected->pixels) << type;
  }
}

TEST_F(LoadGrayImageTest, RefusesBrokenImagesInMemory) {
  View view = InMemory<std::uint8_t>(Texture(CV_8UC1));
  const auto message = [&] { return LoadGrayImage(view, camera_).status(); };
  view.image->num_channels = 2;
  EXPECT_THAT(message().message(), HasSubstr("a.png in memory"));
  view.image = {80, 60, 1, {}};
  EXPECT_EQ(message().code(), StatusCode::kInvalidArgument);
  view.image->width = 81;
  EXPECT_THAT(message().message(), HasSubstr("a.png is 81 x 60 pixels"));
}

TEST_F(LoadGrayImageTest, IgnoresTheExifRotation) {
  const Bytes plain = Contents(Written("plain.jpg", Texture(CV_8UC1)));
  // APP1: "Exif", little-endian TIFF, one entry: orientation (0x112) = 6.
  const unsigned char exif[] = {0xFF, 0xE1, 0,    34, 'E', 'x', 'i', 'f', 0,
                                0,    'I',  'I',  42, 0,   8,   0,   0,   0,
                                1,    0,    0x12, 1,  3,   0,   1,   0,   0,
                                0,    6,    0,    0,  0,   0,   0,   0,   0};
  Bytes rotated(plain.begin(), plain.begin() + 2);
  for (const unsigned char byte : exif) {
    rotated.push_back(static_cast<char>(byte));
  }
  rotated.insert(rotated.end(), plain.begin() + 2, plain.end());
  const fs::path path = Written("rotated.jpg", rotated);
  ASSERT_EQ(cv::imread(path.string()).cols, 60) << "OpenCV sees a rotation";
  const Result<GrayImage> gray = Loaded(path);
  ASSERT_TRUE(gray.ok());
  EXPECT_EQ(gray->width, 80);
  EXPECT_EQ(gray->height, 60);
}

// 3 x 2 grey pixels of 16 bits, the largest first, the others black.
Bytes Tiff(bool is_big, int orientation) {
  Bytes bytes;
  const auto append = [&](int number, int size) {
    for (int i = 0; i < size; ++i) {
      const int shift = 8 * (is_big ? size - 1 - i : i);
      bytes.push_back(static_cast<char>(number >> shift));
    }
  };
  append(is_big ? 0x4D4D : 0x4949, 2);
  append(42, 2);
  append(8, 4);
  constexpr int kPixels = 8 + 2 + 12 * 9 + 4;
  // Tags and their values: sizes, bits, grey, where, orientation, ...
  const int entries[][2] = {{256, 3},
                            {257, 2},
                            {258, 16},
                            {262, 1},
                            {273, kPixels},
                            {274, orientation},
                            {277, 1},
                            {278, 2},
                            {279, 12}};
  append(9, 2);
  for (const auto& [tag, value] : entries) {
    append(tag, 2);
    append(3, 2);  // a short number
    append(1, 4);
    append(value, 2);
    append(0, 2);
  }
  append(0, 4);
  append(0xFFFF, 2);
  append(0, 10);
  return bytes;
}

TEST_F(LoadGrayImageTest, IgnoresTheOrientationOfTiff) {
  for (const bool is_big : {false, true}) {
    for (int orientation = 1; orientation <= 8; ++orientation) {
      const fs::path path = Written("a.tif", Tiff(is_big, orientation));
      const Result<GrayImage> gray = Loaded(path);
      ASSERT_TRUE(gray.ok()) << gray.status().message();
      EXPECT_EQ(gray->width, 3);
      EXPECT_EQ(gray->height, 2);
      EXPECT_EQ(gray->pixels, (std::vector<float>{255, 0, 0, 0, 0, 0}))
          << orientation;
    }
  }
}

TEST_F(LoadGrayImageTest, ExplainsWhatIsMissing) {
  EXPECT_EQ(CodeOf(folder_.path() / "nowhere.png"), StatusCode::kNotFound);
  EXPECT_EQ(CodeOf(folder_.path()), StatusCode::kNotFound) << "a folder";
  EXPECT_EQ(CodeOf(Written("empty.png", Bytes())), StatusCode::kDataLoss);
  EXPECT_EQ(CodeOf(Written("text.png", Bytes{'h', 'e', 'l', 'l', 'o'})),
            StatusCode::kDataLoss);
}

TEST_F(LoadGrayImageTest, NamesHeif) {
  const Bytes bytes = {0, 0, 0, 24, 'f', 't', 'y', 'p', 'h', 'e', 'i', 'c'};
  const Status status = Loaded(Written("photo.heic", bytes)).status();
  EXPECT_EQ(status.code(), StatusCode::kUnsupported);
  EXPECT_THAT(status.message(), HasSubstr("photo.heic is HEIF"));
}

TEST_F(LoadGrayImageTest, NoticesTruncatedFiles) {
  for (const char* name : {"whole.png", "whole.jpg"}) {
    const Bytes whole = Contents(Written(name, Texture(CV_8UC3)));
    ASSERT_TRUE(Loaded(folder_.path() / name).ok());
    for (const std::size_t tenths : {1u, 5u, 9u}) {
      const auto size = static_cast<std::ptrdiff_t>(whole.size() * tenths / 10);
      EXPECT_EQ(CodeOf(Written(std::string("cut_") + name,
                               Bytes(whole.begin(), whole.begin() + size))),
                StatusCode::kDataLoss)
          << name << ", " << tenths << " tenths";
    }
  }
}

TEST_F(LoadGrayImageTest, RefusesOtherSizesBeforeItDecodes) {
  for (const char* name : {"a.png", "a.jpg", "a.tiff", "a.bmp"}) {
    const fs::path path = Written(name, Texture(CV_8UC3));
    EXPECT_EQ(*ReadImageSize(path), (ImageSize{80, 60})) << name;
    EXPECT_TRUE(Loaded(path, ImageSize{80, 60}).ok()) << name;
    const Status status = Loaded(path, ImageSize{60, 80}).status();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << name;
    EXPECT_THAT(status.message(), HasSubstr("is 80 x 60 pixels"));
    EXPECT_THAT(status.message(), HasSubstr("EXIF")) << "the sides are swapped";
    EXPECT_THAT(Loaded(path, ImageSize{60, 81}).status().message(),
                ::testing::Not(HasSubstr("EXIF")));
  }
  // A head without a body, of an image of a terabyte.
  Bytes head = Contents(folder_.path() / "a.png");
  head.resize(33);
  head[16] = head[20] = 0;
  head[17] = head[21] = 15;
  const fs::path path = Written("huge.png", head);
  EXPECT_EQ(Loaded(path, ImageSize{80, 60}).status().code(),
            StatusCode::kInvalidArgument);
}

TEST_F(LoadGrayImageTest, RefusesOtherPixelFormats) {
  EXPECT_EQ(CodeOf(Written("float.tiff", cv::Mat(4, 4, CV_32FC1, 0.5))),
            StatusCode::kUnsupported);
}

// By the header alone: bodies are cut off.
TEST_F(LoadGrayImageTest, ChecksHeadersWithTheSameWords) {
  View view;
  const std::vector<std::pair<std::string, cv::Mat>> images = {
      {"a.png", Texture(CV_8UC3)},
      {"a.jpg", Texture(CV_8UC3)},
      {"a.tiff", Texture(CV_16UC3)},
      {"a.bmp", Texture(CV_8UC3)},
      {"a.pgm", Texture(CV_16UC1)},
      {"a.ppm", Texture(CV_8UC3)},
      {"wide.png", cv::Mat(60, 81, CV_8U, cv::Scalar(7))},
      {"turned.jpg", cv::Mat(80, 60, CV_8U, cv::Scalar(7))},
      {"float.tiff", cv::Mat(60, 80, CV_32FC1, 0.5)},
      {"wide.tiff", cv::Mat(60, 81, CV_16UC1, cv::Scalar(7))},
      {"turned.bmp", cv::Mat(80, 60, CV_8U, cv::Scalar(7))},
      {"wide.pgm", cv::Mat(60, 81, CV_8U, cv::Scalar(7))}};
  for (const auto& [name, image] : images) {
    view.image_path = Written(name, image);
    EXPECT_EQ(CheckImageAndMask(view, camera_).message(),
              LoadGrayImage(view, camera_).status().message());
    EXPECT_EQ(CheckImageAndMask(view, camera_).ok(), name[0] == 'a') << name;
  }
  for (const std::string start : {"", "hello", "GIF89a\x50", "....ftypheic"}) {
    view.image_path = Written("a.gif", Bytes(start.begin(), start.end()));
    EXPECT_FALSE(CheckImageAndMask(view, camera_).ok()) << start;
    EXPECT_EQ(CheckImageAndMask(view, camera_).message(),
              LoadGrayImage(view, camera_).status().message());
  }
  // No more than the header is looked at, and formats without one pass.
  for (const char* name : {"a.png", "a.jpg", "a.bmp", "a.pgm"}) {
    Bytes head = Contents(folder_.path() / name);
    head.resize(head.size() / 2);
    view.image_path = Written(std::string("cut_") + name, head);
    EXPECT_TRUE(CheckImageAndMask(view, camera_).ok()) << name;
  }
  view.image_path = Written("b.webp", Texture(CV_8UC3));
  EXPECT_TRUE(CheckImageAndMask(view, camera_).ok());
}

TEST_F(LoadGrayImageTest, ChecksHeadersOfEveryKindOfBmpAndPnm) {
  View view;
  // From the top row down: the height is below 0.
  Bytes bmp = Contents(Written("down.bmp", Texture(CV_8UC3)));
  for (const int at : {23, 24, 25}) bmp[static_cast<std::size_t>(at)] = '\xFF';
  for (const int height : {60, 59}) {
    bmp[22] = static_cast<char>(-height);
    view.image_path = Written("down.bmp", bmp);
    EXPECT_EQ(CheckImageAndMask(view, camera_).ok(), height == 60);
    EXPECT_EQ(CheckImageAndMask(view, camera_).message(),
              LoadGrayImage(view, camera_).status().message());
  }
  for (const auto& [text, is_right] :
       {std::pair("P5\n# 7 9\n80 60\n255\n", true),
        std::pair("P2 80\t# 7\n#\n60\n9\n", true),
        std::pair("P6 60\r\n80 255 ", false),
        std::pair("P5 x 80 60 ", false),
        std::pair("P5", false)}) {
    const std::string start = text;
    view.image_path = Written("a.pnm", Bytes(start.begin(), start.end()));
    EXPECT_EQ(ReadImageHeader(view.image_path).has_value() &&
                  CheckImageAndMask(view, camera_).ok(),
              is_right)
        << start;
  }
}

// 80 x 60 pixels, three channels of so many bits, which stand behind the
// directory.
Bytes TiffHeader(char bits) {
  return {'I', 'I', 42, 0, 8, 0, 0,  0, 3, 0, 0,    1, 3,    0, 1,    0, 0, 0,
          80,  0,   0,  0, 1, 1, 3,  0, 1, 0, 0,    0, 60,   0, 0,    0, 2, 1,
          3,   0,   3,  0, 0, 0, 46, 0, 0, 0, bits, 0, bits, 0, bits, 0};
}

TEST_F(LoadGrayImageTest, ChecksTheBitsOfColours) {
  View view;
  view.image_path = Written("short.tiff", TiffHeader(16));
  EXPECT_TRUE(CheckImageAndMask(view, camera_).ok());
  view.image_path = Written("float.tiff", TiffHeader(32));
  EXPECT_EQ(CheckImageAndMask(view, camera_).code(), StatusCode::kUnsupported);
}

TEST_F(LoadGrayImageTest, ChecksTheShapeOfMasks) {
  View view;
  view.image_path = Written("a.png", Texture(CV_8UC1));
  view.mask_path = Written("half.png", cv::Mat(30, 40, CV_8U, cv::Scalar(7)));
  EXPECT_TRUE(CheckImageAndMask(view, camera_).ok());
  view.mask_path = Written("flat.png", cv::Mat(20, 40, CV_8U, cv::Scalar(7)));
  EXPECT_EQ(CheckImageAndMask(view, camera_).message(),
            LoadMask(view, camera_).status().message());
  EXPECT_THAT(CheckImageAndMask(view, camera_).message(),
              HasSubstr("flat.png"));
}

}  // namespace
}  // namespace curvix
