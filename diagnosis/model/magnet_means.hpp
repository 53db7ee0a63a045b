#pragma once
// Coil currents and magnet forces of one period of the model, as means over it.
//
// Why      a current that follows noisy commands moves by tenths of the bias within a period, and
//          the force goes with its square: the force of the mean current is not the mean force, and
//          a delay, which shows in their difference, would look like another stiffness.
// Method   the current relaxes exponentially towards its command; the mean of a force that is
//          quadratic in it is that of the two currents a standard deviation off the mean.
// Units    SI, bearing frame. Thread: one object per model run.

#include <array>

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/model/sample_point.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

class MagnetMeans {
 public:
  explicit MagnetMeans(const RigView& rig);

  /// Fills currents, displacements, forces and their slopes of a moment whose coil_start_a,
  /// coil_end_a (without what is added), command_now_a and q are known.
  void Fill(double bias_a, const Contribution& add, SamplePoint& m);

  /// [N] by what terms add to the current of an axis, at the last Fill.
  [[nodiscard]] double OfAddedCurrent(std::size_t axis) const { return added_n_[axis]; }

 private:
  const RigView& rig_;
  std::array<double, kMaxAxes> relaxing_{};  ///< mean over a period of what decays from 1
  std::array<double, kMaxAxes> added_n_{};
};

}  // namespace levitas::diagnosis
