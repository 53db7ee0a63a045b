#pragma once
// What is computed from the files that a run carries in its header, and its pictures: |S| over
// frequency at the speeds of the verdict, modes and critical speeds of the levitated rotor.
//
// Speeds    those that the verdict graded: standing, the top speed, the worst between.
// Measured  peaks of test signals stand in the same picture as rings.
// Thread    any; offline. Failure: BadInput when the header's files cannot be read.

#include <vector>

#include "analysis/critical_speeds.hpp"
#include "report/rig/margins_picture.hpp"
#include "report/session/pictures.hpp"
#include "verdict/verdict.hpp"

namespace levitas::report {

struct RunModel {
  std::vector<LoopAtSpeed> loops;
  analysis::Campbell levitated;
  double rated_rad_per_s{};
  std::vector<std::string> channels;
};

[[nodiscard]] RunModel ModelOf(const session::SessionHeader& header,
                               const verdict::Verdict& verdict);

[[nodiscard]] std::vector<NamedPicture> ModelPictures(const RunModel& model,
                                                      const verdict::Verdict& verdict);

}  // namespace levitas::report
