#pragma once
// Balancing from recorded run-ups: records and planes in, unbalance, corrections and forecast out.
//
// Planes     the fit has unbalance at the planes of the rig file and at the correction planes; of
//            two within a millimetre the correction plane stays.
// Speeds     of forecast and correction: a hundred from a tenth of the top speed to all of it.
// Placed     with radii the forecast is of the weights as placed (holes, limits), else of the
//            moments.
// Modal      unbalance by mode: sum U_i phi(z_i) over the largest |phi|; of the rigid rotor the sum
//            of all (static) and about the centre of mass (couple [kg m2]).
// Units      SI; complex as balance_rig.hpp says. Thread: any; allocates.
// Failure    BadInput, one sentence: what recorded_run.hpp, balance_rig.hpp and planes.hpp refuse,
//            a weight at a plane that is none of those given.

#include <optional>
#include <string>
#include <vector>

#include "identification/balance/correction.hpp"
#include "identification/balance/hole_split.hpp"
#include "identification/balance/influence.hpp"
#include "identification/balance/planes.hpp"
#include "identification/balance/recorded_run.hpp"
#include "identification/balance/unbalance_fit.hpp"

namespace levitas::balancing {

struct BalanceRequest {
  configuration::RigFile rig;
  std::vector<RecordedRun> runs;      ///< the last is what the rotor is like now
  std::optional<law::LawConfig> law;  ///< none: as the records show it
  CorrectionPlanes planes;
  double top_rad_per_s{};
};

struct PlaneResult {
  std::string name;  ///< empty: a plane of the rig file where nothing can go
  double z_m{};
  std::complex<double> unbalance_kg_m;  ///< as it is now
  double deviation_kg_m{};              ///< along its direction
  double angle_deviation_rad{};
};

struct CorrectionResult {
  CorrectionPlane plane;
  std::complex<double> added_kg_m;
  double deviation_kg_m{}, angle_deviation_rad{};
  PlacedWeights placed;  ///< with a radius
};

struct ModalUnbalance {
  std::string name;
  double frequency_hz{};
  std::complex<double> before, after;  ///< [kg m]; of the couple [kg m2]
  double deviation{};
};

struct BalanceResult {
  UnbalanceFit fit;
  std::vector<Unknown> unknowns;
  std::vector<PlaneResult> planes;
  std::vector<CorrectionResult> corrections;
  std::vector<ModalUnbalance> modal;
  std::vector<OrbitForecast> orbits;
  std::vector<InfluenceChange> influence;  ///< of the last weights; empty with one run
  double mass_kg{};
  double lowest_rad_per_s{}, highest_rad_per_s{};  ///< that the records show
  bool law_known{};
  /// Root mean square over speeds and probes, after over before.
  double left_share{};
};

[[nodiscard]] BalanceResult Balance(const BalanceRequest& request);

}  // namespace levitas::balancing
