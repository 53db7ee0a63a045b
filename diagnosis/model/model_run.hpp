#pragma once
// The nonlinear model driven through a record: plant, observer and the terms in force.
//
// Equation   analysis/records/observer.hpp, with what the terms add (term.hpp).
// Lost       up to 20 frames in a row are bridged with the current held and no correction; so are
//            frames that repeat more often than by chance (repeated_frames.hpp). They do not count.
// Validation  every sixth stretch of 50 ms when the record asks for it: run and corrected like all
//            others, but `held` instead of `counts`, so that what is measured there was not fitted
//            and every excitation and speed is in both parts.
// Start      after a (re)start the modes swing as nobody knows, and a slow observer takes half a
//            second to learn it: a fast one does so first, its forces left at zero, since static
//            forces are for the parameters to explain. From there on the gain falls as the Kalman
//            filter's does (analysis::DesignSettling): what the fast one does not know would
//            otherwise pass for a static force that the parameters lack.
// Settling   the first `settling_s` after every (re)start are run and do not count.
// Cost       2 to 3 us per sample. Thread: any; one call per thread.

#include <memory>
#include <string>
#include <vector>

#include "analysis/records/innovations.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

struct Record {
  std::string name;
  std::vector<analysis::RecordedRow> rows;
  double mean_speed_rad_per_s{};
  std::uint32_t number{};   ///< within its diagnosis
  bool keeps_validation{};  ///< part of it is not to be fitted
  /// [s] of the rows as their file has them, until errors of the record have been looked for.
  std::vector<double> times_s;
};

/// A gain from one row after the start phase on, until the next one's.
struct GainStage {
  std::uint64_t from_row{};
  std::shared_ptr<const analysis::ObserverGain> gain;
};

/// Gains for one record.
struct ObserverGains {
  std::shared_ptr<const analysis::ObserverGain> start;
  std::vector<GainStage> stages;  ///< after the start; the last one is stationary

  [[nodiscard]] const analysis::ObserverGain& steady() const { return *stages.back().gain; }
};

struct Trajectory {
  std::vector<SamplePoint> moments;
  ObserverGains gains;  ///< as used: divided by the model's scales (observer_scale.hpp)
};

/// `theta` has one value per term. Terms at 0 cost nothing.
[[nodiscard]] Trajectory RunModel(const RigView& rig, const Record& record,
                                  const ObserverGains& gains, const std::vector<Term>& terms,
                                  const std::vector<double>& theta, double settling_s);

}  // namespace levitas::diagnosis
