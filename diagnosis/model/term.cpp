#include "diagnosis/model/term.hpp"

#include <utility>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {

std::string_view Term::effect_name() const {
  return effect ? effect::At(*effect).name : std::string_view{};
}

Term MakeTerm(TermName name, double tolerance, double faulty_std, TermLaw drive) {
  Term term;
  term.effect = name.effect;
  term.location = std::move(name.location);
  term.parameter = std::move(name.parameter);
  term.unit = std::move(name.unit);
  term.tolerance = tolerance;
  term.faulty_std = faulty_std;
  term.drive = std::move(drive);
  return term;
}

Term MakeReading(TermName name, double tolerance, double faulty_std, TermLaw read) {
  Term term = MakeTerm(std::move(name), tolerance, faulty_std, nullptr);
  term.read = std::move(read);
  return term;
}

}  // namespace levitas::diagnosis
