#include "diagnosis/report/separations.hpp"

#include <algorithm>
#include <array>

namespace levitas::diagnosis {
namespace {

using effect::Id;

/// Pairs of similar effects, and the record that separates them.
struct Pair {
  Id first;
  Id second;
  const char* record;
};

constexpr std::array kPairs{
    Pair{Id::kUnbalance, Id::kShaftBow,
         "a run-up over at least a factor of two in speed: unbalance "
         "grows with the square of speed, a bow does not"},
    Pair{Id::kUnbalance, Id::kSensorRunout,
         "a slow roll and a run-up: run-out stays as it is at low "
         "speed, unbalance vanishes"},
    Pair{Id::kSensorRunout, Id::kMisalignment,
         "a run-up through a bending mode: only a force excites it"},
    Pair{Id::kCurrentGain, Id::kSensorGain,
         "a record of the healthy rig or a known weight "
         "hung on the shaft"},
    Pair{Id::kCurrentGain, Id::kDisplacementStiffness,
         "standing with a test signal at two bias currents"},
    Pair{Id::kCurrentGain, Id::kForceConstant,
         "standing with a test signal at two bias currents: only a force "
         "constant changes the negative stiffness"},
    Pair{Id::kCommandOffset, Id::kStaticLoad,
         "two bias currents: the force of an offset current grows with the "
         "bias, a load stays"},
    Pair{Id::kExtraDelay, Id::kAmplifierBandwidth, "standing with a test signal rich above 500 Hz"},
    Pair{Id::kExtraDelay, Id::kEddyCurrent, "standing with a test signal rich above 500 Hz"},
    Pair{Id::kEddyCurrent, Id::kAmplifierBandwidth,
         "standing with measured coil currents, or a test "
         "signal rich above 500 Hz"},
    Pair{Id::kSensorOffset, Id::kStaticLoad,
         "two bias currents: an offset's force grows with the bias "
         "squared, a load stays"},
    Pair{Id::kMainsPickup, Id::kSensorRunout, "another speed: mains stay at their frequency"}};

constexpr std::array kOfTheLoop{Id::kExtraDelay, Id::kEddyCurrent, Id::kAmplifierBandwidth,
                                Id::kSensorBandwidth, Id::kAmplifierSlew};

}  // namespace

std::string_view SeparatingRecord(Id cause, const std::vector<Id>& others) {
  const auto has = [&others](Id id) {
    return std::find(others.begin(), others.end(), id) != others.end();
  };
  for (const Pair& pair : kPairs) {
    if ((cause == pair.first && has(pair.second)) || (cause == pair.second && has(pair.first))) {
      return pair.record;
    }
  }
  return {};
}

bool NeedsFastSignal(Id id) {
  return std::find(kOfTheLoop.begin(), kOfTheLoop.end(), id) != kOfTheLoop.end();
}

}  // namespace levitas::diagnosis
