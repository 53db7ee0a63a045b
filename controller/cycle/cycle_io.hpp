#pragma once
// Inputs and outputs of one control cycle: all that a replay needs, as plain data.

#include <array>
#include <cstdint>

#include "common/axes.hpp"
#include "common/enums.hpp"
#include "common/frames.hpp"
#include "controller/synchronous/block_status.hpp"

namespace levitas::cycle {

/// What the operator (person, script or scenario) asks for in this cycle.
struct OperatorInput {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};          ///< with kSpin: set point
  double acceleration_rad_per_s2{};  ///< with kSpin: rate
  AxisArray excitation_a{};          ///< [A] added to the law's current before the limit
  AxisArray excitation_m{};          ///< [m] added to what the law reads, nothing else sees it
};

struct CycleInputs {
  std::uint64_t cycle{};  ///< the controller's own count, consecutive
  bool frame_present{};   ///< a new sensor frame is there; else `frame` is the last one
  SensorFrame frame;
  std::uint32_t missed_deadlines{};  ///< periods skipped since the previous cycle
  OperatorInput op;
  /// [A] as measured, of the coil towards + and the coil away of each axis; the law never reads
  /// them. `coils` entries are valid: none on a rig that does not measure them.
  std::array<double, 2 * kMaxAxes> coil_current_a{};
  std::uint32_t coils{};
};

struct CycleOutputs {
  CurrentFrame current;
  AxisArray reference_m{};         ///< [m] bearing frame
  std::uint16_t saturated_axes{};  ///< bit i: axis i was limited in this cycle
  Mode mode{Mode::kOff};
  Fault fault{Fault::kNone};  ///< latched until reset
  std::int8_t fault_axis{-1};
  double fault_value{};    ///< SI, what was measured when it tripped
  double fault_limit{};    ///< SI, what was allowed
  bool command_refused{};  ///< the mode table does not allow the command of this cycle
  /// What synchronous control does; in memory only, a session holds it as events.
  std::array<synchronous::BlockStatus, synchronous::kMaxBlocks> synchronous{};
  std::uint8_t synchronous_blocks{};
  /// Which of the laws that change places over speed acts, counted from rest; in memory only too.
  std::uint8_t acting_law{};
};

/// One line of the session file: inputs first.
struct CycleRecord {
  CycleInputs in;
  CycleOutputs out;
};

}  // namespace levitas::cycle
