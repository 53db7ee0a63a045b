// Every way a run can end has its own outcome and sentence; the table fits its columns and the JSON
// names its units for every number of bearings.

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "tests/unit/verdict/synthetic_session.hpp"
#include "verdict/report.hpp"

namespace levitas::verdict {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

RigNumbers Rig(std::size_t bearings, const std::string& stem = "b") {
  RigNumbers rig = TwoBearingRig();
  rig.bearings.clear();
  rig.channels.clear();
  for (std::size_t b = 0; b < bearings; ++b) {
    rig.bearings.push_back(fmt::format("{}{}", stem, b));
    for (const char* axis : {"x", "y"}) {
      rig.channels.push_back(fmt::format("{}_{}", rig.bearings.back(), axis));
    }
  }
  return rig;
}

/// Figures of a run of this rig with the given orbits; the other figures are small.
PhaseFigures Phase(const RigNumbers& rig, double radius_m, double speed_rad_per_s) {
  PhaseFigures phase;
  phase.cycles = 10'000;
  phase.duration_s = 1.0;
  for (const std::string& name : rig.bearings) {
    BearingFigures bearing;
    bearing.name = name;
    bearing.orbit = {radius_m, speed_rad_per_s, 2.5, radius_m, 0.1e-6, 0.2e-6};
    bearing.current = {{{0.25, 0.01, 0.3, 0.0}, {-0.25, 0.01, 0.3, 0.0}}};
    phase.bearings.push_back(bearing);
  }
  return phase;
}

Inputs GoodRun(const RigNumbers& rig) {
  Inputs in;
  in.rig = rig;
  in.rig.max_speed_rad_per_s = RpmToRadPerS(6000.0);
  in.session.cycles = 20'000;
  in.session.duration_s = 2.0;
  in.session.top_speed_rad_per_s = RpmToRadPerS(3000.0);
  in.session.levitated_speed_rad_per_s = in.session.top_speed_rad_per_s;
  in.session.standing = Phase(rig, 4e-6, 0.0);
  in.session.spinning = Phase(rig, 20e-6, in.session.top_speed_rad_per_s);
  return in;
}

analysis::SensitivityResult Loop(const RigNumbers& rig, double peak, std::optional<Zone> zone) {
  analysis::SensitivityResult loop;
  loop.stable = zone.has_value();
  loop.axes.resize(rig.axes(), {.peak = peak, .frequency_hz = 95.0, .zone = zone, .margins = {}});
  return loop;
}

TripFigures Trip() { return {Fault::kOverSpeed, -1, 697.4, 691.2, 1.25, Mode::kSpinning, 690.0}; }

struct Ending {
  const char* what;
  void (*change)(Inputs&);
  Outcome outcome;
  std::vector<const char*> words;  ///< in the sentence
};

const Ending kEndings[] = {
    {"everything met",
     [](Inputs&) {},
     Outcome::kAccepted,
     {"ACCEPTED up to 3000 of 6000 rpm: orbit standing 4.0 um of 7.0 um",
      "spinning 20.0 um of 36.0 um", "(zone A)"}},
    {"never spun",
     [](Inputs& in) {
       in.session.spinning = {};
       in.session.levitated_speed_rad_per_s = 0.0;
     },
     Outcome::kAccepted,
     {"ACCEPTED standing, 0 of 6000 rpm: ", "spinning not run"}},
    {"orbit too large standing",
     [](Inputs& in) { in.session.standing.bearings[1].orbit.max_m = 9e-6; },
     Outcome::kNotAccepted,
     {"NOT ACCEPTED: b1 orbit 9.0 um while standing exceeds 7.0 um"}},
    {"orbit too large spinning",
     [](Inputs& in) { in.session.spinning.bearings[0].orbit.max_m = 40e-6; },
     Outcome::kNotAccepted,
     {"NOT ACCEPTED: b0 orbit 40.0 um while spinning", "at 3000 rpm"}},
    {"displacement in zone C",
     [](Inputs& in) {
       in.rig.spinning_orbit_objective_m = 150e-6;
       in.session.spinning.bearings[0].orbit.max_m = 90e-6;
     },
     Outcome::kNotAccepted,
     {"0.45 clearances while spinning is zone C"}},
    {"reading that was no number",
     [](Inputs& in) {
       in.session.standing.bearings[0].orbit.max_m = std::numeric_limits<double>::infinity();
     },
     Outcome::kNotAccepted,
     {"b0 orbit inf um while standing", "zone D"}},
    {"sensitivity in zone C",
     [](Inputs& in) { in.sensitivity = {Loop(in.rig, 4.2, Zone::kC)}; },
     Outcome::kNotAccepted,
     {"computed sensitivity peak of b0_x is 4.20 at 0 rpm, zone C"}},
    {"unstable loop",
     [](Inputs& in) { in.sensitivity = {Loop(in.rig, 9.0, {})}; },
     Outcome::kNotAccepted,
     {"the linear loop is unstable at 0 rpm"}},
    {"never levitated",
     [](Inputs& in) {
       in.session.standing = {};
       in.session.spinning = {};
     },
     Outcome::kNotAccepted,
     {"was not levitated for longer than the settling time"}},
    {"stopped by the operator",
     [](Inputs& in) { in.incomplete_reason = "stopped by the operator before the end"; },
     Outcome::kIncomplete,
     {"INCOMPLETE: stopped by the operator before the end"}},
    {"a program died",
     [](Inputs& in) { in.incomplete_reason = "amb-plant was ended by signal 9"; },
     Outcome::kIncomplete,
     {"INCOMPLETE: amb-plant was ended by signal 9"}},
    {"tripped, sentence recorded",
     [](Inputs& in) {
       in.session.trip = Trip();
       in.trip_text = "TRIP over_speed in cycle 12500: the rotor is too fast.";
     },
     Outcome::kTripped,
     {"TRIPPED over_speed in cycle 12500",
      "in mode spinning at 6589 rpm, 1.250 s after the start"}},
    {"tripped, sentence lost",
     [](Inputs& in) { in.session.trip = Trip(); },
     Outcome::kTripped,
     {"TRIPPED: over_speed: 697.4, allowed 691.2."}},
    {"tripped and cut short",
     [](Inputs& in) {
       in.session.trip = Trip();
       in.incomplete_reason = "a reason that must not hide the trip";
     },
     Outcome::kTripped,
     {"TRIPPED: over_speed"}},
};

TEST(Ending, OfEveryKindHasItsOutcomeAndItsOwnSentenceOfOneLine) {
  std::set<std::string> sentences;
  for (const Ending& ending : kEndings) {
    Inputs in = GoodRun(Rig(2));
    ending.change(in);
    const Verdict verdict = Judge(in);
    EXPECT_EQ(verdict.outcome, ending.outcome) << ending.what;
    for (const char* words : ending.words) {
      EXPECT_THAT(verdict.sentence, HasSubstr(words)) << ending.what;
    }
    EXPECT_THAT(verdict.sentence, Not(HasSubstr("\n"))) << ending.what;
    EXPECT_TRUE(Table(verdict).ends_with("\n" + verdict.sentence + "\n")) << ending.what;
    const auto json = nlohmann::json::parse(Json(verdict).dump());
    EXPECT_EQ(json["verdict"], Name(ending.outcome)) << ending.what;
    EXPECT_EQ(json["sentence"], verdict.sentence) << ending.what;
    EXPECT_EQ(json["trip"].is_null(), ending.outcome != Outcome::kTripped) << ending.what;
    if (ending.outcome == Outcome::kAccepted) {
      EXPECT_TRUE(json["objections"].empty()) << ending.what;
    }
    if (ending.outcome != Outcome::kTripped) sentences.insert(verdict.sentence);
  }
  EXPECT_EQ(sentences.size(), std::size(kEndings) - 3U);  // three endings are trips
}

TEST(Ending, IsAcceptedExactlyWhenTheWorstBearingIsInsideBothLimits) {
  Random draw{20261121};
  for (int round = 0; round < 3000; ++round) {
    const std::size_t bearings = 1 + draw.Bits() % 4;
    Inputs in = GoodRun(Rig(bearings));
    in.rig.standing_orbit_objective_m = 150e-6 * draw.Uniform();
    double worst_m = 0.0;
    for (BearingFigures& bearing : in.session.standing.bearings) {
      bearing.orbit.max_m = 120e-6 * draw.Uniform();
      worst_m = std::max(worst_m, bearing.orbit.max_m);
    }
    // Clearance 200 um: zone C begins at 0.4 of it (ISO 14839-2).
    const bool good = worst_m < in.rig.standing_orbit_objective_m && worst_m / 200e-6 < 0.4;
    const Verdict verdict = Judge(in);
    ASSERT_EQ(verdict.outcome == Outcome::kAccepted, good) << worst_m << " in round " << round;
    ASSERT_EQ(verdict.objections.empty(), good);
    ASSERT_EQ(verdict.orbits.size(), 2 * bearings);
  }
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Table, FitsAHundredColumnsForOneToFourBearingsAndLongFigures) {
  for (std::size_t bearings = 1; bearings <= 4; ++bearings) {
    Inputs in = GoodRun(Rig(bearings, "bearing_"));
    in.sensitivity = {Loop(in.rig, 1234.567, Zone::kD), Loop(in.rig, 1e3, {})};
    in.sensitivity[1].speed_rad_per_s = RpmToRadPerS(120'000.0);
    for (BearingFigures& bearing : in.session.spinning.bearings) {
      bearing.orbit.max_m = bearing.orbit.rms_m = 9.9999e-4;
      bearing.orbit.max_speed_rad_per_s = RpmToRadPerS(120'000.0);
      bearing.orbit.max_time_s = 9999.99;
      for (CurrentFigures& current : bearing.current) current = {-12.5, 12.5, 25.0, 1.0};
    }
    in.session.skipped_periods = in.session.missing_frames = in.session.held_currents = 99'999;
    in.session.missing_records = 99'999;
    const Verdict verdict = Judge(in);
    std::size_t orbits = 0;
    for (const std::string& line : Lines(Table(verdict))) {
      if (line == verdict.sentence) continue;
      EXPECT_LE(line.size(), 100U) << line;
      EXPECT_THAT(line, Not(testing::EndsWith("\t")));
      if (line.find(" spinning ") != std::string::npos && line.find("rpm, ") != std::string::npos) {
        ++orbits;
      }
    }
    EXPECT_EQ(orbits, bearings);
  }
}

TEST(Table, KeepsABlankBetweenALongChannelNameAndWhatFollows) {
  Inputs in = GoodRun(Rig(2, "driven_end_"));  // channels of 13 letters: driven_end_0_x
  in.sensitivity = {Loop(in.rig, 2.5, Zone::kA)};
  const std::string table = Table(Judge(in));
  for (const std::string& name : in.rig.channels) {
    EXPECT_TRUE(std::regex_search(table, std::regex("\n" + name + " +standing +"))) << table;
    EXPECT_TRUE(std::regex_search(table, std::regex("\n" + name + " +0 +2\\.500"))) << table;
  }
  for (const std::string& name : in.rig.bearings) {
    EXPECT_TRUE(std::regex_search(table, std::regex("\n" + name + " +spinning +"))) << table;
  }
}

/// Every key below which a number stands, with its path.
void NumberKeys(const nlohmann::json& json, const std::string& key, std::set<std::string>& keys) {
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) {
      // Below max_m stand names of bearings: the unit is that of the parent.
      NumberKeys(value, key == "max_m" ? key : name, keys);
    }
  } else if (json.is_array()) {
    for (const auto& value : json) NumberKeys(value, key, keys);
  } else if (json.is_number()) {
    keys.insert(key);
  }
}

TEST(Json, NamesTheUnitOfEveryNumberThatHasOne) {
  Inputs in = GoodRun(Rig(3));
  in.sensitivity = {Loop(in.rig, 2.5, Zone::kA)};
  in.session.trip = Trip();
  in.session.profile = {{10.0, 5, {1e-6, 1e-6, 1e-6}}};
  in.session.modes = {{Mode::kLift, 0.0, 1.0}};
  TimingFigures timing;
  timing.wall_s = 1.0;
  timing.durations = {{"law", 10, 1.0, 2.0, 3.0, 4.0}};
  in.timing = timing;
  in.rig_process = RigFigures{};
  std::set<std::string> keys;
  NumberKeys(nlohmann::json::parse(Json(Judge(in)).dump()), "", keys);
  EXPECT_GT(keys.size(), 30U);
  const std::regex with_unit(".*_(m|s|a|ns|hz|rpm|si|share|per_s)");
  // Counts and ratios: pure numbers by their nature.
  const std::set<std::string> pure{"cycles",
                                   "count",
                                   "seed",
                                   "peak",
                                   "largest_pole_modulus",
                                   "largest_singular_value",
                                   "damping_ratio",
                                   "times_real_time",
                                   "skipped_periods",
                                   "missing_frames",
                                   "held_currents",
                                   "missing_records",
                                   "lost_records",
                                   "lost_messages",
                                   "rejected_frames",
                                   "watchdog_trips"};
  for (const std::string& key : keys) {
    EXPECT_TRUE(pure.contains(key) || std::regex_match(key, with_unit)) << key;
  }
}

}  // namespace
}  // namespace levitas::verdict
