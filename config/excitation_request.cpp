#include "config/excitation_request.hpp"

#include <fmt/format.h>

#include "config/schema/schema.hpp"
#include "config/text/reader.hpp"

namespace levitas::config {
namespace {

double MultisineTerms(const scenario::Excitation& excitation, const RigNumbers& rig) {
  if (excitation.kind != scenario::SignalKind::kMultisine) return 0.0;
  const double samples = excitation.repeat_s / rig.period_s();
  return samples * (excitation.to_hz - excitation.from_hz) * excitation.repeat_s;
}

void RefuseCostly(Visitor& v, const scenario::Step& step, const RigNumbers& rig) {
  v.RefuseIf(step.hold_s > kLongestHoldSeconds, "hold_s",
             fmt::format("found {:.6g} s, a request may last {:.6g} s at most", step.hold_s,
                         kLongestHoldSeconds));
  v.RefuseIf(step.excitation.empty(), "excitation", "no test signal is asked for");
  v.RefuseIf(step.excitation.size() > kMostSignals, "excitation",
             fmt::format("{} signals, a request may have {} at most", step.excitation.size(),
                         kMostSignals));
  for (const scenario::Excitation& excitation : step.excitation) {
    v.RefuseIf(MultisineTerms(excitation, rig) > kMostMultisineTerms, "excitation",
               fmt::format("a multisine of {:.6g} s from {:.6g} to {:.6g} Hz takes too long to "
                           "make; choose a shorter repeat_s or fewer frequencies",
                           excitation.repeat_s, excitation.from_hz, excitation.to_hz));
  }
}

}  // namespace

scenario::Step ParseExcitation(const std::string& text, const std::string& name,
                               const RigNumbers& rig) {
  const Document document = ReadDocument(text);
  Reader reader(document, name);
  scenario::Step step;
  if (reader.WrongKind("excitation")) {
    reader.FinishEarly();
  } else {
    DescribeExcitations(reader, step, rig);
    RefuseCostly(reader, step, rig);
    reader.Finish();
  }
  return step;
}

}  // namespace levitas::config
