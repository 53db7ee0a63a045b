#pragma once
// Answers made by hand, as if a diagnosis had found them.

#include <memory>
#include <vector>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {

/// An answer without a cause: the model explains data that can tell all.
inline DiagnosisResult NothingFound() {
  DiagnosisResult s;
  s.view = std::make_shared<const RigView>(FlexibleRotor().numbers, FlexibleRotor().plant);
  s.terms = AllTerms(*s.view, Tolerances{}, 50e-6);
  s.answer.calibrated = PointAt(s.terms, std::vector<double>(s.terms.size(), 0.0));
  s.answer.extended = s.answer.calibrated;
  s.answer.residual.channels.resize(s.view->axes);
  s.fastest_rad_per_s = 300.0;
  s.excited = true;
  return s;
}

/// The effect at that place, every term of it with `share` of its usual size.
inline DiagnosisResult Found(effect::Id effect, const std::string& place, double share = 0.5) {
  DiagnosisResult s = NothingFound();
  s.answer.verdict = Verdict::kEffect;
  for (const Hypothesis& h : MakeHypotheses(*s.view, s.terms)) {
    if (h.effect != effect || h.place != place) continue;
    s.answer.causes = {h};
    for (const std::size_t t : h.terms) {
      const double scale = s.terms[t].scale();
      s.answer.extended.theta[t] = share * scale;
      s.answer.parameters.push_back({t, share * scale, 0.05 * scale});
    }
    s.answer.candidates.push_back({.effect = effect, .place = place, .score = 20.0});
    return s;
  }
  throw std::runtime_error("no hypothesis " + std::string(effect::At(effect).name) + " at " +
                           place);
}

}  // namespace levitas::diagnosis
