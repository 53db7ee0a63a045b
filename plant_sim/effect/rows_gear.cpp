// Catalogue: the teeth between geared shafts. The force law is gear::MeshLaw.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr std::array kToothStiffness{
    Parameter{"stiffness", "n_per_m", "n_per_m", 1.0, 1e12, 0.7, kOwn, Scaling::kLinear,
              std::nullopt, "mean stiffness of the mesh", false},
    Parameter{"damping", "n_s_per_m", "n_s_per_m", 0.0, 1e9, 0.8, kOwn, Scaling::kLinear,
              std::nullopt, "damping of the mesh", false}};

constexpr std::array kVariation{
    Parameter{"order", "", "", 1.0, 100.0, 1.0, 1.0, Scaling::kFixed, 1.0, "times the mesh", true},
    Parameter{"amplitude", "", "", 0.0, 0.9, 0.2, 0.0, Scaling::kLinear, std::nullopt,
              "share of the mean stiffness", false},
    Phase("at engagement angle 0")};

constexpr std::array kBacklashGap{Parameter{"gap", "m", "um", 0.0, 5e-3, 40e-6, 0.0,
                                            Scaling::kLinear, std::nullopt,
                                            "whole gap along the line of action", false}};

constexpr std::array kFriction{Parameter{"coefficient", "", "", 0.0, 1.0, 0.1, 0.0,
                                         Scaling::kLinear, std::nullopt,
                                         "Coulomb coefficient of the sliding flanks", false}};

constexpr std::array kError{
    Parameter{"order", "", "", -100.0, 100.0, 1.0, 1.0, Scaling::kFixed, std::nullopt,
              "times the mesh; negative: backward, 0: mean", true},
    Parameter{"amplitude", "m", "um", 0.0, 1e-2, 10e-6, 0.0, Scaling::kLinear, std::nullopt,
              "of this harmonic, added to what the rig has", false},
    Phase("at engagement angle 0")};

constexpr std::array kEccentricity{
    Parameter{"amplitude", "m", "um", 0.0, 1e-2, 30e-6, 0.0, Scaling::kLinear, std::nullopt,
              "of the pitch circle off the shaft's axis, added to what the rig has", false},
    Phase("its direction in the wheel, from x towards y at angle 0")};

constexpr std::array kToothCrack{
    Parameter{"depth", "", "", 0.0, 1.0, 0.5, 0.0, Scaling::kLinear, std::nullopt,
              "share of the stiffness lost while the tooth carries alone", false},
    Parameter{"tooth", "", "", 0.0, 10000.0, 0.0, 0.0, Scaling::kFixed, 0.0,
              "0: the one in mesh at angle 0", true}};

constexpr std::array kGearRows{
    Row{Id::kMeshStiffness, "mesh_stiffness", Place::kGear, Scope::kGear, kToothStiffness,
        "mean stiffness and damping of the teeth differ from the drawing's",
        "f = stiffness delta + damping delta'",
        "moves the modes in which the wheels move against each other; a line of the transmission "
        "error pushes with k e, so it scales with k below them",
        "Ozguven & Houser 1988, J. Sound Vib. 121(3) 383",
        Facts{.needs_rotation = true, .shows_in = Shows::kGearMesh}},
    Row{Id::kMeshStiffnessVariation, "mesh_stiffness_variation", Place::kGear, Scope::kGear,
        kVariation, "the stiffness varies as teeth come into and out of contact",
        "k(t) = k [1 + amplitude cos(order mesh angle + phase)]",
        "multiplies delta: sum and difference of order x mesh and every line there is; a static "
        "load alone shows as a line at order x mesh",
        "Kahraman & Singh 1991, J. Sound Vib. 146(1) 135",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kGearMesh}},
    Row{Id::kBacklash, "backlash", Place::kGear, Scope::kGear, kBacklashGap,
        "no mesh force within the gap between the flanks",
        "f = k d max(0, 1 - (gap/2)/|d|) + c d' while the teeth touch,  d = delta + n (F0/k + "
        "gap/2)",
        "nothing while the load keeps the teeth in contact; beyond, free flight and impacts: "
        "harmonics and sub-harmonics of the mesh",
        "Kahraman & Singh 1990, J. Sound Vib. 142(1) 49",
        Facts{.needs_rotation = true, .shows_in = Shows::kGearMesh}},
    Row{Id::kMeshFriction, "mesh_friction", Place::kGear, Scope::kGear, kFriction,
        "the flanks slide on each other, one way before the pitch point, the other way behind it",
        "f += coefficient N sign(sliding) j n",
        "force across the line of action, in proportion to the load, a square wave over the mesh: "
        "odd mesh harmonics",
        "Vaishya & Singh 2001, J. Sound Vib. 248(4) 671",
        Facts{.needs_rotation = true, .shows_in = Shows::kGearMesh}},
    Row{Id::kTransmissionError, "transmission_error", Place::kGear, Scope::kGear, kError,
        "a harmonic of the transmission error that the model lacks",
        "e(t) += amplitude e^(j (order mesh angle + phase))",
        "one line of the full spectrum at order x mesh, on its side only: forward or backward",
        "Ozguven & Houser 1988, J. Sound Vib. 121(3) 383",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kGearMesh}},
    Row{Id::kGearRunout, "gear_runout", Place::kGear, Scope::kGear, kEccentricity,
        "the pitch circle is eccentric on its shaft, and with it the wheel's mass",
        "delta += amplitude e^(j (angle + phase));  unbalance eccentric_mass x amplitude",
        "one line at the wheel's own rotation, in its sense: forward for the first shaft, backward "
        "for the one it turns",
        "Smith 2003, Gear Noise and Vibration, 2nd ed., ch. 2",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kGearMesh}},
    Row{Id::kToothCrack, "tooth_crack", Place::kGear, Scope::kGear, kToothCrack,
        "a tooth with a cracked root carries less, once per turn of its wheel",
        "k(t) = k [1 - depth w],  w a Hann window one pitch to either side of the tooth",
        "a pulse once per turn: lines at multiples of the wheel's rotation, side bands of the mesh "
        "at that spacing",
        "Chaari, Fakhfakh & Haddar 2009, Eur. J. Mech. A/Solids 28(3) 461",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kGearMesh}},
};

static_assert(AreAtTheirPlaces(kGearRows));

}  // namespace

std::span<const Row> GearRows() { return kGearRows; }

}  // namespace levitas::effect
