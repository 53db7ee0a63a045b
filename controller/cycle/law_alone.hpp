#pragma once
// The law of a controller without its supervisor, on data that know no modes and no commands.
//
// Start    the filters are empty at the first sample; the caller leaves the first cycles out.
// Reference  the centre. NaN readings and cycles without a frame hold the last current.
// Thread   any; pure as the law itself.
// Failure  std::invalid_argument for configurations that a control cycle would refuse as well.

#include "common/probe_map.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/law/running_law.hpp"

namespace levitas::cycle {

class LawAlone {
 public:
  explicit LawAlone(const CycleConfig& config);

  /// Outputs with the currents and energised coils; the mode is left off.
  [[nodiscard]] CycleOutputs Step(const CycleInputs& in) noexcept;

 private:
  std::size_t axes_;
  double limit_a_;
  ProbeMap probes_;
  law::RunningLaw law_;
  bool started_{};
  law::LawOutput given_;
};

}  // namespace levitas::cycle
