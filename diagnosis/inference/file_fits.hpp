#pragma once
// What the search for swallowed causes asks of the records: fits that begin at the rig file's
// numbers, under the fast observer.
//
// Why     which cause is tried, added or given up is decided by what the fits cost
//         (swallowed_causes.hpp); behind this interface the decisions need no rig and no record.
// Costs   compare with each other, whatever was held or filtered: same rows, same observer, each
//         with a filter of its own.
// Units   nats. Thread: blocks the caller, every processor inside. Failure: a cost of infinity,
//         and a Refined that is not `ok`.

#include <limits>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

/// Causes, the point held to the file, and the fit that is free within the tolerances.
struct JointFit {
  std::vector<Hypothesis> causes;
  Point held;
  Refined free;
  double cost{std::numeric_limits<double>::infinity()};  ///< [nat]
};

/// Causes, held to the file on few rows: where a joint fit goes on from.
struct JointStart {
  std::vector<Hypothesis> causes;
  Point held;
  double cost{std::numeric_limits<double>::infinity()};  ///< [nat] on the few rows
};

class FileFits {
 public:
  FileFits() = default;
  FileFits(const FileFits&) = delete;
  FileFits& operator=(const FileFits&) = delete;
  virtual ~FileFits() = default;

  /// Free within the tolerances, from `held` on.
  [[nodiscard]] virtual JointFit Free(const Point& held,
                                      const std::vector<Hypothesis>& causes) const = 0;
  /// The nuisances alone from the file's numbers on, by the way that causes go.
  [[nodiscard]] virtual JointFit Anew() const = 0;
  /// Of everything, on few rows.
  [[nodiscard]] virtual View LineariseAt(const Point& held) const = 0;
  /// Every effect at its best place on top of these, best first.
  [[nodiscard]] virtual std::vector<Candidate> Screened(const View& view,
                                                        const JointFit& base) const = 0;
  /// With a cause more; of infinite cost where the model cannot follow.
  [[nodiscard]] virtual JointStart Begin(const View& view, const JointFit& base,
                                         const Hypothesis& cause) const = 0;
  [[nodiscard]] virtual JointFit Finish(const JointStart& begun) const = 0;
};

}  // namespace levitas::diagnosis
