#include "configuration/excitation_request.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "configuration/schema/schema.hpp"
#include "configuration/text/reader.hpp"

namespace levitas::configuration {
namespace {

// Steps of work that the table takes: each line adds to each sample, and each sample costs two
// cosines of its own, even where there is one line only. The other signals are made while they are
// played.
double TableTerms(const scenario::Excitation& excitation, const RigNumbers& rig) {
  if (excitation.kind != scenario::SignalKind::kMultisine) return 0.0;
  const double samples = excitation.repeat_s / rig.period_s();
  const double band_hz = std::max(0.0, excitation.to_hz - excitation.from_hz);
  return samples * (band_hz * excitation.repeat_s + kTermsPerSample);
}

void RefuseCostly(Visitor& v, const scenario::Step& step, const RigNumbers& rig) {
  v.RefuseIf(step.hold_s > kLongestHoldSeconds, "hold_s",
             fmt::format("found {:.6g} s, a request may last {:.6g} s at most", step.hold_s,
                         kLongestHoldSeconds));
  v.RefuseIf(step.excitation.empty(), "excitation", "no test signal is asked for");
  v.RefuseIf(step.excitation.size() > kMostSignals, "excitation",
             fmt::format("{} signals, a request may have {} at most", step.excitation.size(),
                         kMostSignals));
  double terms = 0.0;
  for (const scenario::Excitation& excitation : step.excitation) {
    terms += TableTerms(excitation, rig);
  }
  v.RefuseIf(
      terms > kMostTableTerms, "excitation",
      fmt::format("its multisines together take {:.3g} steps to make (lines times samples of "
                  "a period), a request may take {:.3g}: choose a shorter repeat_s, fewer "
                  "frequencies or fewer multisines",
                  terms, kMostTableTerms));
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

}  // namespace levitas::configuration
