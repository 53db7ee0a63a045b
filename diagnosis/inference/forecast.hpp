#pragma once
// The interval of a diagnosis' forecast of validation records: its posterior, carried through the
// nonlinear model.
//
// Method     draws of all fitted numbers from their posterior (normal, about the fit, from the last
//            linearisation) are run on the validation records; each draw's distance from the
//            prediction of the fit, speed by speed, is what the undetermined directions may make
//            wrong (forecast_interval.hpp).
// Nonlinear  a critical speed that is a per cent off is no small change: the model is run, not
//            extrapolated.
// Bands      equal parts of the speeds of the validation records, or one where the speed hardly
//            changes; those of less than half a block of samples are left out.
// Cost       one run of the model per draw, at most kForecastRows rows each.
// Units      SI. Thread: blocks the caller, every processor inside. Failure: none.

#include <vector>

#include "diagnosis/inference/diagnose.hpp"
#include "diagnosis/inference/forecast_interval.hpp"
#include "diagnosis/inference/search.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kForecastDraws = 40;
inline constexpr std::size_t kForecastRows = 40'000;
inline constexpr std::size_t kSpeedBands = 8;

/// `fitted`: runs of the answer's model on the fitted records.
[[nodiscard]] Forecast Foretell(const Search& search, const std::vector<Term>& terms,
                                const SearchResult& answer, const std::vector<Trajectory>& fitted,
                                const std::vector<Record>& validation, const Judging& judging);

}  // namespace levitas::diagnosis
