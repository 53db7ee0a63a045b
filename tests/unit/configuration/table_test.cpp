// Loops over the tables: every key of every file is broken in every way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <set>
#include <sstream>

#include "common/problem.hpp"
#include "configuration/schema/schema.hpp"
#include "configuration/text/documenter.hpp"
#include "controller/law/state_space_law.hpp"
#include "tests/unit/configuration/field_list.hpp"
#include "tests/unit/configuration/full_samples.hpp"

namespace levitas::configuration::test {
namespace {

struct Kind {
  std::string name;
  std::function<void(Visitor&)> describe;
  std::function<void(const std::string&)> parse;
};

/// The full rig with one item in every list: the second would only repeat the first one's keys.
RigFile OneOfEach() {
  RigFile rig = FullRig();
  rig.plant.bearings.resize(1);
  rig.plant.rotor.discs.resize(1);
  rig.plant.unbalance.resize(1);
  return ParseRig(WriteRig(rig), "one of each");
}

std::vector<Kind> Kinds() {
  const RigFile rig = OneOfEach();
  const RigNumbers numbers = rig.numbers;
  return {{"rig",
           [rig](Visitor& v) {
             RigFile copy = rig;
             Describe(v, copy);
           },
           [](const std::string& text) { (void)ParseRig(text, "f"); }},
          {"controller",
           [numbers](Visitor& v) {
             ControllerFile copy = FullController(FullRig().numbers);
             copy.law.axes.resize(2);
             Describe(v, copy, numbers);
           },
           [numbers](const std::string& text) { (void)ParseController(text, "f", numbers); }},
          {"scenario",
           [numbers](Visitor& v) {
             scenario::ScenarioConfig copy = FullScenario(FullRig().numbers);
             copy.steps[1].excitation.resize(1);
             Describe(v, copy, numbers);
           },
           [numbers](const std::string& text) { (void)ParseScenario(text, "f", numbers); }}};
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string Joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text.append(line).append("\n");
  return text;
}

std::string Problems(const Kind& kind, const std::string& text) {
  try {
    kind.parse(text);
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "";
}

/// Calls `check` for every scalar of every kind and every way to give the magnet's strength.
void ForEveryField(const std::function<void(const Kind&, const ListedField&,
                                            const std::vector<std::string>&)>& check) {
  for (const Kind& kind : Kinds()) {
    std::set<std::string> seen;  // keys of the forms before
    for (std::size_t form = 0; form < (kind.name == "rig" ? 3U : 1U); ++form) {
      FieldList list(kind.name, form);
      kind.describe(list);
      ASSERT_EQ(Problems(kind, list.text()), "") << list.text();
      const std::vector<std::string> lines = Lines(list.text());
      for (const ListedField& field : list.fields()) {
        if (form == 0 || !seen.contains(field.key)) check(kind, field, lines);
      }
      for (const ListedField& field : list.fields()) seen.insert(field.key);
    }
  }
}

TEST(Tables, RefuseEveryBadValueOfEveryKeyAtItsLine) {
  int tried = 0;
  ForEveryField([&](const Kind& kind, const ListedField& field,
                    const std::vector<std::string>& lines) {
    const auto at = static_cast<std::size_t>(field.line - 1);
    const std::size_t colon = lines[at].find(": ");
    ASSERT_NE(lines[at].find(field.key + ": "), std::string::npos) << lines[at];
    for (const std::string& bad : field.bad) {
      std::vector<std::string> broken = lines;
      broken[at] = fmt::format("{}{}", lines[at].substr(0, colon + 2), bad);
      const std::string problems = Problems(kind, Joined(broken));
      const std::string place = fmt::format("f:{}:", field.line);
      ASSERT_NE(problems.find(place), std::string::npos) << kind.name << " " << broken[at] << "\n"
                                                         << problems;
      ASSERT_NE(problems.find(field.key + ": found "), std::string::npos)
          << kind.name << " " << broken[at] << "\n"
          << problems;
      ++tried;
    }
  });
  EXPECT_GT(tried, 1000);
}

TEST(Tables, ReportEveryMisspeltKeyWithTheNearest) {
  ForEveryField(
      [](const Kind& kind, const ListedField& field, const std::vector<std::string>& lines) {
        const auto at = static_cast<std::size_t>(field.line - 1);
        std::vector<std::string> broken = lines;
        const std::size_t end = lines[at].find(field.key) + field.key.size();
        broken[at] = fmt::format("{}q{}", lines[at].substr(0, end), lines[at].substr(end));
        const std::string problems = Problems(kind, Joined(broken));
        ASSERT_NE(problems.find(fmt::format("{0}q: unknown key, nearest key {0}", field.key)),
                  std::string::npos)
            << kind.name << " " << broken[at] << "\n"
            << problems;
      });
}

TEST(Tables, ReportEveryKeyGivenTwice) {
  ForEveryField([](const Kind& kind, const ListedField& field,
                   const std::vector<std::string>& lines) {
    const auto at = static_cast<std::size_t>(field.line - 1);
    std::string copy = lines[at];
    if (const std::size_t dash = copy.find("- "); dash != std::string::npos) copy[dash] = ' ';
    std::vector<std::string> broken = lines;
    broken.insert(broken.begin() + field.line, copy);
    ASSERT_NE(Problems(kind, Joined(broken))
                  .find(fmt::format("{}: given twice, first on line {}", field.key, field.line)),
              std::string::npos)
        << kind.name << " " << copy;
  });
}

TEST(Tables, ReportEveryMissingKeyThatHasNoDefault) {
  ForEveryField([](const Kind& kind, const ListedField& field,
                   const std::vector<std::string>& lines) {
    const auto at = static_cast<std::size_t>(field.line - 1);
    std::vector<std::string> broken = lines;
    if (const std::size_t dash = lines[at].find("- "); dash != std::string::npos) {
      // The dash moves to the next key of the item, if there is one.
      if (at + 1 == lines.size() || lines[at + 1].find("- ") != std::string::npos) return;
      if (lines[at + 1].size() <= dash + 2 || lines[at + 1][dash + 2] == ' ') return;
      broken[at + 1][dash] = '-';
    }
    broken.erase(broken.begin() + field.line - 1);
    const std::string problems = Problems(kind, Joined(broken));
    const bool said = problems.find(field.key + ": missing") != std::string::npos ||
                      problems.find("is missing; give") != std::string::npos ||
                      problems.find("must hold") != std::string::npos;
    ASSERT_EQ(said, field.required) << kind.name << " without " << lines[at] << "\n" << problems;
  });
}

TEST(Tables, AreDocumentedKeyByKey) {
  std::set<std::string> written;
  ForEveryField([&](const Kind&, const ListedField& field, const std::vector<std::string>&) {
    written.insert(field.key);
  });
  FieldList effects("rig", 0);
  RigFile rig = AllEffects();
  Describe(effects, rig);
  for (const ListedField& field : effects.fields()) written.insert(field.key);
  // What other rigs have: effects of gears, a rotor of given modes, coils on a voltage.
  for (RigFile other :
       {AllEffects(true), ModalRig(), LoadRig(FindConfig("two_magnet_levitator", "rigs"))}) {
    FieldList fields("rig", 0);
    Describe(fields, other);
    for (const ListedField& field : fields.fields()) written.insert(field.key);
  }
  const RigFile pump = ModalRig();
  FieldList blocks("controller", 0);
  ControllerFile law = StateSpaceController(pump.numbers);
  Describe(blocks, law, pump.numbers);
  FieldList poles("controller", 0);
  law.law.state_space = law::DiscretiseBlocks(*law.law.state_space, 50e-6);
  Describe(poles, law, pump.numbers);
  for (const FieldList& fields : {blocks, poles}) {
    for (const ListedField& field : fields.fields()) written.insert(field.key);
  }
  FieldList schedule("controller", 0);
  ControllerFile scheduled = FullController(FullRig().numbers);
  scheduled.law.schedule = {{1.0, scheduled.law.axes, {}}};
  Describe(schedule, scheduled, FullRig().numbers);
  for (const ListedField& field : schedule.fields()) written.insert(field.key);
  FieldList turning("controller", 0);
  ControllerFile synchronous = SynchronousController(FullRig().numbers);
  Describe(turning, synchronous, FullRig().numbers);
  for (const ListedField& field : turning.fields()) written.insert(field.key);
  FieldList events("scenario", 0);
  scenario::ScenarioConfig eventful = EventfulScenario(FullRig().numbers);
  Describe(events, eventful, FullRig().numbers);
  for (const ListedField& field : events.fields()) written.insert(field.key);
  // Geared rigs stand instead of a rotor: in every way to give the stiffness of their shafts.
  for (const char* name : {"geared_rotor_12dof", "rao_geared_pair"}) {
    for (std::size_t form = 0; form < 3; ++form) {
      FieldList fields("rig", form);
      RigFile geared = LoadRig(FindConfig(name, "rigs"));
      Describe(fields, geared);
      for (const ListedField& field : fields.fields()) written.insert(field.key);
    }
  }
  std::set<std::string> documented;
  for (const std::string& line : Lines(ConfigurationDocument())) {
    const bool scalar = line.starts_with("| `") && line.find("| group of") == std::string::npos &&
                        line.find("| list of") == std::string::npos && line[3] != '<';
    if (scalar) documented.insert(line.substr(3, line.find('`', 3) - 3));
  }
  const auto missing = [](const std::set<std::string>& from, const std::set<std::string>& in) {
    std::string keys;
    for (const std::string& key : in) {
      if (from.count(key) == 0) keys += " " + key;
    }
    return keys;
  };
  EXPECT_EQ(missing(documented, written), "") << "written and not documented";
  EXPECT_EQ(missing(written, documented), "") << "documented and never written";
}

/// Fields of an aggregate: the longest list of initialisers it takes.
struct Anything {
  template <class T>
  operator T() const {
    std::abort();
  }  // NOLINT(google-explicit-constructor): must convert by itself
};
template <class T, class... Initialisers>
constexpr std::size_t FieldCount() {
  if constexpr (requires { T{Initialisers{}..., Anything{}}; }) {
    return FieldCount<T, Initialisers..., Anything>();
  } else {
    return sizeof...(Initialisers);
  }
}

// A field added to one of these structs fails here: give it a row in the table, then count it.
TEST(Tables, KnowEveryFieldOfTheStructs) {
  EXPECT_EQ(FieldCount<RigNumbers>(), 17U);
  EXPECT_EQ(FieldCount<bias::BiasConfig>(), 5U);
  EXPECT_EQ(FieldCount<plant::PlantConfig>(), 14U);
  EXPECT_EQ(FieldCount<plant::BearingConfig>(), 9U);
  EXPECT_EQ(FieldCount<plant::MagnetConfig>(), 5U);
  EXPECT_EQ(FieldCount<plant::AmplifierConfig>(), 4U);
  EXPECT_EQ(FieldCount<plant::ExponentialForce>(), 3U);
  EXPECT_EQ(FieldCount<plant::VoltageDrive>(), 11U);
  EXPECT_EQ(FieldCount<plant::SensorConfig>(), 7U);
  EXPECT_EQ(FieldCount<plant::TouchdownConfig>(), 5U);
  EXPECT_EQ(FieldCount<plant::UnbalanceMass>(), 4U);
  EXPECT_EQ(FieldCount<plant::DriveConfig>(), 4U);
  EXPECT_EQ(FieldCount<rotor::RotorConfig>(), 8U);
  EXPECT_EQ(FieldCount<rotor::Material>(), 3U);
  EXPECT_EQ(FieldCount<rotor::Section>(), 3U);
  EXPECT_EQ(FieldCount<rotor::Disc>(), 4U);
  EXPECT_EQ(FieldCount<rotor::Ring>(), 5U);
  EXPECT_EQ(FieldCount<rotor::LumpedShaft>(), 9U);
  EXPECT_EQ(FieldCount<rotor::Support>(), 5U);
  EXPECT_EQ(FieldCount<rotor::TorsionInertia>(), 5U);
  EXPECT_EQ(FieldCount<gear::Wheel>(), 7U);
  EXPECT_EQ(FieldCount<gear::Harmonic>(), 3U);
  EXPECT_EQ(FieldCount<law::LawConfig>(), 5U);
  EXPECT_EQ(FieldCount<law::LawAtSpeed>(), 4U);
  EXPECT_EQ(FieldCount<law::AxisLawConfig>(), 6U);
  EXPECT_EQ(FieldCount<law::LeadLag>(), 2U);
  EXPECT_EQ(FieldCount<law::Notch>(), 4U);
  EXPECT_EQ(FieldCount<supervisor::SequenceConfig>(), 9U);
  EXPECT_EQ(FieldCount<supervisor::ProtectionConfig>(), 14U);
  EXPECT_EQ(FieldCount<scenario::Step>(), 9U);
  EXPECT_EQ(FieldCount<scenario::Excitation>(), 18U);
}

}  // namespace
}  // namespace levitas::configuration::test
