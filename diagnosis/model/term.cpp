#include "diagnosis/model/term.hpp"

#include <utility>

namespace levitas::diagnosis {

Term MakeTerm(TermName name, double tolerance, double faulty_std, TermLaw drive) {
  Term term;
  term.effect = std::move(name.effect);
  term.place = std::move(name.place);
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
