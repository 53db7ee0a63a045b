#include "identification/geared/probe_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "identification/geared/elastic_shaft.hpp"
#include "identification/geared/geared_forces.hpp"

namespace levitas::identification {
namespace {

using Kind = GearedLine::Kind;

double Amplification(const ShaftKnown& shaft, const GearedLine& line, double ks_n_per_m) {
  if (!shaft.elastic) return 1.0;
  return std::abs(GainsOf(ReceptancesOf(shaft, line), ks_n_per_m, 1.0).gear_per_m);
}

bool IsSeen(const ShaftKnown& shaft, const GearedLine& line) {
  return Amplification(shaft, line, shaft.ks_n_per_m) <= kMostAmplification;
}

std::string NameOf(const GearedLine& line) {
  if (line.kind == Kind::kPinion) return "pinion_1x";
  if (line.kind == Kind::kGear) return "gear_1x";
  if (line.kind == Kind::kTransmissionError && line.harmonic != 0) {
    return fmt::format("mesh_{:+d}", line.harmonic);
  }
  return line.frequency_rad_per_s == 0.0 ? "mean" : "1x the other way";
}

/// The line that the probes of a shaft see least, one of rotation before all others.
struct Unseen {
  const ShaftKnown* shaft;
  const GearedLine* line;
  bool rotates;
  double amplification;
};

Unseen WorstOf(const std::vector<GearedLine>& lines, const GearedKnown& known) {
  Unseen worst{&known.pinion, &lines.front(), false, 0.0};
  for (const GearedLine& line : lines) {
    const bool rotates = line.kind == Kind::kPinion || line.kind == Kind::kGear;
    for (const ShaftKnown* shaft : {&known.pinion, &known.gear}) {
      if (IsSeen(*shaft, line) || (worst.rotates && !rotates)) continue;
      const double one = Amplification(*shaft, line, shaft->ks_n_per_m);
      if (rotates == worst.rotates && one <= worst.amplification) continue;
      worst = {shaft, &line, rotates, one};
    }
  }
  return worst;
}

[[noreturn]] void Refuse(const std::vector<GearedLine>& lines, const GearedKnown& known,
                         std::size_t left) {
  const Unseen worst = WorstOf(lines, known);
  const ElasticShaft& planes = *worst.shaft->elastic;
  throw BadInput(fmt::format(
      "full spectrum: the probes of the {} at z = {:.6g} mm stand at a node: on line {} at "
      "{:.4g} Hz of the pinion the gear at z = {:.6g} mm moves {:.3g} times as far as they do, "
      "allowed {:g}; of {} lines {} are left, too few. Put the probes nearer to the gear",
      worst.shaft == &known.pinion ? "pinion" : "gear", 1e3 * planes.probe_z_m, NameOf(*worst.line),
      worst.line->speed_rad_per_s / kTwoPi, 1e3 * planes.gear_z_m, worst.amplification,
      kMostAmplification, lines.size(), left));
}

std::optional<ProbePlane> PlaneOf(const ShaftKnown& shaft, const ShaftFound& found,
                                  const std::vector<GearedLine>& all,
                                  const std::vector<GearedLine>& used) {
  if (!shaft.elastic) return std::nullopt;
  ProbePlane plane{shaft.elastic->probe_z_m, shaft.elastic->gear_z_m};
  std::vector<double> each;
  for (const GearedLine& line : used) {
    const double one = Amplification(shaft, line, found.ks_n_per_m);
    each.push_back(one);
    if (one <= plane.amplification) continue;
    plane.amplification = one;
    plane.at_rad_per_s = line.frequency_rad_per_s;
  }
  std::ranges::sort(each);
  plane.median_amplification = each[each.size() / 2];
  plane.left_out = static_cast<std::size_t>(
      std::ranges::count_if(all, [&](const GearedLine& line) { return !IsSeen(shaft, line); }));
  return plane;
}

}  // namespace

std::string WhatLacks(const std::vector<GearedLine>& lines) {
  std::set<double> speeds;
  bool pinion = false;
  bool gear = false;
  for (const GearedLine& line : lines) {
    speeds.insert(line.speed_rad_per_s);
    pinion = pinion || line.kind == Kind::kPinion;
    gear = gear || line.kind == Kind::kGear;
  }
  if (speeds.size() < 2) {
    return "lines of one speed only; at least two speeds tell stiffness from damping and run-out "
           "from transmission error";
  }
  if (pinion && gear) return {};
  return fmt::format("no line {}: the run-out is not determined", pinion ? "gear_1x" : "pinion_1x");
}

std::vector<GearedLine> LinesOffNodes(const std::vector<GearedLine>& lines,
                                      const GearedKnown& known) {
  const auto is_seen = [&known](const GearedLine& line) {
    return IsSeen(known.pinion, line) && IsSeen(known.gear, line);
  };
  std::vector<GearedLine> unseen;
  std::ranges::remove_copy_if(lines, std::back_inserter(unseen), is_seen);
  // The wheels turn under the forces of both whirls: without the one the other says nothing.
  const auto lacks_its_mirror = [&](const GearedLine& line) {
    return known.torsion && std::ranges::any_of(unseen, [&line](const GearedLine& one) {
             return StandsAt(one, line.speed_rad_per_s, -line.frequency_rad_per_s);
           });
  };
  std::vector<GearedLine> seen;
  std::ranges::copy_if(lines, std::back_inserter(seen), [&](const GearedLine& line) {
    return is_seen(line) && !lacks_its_mirror(line);
  });
  if (seen.size() < lines.size() && !WhatLacks(seen).empty()) Refuse(lines, known, seen.size());
  return seen;
}

void TellProbePlanes(const std::vector<GearedLine>& all, const std::vector<GearedLine>& used,
                     const GearedKnown& known, GearedParameters& p) {
  p.pinion.plane = PlaneOf(known.pinion, p.pinion, all, used);
  p.gear.plane = PlaneOf(known.gear, p.gear, all, used);
}

}  // namespace levitas::identification
