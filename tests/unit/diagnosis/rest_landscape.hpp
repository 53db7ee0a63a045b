#pragma once
// The landscape of a record made by hand: the weightless rotor of hum.hpp at rest, every term of
// the vocabulary and the 50 Hz line.
//
// Known   what was put there: a hum on de_x, a probe that reads beside where its file says. Beside
//         the offset of 10 um, a static load of 0.01 N is all that a healthy rig may have, and its
//         coils are alike: then the data know the offset to a hundredth of its tolerance, since a
//         rotor that stood elsewhere would fall towards its magnets (10 um: 1 N). At rest nothing
//         is known of what rotates.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/inference/record_landscape.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/hum.hpp"

namespace levitas::diagnosis {

inline constexpr std::size_t kRestRows = 6'000;
inline constexpr std::size_t kRestCount = kRestRows - kHumSettling;
inline constexpr const char* kHumPlace = "50 Hz, de_x";
inline constexpr double kOffsetTolerance = 10e-6;  // [m]
inline constexpr double kUsualOffset = 50e-6;      // [m] rms where the effect is there

/// A hum on de_x of the amplitude, and a probe there that reads so much beside.
inline Record RestRecord(double hum_m, double offset_m = 0.0) {
  Record record = HumRecord(hum_m, kRestRows);
  for (analysis::RecordedRow& row : record.rows) row.sample.position_m[0] += offset_m;
  return record;
}

inline std::vector<Term> TermsAtRest() {
  Tolerances tolerances;
  tolerances.static_load_n = 0.01;
  std::vector<Term> terms = AllTerms(WeightlessView(), tolerances, 50e-6);
  for (Term& term : terms) {
    if (term.effect == effect::Id::kCoilAsymmetry) term.tolerance = 0.0;
  }
  for (Term& term : MainsTerms(WeightlessView(), {kHumHz}, 1)) terms.push_back(std::move(term));
  return terms;
}

class RestLandscape {
 public:
  /// Calibrated to what was put there, the hum left out, and linearised there.
  explicit RestLandscape(double hum_m, double offset_m = 0.0)
      : records_{RestRecord(hum_m, offset_m)}, at_(landscape.search().HealthyPoint()) {
    at_.theta[TermOf(effect::Id::kSensorOffset, "de_x")] = offset_m;
    landscape.LineariseAt(at_);
  }

  /// Linearised there again, whatever a test did with it.
  RestLandscape& Again() {
    if (landscape.view().point != at_) landscape.LineariseAt(at_);
    return *this;
  }

  /// No cause.
  [[nodiscard]] CauseSelection Calibrated() const {
    CauseSelection found;
    found.point = found.calibrated = landscape.view().point;
    found.calibrated_runs = landscape.view().runs;
    return found;
  }
  [[nodiscard]] std::size_t IndexOf(effect::Id id, const std::string& place) const {
    const auto& all = landscape.hypotheses();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].effect == id && all[i].place == place) return i;
    }
    throw std::runtime_error("no hypothesis at " + place);
  }
  [[nodiscard]] const Hypothesis& Of(effect::Id id, const std::string& place) const {
    return landscape.hypotheses()[IndexOf(id, place)];
  }
  /// As a ranking would have it.
  [[nodiscard]] Candidate CandidateOf(effect::Id id, const std::string& place, double score) const {
    const Hypothesis& h = Of(id, place);
    return {h.effect, h.place, score, IndexOf(id, place), false};
  }
  [[nodiscard]] std::size_t TermOf(effect::Id id, const std::string& place) const {
    return Of(id, place).terms.front();
  }

 private:
  std::vector<Record> records_;
  const std::vector<Term> terms_ = TermsAtRest();
  Settings settings_;

 public:
  RecordLandscape landscape{WeightlessView(), records_, settings_,
                            Effort{5, 3, 3, 2, kMostRows, false}, terms_};

 private:
  Point at_;
};

// One of each for all tests of a program: a linearisation takes a second.

inline RestLandscape& NothingWrong() {
  static RestLandscape rest(0.0);
  return rest.Again();
}

inline constexpr double kHum = 1e-6;  // [m]

inline RestLandscape& Humming() {
  static RestLandscape rest(kHum);
  return rest.Again();
}

/// The probe of de_x reads four tolerances beside where its file says.
inline RestLandscape& FourTolerances() {
  static RestLandscape rest(0.0, 4.0 * kOffsetTolerance);
  return rest.Again();
}

}  // namespace levitas::diagnosis
