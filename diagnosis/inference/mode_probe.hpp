#pragma once
// Additional starts for the frequency of a bending mode, out of reach of the derivatives.
//
// Why      a lightly damped mode many of its widths off the file's frequency rings where the model
//          has no response; derivatives about the file's frequency carry no information on it.
// Method   of the spectra of innovations at rest (else of all), the highest line within 15 % of
//          every mode, if it stands out of the noise.
// Thread   any; pure.

#include <cstddef>
#include <vector>

#include "diagnosis/inference/hypothesis.hpp"
#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

/// A hypothesis about one mode's frequency, and the value of its term to begin with.
struct ModeProbe {
  std::size_t hypothesis{}, term{};
  double theta{};
};

[[nodiscard]] std::vector<ModeProbe> ProbeModes(const RigView& rig, const std::vector<Term>& terms,
                                                const std::vector<Hypothesis>& hypotheses,
                                                const std::vector<Trajectory>& runs);

}  // namespace levitas::diagnosis
