// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/ground_truth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <system_error>

#include "base/file_io.h"
#include "base/line_reader.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

// The numbers of one line, with blanks or commas between, comments removed;
// nothing if a word is not a finite number.
std::optional<std::vector<double>> ParseRow(std::string_view line) {
  std::string words(line.substr(0, line.find('#')));
  std::ranges::replace(words, ',', ' ');
  std::vector<double> row;
  for (WordReader reader(words); !reader.AtEnd();) {
    row.push_back(reader.Number<double>());
    if (reader.failed() || !std::isfinite(row.back())) return std::nullopt;
  }
  return row;
}

int ToInt(double value) {
  return static_cast<int>(std::clamp(value, -2e9, 2e9));
}

// Whether a row may have so many numbers.
bool IsColumnCount(std::size_t count) {
  return count == 3 || (count >= 6 && count <= 10);
}

bool HasKnownKind(const std::vector<double>& row) {
  return row.size() < 10 || (row[9] >= 0 && row[9] < kNumCurveKinds &&
                             row[9] == std::floor(row[9]));
}

TrueSample MakeSample(const std::vector<double>& row) {
  TrueSample sample;
  sample.position = Eigen::Vector3d::Map(row.data());
  if (row.size() >= 6) {
    sample.tangent = Eigen::Vector3d::Map(row.data() + 3);
  }
  if (row.size() >= 7) sample.curve_id = ToInt(row[6]);
  if (row.size() >= 8) {
    sample.num_views_seen = ToInt(row[7]);
    sample.num_views_edge = ToInt(row[row.size() >= 9 ? 8 : 7]);
  }
  if (row.size() >= 10) sample.kind = static_cast<CurveKind>(ToInt(row[9]));
  return sample;
}

Status Broken(std::size_t line_number) {
  return Status::DataLoss("line " + std::to_string(line_number) +
                          " is not \"x y z [tx ty tz [curve_id [views_seen "
                          "[views_edge [kind]]]]]\", the kind from 0 to 4, "
                          "with as many numbers as the rows before it");
}

// Of a/gt.txt: a/gt_class.txt.
std::filesystem::path ClassPath(std::filesystem::path path) {
  const std::filesystem::path extension = path.extension();
  path.replace_extension();
  path += "_class";
  path += extension;
  return path;
}

}  // namespace

Result<GroundTruth> ParseGroundTruth(std::string_view text) {
  GroundTruth truth;
  std::size_t num_columns = 0;
  text = WithoutByteOrderMark(text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto row = ParseRow(TakeLine(text));
    if (!row) return Broken(number);
    if (row->empty()) continue;
    if (num_columns == 0) num_columns = row->size();
    if (row->size() != num_columns || !IsColumnCount(num_columns) ||
        !HasKnownKind(*row)) {
      return Broken(number);
    }
    truth.samples.push_back(MakeSample(*row));
  }
  if (truth.samples.empty()) {
    return Status::DataLoss("there is no ground-truth sample");
  }
  truth.has_tangents = num_columns >= 6;
  truth.has_curve_ids = num_columns >= 7;
  truth.has_views = num_columns >= 8;
  truth.has_kinds = num_columns >= 10;
  return truth;
}

Status ParseCurveKinds(std::string_view text, GroundTruth& truth) {
  std::map<int, CurveKind> kinds;
  text = WithoutByteOrderMark(text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = TakeLine(text);
    line = line.substr(0, line.find('#'));
    const std::string_view id = TakeWord(line);
    if (id.empty()) continue;
    const std::optional<int> curve_id = ParseNumber<int>(id);
    const std::string_view kind = TakeWord(line);
    if (!curve_id || kind.empty()) {
      return Status::DataLoss("line " + std::to_string(number) +
                              " is not \"curve_id kind\"");
    }
    kinds[*curve_id] = KindFromName(kind).value_or(CurveKind::kUnknown);
  }
  if (!truth.has_curve_ids) {
    return Status::DataLoss("the ground truth has no curve ids");
  }
  for (TrueSample& sample : truth.samples) {
    const auto kind = kinds.find(sample.curve_id);
    if (kind != kinds.end()) sample.kind = kind->second;
  }
  truth.has_kinds = true;
  return {};
}

Result<GroundTruth> ReadGroundTruth(const std::filesystem::path& path) {
  CURVIX_ASSIGN_OR_RETURN(const std::string text, ReadFile(path));
  Result<GroundTruth> truth = ParseGroundTruth(text);
  if (!truth.ok()) return InFile(path, truth.status());
  const std::filesystem::path class_path = ClassPath(path);
  std::error_code error;
  if (truth->has_kinds || !std::filesystem::exists(class_path, error)) {
    return truth;
  }
  CURVIX_ASSIGN_OR_RETURN(const std::string classes, ReadFile(class_path));
  const Status status = ParseCurveKinds(classes, *truth);
  if (!status.ok()) return InFile(class_path, status);
  return truth;
}

}  // namespace curvix
