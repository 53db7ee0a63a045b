// Catalogue: timing and amplifiers.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr std::array kExtraDelay{
    Parameter{"delay", "s", "us", 0.0, 5e-3, 40e-6, 0.0, Scaling::kLinear, std::nullopt,
              "added to the delay of the rig, fractions of a sample included", false}};

constexpr std::array kDropped{
    Parameter{"probability", "", "", 0.0, 0.5, 0.01, 0.0, Scaling::kLinear, std::nullopt,
              "that a burst begins with a frame", false},
    Parameter{"burst_samples", "", "", 1.0, 1000.0, 1.0, 1.0, Scaling::kFixed, 1.0,
              "frames lost in a row", true}};

constexpr std::array kJitter{Parameter{"deviation", "s", "us", 0.0, 1e-3, 5e-6, 0.0,
                                       Scaling::kLinear, std::nullopt,
                                       "standard deviation of the sampling instant", false}};

constexpr std::array kBandwidth{Parameter{"bandwidth", "hz", "hz", 10.0, 1e5, 0.7, kOwn,
                                          Scaling::kGeometric, std::nullopt,
                                          "-3 dB of the first-order current loop", false}};

constexpr std::array kSlew{Parameter{"slew", "a_per_s", "a_per_s", 1.0, 1e8, 150.0, kNever,
                                     Scaling::kInverse, std::nullopt,
                                     "most a coil current can change per second", false}};

constexpr std::array kLoopRows{
    Row{Id::kExtraDelay, "extra_delay", Place::kTiming, Scope::kRig, kExtraDelay,
        "the current acts later than the model says, by any fraction of a sample",
        "i(t) = u(t - T_rig - delay)",
        "phase -2 pi f delay on every actuator channel; gain unchanged",
        "Franklin, Powell & Workman 1998, Digital Control of Dynamic Systems, 3rd ed., ch. 4",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kDroppedSamples, "dropped_samples", Place::kTiming, Scope::kRig, kDropped,
        "some sensor frames never arrive, so the last current is held",
        "u[n] = u[n-1] during a burst; a burst begins with probability p",
        "current held for whole periods at random; share of held periods p L/(1 + p (L - 1))",
        "Nilsson 1998, Real-Time Control Systems with Delays (thesis, Lund), ch. 5",
        Facts{.shows_in = Shows::kSpectrum}},
    Row{Id::kSampleJitter, "sample_jitter", Place::kTiming, Scope::kRig, kJitter,
        "sampling instants scatter about the grid",
        "reading = s(t) + d s'(t),  d normal, the same for all channels of a frame",
        "broadband error of rms deviation x rate: grows with frequency of the motion",
        "Da Dalt et al. 2002, IEEE Trans. Circuits Syst. I 49(9) 1354",
        Facts{.shows_in = Shows::kSpectrum}},
    Row{Id::kAmplifierBandwidth, "amplifier_bandwidth", Place::kAmplifier, Scope::kChannels,
        kBandwidth, "the current loop is slower or faster than nominal",
        "i/u = 1/(1 + s/(2 pi bandwidth))",
        "gain and phase of the actuator above the bandwidth; static gain unchanged",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kAmplifierSlew, "amplifier_slew", Place::kAmplifier, Scope::kChannels, kSlew,
        "the supply voltage limits how fast a coil current can change", "|di/dt| <= slew",
        "amplitude-dependent: odd harmonics and lag once 2 pi f i exceeds slew",
        "Maslen, Hermann, Scott & Humphris 1989, ASME J. Tribology 111(2) 331",
        Facts{.shows_in = Shows::kForce}},
};

static_assert(AreAtTheirPlaces(kLoopRows));

}  // namespace

std::span<const Row> LoopRows() { return kLoopRows; }

}  // namespace levitas::effect
