// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/importers.h"

#include <array>
#include <string_view>

#include "base/count_text.h"
#include "base/file_io.h"
#include "base/line_reader.h"
#include "base/text_fields.h"
#include "colmap/files.h"
#include "plugin/imports/projection_matrix.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status BrokenMiddlebury(const fs::path& file,
                        int line,
                        const std::string& why) {
  return Status::DataLoss(file.string() + ", line " + std::to_string(line) +
                          " " + why + "; download it again.");
}

// `line` counts from 1.
Result<CalibratedImage> ParseParLine(std::string_view text,
                                     const fs::path& file,
                                     int line) {
  using Matrix3dRowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  WordReader words(text);
  CalibratedImage result;
  result.name = words.Word();
  result.source = result.name;
  std::array<double, 21> numbers;
  for (double& number : numbers) number = words.Number<double>();
  if (words.failed()) {
    return BrokenMiddlebury(file, line, "does not hold 21 numbers");
  }
  if (!words.AtEnd()) {
    return BrokenMiddlebury(file, line, "holds more than 21 numbers");
  }
  result.pose.calibration = Eigen::Map<const Matrix3dRowMajor>(numbers.data());
  const auto rotation =
      RotationFromMatrix(Eigen::Map<const Matrix3dRowMajor>(&numbers[9]));
  if (!rotation) {
    return BrokenMiddlebury(file, line, "holds no rotation matrix");
  }
  result.pose.cam_from_world = {
      *rotation, Eigen::Map<const Eigen::Vector3d>(&numbers[18])};
  return result;
}

// The lines after the first, which counts them.
Result<std::vector<CalibratedImage>> ParsePar(std::string_view text,
                                              const fs::path& file) {
  std::string_view first = TakeLine(text);
  const auto count = ParseNumber<int>(TakeWord(first));
  if (!count || *count < 1) {
    return BrokenMiddlebury(file, 1, "is not the number of images");
  }
  std::vector<CalibratedImage> lines;
  for (int number = 2; !text.empty(); ++number) {
    const std::string_view line = TakeLine(text);
    std::string_view rest = line;
    if (TakeWord(rest).empty()) continue;
    CURVIX_ASSIGN_OR_RETURN(CalibratedImage parsed,
                            ParseParLine(line, file, number));
    lines.push_back(std::move(parsed));
  }
  if (lines.size() != static_cast<std::size_t>(*count)) {
    return BrokenMiddlebury(file,
                            1,
                            "announces " + Plural(*count, "image") +
                                ", and there " +
                                OneOrMore(lines.size(), "is ", "are ") +
                                std::to_string(lines.size()));
  }
  return lines;
}

}  // namespace

Result<ImportedScene> ImportMiddlebury(const ImportOptions& options) {
  fs::path file = options.input_path;
  if (IsFolder(file)) {
    CURVIX_ASSIGN_OR_RETURN(file, OnlyFile(file, "", "_par.txt"));
  }
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(file));
  CURVIX_ASSIGN_OR_RETURN(const std::vector<CalibratedImage> lines,
                          ParsePar(WithoutByteOrderMark(text), file));
  std::vector<std::string> names;
  for (const CalibratedImage& line : lines) {
    CURVIX_RETURN_IF_ERROR(CheckImageName(line.name, file));
    names.push_back(line.name);
  }
  const fs::path base = file.parent_path();
  CURVIX_ASSIGN_OR_RETURN(
      const fs::path folder,
      FindImageFolder(
          options.image_path, {base, base / "images"}, names.front()));
  CURVIX_RETURN_IF_ERROR(CheckImagesExist(names, folder));
  return SceneOfImages(lines, folder, options.first_pixel.value_or(0), file);
}

}  // namespace curvix
