#pragma once
// Derivatives of the model's state by several terms, advanced side by side over one period.
//
// Equation   sensitivity.hpp. Lane l of every number belongs to term l of the block.
// Precision  single: enough for derivatives (1e-5), and a vector register holds all lanes.
// Cost       about 40 ns per sample and term with AVX2, twice that without; chosen at start-up.
//            Both ways round alike: no contraction (cmake/Compiler.cmake).
// Thread     one state per thread; the model may be shared.

#include <array>
#include <vector>

#include "analysis/records/observer.hpp"
#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kLanes = 8;

/// One number of every term of a block.
struct alignas(kLanes * sizeof(float)) Lane {
  using Vector [[gnu::vector_size(kLanes * sizeof(float))]] = float;
  Vector value;
};

/// Numbers of the rig and its observer, in the order in which a period needs them.
struct TangentBatch {
  TangentBatch(const RigView& rig, const analysis::ObserverGain& gain, const LinearChange& change);

  struct Mode {
    float xx, xv, vx, vv, x0, v0;
    float half_xx, half_xv, half_vx, half_vv;
  };
  struct Axis {
    std::array<float, kMaxModes> actuator{};  ///< displacement in the magnet
    std::array<float, kMaxModes> drive{};     ///< what the magnet's force does to the modes
    std::array<float, kMaxModes> sensor{};
    std::array<float, kMaxModes> added_q{}, added_v{};  ///< to the reading, past the filter
    bool adds{};                                        ///< any of them
    float coil_decay{}, coil_mean{};
    float coil_lead{};  ///< [s^2] displacement by which a decaying current is ahead of its mean
    float sensor_decay{}, sensor_start{}, sensor_end{};
  };
  std::size_t axes{}, modes{};
  std::vector<float> correct_q, correct_v;                         ///< [state][axis]
  std::vector<float> correct_coil, correct_sensor, correct_force;  ///< [axis][axis]
  std::vector<Mode> mode;
  std::vector<Axis> axis;
  std::vector<float> turning;    ///< gyroscopic moments' own directions, [direction][mode]
  std::vector<float> turn_rate;  ///< [s] a quarter of the angle of a period, per speed
  /// Geared shafts: modal accelerations per displacement and velocity, [row][column] over the modes
  /// of both planes. Empty for one rotor.
  std::vector<float> coupled_q, coupled_v;
};

struct LaneState {
  std::array<Lane, 2 * kMaxModes> q{}, v{};
  std::array<Lane, kMaxAxes> coil{}, sensor{}, force{};
  // Contributions of the terms over the period; consumed by Advance.
  std::array<Lane, 2 * kMaxModes> add_modal{};
  std::array<Lane, kMaxAxes> add_force{}, add_coil_end{}, add_coil_mean{};
};

/// Derivatives of the readings.
void Reading(const TangentBatch& model, const SamplePoint& moment, const LaneState& state,
             std::array<Lane, kMaxAxes>& reading) noexcept;
/// x += K e for the derivatives `e` of the innovations.
void Correct(const TangentBatch& model, const std::array<Lane, kMaxAxes>& e,
             LaneState& state) noexcept;
/// One period about the model's own motion; clears what was added.
void Advance(const TangentBatch& model, const SamplePoint& moment, LaneState& state) noexcept;

}  // namespace levitas::diagnosis
