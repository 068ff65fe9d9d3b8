// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/npy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <bit>
#include <limits>

#include "base/file_io.h"
#include "tests/plugin/import_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::initializer_list<int> kSixNumbers = {0, 1, 2, 10, 11, 12};

template <typename T>
std::string Bytes(std::endian order) {
  std::string all;
  for (const int number : kSixNumbers) {
    std::string bytes;
    AppendLittleEndian(static_cast<T>(number), bytes);
    if (order == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    all += bytes;
  }
  return all;
}

TEST(Npy, ReadsBothPrecisionsAndByteOrders) {
  const std::pair<std::string, std::string> kinds[] = {
      {"'<f4'", Bytes<float>(std::endian::little)},
      {"'>f4'", Bytes<float>(std::endian::big)},
      {"'<f8'", Bytes<double>(std::endian::little)},
      {"'>f8'", Bytes<double>(std::endian::big)}};
  for (const auto& [descr, values] : kinds) {
    const auto array = ParseNpy(NpyFile(descr, "False", "(2, 3)", values), "a");
    ASSERT_TRUE(array.ok()) << array.status().message();
    EXPECT_THAT(array->shape, ElementsAre(2, 3));
    EXPECT_THAT(array->values, ElementsAre(0, 1, 2, 10, 11, 12)) << descr;
  }
}

TEST(Npy, TurnsFortranOrderIntoCOrder) {
  const std::string values = Bytes<double>(std::endian::little);
  const auto array = ParseNpy(NpyFile("'<f8'", "True", "(3, 2)", values), "a");
  ASSERT_TRUE(array.ok()) << array.status().message();
  EXPECT_THAT(array->values, ElementsAre(0, 10, 1, 11, 2, 12));
}

TEST(Npy, ReadsVersionsShapesAndPython2) {
  const std::string values = Bytes<float>(std::endian::little);
  for (const char version : {'\1', '\2', '\3'}) {
    for (const char* shape : {"(6,)", "(3L, 2L)", "(1, 2, 3)"}) {
      const std::string file =
          NpyFile("'<f4'", "False", shape, values, version);
      EXPECT_TRUE(ParseNpy(file, "a").ok()) << shape << int{version};
    }
  }
  const std::string one = values.substr(0, 4);
  EXPECT_TRUE(ParseNpy(NpyFile("'<f4'", "False", "()", one), "a").ok());
  const auto none = ParseNpy(NpyFile("'<f4'", "False", "(0, 4)", ""), "a");
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(none->values.empty());
}

TEST(Npy, RefusesEveryTruncation) {
  const std::string file = NpyOfMatrix(Eigen::Matrix4d::Identity());
  ASSERT_TRUE(ParseNpy(file, "a").ok());
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_EQ(ParseNpy(file.substr(0, size), "a").status().code(),
              StatusCode::kDataLoss)
        << size;
  }
}

TEST(Npy, RefusesShapesThatDoNotFitTheBytes) {
  for (const char* shape : {"(18446744073709551615,)",
                            "(4294967296, 4294967296, 2)",
                            "(1000000000, 1000000000)",
                            "(99999999999999999999999,)",
                            "(-1, -6)",
                            "(2, 2)",
                            "(2, x)",
                            "2, 3",
                            "(2, 3"}) {
    const auto array = ParseNpy(
        NpyFile("'<f8'", "False", shape, Bytes<double>(std::endian::little)),
        "world_mat_0");
    EXPECT_EQ(array.status().code(), StatusCode::kDataLoss) << shape;
    EXPECT_THAT(array.status().message(), HasSubstr("world_mat_0"));
  }
}

TEST(Npy, NamesTheTypeThatItDoesNotRead) {
  for (const char* descr : {"'<i8'", "'|O'", "'<c16'", "'f8'", "''"}) {
    const auto array =
        ParseNpy(NpyFile(descr, "False", "(1,)", "12345678"), "a");
    EXPECT_EQ(array.status().code(), StatusCode::kUnsupported) << descr;
  }
  const auto records =
      ParseNpy(NpyFile("[('x', '<f8')]", "False", "(1,)", "12345678"), "a");
  EXPECT_THAT(records.status().message(), HasSubstr("records"));
}

TEST(Npy, GivesMatricesOfTheRightShapeOnly) {
  const auto array = ParseNpy(NpyOfMatrix(Eigen::MatrixXd::Ones(4, 3)), "a");
  ASSERT_TRUE(array.ok());
  EXPECT_TRUE(MatrixFromNpy(*array, 4, 3, "a").ok());
  EXPECT_FALSE(MatrixFromNpy(*array, 3, 4, "a").ok());
  Eigen::MatrixXd hole = Eigen::MatrixXd::Ones(2, 2);
  hole(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(MatrixFromNpy(*ParseNpy(NpyOfMatrix(hole), "a"), 2, 2, "b")
                  .status()
                  .message(),
              HasSubstr("NaN"));
}

const auto kAll = [](const std::string&) { return true; };

TEST(Npz, UnpacksWhatIsWanted) {
  const TemporaryFolder folder;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(4, 4);
  const auto path = folder.path() / "a.npz";
  WriteNpz(path, {{"one", NpyOfMatrix(matrix)}, {"other", "no array"}});
  const auto arrays =
      ReadNpz(path, [](const std::string& name) { return name == "one"; });
  ASSERT_TRUE(arrays.ok()) << arrays.status().message();
  ASSERT_EQ(arrays->size(), 1u);
  EXPECT_EQ(*MatrixFromNpy(arrays->at("one"), 4, 4, "one"), matrix);
  EXPECT_EQ(ReadNpz(path, kAll).status().code(), StatusCode::kDataLoss);
}

TEST(Npz, RefusesEveryTruncationAndSurvivesEveryFlippedByte) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.npz";
  WriteNpz(path, {{"one", NpyOfMatrix(Eigen::Matrix4d::Identity())}});
  const std::string file = *ReadFile(path);
  for (std::size_t size = 0; size < file.size(); ++size) {
    folder.Write("cut.npz", file.substr(0, size));
    EXPECT_FALSE(ReadNpz(folder.path() / "cut.npz", kAll).ok()) << size;
  }
  for (std::size_t i = 0; i < file.size(); ++i) {
    std::string flipped = file;
    flipped[i] = static_cast<char>(~flipped[i]);
    folder.Write("flipped.npz", flipped);
    const auto arrays = ReadNpz(folder.path() / "flipped.npz", kAll);
    if (!arrays.ok() || !arrays->contains("one")) continue;
    EXPECT_EQ(*MatrixFromNpy(arrays->at("one"), 4, 4, "one"),
              Eigen::MatrixXd(Eigen::Matrix4d::Identity()));
  }
}

TEST(Npz, DoesNotUnpackBombs) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "bomb.npz";
  WriteNpz(path, {{"one", std::string(4 << 20, '\0')}});
  EXPECT_LT(std::filesystem::file_size(path), 10000u);
  EXPECT_THAT(ReadNpz(path, kAll).status().message(), HasSubstr("megabyte"));
}

}  // namespace
}  // namespace curvix
