#pragma once
// The tables of the three kinds of file. Each Describe shows every field of a struct once; see
// visitor.hpp. What a table derives (channel names, ki -> force constant) is set by it too.

#include "configuration/rig_file.hpp"
#include "configuration/schema/visitor.hpp"

namespace levitas::configuration {

void Describe(Visitor& v, RigFile& rig);
/// `rig` gives the bearing and channel names, the period and the current limits.
void Describe(Visitor& v, ControllerFile& controller, const RigNumbers& rig);
/// `channels` may be empty when writing: the names then come from the scenario.
void Describe(Visitor& v, scenario::ScenarioConfig& scenario, const RigNumbers& rig);

// Parts, for the files that hold them.
void Describe(Visitor& v, rotor::RotorConfig& rotor, std::vector<plant::UnbalanceMass>& unbalance);
void Describe(Visitor& v, supervisor::SupervisorConfig& supervisor);
void Describe(Visitor& v, plant::MagnetConfig& magnet);
void Describe(Visitor& v, plant::AmplifierConfig& amplifier);
/// Geared shafts and their gears, which stand instead of a rotor.
void DescribeTrain(Visitor& v, plant::PlantConfig& plant);
/// "shaft", counted from 1 in files and from 0 in the program.
void DescribeShaftNumber(Visitor& v, const plant::PlantConfig& plant, std::size_t& shaft);
/// Refuses a plane that the shaft does not have; silent without shafts.
void RefuseBesideShaft(Visitor& v, const plant::PlantConfig& plant, std::size_t shaft, double z_m,
                       std::string_view key);
void Describe(Visitor& v, gpio::LinesConfig& lines, double period_s);
void DescribeTolerances(Visitor& v, std::optional<Tolerances>& tolerances);
/// The list of effects; needs the names in rig.numbers.
void DescribeEffects(Visitor& v, RigFile& rig);
void Describe(Visitor& v, law::StateSpaceConfig& law, const RigNumbers& rig);
void Describe(Visitor& v, synchronous::SynchronousConfig& control, const RigNumbers& rig);
void Describe(Visitor& v, bias::BiasConfig& bias, const RigNumbers& rig);
void Describe(Visitor& v, scenario::Excitation& excitation, const RigNumbers& rig);
/// Takes a signal of channel: all apart into one for each axis of the rig.
void SpreadOverAxes(std::vector<scenario::Excitation>& excitations, const RigNumbers& rig);
/// Hold time, test signals and orbit limit of a step.
void DescribeExcitations(Visitor& v, scenario::Step& step, const RigNumbers& rig);
void Describe(Visitor& v, ScheduledRigEvent& event, const RigNumbers& rig);
/// An axis of the rig by its channel's name, under any key.
void DescribeAxis(Visitor& v, std::string_view key, std::string_view meaning, const RigNumbers& rig,
                  std::size_t& axis);
/// true or false; left out: false.
void DescribeSwitch(Visitor& v, std::string_view key, std::string_view meaning, bool& on);
/// Reads and writes the channel of something that a scenario does to one axis.
void DescribeChannel(Visitor& v, const RigNumbers& rig, std::string& channel, std::size_t& axis);
/// Refuses a plane beyond the end of the shaft; silent while the shaft itself is not known.
void RefuseBeyondShaft(Visitor& v, const rotor::RotorConfig& rotor, double z_m,
                       std::string_view key);

}  // namespace levitas::configuration
