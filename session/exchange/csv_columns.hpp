#pragma once
// The columns of a measured CSV file: which column holds what, by the names of its first line.
//
// Names     gap_<channel>_<m|mm|um> (distance from the coil towards +, instead of a position),
//           duty_towards_<channel>, duty_away_<channel> (0 to 1, instead of a control current),
//           coil_current_towards_<channel>_<a|ma>, coil_current_away_<channel>_<a|ma> (measured),
//           time_<s|ms|us>, rotor_angle_<rad|deg>, speed_<rpm|hz>, position_<channel>_<m|mm|um>,
//           control_current_<channel>_<a|ma>, excitation_<channel>_<a|ma> into the current and
//           excitation_<channel>_<m|mm|um> into the measured position; channels from the rig.
//           bias_current_<a|ma> where it is not the rig's.
// Needed    time_s; position (or gap) and control current (or duty) of every channel of the rig.
// Others    are ignored and listed, unless they look like a misspelt or misplaced name of the
//           above.
// Time      in proportion to the first line's length: at most kMostColumns names, of which the
//           first 100 characters are compared.
// Failure   BadInput listing every problem of the first line at once.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::session {

enum class CsvQuantity : std::uint8_t {
  kIgnored,
  kTime,
  kAngle,
  kSpeed,
  kPosition,
  kControlCurrent,
  kExcitation,
  kPositionExcitation,
  kGap,
  kDutyTowards,
  kDutyAway,
  kCoilTowards,
  kCoilAway,
  kBias,
};

struct CsvColumn {
  CsvQuantity quantity{CsvQuantity::kIgnored};
  std::size_t axis{};
  double divisor{1.0};  ///< a value of the file divided by this is in SI (or rpm)
  std::string name;
  double factor{1.0};  ///< of a map of columns: sign and scale
  double offset{0.0};  ///< of a map: what the file shows at zero
};

inline constexpr std::size_t kMostColumns = 10'000;

struct CsvLayout {
  char separator{','};
  std::vector<CsvColumn> columns;
  std::vector<std::string> ignored;
  [[nodiscard]] bool Has(CsvQuantity quantity) const noexcept;
};

/// Of a line of names or numbers: tab, semicolon, comma, or else blanks where there are any.
[[nodiscard]] char SeparatorOf(std::string_view line);

/// Whether a name begins as those of this contract do.
[[nodiscard]] bool IsNameOfOurs(std::string_view name);

/// The layout of columns with these names; `where` begins a message.
[[nodiscard]] CsvLayout ParseColumns(const std::vector<std::string>& names,
                                     const std::string& where,
                                     const std::vector<std::string>& channels);

/// Cells of a line, without blanks and quotes around them; ' ' parts cells however often it stands.
void SplitCsv(std::string_view line, char separator, std::vector<std::string_view>& cells);

}  // namespace levitas::session
