#pragma once
// Probes that jumped while the rotor was levitated: what a law follows and no limit of one reading
// sees.
//
// Seen      a reading that moves in one cycle by more than a rotor can, a tenth of the clearance
//           and kOfSteps times the rms of the steps so far. The law then moves the rotor until the
//           reading is what it was, and where the rotor stands is no longer what the probe says.
//           Steps that follow one another are summed; a reading that steps back was wrong for a
//           while, and is no jump.
// Judged    by the currents that the new place costs. At rest the rotor moves by P di, with P the
//           plant from the currents to the places at the sensors at frequency zero and di the
//           change of all mean currents, so that the probe has moved by
//             d = dy - (P di)_axis
//           with dy the change of the mean reading: kBeforeS before the step, and as long after
//           kSettleS. Where d is the step within kAgree, the probe jumped. On a free rotor with
//           magnets of negative stiffness P is -ki/ks of an axis, with springs far less.
// Broken off  a step after which the rotor did not stay levitated for as long as that takes: the
//           law's answer to it may have tripped a protection. It is told apart, unjudged.
// Touching  where the rotor would stand beyond kInContact of the clearance by its reading less the
//           step, it lies in its touchdown bearing, which carries what the magnets do not.
// Model     P of the rig file about its centre at standstill: kAgree is wide for that.
// Not seen  probes that drift; jumps below the limit; what lasts less than kSettleS + kBeforeS, or
//           begins less than kBeforeS after the settling time; a load that comes within that time
//           of a jump, or of a reading that is wrong for good.
// Units     SI, bearing frame. Thread: one; offline, allocates when made.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/log/record_frame.hpp"
#include "verdict/phase.hpp"

namespace levitas::verdict {

struct ProbeJump {
  std::string channel;
  double time_s{};                ///< of the first step, since the first record
  double step_m{};                ///< of the reading
  double current_a{};             ///< change of the axis' mean current
  std::optional<double> moved_m;  ///< d, by the currents; empty: the rotor touches
  bool returns{};                 ///< takes back the jumps of this probe that were found before
};

class ProbeJumps {
 public:
  static constexpr double kBeforeS = 0.2;
  static constexpr double kSettleS = 0.4;
  static constexpr double kAgree = 0.4;      // [1] of the step
  static constexpr double kInContact = 0.9;  // [1] of the clearance
  static constexpr double kOfSteps = 8.0;    // chosen: normal noise reaches it once in 1e15 cycles

  /// `standstill_rad_per_s`, `settle_s`: as for SessionStatistics.
  ProbeJumps(const configuration::RigFile& rig, double standstill_rad_per_s, double settle_s);

  /// Call once per record, in order.
  void Add(const cycle::CycleRecord& record);
  /// By the time at which they were found.
  [[nodiscard]] const std::vector<ProbeJump>& Found() const noexcept { return found_; }
  /// Steps that were broken off; their currents are 0.
  [[nodiscard]] const std::vector<ProbeJump>& BrokenOff() const noexcept { return broken_off_; }

 private:
  struct Mean {
    double reading_m{};
    AxisArray current_a{};
    std::uint64_t cycles{};
  };
  /// Steps whose cost is being measured.
  struct Pending {
    std::uint64_t first{}, last{};  ///< cycles of the first and of the last step
    double step_m{};
    Mean before, after;
  };
  struct Axis {
    double limit_m{}, clearance_m{};
    double last_m{}, square_m2{};
    std::uint64_t steps{};
    Mean earlier, recent;  ///< of the last full window, of the one that fills
    std::optional<Pending> pending;
    double jumped_m{};  ///< sum of what was found
  };

  void BreakOff(std::size_t axis);
  void Forget() noexcept;
  void AddStep(Axis& axis, double reading_m, std::uint64_t cycle);
  void AddMeans(std::size_t axis, double reading_m, const AxisArray& current_a,
                std::uint64_t cycle);
  void Judge(std::size_t axis);
  void Average(Mean& mean, double reading_m, const AxisArray& current_a) const noexcept;
  [[nodiscard]] std::uint64_t Cycles(double time_s) const noexcept;

  session::RecordFrame frame_;
  std::vector<std::string> channels_;
  double period_s_;
  PhaseSplitter splitter_;
  Eigen::MatrixXd place_per_current_m_per_a_;  ///< P
  std::vector<Axis> axes_;
  std::vector<ProbeJump> found_, broken_off_;
  std::optional<std::uint64_t> first_cycle_, previous_;  ///< of all, of one with readings
};

}  // namespace levitas::verdict
