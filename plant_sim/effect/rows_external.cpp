// Catalogue: what acts on the rotor from outside, and the supports.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr Parameter Signed(std::string_view stem, std::string_view unit, double most, double clear,
                           std::optional<double> fallback, std::string_view meaning) {
  return {stem, unit, unit, -most, most, clear, 0.0, Scaling::kLinear, fallback, meaning, false};
}

constexpr std::array kMisalignment{
    Plane(0.0, 0.0),
    Parameter{"order", "", "", -20.0, 20.0, 2.0, 2.0, Scaling::kFixed, 2.0,
              "times rotation; negative = a force that turns backward", true},
    Parameter{"force", "n", "n", 0.0, 1e6, 1.0, 0.0, Scaling::kLinear, 0.0, "of this order", false},
    Phase("at rotor angle 0, from x towards y"),
    Parameter{
        "rotation_error", "rad", "deg", 0.0, 5.0 * kDegree, 0.0, 0.0, Scaling::kLinear, 0.0,
        "of this order, of geared shafts: by how much the coupling turns its shaft on and back; "
        "a universal joint at angle a: tan^2(a/2) at order 2",
        false}};

constexpr std::array kCouplingStiffness{
    Plane(0.0, 0.0), Signed("direct", "n_per_m", 1e9, 2e4, std::nullopt, "stiffness in x and in y"),
    Signed("cross", "n_per_m", 1e9, 0.0, 0.0, "stiffness between x and y, symmetric"),
    Signed(
        "whirl", "n_per_m", 1e9, 0.0, 0.0,
        "stiffness across the deflection, as of cross_coupled_stiffness; positive drives forward "
        "whirl")};

constexpr std::array kCrossCoupled{Plane(std::nullopt, 0.3),
                                   Signed("stiffness", "n_per_m", 1e9, 5e3, std::nullopt,
                                          "kq of f = kq [-y, x]; positive drives forward whirl")};

constexpr std::array kStaticLoad{
    Plane(std::nullopt, 0.3), Signed("force_x", "n", 1e6, 5.0, 0.0, "constant force towards +x"),
    Signed("force_y", "n", 1e6, 0.0, 0.0, "constant force towards +y")};

constexpr std::array kSupport{
    Parameter{"mass", "kg", "kg", 1e-3, 1e6, 5.0, kNever, Scaling::kInverse, std::nullopt,
              "that moves with the bearing housing", false},
    Parameter{"frequency", "hz", "hz", 0.1, 1e5, 160.0, 160.0, Scaling::kFixed, std::nullopt,
              "of the housing on its spring, without the rotor", false},
    Parameter{"damping_ratio", "", "", 0.0, 0.9, 0.02, 0.02, Scaling::kFixed, 0.02,
              "of the housing on its spring", false}};

constexpr std::array kRub{
    Parameter{"clearance", "m", "um", 0.0, 5e-3, 20e-6, 20e-6, Scaling::kFixed, std::nullopt,
              "radial, in the plane of the magnet", false},
    Parameter{"stiffness", "n_per_m", "n_per_m", 0.0, 1e10, 2e5, 0.0, Scaling::kLinear,
              std::nullopt, "of the contact, radial", false},
    Parameter{"damping", "n_s_per_m", "n_s_per_m", 0.0, 1e6, 0.0, 0.0, Scaling::kLinear, 0.0,
              "of the contact, radial", false},
    Parameter{"friction", "", "", 0.0, 1.0, 0.1, 0.1, Scaling::kFixed, 0.1,
              "Coulomb coefficient of the sliding contact", false}};

constexpr std::array kExternalRows{
    Row{Id::kMisalignment, "misalignment", Place::kExternal, Scope::kRig, kMisalignment,
        "a misaligned coupling pushes at multiples of rotation",
        "f(z) = force e^(j(order angle + phase));  "
        "rotation += rotation_error cos(order angle + phase)",
        "one line at order x rotation, of constant force: +2 turns forward; -3 with 1 x unbalance "
        "makes a diamond orbit. Between geared shafts base radius x rotation_error adds to the "
        "transmission error: forward and backward alike",
        "Gibbons 1976, Proc. 5th Turbomachinery Symp. 111; Sekhar & Prabhu 1995, J. Sound Vib. "
        "185(4) 655; Seherr-Thoss, Schmelz & Aucktor 2006, Universal Joints and Driveshafts, "
        "2nd ed., ch. 1",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kSpectrum}},
    Row{Id::kCouplingStiffness, "coupling_stiffness", Place::kExternal, Scope::kRig,
        kCouplingStiffness, "a spring at the drive end",
        "f(z) = -[direct cross; cross direct] [x, y] + whirl [-y, x]",
        "raises (softens, if negative) the rigid modes; conservative without whirl, so that it "
        "then "
        "neither damps nor drives",
        "Genta 2005, Dynamics of Rotating Systems, ch. 4",
        Facts{.repeats = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheRotor}},
    Row{Id::kCrossCoupledStiffness, "cross_coupled_stiffness", Place::kExternal, Scope::kRig,
        kCrossCoupled, "a seal or an impeller pushes across the deflection", "f(z) = kq [-y, x]",
        "damping of a whirl at w changes by -kq phi^2/w forward and +kq phi^2/w backward; "
        "frequencies unchanged to first order",
        "Alford 1965, ASME J. Eng. Power 87(4) 333; Childs 1993, Turbomachinery Rotordynamics; "
        "API RP 684, whose sign it has",
        Facts{.repeats = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheRotor}},
    Row{Id::kStaticLoad, "static_load", Place::kExternal, Scope::kRig, kStaticLoad,
        "a constant force: belt, motor pull", "f(z) = [force_x, force_y]",
        "order 0 only: mean current or position of the loaded axes",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 4",
        Facts{.repeats = true, .shows_in = Shows::kSpectrum}},
    Row{Id::kSupportMode, "support_mode", Place::kSupport, Scope::kBearing, kSupport,
        "the bearing housing, magnet and sensor with it, moves on its own spring",
        "mass (u'' + 2 zeta w u' + w^2 u) = -F;  magnet and sensor see r - u",
        "an extra pair of modes (x and y) and an antiresonance at the frequency of the support",
        "Kirk & Gunter 1972, ASME J. Eng. Industry 94(1) 221",
        Facts{.shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kTouchdownRub, "touchdown_rub", Place::kSupport, Scope::kBearing, kRub,
        "contact with a ring inside the clearance",
        "d = |r| - clearance;  N = max(0, k d + c d'), T = -friction N sign(v) while d > 0",
        "no force below the clearance; above it harmonics and sub-harmonics, push against rotation",
        "Muszynska 1989, Shock Vib. Digest 21(3) 3",
        Facts{.repeats = true, .shows_in = Shows::kSpectrum}},
};

static_assert(AreAtTheirPlaces(kExternalRows));

}  // namespace

std::span<const Row> ExternalRows() { return kExternalRows; }

}  // namespace levitas::effect
