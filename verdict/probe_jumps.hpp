#pragma once
// Probes that jumped while the rotor was levitated: what a law follows and no limit of one reading
// sees.
//
// Seen      a reading that moves in one cycle by more than a rotor can, a tenth of the clearance
//           and eight times the rms of the steps so far. The law then moves the rotor until the
//           reading is what it was, and where the rotor stands is no longer what the probe says.
// Judged    by the static current that the new place costs. The magnets' static force is the same
//           before and after, ki di + ks dx = 0, so that the probe has moved by
//             d = dy - dx = dy + ki di / ks
//           with dy and di the change of mean reading and mean current: kBeforeS before the step,
//           and as long after kSettleS. Where d is the step within kAgree, the probe jumped. A
//           reading that was wrong for some cycles leaves d near zero and is none.
// Touching  where the mean reading less the step lies beyond kInContact of the clearance instead,
//           the rotor lies in its touchdown bearing, which carries what the magnets do not.
// Model     ki and ks of the rig file at the centre, one axis by itself: probes are near their
//           magnets, and kAgree is wide.
// Not seen  probes that drift; jumps below the limit, or with less than kSettleS + kBeforeS to go;
//           rigs whose magnets have no negative stiffness.
// Units     SI, bearing frame. Thread: one; offline.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/record_frame.hpp"
#include "verdict/phase.hpp"

namespace levitas::verdict {

struct ProbeJump {
  std::string channel;
  double time_s{};     ///< since the first record
  double step_m{};     ///< of the reading
  double current_a{};  ///< change of the mean current
  double moved_m{};    ///< d, by the currents; where it touches, the step
  bool touches{};
};

class ProbeJumps {
 public:
  static constexpr double kBeforeS = 0.2;
  static constexpr double kSettleS = 0.4;
  static constexpr double kAgree = 0.4;      // [1] of the step
  static constexpr double kInContact = 0.9;  // [1] of the clearance

  /// `standstill_rad_per_s`, `settle_s`: as for SessionStatistics.
  ProbeJumps(const config::RigFile& rig, double standstill_rad_per_s, double settle_s);

  /// Call once per record, in order.
  void Add(const cycle::CycleRecord& record);
  /// By time.
  [[nodiscard]] const std::vector<ProbeJump>& Found() const noexcept { return found_; }

 private:
  struct Mean {
    double reading_m{}, current_a{};
    std::uint64_t cycles{};
  };
  /// A step whose cost is being measured.
  struct Pending {
    std::uint64_t cycle{};
    double from_m{}, step_m{};
    Mean before, after;
  };
  struct Axis {
    double ki_n_per_a{}, ks_n_per_m{}, clearance_m{};
    double last_m{}, square_m2{};
    std::uint64_t steps{};
    Mean earlier, recent;  ///< of the last full window, of the one that fills
    std::optional<Pending> pending;
  };

  void Forget() noexcept;
  void Look(Axis& axis, double reading_m, std::uint64_t cycle, bool follows);
  void Measure(Axis& axis, std::size_t at, double reading_m, double current_a, std::uint64_t cycle);
  [[nodiscard]] std::uint64_t Cycles(double time_s) const noexcept;

  session::RecordFrame frame_;
  std::vector<std::string> channels_;
  double period_s_;
  PhaseSplitter splitter_;
  std::vector<Axis> axes_;
  std::vector<ProbeJump> found_;
  std::uint64_t first_cycle_{}, last_cycle_{};
  bool judged_{false};  ///< the record before was
};

}  // namespace levitas::verdict
