#pragma once
// Figures of one recorded run, gathered cycle by cycle: orbits and currents per bearing and phase,
// orbit over speed, modes, trips, what the loop missed.
//
// Orbit      radius r = sqrt(x^2 + y^2) at the sensor plane in the bearing frame, counted from the
//            centre of the clearance: a constant offset is part of it, as it is part of the danger.
//            rms = sqrt(mean(r^2)). Sensor noise is in the readings and so in the figures.
// Current    commanded control current, excitation included, in the bearing frame: mean (static
//            load), rms about the mean, largest magnitude.
// Units      SI. Frame: bearing frame, as session/log/record_frame.hpp gives it.
// Thread     one; offline, allocates.
// Failure    std::invalid_argument for a rig whose polarity is neither +1 nor -1. A cycle without a
//            new sensor frame counts as missing and is left out of the orbit; readings that are not
//            finite make the largest radius infinite.
// Not done   no judgement (see verdict.hpp), no spectra.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "common/rotational_speed.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/log/record_frame.hpp"
#include "verdict/phase.hpp"

namespace levitas::verdict {

struct OrbitFigures {
  double max_m{};                     ///< largest radius
  double max_speed_rad_per_s{};       ///< speed at which it was seen
  double max_time_s{};                ///< when it was seen, since the first record
  double rms_m{};                     ///< root of the mean square radius
  double offset_x_m{}, offset_y_m{};  ///< mean position
};

struct CurrentFigures {
  double mean_a{};           ///< static part
  double dynamic_rms_a{};    ///< rms about the mean
  double peak_a{};           ///< largest magnitude
  double saturated_share{};  ///< [1] of the cycles the axis was limited
};

struct BearingFigures {
  std::string name;
  OrbitFigures orbit;
  std::array<CurrentFigures, 2> current;  ///< x, y
};

struct PhaseFigures {
  std::uint64_t cycles{};
  double duration_s{};
  double saturated_share{};  ///< [1] of the cycles with any axis limited
  std::vector<BearingFigures> bearings;
  double mean_bias_a{};  ///< as commanded
  /// [1] mean of b^2 + ic^2 over all axes, which is half the square of both coil currents, over
  /// that of the rig's bias alone: what copper turns into heat.
  double copper_share{};
};

/// Largest orbit per bearing while the speed was within one bin of kProfileBinRadPerS.
struct ProfileBin {
  double speed_rad_per_s{};  ///< middle of the bin
  std::uint64_t cycles{};
  std::vector<double> max_m;
};

struct TripFigures {
  Fault fault{Fault::kNone};
  int axis{-1};
  double value{}, limit{};  ///< SI
  double time_s{};
  Mode mode_before{Mode::kOff};
  double speed_rad_per_s{};
};

/// The amplifiers went off while the rotor turned, on purpose or not.
struct ReleaseFigures {
  double time_s{};
  double speed_rad_per_s{};  ///< magnitude, shown by two frames
};

/// A rotor that turns does not stop within this time, so a speed read this long after the
/// amplifiers went off shows that it turned then, whatever the one frame said on which they did.
inline constexpr double kReleaseWindowS = 0.05;

struct ModeSpan {
  Mode mode{};
  double start_s{};
  double duration_s{};
};

struct SessionFigures {
  std::uint64_t cycles{};              ///< records seen
  double duration_s{};                 ///< from the first to the last record, one period included
  double top_speed_rad_per_s{};        ///< of all records
  double levitated_speed_rad_per_s{};  ///< largest shown by two frames in a row while spinning
  double standstill_rad_per_s{};       ///< the controller's
  PhaseFigures standing, spinning;
  std::vector<ProfileBin>
      profile;  ///< spinning only, by rising speed, bins without cycles left out
  std::vector<ModeSpan> modes;
  std::optional<TripFigures> trip;        ///< the first one
  std::uint64_t trips{};                  ///< faults latched
  std::optional<ReleaseFigures> release;  ///< the first one at speed
  std::uint64_t missing_frames{};         ///< cycles that had no new sensor frame
  std::uint64_t skipped_periods{};        ///< periods in which no cycle was started
  std::uint64_t held_currents{};          ///< periods in which the rig reused an old current
  std::uint64_t missing_records{};        ///< gaps in the cycle numbers
};

inline constexpr double kProfileBinRadPerS = RpmToRadPerS(50.0);

class SessionStatistics {
 public:
  /// `settle_s`: what is left out after each lift (phase.hpp).
  SessionStatistics(const RigNumbers& rig, double standstill_rad_per_s, double settle_s);

  /// Call once per record, in order.
  void Add(const cycle::CycleRecord& record);
  [[nodiscard]] SessionFigures Figures() const;

 private:
  struct AxisSums {
    double sum_a{}, square_a2{}, peak_a{};
    std::uint64_t saturated{};
  };
  struct BearingSums {
    OrbitFigures worst;
    double sum_x_m{}, sum_y_m{}, square_m2{};
    std::array<AxisSums, 2> axis;
  };
  struct PhaseSums {
    std::uint64_t cycles{}, orbit_cycles{}, saturated{};
    std::vector<BearingSums> bearings;
    double bias_a{}, bias_square_a2{};
  };

  void AddSpeed(double speed_rad_per_s);
  void AddOrbit(const cycle::CycleRecord& record, PhaseSums& sums, bool spinning);
  void AddCurrents(const cycle::CycleRecord& record, PhaseSums& sums) const;
  void AddMode(const cycle::CycleRecord& record);
  void AddLosses(const cycle::CycleRecord& record);
  void AddRelease(const cycle::CycleRecord& record);
  [[nodiscard]] double TimeOf(const cycle::CycleRecord& record) const;
  [[nodiscard]] PhaseFigures Summary(const PhaseSums& sums) const;

  RigNumbers rig_;
  session::RecordFrame frame_;
  PhaseSplitter splitter_;
  PhaseSums standing_, spinning_;
  std::vector<ProfileBin> profile_;
  SessionFigures figures_;
  std::uint64_t first_cycle_{}, previous_cycle_{};
  std::uint32_t previous_held_{}, rig_session_{};
  Fault previous_fault_{Fault::kNone};
  double standstill_rad_per_s_;
  double previous_spinning_rad_per_s_{};  ///< of the frame before, 0 where it was not spinning
  bool energised_{false};
  double last_speed_rad_per_s_{};
  std::optional<ReleaseFigures> letting_go_;  ///< amplifiers just off, its window not yet over
  bool first_frame_{true};
};

}  // namespace levitas::verdict
