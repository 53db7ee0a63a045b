#pragma once
// A block of synchronous control for a rig and its law: T over speed, and the speeds at which it
// may act.
//
// Table     T = inverse of the answer of the linear loop (analysis/synchronous_loop.hpp), at nine
//           speeds first; a speed is added wherever T between two of them lets an eigenvalue of T
//           times the answer leave the circle of kBetween about 1, up to kMostSpeeds.
// Knowledge of the rotor: T is that inverse. Of the bearings alone: T is bearing_phase.hpp's, at
//           speeds close enough for its straight lines; the rotor of the file is only judged with.
// Measured  T is the inverse of the answer that records give with the law (measured_plant.hpp), and
//           judged with them: the rig file, which may be wrong, is not asked. Its poles are shown.
// Direction forward keeps what turns with the rotor in the plane x + j y of each bearing, backward
//           what turns against it; both keeps all. T is projected, so that the rest never adapts.
// Growth    with target current the bearing no longer holds the rotor at this order: its orbit is
//           that of the law alone times T, at most times the largest singular value of T. Beyond
//           `most_growth` the speed is refused: the law carries the rotor through a critical speed
//           there (a notch in the feedback cannot cross it).
// Current   with target vibration the magnets give T times what the law alone leaves. More than the
//           block's largest_current_a for the rig file's unbalance (order 1) is refused, and so is
//           a condition number of T beyond kMostCondition: a node of the shaft lies between magnet
//           and sensor there, and no current moves what is read.
// Judged    at every speed of JudgedSpeeds with kJudged of them, on the file's rig and on each
//           drawn one: slowest decay above kLeastDecay of the file's rig and above 0 of the
//           drawn ones, and the poles of the whole sampled loop within the unit circle. A drawn
//           rig that its law does not hold without the block is counted apart and not held
//           against the block.
// Failure   BadInput when the law's axes do not fit the plant's, or the loop is not stable without
//           the block at a speed of the window (the speed is named).
// Thread    any; deterministic for the rigs given.
// Not done  running: the nonlinear rig is asked by tests and by `amb run`.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "controller/law/law_config.hpp"
#include "controller/synchronous/synchronous_config.hpp"
#include "design/notch/measured_plant.hpp"

namespace levitas::design {

inline constexpr double kBetween = 0.05;
inline constexpr double kLeastDecay = 0.2;
inline constexpr double kMostCondition = 30.0;
inline constexpr std::size_t kMostSpeeds = 64;
inline constexpr std::size_t kJudged = 41;

enum class Direction : std::uint8_t { kBoth, kForward, kBackward };
enum class Knowledge : std::uint8_t { kRotor, kBearings };

/// What is asked; `block.inverse` is empty.
struct NotchRequest {
  synchronous::BlockConfig block;
  Direction direction{Direction::kBoth};
  Knowledge knowledge{Knowledge::kRotor};
  double most_growth{4.0};
  std::vector<MeasuredPlant> measured;  ///< by rising speed; where there is one, T is of them
};

/// `request.block` with its table.
[[nodiscard]] synchronous::BlockConfig WithInverse(const configuration::RigFile& rig,
                                                   const law::LawConfig& law,
                                                   const NotchRequest& request);

struct SpeedFigures {
  double speed_rad_per_s{};
  double slowest_decay{};         ///< of the file's rig
  double worst_decay{};           ///< of all rigs
  double largest_pole_modulus{};  ///< of all rigs
  double growth{};                ///< of the orbit at most, of target current [1]
  double condition{};             ///< of the answer
  double orbit_m{};               ///< with the block, rig file's unbalance; 0: none or other order
  double orbit_alone_m{};         ///< with the law alone; some per cent off near a resonance
  double current_a{};             ///< largest amplitude of the block's current, the same
  std::string refused;            ///< why; empty: allowed
  [[nodiscard]] bool allowed() const noexcept { return refused.empty(); }
};

struct NotchFigures {
  std::vector<SpeedFigures> speeds;  ///< ascending
  std::size_t rigs{};                ///< judged beside the file's
  std::size_t not_held{};            ///< drawn rigs that the law alone does not hold somewhere
  double hysteresis_rad_per_s{};     ///< by which they reach beyond the window
  [[nodiscard]] bool allowed() const noexcept;
  /// "1200 to 1450 rpm (orbit grows 12-fold), 2100 rpm (...)"; empty when all are allowed.
  [[nodiscard]] std::string RefusedSpeeds() const;
  /// Windows to ask for instead, hysteresis off: "1000 to 1200 rpm, 2200 to 3900 rpm" of those
  /// judged; "nowhere" when none is.
  [[nodiscard]] std::string AllowedSpeeds() const;
};

/// Judges `request.block`, its table made, alone in the loop.
[[nodiscard]] NotchFigures JudgeNotch(const configuration::RigFile& rig,
                                      const std::vector<configuration::RigFile>& drawn,
                                      const law::LawConfig& law, const NotchRequest& request);

}  // namespace levitas::design
