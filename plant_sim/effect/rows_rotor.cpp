// Catalogue: rotor.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr std::array kUnbalance{
    Plane(std::nullopt, 0.3),
    Parameter{"moment", "kg_m", "g_mm", 0.0, 10.0, 20e-6, 0.0, Scaling::kLinear, std::nullopt,
              "mass times eccentricity, added to the rig's", false},
    Phase("direction in the rotor, from x towards y at angle 0")};

constexpr std::array kBow{
    Parameter{"amplitude", "m", "um", 0.0, 0.01, 20e-6, 0.0, Scaling::kLinear, std::nullopt,
              "largest deflection of the bent shaft, in the shape of the mode", false},
    Phase("direction in the rotor, from x towards y at angle 0")};

constexpr std::array kAnisotropy{
    Parameter{"ratio", "", "", 0.0, 0.5, 0.05, 0.0, Scaling::kLinear, std::nullopt,
              "(k_stiff - k_soft)/(k_stiff + k_soft) of the bending stiffness", false},
    Phase("direction of the stiff axis in the rotor")};

constexpr std::array kFrequency{Parameter{"frequency", "hz", "hz", 0.1, 1e6, 1.05, kOwn,
                                          Scaling::kGeometric, std::nullopt,
                                          "of the free rotor at rest", false}};
constexpr std::array kDamping{Parameter{"damping_ratio", "", "", 0.0, 0.9, 5.0, kOwn,
                                        Scaling::kLinear, std::nullopt, "of the mode", false}};

constexpr std::array kGyroscopic{Ratio(0.0, 5.0, 1.5, "polar inertia over its nominal value")};

constexpr std::array kInternal{
    Plane(std::nullopt, 0.3),
    Parameter{"damping", "n_s_per_m", "n_s_per_m", 0.0, 1e6, 20.0, 0.0, Scaling::kLinear,
              std::nullopt, "rotating damping of the bending at this plane", false}};

constexpr std::array kMass{Ratio(0.2, 5.0, 1.1, "mass of the rigid rotor over its nominal value")};

constexpr std::array kCrack{
    Plane(std::nullopt, 0.25),
    Parameter{"depth", "", "", 0.0, 0.5, 0.3, 0.0, Scaling::kLinear, std::nullopt,
              "of the crack, as a share of the shaft's diameter", false},
    Phase("direction of the crack in the rotor, from x towards y at angle 0")};

constexpr std::array kRotorRows{
    Row{Id::kUnbalance, "unbalance", Place::kRotor, Scope::kRig, kUnbalance,
        "mass eccentricity differs from nominal", "f(z) = moment W^2 e^(j(W t + phase))",
        "forward line at 1 x rotation, force proportional to speed squared",
        "Genta 2005, Dynamics of Rotating Systems, ch. 2; ISO 21940-11",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kSpectrum}},
    Row{Id::kShaftBow, "shaft_bow", Place::kRotor, Scope::kMode, kBow,
        "the shaft is bent even without load",
        "q'' + 2 zeta w q' + w^2 (q - b e^(j(angle + phase))) = ...",
        "forward line at 1 x rotation whose deflection does not vanish at low speed",
        "Nicholas, Gunter & Allaire 1976, ASME J. Eng. Power 98(2) 171",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kSpectrum}},
    Row{Id::kShaftAnisotropy, "shaft_anisotropy", Place::kRotor, Scope::kRig, kAnisotropy,
        "bending stiffness differs in two axes that turn with the rotor",
        "n_i = -ratio w_i^2 conj(q_i) e^(2j(angle + phase)) on every flexible mode",
        "forward line at 2 x rotation under a static load (weight)",
        "Tondl 1965, Some Problems of Rotor Dynamics; Genta 2005, ch. 6",
        Facts{.needs_rotation = true, .shows_in = Shows::kSpectrum, .modes = Modes::kTurning}},
    Row{Id::kModalFrequency, "modal_frequency", Place::kRotor, Scope::kMode, kFrequency,
        "a flexible mode lies elsewhere", "w_i = 2 pi frequency",
        "poles of one mode move; damping ratio and shape unchanged",
        "Ewins 2000, Modal Testing, 2nd ed., ch. 2",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheRotor}},
    Row{Id::kModalDamping, "modal_damping", Place::kRotor, Scope::kMode, kDamping,
        "a flexible mode is damped otherwise", "zeta_i = damping_ratio",
        "width of one peak; frequency and shape unchanged",
        "Ewins 2000, Modal Testing, 2nd ed., ch. 2",
        Facts{.shows_in = Shows::kResponse, .modes = Modes::kOnTheRotor}},
    Row{Id::kGyroscopicInertia, "gyroscopic_inertia", Place::kRotor, Scope::kRig, kGyroscopic,
        "the polar inertia is wrong", "G = ratio G_nominal",
        "split of forward and backward whirl, proportional to speed; nothing at rest",
        "Genta 2005, Dynamics of Rotating Systems, ch. 4",
        Facts{.needs_rotation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheRotor}},
    Row{Id::kInternalDamping, "internal_damping", Place::kRotor, Scope::kRig, kInternal,
        "damping that turns with the rotor",
        "f(z) = -damping (r_bend' - j W r_bend),  r_bend = flexible modes alone",
        "damps below, drives forward whirl above the critical speed: unstable from "
        "W = w (1 + 2 zeta w/(damping phi^2))",
        "Kimball 1924, General Electric Review 27; Genta 2005, ch. 2",
        Facts{.repeats = true,
              .needs_rotation = true,
              .shows_in = Shows::kResponse,
              .modes = Modes::kOnTheRotor}},
    Row{Id::kRotorMass, "rotor_mass", Place::kRotor, Scope::kRig, kMass,
        "the mass of the rotor is wrong", "rigid modes: shape / sqrt(ratio), weight x ratio",
        "rigid-body line 1/(ratio m s^2) and weight; flexible modes unchanged",
        "Ewins 2000, Modal Testing, 2nd ed., ch. 2 (mass line)",
        Facts{.shows_in = Shows::kResponse, .modes = Modes::kOnTheRotor}},
    Row{Id::kBreathingCrack, "breathing_crack", Place::kRotor, Scope::kRig, kCrack,
        "a transverse crack opens and closes once per turn as the weight bends the shaft",
        "softening S g/(1 + S g R) of the curvature across the crack, S = c (E I)^2, R = sum of "
        "k_i^2/w_i^2 over the modes, g = (1 + cos(angle + phase - gravity))/2, "
        "c = 6 pi (1 - nu^2) d P(depth)/(E I)",
        "lines at 1, 2 and 3 x rotation under a static load, side bands of resonances",
        "Gasch 1993, J. Sound Vib. 160(2) 313; compliance: Chondros, Dimarogonas & Yao 1998, "
        "J. Sound Vib. 215(1) 17",
        Facts{.repeats = true,
              .needs_rotation = true,
              .shows_in = Shows::kSpectrum,
              .modes = Modes::kTurning}},
};

static_assert(AreAtTheirPlaces(kRotorRows));

}  // namespace

std::span<const Row> RotorRows() { return kRotorRows; }

}  // namespace levitas::effect
