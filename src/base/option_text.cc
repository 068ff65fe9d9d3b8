// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Values of the option table as text and back.
#include <optional>
#include <string_view>

#include "base/check.h"
#include "base/infinity.h"
#include "base/option_table.h"
#include "base/text_fields.h"

namespace curvix {
namespace {

std::optional<bool> ParseSwitch(const std::string& text) {
  for (const char* yes : {"1", "true", "yes", "on"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"0", "false", "no", "off"}) {
    if (text == no) return false;
  }
  return std::nullopt;
}

std::optional<int> ParseChoice(const OptionRow& row, std::string_view text) {
  for (std::size_t i = 0; i < row.choices.size(); ++i) {
    if (row.choices[i] == text) return static_cast<int>(i);
  }
  return std::nullopt;
}

// The value as a number: of an enum, its index; of a set, none.
struct Number {
  double operator()(const CurveKindSet*) const { return 0; }
  template <typename T>
  double operator()(const T* field) const {
    return static_cast<double>(*field);
  }
};
double NumberOf(const OptionRow& row) {
  return std::visit(Number(), row.field);
}

std::string SetText(const OptionRow& row, const CurveKindSet& kinds) {
  std::string text;
  for (const std::string& name : row.choices) {
    if (!kinds.Has(KindFromName(name).value())) continue;
    text += (text.empty() ? "" : ",") + name;
  }
  return text;
}

Status OutOfRange(const OptionRow& row, const std::string& text) {
  std::string what;
  if (std::holds_alternative<int*>(row.field) && !ParseNumber<int>(text)) {
    what = "a whole number ";
  } else if (std::holds_alternative<double*>(row.field) &&
             !ParseNumber<double>(text)) {
    what = "a number ";
  }
  return Status::InvalidArgument(FullName(row) + " is " + text +
                                 "; it must be " + what + RangeText(row));
}

// Also catches NaN.
bool IsInRange(const OptionRow& row, double value) {
  return value <= row.max &&
         (row.min_is_excluded ? value > row.min : value >= row.min);
}

bool HasAllKinds(const CurveKindSet& kinds) {
  for (int i = 0; i < kNumCurveKinds; ++i) {
    if (!kinds.Has(static_cast<CurveKind>(i))) return false;
  }
  return true;
}

// Text into a field; false if the text is none of the field's values.
struct FieldReader {
  const OptionRow& row;
  const std::string& text;

  bool operator()(bool* field) const {
    const std::optional<bool> value = ParseSwitch(text);
    if (value) *field = *value;
    return value.has_value();
  }
  bool operator()(int* field) const { return ReadNumber(field); }
  bool operator()(double* field) const { return ReadNumber(field); }
  bool operator()(CurveKindSet* field) const {
    // Where the kind is unknown, it is not another one.
    CurveKindSet kinds = CurveKindSet::None();
    kinds.Add(CurveKind::kUnknown);
    for (const std::string_view name : SplitAt(text, ',')) {
      const auto kind = KindFromName(name);
      if (!kind || !ParseChoice(row, name)) return false;
      kinds.Add(*kind);
    }
    *field = kinds;
    return true;
  }
  template <typename Enum>
  bool operator()(Enum* field) const {
    const std::optional<int> value = ParseChoice(row, text);
    if (value) *field = static_cast<Enum>(*value);
    return value.has_value();
  }

 private:
  template <typename T>
  bool ReadNumber(T* field) const {
    const std::optional<T> value = ParseNumber<T>(text);
    if (!value || !IsInRange(row, static_cast<double>(*value))) return false;
    *field = *value;
    return true;
  }
};

}  // namespace

std::string FullName(const OptionRow& row) {
  return row.section.empty() ? row.name : row.section + "." + row.name;
}

std::string ValueText(const OptionRow& row) {
  if (const auto* field = std::get_if<int*>(&row.field)) {
    return std::to_string(**field);
  }
  if (const auto* field = std::get_if<CurveKindSet*>(&row.field)) {
    return SetText(row, **field);
  }
  if (row.choices.empty()) return NumberText(NumberOf(row));
  const auto index = static_cast<std::size_t>(NumberOf(row));
  CURVIX_CHECK(index < row.choices.size(), FullName(row) << " has no name");
  return row.choices[index];
}

std::string RangeText(const OptionRow& row) {
  if (std::holds_alternative<bool*>(row.field)) return "0 or 1";
  if (std::holds_alternative<CurveKindSet*>(row.field)) {
    return "one or more of " + SetText(row, CurveKindSet());
  }
  if (!row.choices.empty()) {
    std::string text = row.choices.front();
    for (std::size_t i = 1; i < row.choices.size(); ++i) {
      text += (i + 1 == row.choices.size() ? " or " : ", ") + row.choices[i];
    }
    return text;
  }
  const std::string sign = row.min_is_excluded ? "> " : ">= ";
  std::string text = sign + NumberText(row.min);
  if (row.max < kInfinity) {
    text += " and <= " + NumberText(row.max);
  }
  return text;
}

Status SetFromText(const OptionRow& row, const std::string& text) {
  const bool is_read = std::visit(FieldReader{row, text}, row.field);
  return is_read ? Status() : OutOfRange(row, text.empty() ? "empty" : text);
}

Status CheckRange(const OptionRow& row) {
  if (IsInRange(row, NumberOf(row))) return {};
  return OutOfRange(row, NumberText(NumberOf(row)));
}

Status Validate(const Options& options) {
  Options copy = options;
  for (const OptionRow& row : OptionTable(copy)) {
    CURVIX_RETURN_IF_ERROR(CheckRange(row));
  }
  if (copy.hypotheses.min_ray_angle_deg > copy.hypotheses.max_ray_angle_deg) {
    return Status::InvalidArgument(
        "Hypotheses.min_ray_angle_deg is larger than "
        "Hypotheses.max_ray_angle_deg");
  }
  if (!copy.curve_kinds.enabled && !HasAllKinds(copy.curve_filter.kinds)) {
    return Status::InvalidArgument(
        "CurveFilter.kinds leaves out kinds of curves, which are not told "
        "apart; set CurveKinds.enabled to 1");
  }
  return {};
}

}  // namespace curvix
