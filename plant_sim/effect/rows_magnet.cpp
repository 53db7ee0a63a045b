// Catalogue: magnets.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr std::array kCurrentGain{Ratio(0.1, 3.0, 0.8, "ki over its nominal value")};
constexpr std::array kForce{Ratio(0.1, 3.0, 0.85, "k over its nominal value")};
constexpr std::array kStiffness{Ratio(0.0, 5.0, 1.25, "ks over its nominal value")};
constexpr std::array kAsymmetry{
    Ratio(0.2, 5.0, 1.2, "force constant of the coil towards + over that of the opposed one")};

constexpr std::array kSaturation{
    Parameter{"knee", "a", "a", 0.01, 1e4, 1.3, kNever, Scaling::kInverse, std::nullopt,
              "coil current at which the iron bends the characteristic", false},
    Parameter{"exponent", "", "", 1.0, 20.0, 4.0, 4.0, Scaling::kFixed, 4.0,
              "sharpness of the bend", false}};

constexpr std::array kHysteresis{
    Parameter{"width", "a", "a", 0.0, 1.0, 0.03, 0.0, Scaling::kLinear, std::nullopt,
              "half width of the loop, in control current", false},
    Parameter{"shape", "", "", 0.0, 2.0, 1.0, 1.0, Scaling::kFixed, 1.0,
              "0 = play (a parallelogram), 1 = exponential approach", false}};

constexpr std::array kEddy{
    Parameter{"tau", "s", "us", 0.0, 0.1, 50e-6, 0.0, Scaling::kLinear, std::nullopt,
              "diffusion time of the flux", false},
    Parameter{"displacement_share", "", "", 0.0, 1.0, 1.0, 1.0, Scaling::kFixed, 1.0,
              "of the force of displacement that lags too: 0 where only the current is delayed",
              false}};

constexpr std::array kRotation{Parameter{"angle", "rad", "deg", -45.0 * kDegree, 45.0 * kDegree,
                                         5.0 * kDegree, 0.0, Scaling::kLinear, std::nullopt,
                                         "from x towards y", false}};

constexpr std::array kOffset{Parameter{"offset", "a", "a", -10.0, 10.0, 0.12, 0.0, Scaling::kLinear,
                                       std::nullopt,
                                       "control current at a command of zero, towards +", false}};

constexpr std::array kCoupling{Parameter{"ratio", "", "", -0.5, 0.5, 0.08, 0.0, Scaling::kLinear,
                                         std::nullopt,
                                         "force across per force along the current's axis", false}};

constexpr std::array kMagnetRows{
    Row{Id::kCurrentGain, "current_gain", Place::kAmplifier, Scope::kChannels, kCurrentGain,
        "the force per control current differs from nominal", "F = F_nominal(ratio ic, x)",
        "every response to current scaled by ratio; ks, the limits of the coils and all else "
        "unchanged",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 4",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kCommandOffset, "command_offset", Place::kAmplifier, Scope::kChannels, kOffset,
        "the amplifier's zero: a constant is added to every command",
        "coil command = i0 +- (ic + offset)",
        "a static force ki offset that the law's integrator cancels with a command of -offset; "
        "with currents off it is gone",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3", Facts{.shows_in = Shows::kSpectrum}},
    Row{Id::kDisplacementStiffness, "displacement_stiffness", Place::kMagnet, Scope::kChannels,
        kStiffness, "the negative stiffness of the magnet differs from nominal",
        "F = F_nominal(ic, x) + (ratio - 1) ks x",
        "low-frequency response and rigid poles; ki unchanged",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 4",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kForceConstant, "force_constant", Place::kMagnet, Scope::kChannels, kForce,
        "the constant of the force law differs from nominal: pole area, turns, leakage",
        "F = ratio F_nominal(ic, x)",
        "ki and ks scaled by the same ratio, so the magnet's share of every response",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 4",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kCoilAsymmetry, "coil_asymmetry", Place::kMagnet, Scope::kChannels, kAsymmetry,
        "the two opposed coils differ",
        "F = k [(1 + a) (i+/(s0 - x))^2 - (1 - a) (i-/(s0 + x))^2],  a = (ratio - 1)/(ratio + 1)",
        "static pull a ki i0/2 towards the stronger coil and a force 2 a k ic^2/s0^2 of even "
        "order; "
        "ki and ks unchanged",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 4",
        Facts{.shows_in = Shows::kForce, .modes = Modes::kOnTheLoop}},
    Row{Id::kMagneticSaturation, "magnetic_saturation", Place::kMagnet, Scope::kChannels,
        kSaturation, "the force grows more slowly than the square of the current above a knee",
        "each coil: i -> i/(1 + (i/knee)^n)^(1/n)",
        "third-order compression of the force; smaller ki at the bias current, odd harmonics",
        "Froelich's law for n = 1; Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3",
        Facts{.shows_in = Shows::kForce, .modes = Modes::kOnTheLoop}},
    Row{Id::kHysteresis, "hysteresis", Place::kMagnet, Scope::kChannels, kHysteresis,
        "the force lags the current by a loop that does not depend on the rate",
        "ic -> ic - width z,  dz/d ic = (1/width) ((1 - z sign(d ic))/2)^shape,  |z| <= 1",
        "phase lag that does not grow with frequency and falls with amplitude; odd harmonics; "
        "remanence",
        "Dahl 1968, Aerospace Corp. TOR-158; Coleman & Hodgdon 1986, Int. J. Eng. Sci. 24(6) 897; "
        "play for shape 0: Krasnosel'skii & Pokrovskii 1989",
        Facts{.shows_in = Shows::kForce, .modes = Modes::kOnTheLoop}},
    Row{Id::kEddyCurrent, "eddy_current", Place::kMagnet, Scope::kChannels, kEddy,
        "the flux lags current and displacement by a diffusion law of half order",
        "F = (ki ic + share ks x)/(1 + sqrt(s tau)) + (1 - share) ks x",
        "gain falls by 10 dB per decade and phase tends to -45 degrees; static force unchanged; "
        "the lag of ks x adds damping",
        "Zhu, Knospe & Maslen 2005, IEEE Trans. Magnetics 41(4) 1248",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kMagneticCoupling, "magnetic_coupling", Place::kMagnet, Scope::kBearing, kCoupling,
        "a shared yoke: the current of one axis makes force in the other",
        "Fx += ratio ki icy,  Fy += ratio ki icx",
        "cross response x to y and y to x of the same sign, where a rotation has opposite ones; "
        "none of displacement",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kAxisRotation, "axis_rotation", Place::kMagnet, Scope::kBearing, kRotation,
        "the axes of magnets or sensors are turned: x acts on, or reads, a little of y",
        "magnet: F = R(angle) F_nominal(ic, R(-angle) r);  sensor: reading = R(-angle) r",
        "cross response x to y of sin(angle), opposite in sign to y to x; direct one cos(angle)",
        "ISO 14839-1; Schweitzer & Maslen 2009, Magnetic Bearings, ch. 7",
        Facts{.shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
};

static_assert(AreAtTheirPlaces(kMagnetRows));

}  // namespace

std::span<const Row> MagnetRows() { return kMagnetRows; }

}  // namespace levitas::effect
