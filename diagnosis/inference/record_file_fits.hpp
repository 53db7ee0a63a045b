#pragma once
// Fits of recorded data that begin at the rig file's numbers: on few rows and on more, held to the
// file and free.
//
// Held      to a fifth of the tolerances of what is built (HeldToFile, calibrate.hpp), so that
//           nuisances do not run to where they imitate a cause.
// Coarse    few rows say where to begin; more rows say how well it ends.
// Lifetime  refers to the search, terms and rig of the landscape that made them; its records are
//           copied.
// Thread    blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/file_fits.hpp"

namespace levitas::diagnosis {

class RecordFileFits final : public FileFits {
 public:
  /// `search` has everything, on `terms`.
  RecordFileFits(const Search& search, const std::vector<Term>& terms,
                 const std::vector<Record>& records);

  [[nodiscard]] JointFit Free(const Point& held,
                              const std::vector<Hypothesis>& causes) const override;
  [[nodiscard]] JointFit Anew() const override;
  [[nodiscard]] View LineariseAt(const Point& held) const override;
  [[nodiscard]] std::vector<Candidate> Screened(const View& view,
                                                const JointFit& base) const override;
  /// From the best of four sizes of the cause: none, as the screen sees it, and two and four times
  /// as large, since a straight line sees too little of what moves a lightly damped mode by more
  /// than its width. Where none and the largest end alike, the others would, too.
  [[nodiscard]] JointStart Begin(const View& view, const JointFit& base,
                                 const Hypothesis& cause) const override;
  [[nodiscard]] JointFit Finish(const JointStart& begun) const override;

 private:
  const Search& search_;
  std::vector<Term> held_;
  Search cautious_;
  std::vector<Record> few_, part_;
  Gains fast_few_, fast_;
  Refiner coarse_, fine_, free_;
};

}  // namespace levitas::diagnosis
