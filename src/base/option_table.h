// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). One row per option: the command line, --help,
// validation, docs/options.md and report.json all come from this table.
#pragma once

#include <curvix/options.h>
#include <curvix/status.h>
#include <string>
#include <variant>
#include <vector>

#include "base/infinity.h"

namespace curvix {

struct OptionRow {
  std::string section = {};  // "Validation": of the project file; "": none
  std::string name;          // "min_num_support_views"
  std::variant<bool*, int*, double*, ViewSelection*, CurveKindSet*> field;
  double min = 0;                         // smallest value allowed
  double max = kInfinity;                 // largest value allowed
  bool min_is_excluded = false;           // "> min" instead of ">= min"
  std::vector<std::string> choices = {};  // of an enum, by value, or a set
  std::string unit = {};                  // "px", "deg", or ""
  std::string symbol = {};  // of the paper: "Delta gamma, Sec. 3", or ""
  std::string help;         // one line
};

// "Validation.min_num_support_views": the flag without --.
std::string FullName(const OptionRow& row);

// The rows in the order of Options; the pointers lead into `options`, which
// must outlive them.
std::vector<OptionRow> OptionTable(Options& options);

// The value of a row as text, and text into the row's field.
// kInvalidArgument: "Validation.max_angle_deg is -1; it must be > 0".
// A double is printed with the fewest digits that read back as it, a bool as 1
// or 0 (also read: true, false, yes, no, on, off), a set
// as "crease,boundary".
std::string ValueText(const OptionRow& row);
Status SetFromText(const OptionRow& row, const std::string& text);

// kInvalidArgument, as by SetFromText(), if the field is out of range.
Status CheckRange(const OptionRow& row);

// What a row allows: "> 0", ">= 0 and <= 1", "0 or 1", "a or b or c".
std::string RangeText(const OptionRow& row);

// kInvalidArgument, naming the field, its value and the range, if any is
// outside, or two that contradict each other.
Status Validate(const Options& options);

}  // namespace curvix
