#pragma once
// What an export of a session holds: names of its columns, and the numbers of a row.
//
// Columns   time_s, rotor_angle_rad, speed_rpm, then per channel position [m], control current and
//           excitation [A], an injection into the measured position [m] when the scenario asks for
//           one, the bias current [A] when the controller lowers it, torque [N m] and twist [rad]
//           of couplings where the rig measures them (nan where their batch was lost), and the mode
//           as its number (docs/formats.md).
// Time      of the sample. In real time it starts at 0; when the rig restarts it runs on.
// Selection rows by their time and by counting, columns by their names. Rows are left out as they
//           are: no filter keeps what is above half the new rate from folding down.
// Thread    one. Failure: Problem(kUsage) for a selection that is empty or names what is not there.

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"
#include "session/log/torsion_recording.hpp"

namespace levitas::session {

class SessionReader;

/// Which rows and columns are exported; as it stands, all of them.
struct ExportSelection {
  double from_s{-std::numeric_limits<double>::infinity()};  ///< of column time_s, this one included
  double to_s{std::numeric_limits<double>::infinity()};     ///< this one included
  std::uint64_t every{1};  ///< one row of so many, beginning with the first within the times
  std::vector<std::string> columns{};  ///< behind time_s, in this order; empty: all
};

struct ExportReport {
  std::uint64_t rows{};
  std::uint64_t cycles_without_frame{};
};

class ExportRows {
 public:
  /// Torsion is exported as `torsion` has it, which may be empty.
  explicit ExportRows(const SessionHeader& header, const ExportSelection& selection = {},
                      TorsionRecording torsion = {});

  /// The time is the first.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }

  /// The time [ns] of a record with a sensor frame; `values` becomes what stands behind it, empty
  /// for a row that was not asked for. Call in order.
  std::int64_t Next(const cycle::CycleRecord& record, std::vector<double>& values);

  using Take = std::function<void(std::int64_t time_ns, const std::vector<double>& values)>;
  /// The rest of `reader`, row by row.
  ExportReport ForEach(SessionReader& reader, const Take& take);

 private:
  void Choose(const ExportSelection& selection);
  [[nodiscard]] bool AskedFor(std::int64_t time_ns);
  std::int64_t TimeOf(const cycle::CycleInputs& in);

  std::vector<std::string> names_;
  std::vector<std::size_t> chosen_;  ///< of all values
  std::size_t axes_;
  bool injects_position_;
  bool lowers_bias_;
  TorsionRecording torsion_;
  std::int64_t from_ns_, to_ns_;
  std::uint64_t every_;
  std::uint64_t within_{};  ///< rows within the times so far
  std::vector<double> all_;
  std::uint64_t period_ns_;
  bool from_zero_;
  bool started_{false};
  std::uint32_t rig_session_{};
  std::uint64_t cycle_{};
  std::uint64_t time_ns_{};
  std::uint64_t offset_ns_{};
};

}  // namespace levitas::session
