#pragma once
// Closed-loop free run beside a record: model of the rig and law of the session in one loop, moved
// by nothing but the recorded test signal, speed and angle of rotation. The rotor alone is
// unstable; in its loop a model that is nearly right stays near the record for ever.
//
// Equation  fit = 100 (1 - |y - y_model| / |y - mean y|)  in percent over the rows of a test signal
//           (NRMSE); 100: the same, 0: no better than the mean.
// Start     where each levitated interval with a test signal has its first: the loop has then run
//           for kSettleS at the recorded speed, with the angle that leads to the recorded one.
// Segment   from the first row of a test signal until other axes are excited, or to kTailS after
//           its last row.
// Model     nonlinear, without noise of the sensors and rounding of the converters.
// Frame     bearing frame; units SI. Thread any; offline.
// Failure   BadInput, one sentence: no test signal while levitated.
// Not done  supervisor, network and drop-outs: the reference is the centre throughout.

#include <optional>
#include <vector>

#include "analysis/records/innovations.hpp"
#include "controller/law/law_config.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::analysis {

inline constexpr double kSettleS = 3.0;
inline constexpr double kTailS = 0.1;

struct FreeRunSegment {
  session::RowRange rows;  ///< of the recording
  double speed_rad_per_s{};
  std::vector<std::size_t> excited;  ///< axes
  std::vector<double> fit_percent;   ///< per axis; NaN where the record does not move
};

struct FreeRun {
  std::vector<session::Column> model_m;  ///< per axis and row; NaN where nothing was simulated
  std::vector<FreeRunSegment> segments;
  std::vector<double> fit_percent;           ///< per axis, over all segments
  std::vector<double> one_step_fit_percent;  ///< of the observer, over the same rows
  bool finite{true};
};

/// Segments of test signals inside levitated intervals, in the order of the record.
[[nodiscard]] std::vector<FreeRunSegment> ExcitedSegments(const session::Recording& recording);

/// BadInput when there is none.
void RefuseUnexcited(const session::Recording& recording);

[[nodiscard]] FreeRun RunFree(const plant::PlantConfig& rig, const law::LawConfig& law,
                              const session::Recording& recording, const InnovationRun& one_step);

}  // namespace levitas::analysis
