#include "diagnosis/levitator/build_report.hpp"

#include <string>

#include "diagnosis/levitator/causes.hpp"
#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/words.hpp"

namespace levitas::levitator {
namespace {

std::string PlaceOf(const LevitatorResult& result) {
  if (result.found.causes.empty()) return diagnosis::PlaceOf(result.common);
  const Cause& first = Causes()[result.found.causes.front()];
  return std::string(Table()[first.moves.front()].place);
}

}  // namespace

diagnosis::DiagnosisReport BuildReport(const LevitatorResult& result) {
  return diagnosis::BuildReport(result.common, PlaceOf(result));
}

}  // namespace levitas::levitator
