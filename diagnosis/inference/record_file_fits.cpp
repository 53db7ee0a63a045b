#include "diagnosis/inference/record_file_fits.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kFewRows = 18'000;
constexpr std::size_t kJointRows = 30'000;
constexpr int kHeldPasses = 12;
constexpr int kFreePasses = 12;

Point WithCauseAt(Point at, const std::vector<double>& seen, const Hypothesis& cause,
                  double times) {
  for (const std::size_t i : cause.terms) at.theta[i] += times * (seen[i] - at.theta[i]);
  return at;
}

}  // namespace

RecordFileFits::RecordFileFits(const Search& search, const std::vector<Term>& terms,
                               const std::vector<Record>& records)
    : search_(search),
      held_(HeldToFile(terms)),
      cautious_(SearchHeldBy(held_, search)),
      few_(Spans(records, kFewRows, search.rig().period_s)),
      part_(Spans(records, kJointRows, search.rig().period_s)),
      fast_few_(cautious_.DesignGains(few_, kFast)),
      fast_(cautious_.DesignGains(part_, kFast)),
      coarse_(cautious_, held_, few_, fast_few_, search.rig().axes),
      fine_(cautious_, held_, part_, fast_, search.rig().axes),
      free_(search, terms, part_, fast_, search.rig().axes) {}

JointFit RecordFileFits::Free(const Point& held, const std::vector<Hypothesis>& causes) const {
  JointFit made{causes, held, free_.Approach(held, kWhiteningOrder, kFreePasses, causes)};
  if (made.free.ok) made.cost = free_.Misfit(made.free.point, kWhiteningOrder, causes);
  return made;
}

JointFit RecordFileFits::Anew() const {
  const Point file = cautious_.HealthyPoint();
  const Refined coarse = coarse_.Approach(file, kWhiteningOrder, kHeldPasses);
  const Refined held =
      fine_.Approach(coarse.ok ? coarse.point : file, kWhiteningOrder, kHeldPasses);
  return Free(held.ok ? held.point : file, {});
}

View RecordFileFits::LineariseAt(const Point& held) const {
  return cautious_.Linearise(few_, fast_few_, held, kWhiteningOrder, cautious_.Everything());
}

std::vector<Candidate> RecordFileFits::Screened(const View& view, const JointFit& base) const {
  return Screen(Evidence(view.problem, held_, base.causes), search_.hypotheses());
}

JointStart RecordFileFits::Begin(const View& view, const JointFit& base,
                                 const Hypothesis& cause) const {
  constexpr double kAlike = 1.0;  // [nat]
  JointStart begun{base.causes, {}};
  begun.causes.push_back(cause);
  const std::vector<double> seen = cautious_.Solve(view.problem, begun.causes);
  double first = begun.cost;
  for (const double times : {0.0, 4.0, 1.0, 2.0}) {
    Refined fit = coarse_.Approach(WithCauseAt(base.held, seen, cause, times), kWhiteningOrder,
                                   kHeldPasses, begun.causes);
    const double cost = fit.ok ? coarse_.Misfit(fit.point, kWhiteningOrder, begun.causes)
                               : std::numeric_limits<double>::infinity();
    if (cost < begun.cost) {
      begun.cost = cost;
      begun.held = std::move(fit.point);
    }
    if (times == 0.0) first = cost;
    if (times == 4.0 && std::abs(cost - first) < kAlike) break;
  }
  return begun;
}

JointFit RecordFileFits::Finish(const JointStart& begun) const {
  const Refined held = fine_.Approach(begun.held, kWhiteningOrder, kHeldPasses, begun.causes);
  return Free(held.ok ? held.point : begun.held, begun.causes);
}

}  // namespace levitas::diagnosis
