#pragma once
// What the page is told, as JSON text: the rig once per run, the newest figures at each tick, a
// spectrum when there is a new one, timing about once a second, events one by one.
//
// Numbers   whole nanometres, milliamperes and milliseconds: short texts, finer than a screen.
// Size      bounded whatever the loop does: the newest orbit has at most kOrbitPoints points, a
//           tick at most kTickEnvelopes buckets.
// Thread    as the LiveRun given. Failure none: what is not known is null.

#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "dashboard/full_spectrum.hpp"
#include "dashboard/live_run.hpp"

namespace levitas::dashboard {

inline constexpr std::size_t kOrbitPoints = 128;
inline constexpr std::size_t kTickEnvelopes = 80;

/// Names, limits and texts of the run: what the page needs before it can draw. `server` tells one
/// start of this program from the next.
[[nodiscard]] std::string RigJson(const LiveRun& run, std::int64_t server);

/// State, newest orbit and envelopes; `now_ns` of CLOCK_MONOTONIC.
[[nodiscard]] std::string TickJson(LiveRun& run, std::int64_t now_ns);

/// `first_order`: of each axis, see first_order.hpp; empty: the rotor does not turn.
[[nodiscard]] std::string SpectrumJson(const FullSpectrum& spectrum,
                                       const std::vector<std::complex<double>>& first_order = {});
[[nodiscard]] std::string TimingJson(const LiveRun& run);
[[nodiscard]] std::string EventJson(const NumberedEvent& event);
/// That the run is over, and how it ended, in a sentence.
[[nodiscard]] std::string EndJson(const std::string& how);

}  // namespace levitas::dashboard
