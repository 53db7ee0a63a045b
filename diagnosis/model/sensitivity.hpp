#pragma once
// Derivatives of the innovations by every term, along the run of the model.
//
// Equation   dx[n+1] = A(n) (dx[n] + d(K e[n])) + E dd[n] + B da,  de[n] = -(C dx[n] + dr): the
//            model linearised about its own trajectory: true slopes of the magnet force at every
//            sample, gyroscopic coupling at the speed of the sample, exact modal steps, and what
//            the terms in force at theta change of these (linear_change.hpp). What a term adds
//            (da, dr) is its addition at theta + h minus that at theta, over h; for linear terms
//            that at 1. dK: what a term changes of the scales by which the gain is divided
//            (observer_scale.hpp).
// Cost       tangent_batch.hpp, and what the terms themselves cost.
// Thread     one instance per thread.

#include <memory>
#include <vector>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/observer_scale.hpp"
#include "diagnosis/model/tangent_batch.hpp"

namespace levitas::diagnosis {

/// The rig with each of the observer's gains.
struct LaneModels {
  LaneModels(const RigView& rig, const ObserverGains& gains, const LinearChange& change)
      : start(std::make_shared<const TangentBatch>(rig, *gains.start, change)) {
    for (const GainStage& stage : gains.stages) {
      stages.push_back(std::make_shared<const TangentBatch>(rig, *stage.gain, change));
    }
  }
  [[nodiscard]] const TangentBatch& At(const SamplePoint& m) const {
    return m.starting ? *start : *stages[m.stage];
  }
  std::shared_ptr<const TangentBatch> start;
  std::vector<std::shared_ptr<const TangentBatch>> stages;
};

/// A block of up to kLanes terms propagated together.
class SensitivityBlock {
 public:
  SensitivityBlock(const RigView& rig, LaneModels models, const std::vector<Term>& terms,
                   const std::vector<double>& theta, std::vector<std::size_t> chosen);

  /// Advances one sample; writes de/dtheta [axis][lane] in metres per Term::scale().
  void Step(const SamplePoint& moment, float* derivative_m) noexcept;
  [[nodiscard]] const std::vector<std::size_t>& chosen() const noexcept { return chosen_; }

 private:
  /// An active term whose contribution depends on a coil delay or bandwidth that another one moves.
  struct Retimed {
    Term now, stepped;
    double theta{};
  };

  /// Contribution of one term with and without the step.
  struct Probe {
    Term now, stepped;
    double theta{}, step{}, scale{};
    bool linear{};
    std::vector<Retimed> retimed{};
    float late_periods{};  ///< with the step
    AxisFloats coil_rate{};
  };

  /// A term that changes scales by which the gain is divided: relative change per Term::scale().
  struct Rescaled {
    std::size_t lane{};
    AxisFloats readings{};
    ModalFloats modes{};
  };

  void AddRescaled(const RigView& rig, const std::vector<Term>& terms,
                   const std::vector<double>& theta, std::size_t chosen);
  void CorrectModes(const TangentBatch& model, const Rescaled& rescaled,
                    const SamplePoint& m) noexcept;
  static void AddRetimed(const std::vector<Term>& terms, const std::vector<double>& theta,
                         std::size_t chosen, Probe& probe);
  void Read(const SamplePoint& m, float* derivative_m) noexcept;
  void Drive(const SamplePoint& m) noexcept;
  void DriveRetimed(Probe& probe, std::size_t lane, const SamplePoint& m) noexcept;
  /// The probe's difference in `difference_`; the scale to apply, 0 when nothing was added.
  template <class Call>
  float Difference(Probe& probe, Call call) noexcept;
  void Clear() noexcept;

  LaneModels models_;
  std::shared_ptr<const TangentBatch> model_;  ///< any of them, for what does not depend on a gain
  std::vector<std::size_t> chosen_;
  std::vector<Probe> probes_;
  std::vector<Rescaled> rescaled_;
  LaneState state_;
  std::array<Lane, kMaxAxes> reading_{};  ///< of the sample that comes
  Contribution difference_, base_;
};

}  // namespace levitas::diagnosis
