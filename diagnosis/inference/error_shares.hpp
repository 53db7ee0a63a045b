#pragma once
// Which share of the rig file's error each changed number explains: causes and calibration alike.
//
// Why        what a cause gains beyond calibration says whether it is proven, not whether it
//            matters: calibration absorbs the greater part of many faults, and a small cause can be
//            proven to a thousand nat. Shares of the file's error say what to look at first.
// Change     D = innovations of the file's model - innovations of the answer's model, in units of
//            the sensors' noise; D is what the answer explains, as a signal.
// Share      of a group g: <D_g, D>/<D, D>, where D_g is what g alone changes, as the mean of g
//            added to the file's model and g taken out of the answer's. For small changes D is the
//            sum of all D_g and the shares add up to 1; else they do so nearly.
// Sign       below 0: the group undoes what others do (a run-out beside the force it hides).
// Groups     every cause; the calibrated numbers of each effect together; those of no effect (mode
//            shapes) together.
// Cost       two runs of the model per group, at most kShareRows rows each.
// Thread     ProjectedChange: any, pure. ErrorShares blocks the caller, every processor inside.
// Failure    none; a model that diverges without a group leaves that group out.

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kShareRows = 16'000;

struct ErrorShare {
  std::optional<effect::Id> effect;  ///< none: shapes of the modes
  std::string place;                 ///< of a cause; empty for calibration
  double share{};
};

/// Of the innovations that count, over the noise of each axis: <from_1 - to_1, from_2 - to_2>.
/// All four are runs of the same records.
struct ChangePair {
  const std::vector<Trajectory>& from_1;
  const std::vector<Trajectory>& to_1;
  const std::vector<Trajectory>& from_2;
  const std::vector<Trajectory>& to_2;
};
[[nodiscard]] double ProjectedChange(const ChangePair& pair,
                                     const std::vector<double>& noise_rms_m);

/// The largest first; empty where the answer changes nothing.
[[nodiscard]] std::vector<ErrorShare> ErrorShares(const Search& search,
                                                  const std::vector<Term>& terms,
                                                  const SearchResult& answer,
                                                  const std::vector<Record>& fitted,
                                                  const std::vector<double>& noise_rms_m);

}  // namespace levitas::diagnosis
