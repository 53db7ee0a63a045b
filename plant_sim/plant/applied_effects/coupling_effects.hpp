#pragma once
// Misaligned couplings of geared shafts: from the entries of a rig to what the time step uses.
//
// Which      an entry names a wheel; the coupling is the one of the shaft that carries it.
// Force      f = force e^(j (order shaft angle + phase)) on the shaft at z, (G17). The shaft's own
//            sense of rotation counts: a wheel that turns backwards carries it backwards.
// Rotation   error cos(order shaft angle + phase), counted like the twist of the shaft. A universal
//            joint at angle a, tan(out) = tan(in)/cos(a), departs by t = tan^2(a/2) twice a turn,
//            by t^2/2 four times, and so on (Seherr-Thoss, Schmelz & Aucktor 2006, ch. 1);
//            parallel offsets and shafts that are not parallel in the mesh do so once.
//   rigid    without inertias on springs the wheel has no rotation of its own: the machine behind
//            the coupling is taken as heavy, and base radius x error adds to the displacement of
//            the teeth, (G18).
//   twist    with them the error twists the spring between the wheel and its neighbour, towards the
//            drive for a driving wheel, away from it for a driven one, (G19): both sides give way
//            by their inertias, which a displacement of the teeth would leave out for the wheel.
// Units      SI. Thread: any; Apply writes the train alone and allocates nothing.
// Failure    Prepare throws std::invalid_argument for a plane that is no node of its shaft.
// Not done   damping of the twisted spring, torque of the force, ShaftLoads of the twisted spring
//            (it tells stiffness x twist of the shaft, the error included).

#include <span>

#include "plant_sim/plant/plant_parameters.hpp"
#include "plant_sim/plant/train_model.hpp"

namespace levitas::plant {

/// Makes room in the train, in the order of the entries; none are there without geared shafts.
void PrepareCouplings(const PlantParameters& parameters, TrainModel& train);

/// `strengths` are those of all entries. Strength 0 adds nothing, bit for bit.
void ApplyToCouplings(const PlantParameters& parameters, std::span<const double> strengths,
                      TrainModel& train) noexcept;

}  // namespace levitas::plant
