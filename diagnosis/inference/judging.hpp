#pragma once
// The numbers that decide which answer a diagnosis gives, each with its source.
//
// Row      name, unit, meaning, how the value was found, how to find it again, and when.
// Sweep    `amb bench diagnosis --sweep NAME=V,V,...` runs the same trials with each value and
//          prints what is right, missed and falsely named; `--constants` prints this table.
// Not here numbers that only steer the minimiser (steps, passes, convergence): they change how long
//          a search takes; those that follow from the statistics of noise: their formula is beside
//          them (residual.cpp, mains_lines.cpp).
// Thread   any; constants.

#include <array>
#include <string>
#include <string_view>

namespace levitas::diagnosis {

struct Judging {
  double decisive_nat{5.0};
  double form_share{0.02};
  double near_nat{15.0};
  double exchange_share{0.4};
  double far_beyond{3.0};
  double unexplained_sigma{15.0};
  double explained_share{0.7};
  double stands_out_sigma{30.0};
  double nearly_all_share{0.95};
  double harm_nat{10.0};
  double gain_deviations{1.645};
  double moved_tolerances{3.0};
  double model_error_share{0.01};
  double number_chance{0.05};
  double suspected_nat{25.0};
};

struct JudgingRow {
  std::string_view name;
  double Judging::*value;
  std::string_view unit;
  std::string_view meaning;
  std::string_view source;  ///< how the value was found, and when
  std::string_view again;   ///< arguments of `amb bench diagnosis` that find it again
};

/// In the order of the members.
[[nodiscard]] const std::array<JudgingRow, 15>& JudgingTable();

/// The row of a name; BadInput lists the names.
[[nodiscard]] const JudgingRow& FindJudging(std::string_view name);

/// docs/diagnosis_results.md.
[[nodiscard]] std::string JudgingMarkdown();

/// [nat] The first row's value, for whoever reads scores: odds of 150 : 1.
inline constexpr double kDecisive = Judging{}.decisive_nat;

}  // namespace levitas::diagnosis
