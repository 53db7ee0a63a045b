// Words of the workshop: rotor, supports, what acts from outside, gears.
#include <array>

#include "plant_sim/effect/workshop.hpp"

namespace levitas::effect {
namespace {

using enum SizeForm;
using enum Yardstick;
using enum Stop;

constexpr std::array kMechanics{
    Words{"unbalance", "Unbalance", "", "moment", kPlain, "", kBalance, kIfSevere,
          "A force at every turn that grows with the square of speed.",
          "Look for deposits, a lost part, a loose fit; then balance (amb balance)."},
    Words{"shaft_bow", "Bent shaft", "", "amplitude", kPlain, "of bend", kClearance, kIfSevere,
          "The shaft runs out at every speed, most near its bending mode.",
          "Measure the run-out at slow roll along the shaft; look for heat on one side, a rub, "
          "sag from long standing; straighten, or warm through at slow roll."},
    Words{"shaft_anisotropy", "Shaft is stiffer in one direction", "", "ratio", kPercent,
          "of its stiffness", kNone, kIfSevere,
          "It shakes twice a turn under its weight, and can be unstable at half a critical speed.",
          "Check keyways, flats and a crack that does not close; keep clear of half the critical "
          "speed."},
    Words{"modal_frequency", "A bending mode lies elsewhere", "", "frequency", kPlain, "", kNone,
          kIfSevere, "Notches and lead of the law act at the wrong frequency.",
          "Identify the modes (amb identify modal); if it fell since, look for a loose fit or a "
          "crack; design the law for the true frequency."},
    Words{
        "modal_damping", "A bending mode is damped otherwise", "", "damping_ratio", kPlain, "",
        kNone, kRunOn, "Its resonance is higher, or lower, than designed for.",
        "Identify the modes (amb identify modal); check fits and shrunk parts; correct the file."},
    Words{"gyroscopic_inertia", "Polar inertia is larger than the file says",
          "Polar inertia is smaller than the file says", "ratio", kOff, "", kNone, kRunOn,
          "Whirl frequencies split otherwise with speed than designed for.",
          "Check discs and impellers of the rotor against the rig file."},
    Words{
        "internal_damping", "Loose or rubbing fit in the rotor", "", "damping", kPlain, "", kNone,
        kIfSevere,
        "It drives forward whirl above the critical speed: unstable without a warning in slow "
        "running.",
        "Do not run faster; check shrink fits, couplings, splines and stacked parts of the rotor."},
    Words{"rotor_mass", "Rotor is heavier than the file says",
          "Rotor is lighter than the file says", "ratio", kOff, "", kNone, kRunOn,
          "The loop has another gain, and the bias current carries another weight.",
          "Weigh the rotor with all that turns with it (coupling half, wheel); correct the file."},
    Words{"breathing_crack", "Crack in the shaft", "", "depth", kPercent, "of the diameter deep",
          kGrows, kAtOnce, "It grows with every turn until the shaft breaks.",
          "Do not run up again. Test the shaft for cracks (dye, ultrasound) at this place first: "
          "fillets, keyways, shrink fits."},
    Words{"misalignment", "Coupling is misaligned", "", "force", kPlain, "", kNone, kIfSevere,
          "A force at a multiple of rotation, of the same size at every speed; wears the coupling.",
          "Align motor and rotor (laser or dial gauge, warm), check the coupling for wear."},
    Words{"coupling_stiffness", "A spring holds the shaft", "", "direct", kPlain, "", kNone, kRunOn,
          "The rotor is held more stiffly than designed, and its lowest modes move.",
          "Check coupling, hoses, cables and seals that touch the shaft; enter it in the file."},
    Words{"cross_coupled_stiffness", "A seal or impeller drives whirl", "", "stiffness", kPlain, "",
          kNone, kIfSevere, "It takes damping from forward whirl: unstable above a load or speed.",
          "Do not raise load or speed; check seal clearances, swirl brakes and the flow."},
    Words{"static_load", "A constant force on the shaft", "", "force", kPlain, "", kNone, kIfSevere,
          "It uses up force of the bearing and heats one coil.",
          "Check belt tension, pull of the motor, how level the machine stands."},
    Words{"support_mode", "Bearing housing moves on its support", "", "frequency", kPlain, "",
          kNone, kIfSevere,
          "The law pushes on a support that gives way: damping is lost near its mode.",
          "Check foundation bolts, feet and grouting of this bearing (tap it, torque wrench)."},
    Words{"touchdown_rub", "Shaft rubs on a ring", "", "clearance", kPlain, "of play", kGrows,
          kAtOnce, "Heat and wear at the contact; it can pull the rotor into backward whirl.",
          "Do not run up again. Check touchdown bearing, seals and labyrinths for marks, and the "
          "clearance all round."},
    Words{"mesh_stiffness", "Teeth are not as stiff as the file says", "", "stiffness", kPlain, "",
          kNone, kRunOn, "Modes in which the wheels move against each other lie elsewhere.",
          "Check contact pattern, face width and material of the wheels; correct the file."},
    Words{"mesh_stiffness_variation", "Stiffness of the teeth varies over the mesh", "",
          "amplitude", kPercent, "of the mean", kNone, kRunOn, "Whine, and forces at the mesh.",
          "Check contact ratio, tip relief and the contact pattern of the wheels."},
    Words{"backlash", "Play between the teeth", "", "gap", kPlain, "", kNone, kIfSevere,
          "Without load the teeth hammer: impacts wear them.",
          "Measure the play with a dial gauge, over one turn; keep a load on the gears."},
    Words{"mesh_friction", "Teeth slide dry", "", "coefficient", kPlain, "", kNone, kIfSevere,
          "Heat and scuffing of the flanks.",
          "Check the lubricant (amount, kind, temperature) and the flanks for scuffing."},
    Words{"transmission_error", "Teeth are cut or mounted unevenly", "", "amplitude", kPlain, "",
          kNone, kRunOn, "A whine at the mesh, and a force in both shafts.",
          "Measure profile and pitch of the wheels; check their seats."},
    Words{"gear_runout", "Gear wheel runs out of true", "", "amplitude", kPlain, "", kNone, kRunOn,
          "Once per turn of this wheel the teeth are pressed, and let go.",
          "Measure the run-out of its pitch circle; check seat, key and shaft below it."},
    Words{"tooth_crack", "Cracked tooth", "", "depth", kPercent, "of its stiffness lost", kGrows,
          kAtOnce, "It breaks off, and the pieces go through the mesh.",
          "Do not run up again. Look at the roots of this wheel's teeth (dye, lens)."},
};

}  // namespace

std::span<const Words> WordsOfMechanics() { return kMechanics; }

}  // namespace levitas::effect
