#include "analysis/critical_speeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/damped_modes.hpp"
#include "analysis/poles.hpp"
#include "analysis/rotor_planes.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::analysis {
namespace {

constexpr double kPerTurn = 2.0 * std::numbers::pi;
constexpr double kNoResonance = 0.5 * std::numbers::sqrt2;
constexpr double kOnePlane = 0.05;  // about one half
constexpr int kFreeSteps = 24;
constexpr int kLevitatedSteps = 40;

/// Where a mode stands among the others: its pole in Hz, and its direction, which keeps the two
/// whirls of one bending mode apart where their frequencies are equal.
struct Place {
  std::complex<double> pole_hz;
  double forward_hz{};
};

Place PlaceOf(const CampbellMode& mode) {
  constexpr double kDirection = 0.01;
  return {{-mode.damping_ratio * mode.frequency_hz, mode.frequency_hz},
          kDirection * mode.frequency_hz * mode.forward_share};
}

double Distance(const Place& a, const Place& b) {
  return std::abs(a.pole_hz - b.pole_hz) + std::abs(a.forward_hz - b.forward_hz);
}

Place Between(const Place& a, const Place& b, double share) {
  return {a.pole_hz + share * (b.pole_hz - a.pole_hz),
          a.forward_hz + share * (b.forward_hz - a.forward_hz)};
}

struct Match {
  std::size_t first{}, second{};
  double distance{};
};

/// Each mode of one speed with one of the next, the nearest matches first.
std::vector<Match> Follow(const std::vector<CampbellMode>& from,
                          const std::vector<CampbellMode>& to) {
  std::vector<Match> all;
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (std::size_t k = 0; k < to.size(); ++k) {
      all.push_back({i, k, Distance(PlaceOf(from[i]), PlaceOf(to[k]))});
    }
  }
  std::sort(all.begin(), all.end(),
            [](const Match& a, const Match& b) { return a.distance < b.distance; });
  std::vector<Match> matches;
  std::vector<bool> left(from.size()), right(to.size());
  for (const Match& match : all) {
    if (left[match.first] || right[match.second]) continue;
    left[match.first] = right[match.second] = true;
    matches.push_back(match);
  }
  return matches;
}

/// [rad/s] of the shaft: how far a mode lies above an order of its rotation.
double Excess(const CampbellMode& mode, double speed_rad_per_s, double per_turn) {
  return kPerTurn * mode.frequency_hz / per_turn - speed_rad_per_s;
}

const CampbellMode* Nearest(const std::vector<CampbellMode>& modes, const Place& place) {
  const auto nearest = std::min_element(
      modes.begin(), modes.end(), [&](const CampbellMode& a, const CampbellMode& b) {
        return Distance(PlaceOf(a), place) < Distance(PlaceOf(b), place);
      });
  return nearest == modes.end() ? nullptr : &*nearest;
}

/// Narrows the interval, by its chord and every third time by its half, so that a jump ends too.
/// The mode is sought where it lies between its ends.
CriticalSpeed Narrow(const ModesAt& modes, double per_turn, double low, CampbellMode at_low,
                     double high, CampbellMode at_high) {
  const double fine = 1e-9 * high;
  for (int step = 1; high - low > fine; ++step) {
    const double below = Excess(at_low, low, per_turn);
    const double share = step % 3 == 0 ? 0.5 : below / (below - Excess(at_high, high, per_turn));
    const double speed = low + std::clamp(share, 1e-3, 1.0 - 1e-3) * (high - low);
    const auto there = modes(speed);
    const CampbellMode* mode =
        Nearest(there, Between(PlaceOf(at_low), PlaceOf(at_high), (speed - low) / (high - low)));
    if (mode == nullptr) break;
    const double excess = Excess(*mode, speed, per_turn);
    if (std::abs(excess) < fine) return {speed, *mode, 0};
    if ((excess > 0.0) == (below > 0.0)) {
      low = speed;
      at_low = *mode;
    } else {
      high = speed;
      at_high = *mode;
    }
  }
  return {low, at_low, 0};
}

std::vector<CampbellMode> FreeModesAt(const rotor::ModalRotor& modal, double speed_rad_per_s,
                                      std::size_t count) {
  const auto whirl = rotor::FreeWhirl(modal, speed_rad_per_s, count);
  std::vector<CampbellMode> modes;
  for (const double f : whirl.backward_hz) modes.push_back({f, 0.0, 0.0, 0.0});
  for (const double f : whirl.forward_hz) modes.push_back({f, 0.0, 1.0, 0.0});
  return modes;
}

std::vector<CampbellMode> ShaftModesAt(const plant::PlantConfig& plant, double speed_rad_per_s,
                                       std::size_t count) {
  std::vector<CampbellMode> modes;
  for (const DampedMode& mode : DampedModes(plant, speed_rad_per_s).modes) {
    if (modes.size() == 3 * count) break;  // both planes have their modes, and torsion its own
    modes.push_back(
        {mode.frequency_hz, mode.damping_ratio, mode.forward_share, mode.torsion_share});
  }
  return modes;
}

/// A mode at one speed and what it has become at the next.
struct At {
  double speed_rad_per_s{};
  const CampbellMode* mode{};
};

void AddCrossings(const ModesAt& modes, const At& from, const At& to, Campbell& campbell) {
  constexpr double kSame = 1e-6;
  for (std::size_t i = 0; i < campbell.orders.size(); ++i) {
    const double per_turn = campbell.orders[i].per_turn;
    const bool above = Excess(*from.mode, from.speed_rad_per_s, per_turn) > 0.0;
    if ((Excess(*to.mode, to.speed_rad_per_s, per_turn) > 0.0) == above) continue;
    auto at =
        Narrow(modes, per_turn, from.speed_rad_per_s, *from.mode, to.speed_rad_per_s, *to.mode);
    // A jump to another mode changes the sign too, and is no crossing.
    const double off = std::abs(Excess(at.mode, at.speed_rad_per_s, per_turn));
    if (off >= kSame * at.speed_rad_per_s) continue;
    at.order = i;
    campbell.crossings.push_back(std::move(at));
  }
}

}  // namespace

std::vector<Order> OrdersOf(const plant::PlantConfig& plant) {
  if (plant.shafts.empty()) return {{"1x", 1.0}};
  const std::vector<double> ratio = plant::SpeedRatios(plant);
  std::vector<Order> orders;
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    orders.push_back({"1x of " + plant.shafts[i].name, std::abs(ratio[i])});
  }
  for (const gear::GearPair& pair : plant.gears) {
    const double teeth = std::abs(ratio[pair.driving.shaft]) * pair.driving.teeth;
    orders.push_back({fmt::format("{} {:g}x", pair.name, teeth), teeth});
  }
  return orders;
}

Campbell CampbellOf(const ModesAt& modes, double top_rad_per_s, int steps,
                    const std::vector<Order>& orders) {
  Campbell campbell;
  campbell.orders = orders;
  for (int i = 0; i <= steps; ++i) {
    const double speed = top_rad_per_s * i / steps;
    campbell.speeds.push_back({speed, modes(speed)});
  }
  for (std::size_t i = 1; i < campbell.speeds.size(); ++i) {
    const CampbellSpeed& before = campbell.speeds[i - 1];
    const CampbellSpeed& after = campbell.speeds[i];
    campbell.next.emplace_back(before.modes.size());
    for (const Match& match : Follow(before.modes, after.modes)) {
      campbell.next.back()[match.first] = match.second;
      const CampbellMode& from = before.modes[match.first];
      const CampbellMode& to = after.modes[match.second];
      AddCrossings(modes, {before.speed_rad_per_s, &from}, {after.speed_rad_per_s, &to}, campbell);
    }
  }
  std::sort(campbell.crossings.begin(), campbell.crossings.end(),
            [](const auto& a, const auto& b) { return a.speed_rad_per_s < b.speed_rad_per_s; });
  return campbell;
}

Campbell FreeCampbell(const plant::PlantConfig& plant, double top_rad_per_s, std::size_t modes) {
  if (!plant.shafts.empty()) {
    return CampbellOf([&](double speed) { return ShaftModesAt(plant, speed, modes); },
                      top_rad_per_s, kFreeSteps, OrdersOf(plant));
  }
  // Every mode of the mesh is kept: nothing is lost by modal coordinates.
  const auto modal = plant.rotor.given
                         ? rotor::FromGivenModes(*plant.rotor.given, PlanesOf(plant))
                         : rotor::Reduce(rotor::Assemble(plant.rotor, PlanesOf(plant)), 0, 0.0);
  return CampbellOf([&](double speed) { return FreeModesAt(modal, speed, modes); }, top_rad_per_s,
                    kFreeSteps);
}

ModesAt LevitatedModes(const plant::PlantConfig& plant, const law::LawConfig& law) {
  return [&plant, &law](double speed) {
    std::vector<CampbellMode> all;
    for (const Pole& pole : ClosedLoopPoles(plant, law, speed).poles) {
      if (pole.frequency_hz == 0.0 || pole.damping_ratio > kNoResonance) continue;
      all.push_back({std::abs(pole.frequency_hz), pole.damping_ratio, pole.forward_share, 0.0});
    }
    return all;
  };
}

Campbell LevitatedCampbell(const plant::PlantConfig& plant, const law::LawConfig& law,
                           double top_rad_per_s) {
  return CampbellOf(LevitatedModes(plant, law), top_rad_per_s, kLevitatedSteps, OrdersOf(plant));
}

double AmplificationFactor(const CampbellMode& mode) { return 0.5 / mode.damping_ratio; }

const char* WhirlName(const CampbellMode& mode) {
  if (mode.torsion_share > 0.5) return "torsion";
  if (std::abs(mode.forward_share - 0.5) < kOnePlane) return "plane";
  return mode.forward_share > 0.5 ? "forward" : "backward";
}

}  // namespace levitas::analysis
