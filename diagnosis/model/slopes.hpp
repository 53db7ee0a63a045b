#pragma once
// Derivatives of the innovations by many terms, kept sample by sample, and the sums over them from
// which every hypothesis is judged: J^T J, J^T e, e^T e of the whitened innovations.
//
// Kept       unwhitened: one linearisation serves a whole fit (chord method, Ortega & Rheinboldt
//            1970, 7.1). A further step then costs a run of the model and one pass over memory
//            instead of the propagation of every term.
// Precision  derivatives single, sums double: sums of single precision lose more than a unit of
//            evidence where terms explain 1e8 of them, and are then no longer positive definite.
// Memory     4 bytes x rows x axes x terms: 160 MB for 53 000 rows of four axes and 185 terms.
// Thread     blocks the caller, every processor inside; results do not depend on their timing.

#include <Eigen/Core>
#include <vector>

#include "diagnosis/model/normal_equations.hpp"

namespace levitas::diagnosis {

class Slopes {
 public:
  /// `runs` are the model's runs at `theta`. Terms outside `chosen` have slopes of zero.
  Slopes(const RigView& rig, const std::vector<Trajectory>& runs, const std::vector<Term>& terms,
         const std::vector<double>& theta, const std::vector<std::size_t>& chosen);

  /// With the innovations of `runs`, which are of the same records but may be of another theta.
  [[nodiscard]] NormalEquations Sum(const std::vector<Trajectory>& runs,
                                    const Whitener& whitener) const;
  /// J^T e and e^T e anew; J^T J stays: for the whitener of the sum that is changed.
  void Renew(const std::vector<Trajectory>& runs, const Whitener& whitener,
             NormalEquations& sum) const;

 private:
  /// One record's: column by term, row by axis and sample.
  struct Part {
    std::vector<std::size_t> acting;  ///< terms, of all
    Eigen::MatrixXf slope;
  };

  std::size_t axes_;
  std::size_t terms_;
  std::vector<Part> parts_;
};

}  // namespace levitas::diagnosis
