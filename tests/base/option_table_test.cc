// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/option_table.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace curvix {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Converts to anything, so that Aggregate{Any, Any, ...} compiles as long as
// there are no more of them than fields.
struct Any {
  template <typename T>
  operator T() const;  // NOLINT: implicit
};

template <std::size_t>
using AnyAt = Any;

template <typename Aggregate, std::size_t... kIndexes>
constexpr bool HasFields(std::index_sequence<kIndexes...>) {
  return requires { Aggregate{AnyAt<kIndexes>{}...}; };
}

// The number of fields of a struct.
template <typename Aggregate, std::size_t kCount = 0>
constexpr std::size_t NumFields() {
  if constexpr (!HasFields<Aggregate>(std::make_index_sequence<kCount + 1>())) {
    return kCount;
  } else {
    return NumFields<Aggregate, kCount + 1>();
  }
}

template <typename... Structs>
constexpr std::size_t NumFieldsOf(const Structs&...) {
  return (NumFields<Structs>() + ...);
}

const OptionRow& Find(const std::vector<OptionRow>& rows,
                      std::string_view name) {
  for (const OptionRow& row : rows) {
    if (FullName(row) == name) return row;
  }
  throw std::runtime_error("no row " + std::string(name));
}

const void* Address(const OptionRow& row) {
  return std::visit([](const auto* field) -> const void* { return field; },
                    row.field);
}

TEST(OptionTable, HasOneRowForEveryField) {
  Options options;
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] =
      options;  // every struct of Options
  const auto rows = OptionTable(options);
  EXPECT_EQ(rows.size(), NumFieldsOf(a, b, c, d, e, f, g, h, i, j, k, l, m))
      << "options.h and option_table.cc do not list the same fields";

  std::set<const void*> fields;
  std::set<std::string> names;
  for (const OptionRow& row : rows) {
    EXPECT_TRUE(fields.insert(Address(row)).second) << FullName(row);
    EXPECT_TRUE(names.insert(FullName(row)).second) << FullName(row);
  }
}

TEST(OptionTable, RowsFollowTheOrderOfTheFields) {
  Options options;
  const void* previous = nullptr;
  for (const OptionRow& row : OptionTable(options)) {
    EXPECT_LT(previous, Address(row)) << FullName(row);
    previous = Address(row);
  }
}

TEST(OptionTable, EveryRowExplainsItself) {
  Options options;
  for (const OptionRow& row : OptionTable(options)) {
    EXPECT_THAT(row.help, testing::SizeIs(testing::Gt(9u))) << FullName(row);
    EXPECT_EQ(row.help.find('\n'), std::string::npos) << FullName(row);
    EXPECT_NE(row.help.back(), '.') << FullName(row);
    EXPECT_FALSE(RangeText(row).empty()) << FullName(row);
    const bool is_degrees = row.name.ends_with("_deg");
    EXPECT_EQ(is_degrees, row.unit == "deg") << FullName(row);
    EXPECT_EQ(row.name.ends_with("_px"), row.unit == "px") << FullName(row);
  }
}

TEST(OptionTable, DefaultsAndPaperValuesAreValid) {
  EXPECT_EQ(Validate(Options()).message(), "");
  EXPECT_EQ(Validate(PaperOptions()).message(), "");
}

TEST(OptionTable, TextOfAValueReadsBackAsTheValue) {
  Options paper = PaperOptions();
  Options options;
  const auto from = OptionTable(paper);
  const auto to = OptionTable(options);
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(SetFromText(to[i], ValueText(from[i])).message(), "");
    EXPECT_EQ(ValueText(to[i]), ValueText(from[i])) << from[i].name;
  }
}

TEST(OptionTable, PrintsTheShortestNumberThatReadsBack) {
  Options options;
  options.hypotheses.location_tolerance_px = 0.1 + 0.2;
  const auto rows = OptionTable(options);
  const OptionRow& row = Find(rows, "Hypotheses.location_tolerance_px");
  EXPECT_EQ(ValueText(row), "0.30000000000000004");
  ASSERT_TRUE(SetFromText(row, "0.3").ok());
  EXPECT_EQ(ValueText(row), "0.3");
}

TEST(OptionTable, ReadsAndPrintsSets) {
  Options options;
  const auto rows = OptionTable(options);
  const OptionRow& row = Find(rows, "CurveFilter.kinds");
  EXPECT_EQ(ValueText(row), "crease,boundary,marking,occluding_contour");
  ASSERT_TRUE(SetFromText(row, "marking,crease").ok());
  EXPECT_EQ(ValueText(row), "crease,marking");
  EXPECT_TRUE(options.curve_filter.kinds.Has(CurveKind::kMarking));
  EXPECT_FALSE(options.curve_filter.kinds.Has(CurveKind::kBoundary));
  EXPECT_TRUE(options.curve_filter.kinds.Has(CurveKind::kUnknown));
  for (const char* wrong : {"", ",", "crease,", "creases", "unknown"}) {
    EXPECT_THAT(SetFromText(row, wrong).message(), HasSubstr("one or more of"));
    EXPECT_EQ(ValueText(row), "crease,marking");
  }
}

TEST(OptionTable, PrintsIntegersInFull) {
  Options options;
  options.hypotheses.num_partners = 1000000;
  const auto rows = OptionTable(options);
  EXPECT_EQ(ValueText(Find(rows, "Hypotheses.num_partners")), "1000000");
}

TEST(OptionTable, RefusesWhatIsOutsideTheRangeAndKeepsTheValue) {
  Options options;
  for (const OptionRow& row : OptionTable(options)) {
    const std::string before = ValueText(row);
    for (const char* text :
         {"", " ", "abc", "nan", "1e999", "-7", "99999999999999999999", "1x"}) {
      const bool is_open_above = std::isinf(row.max);
      if (is_open_above && std::string(text).starts_with("9999")) continue;
      const Status status = SetFromText(row, text);
      EXPECT_EQ(status.code(), StatusCode::kInvalidArgument)
          << FullName(row) << " = " << text;
      EXPECT_THAT(status.message(), HasSubstr(FullName(row)));
      EXPECT_EQ(ValueText(row), before);
    }
  }
}

TEST(OptionTable, LimitsAreInclusiveUnlessExcluded) {
  Options options;
  const auto rows = OptionTable(options);
  const OptionRow& share = Find(rows, "Hypotheses.used_edges_to_stop");
  EXPECT_TRUE(SetFromText(share, "0").ok());
  EXPECT_TRUE(SetFromText(share, "1").ok());
  EXPECT_FALSE(SetFromText(share, "1.0001").ok());
  const OptionRow& step = Find(rows, "Alignment.step_size");
  EXPECT_FALSE(SetFromText(step, "0").ok());
  EXPECT_TRUE(SetFromText(step, "1").ok());
  EXPECT_EQ(RangeText(step), "> 0 and <= 1");
}

TEST(OptionTable, DistancesAtWhichAllIsComparedWithAllAreRefused) {
  Options options;
  const auto rows = OptionTable(options);
  for (const char* name :
       {"Connectivity.max_gap_px", "Connectivity.max_duplicate_distance_px"}) {
    EXPECT_TRUE(SetFromText(Find(rows, name), "20").ok()) << name;
    EXPECT_FALSE(SetFromText(Find(rows, name), "51").ok()) << name;
  }
}

TEST(OptionTable, ErrorsNameTheFieldItsValueAndTheRange) {
  Options options;
  const auto rows = OptionTable(options);
  EXPECT_THAT(
      SetFromText(Find(rows, "Validation.max_angle_deg"), "-1").message(),
      AllOf(HasSubstr("Validation.max_angle_deg is -1"),
            HasSubstr("it must be > 0")));
  EXPECT_EQ(
      SetFromText(Find(rows, "Hypotheses.view_selection"), "all").message(),
      "Hypotheses.view_selection is all; it must be unused_edges or "
      "every_view");

  for (const char* text : {"1.5", "two", "1e3"}) {
    EXPECT_EQ(SetFromText(Find(rows, "num_threads"), text).message(),
              std::string("num_threads is ") + text +
                  "; it must be a whole number >= -1 and <= 4096");
  }
  EXPECT_EQ(SetFromText(Find(rows, "num_threads"), "-2").message(),
            "num_threads is -2; it must be >= -1 and <= 4096");
  const OptionRow& sigma = Find(rows, "EdgeDetection.sigma_px");
  for (const char* text : {"1,5", "one"}) {
    EXPECT_EQ(SetFromText(sigma, text).message(),
              std::string("EdgeDetection.sigma_px is ") + text +
                  "; it must be a number >= 0.3 and <= 10");
  }

  options.validation.max_angle_deg = std::numeric_limits<double>::quiet_NaN();
  const Status status = Validate(options);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(status.message(), HasSubstr("Validation.max_angle_deg is nan"));
}

TEST(OptionTable, RefusesAnEmptyRangeOfRayAngles) {
  Options options;
  options.hypotheses.min_ray_angle_deg = 60;
  options.hypotheses.max_ray_angle_deg = 50;
  EXPECT_EQ(Validate(options).code(), StatusCode::kInvalidArgument);
}

TEST(OptionTable, RefusesAFilterOfKindsThatAreNotToldApart) {
  Options options;
  options.curve_filter.kinds = CurveKindSet::None();
  options.curve_filter.kinds.Add(CurveKind::kCrease);
  EXPECT_TRUE(Validate(options).ok());
  options.curve_kinds.enabled = false;
  EXPECT_THAT(Validate(options).message(),
              AllOf(HasSubstr("CurveFilter.kinds"),
                    HasSubstr("CurveKinds.enabled to 1")));
}

TEST(OptionTable, ReadsSwitchesInEveryUsualSpelling) {
  Options options;
  const auto rows = OptionTable(options);
  const OptionRow& row = Find(rows, "CurveRefinement.enabled");
  for (const char* no : {"0", "false", "no", "off"}) {
    options.curve_refinement.enabled = true;
    EXPECT_TRUE(SetFromText(row, no).ok());
    EXPECT_FALSE(options.curve_refinement.enabled) << no;
  }
  for (const char* yes : {"1", "true", "yes", "on"}) {
    options.curve_refinement.enabled = false;
    EXPECT_TRUE(SetFromText(row, yes).ok());
    EXPECT_TRUE(options.curve_refinement.enabled) << yes;
  }
}

}  // namespace
}  // namespace curvix
