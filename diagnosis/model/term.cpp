#include "diagnosis/model/term.hpp"

#include <utility>

namespace levitas::diagnosis {

Term MakeTerm(TermName name, double tolerance, double wide, Adds drive) {
  Term term;
  term.effect = std::move(name.effect);
  term.place = std::move(name.place);
  term.parameter = std::move(name.parameter);
  term.unit = std::move(name.unit);
  term.tolerance = tolerance;
  term.wide = wide;
  term.drive = std::move(drive);
  return term;
}

Term MakeReading(TermName name, double tolerance, double wide, Adds read) {
  Term term = MakeTerm(std::move(name), tolerance, wide, nullptr);
  term.read = std::move(read);
  return term;
}

}  // namespace levitas::diagnosis
