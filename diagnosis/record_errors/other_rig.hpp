#pragma once
// A doubt whether the file is that of the recorded rig: nothing of what the currents do to the
// rotor is as the file says, while a fault changes one thing. A remark, never a refusal.
//
// Told       logarithm of the powers that the plant's innovations have without currents over those
//            with them, summed over the axes: what the file knows of the currents' work.
// Left       logarithm of the powers over what is left when innovations and currents of the last
//            kLags rows foretell them by least squares: what there is to know besides.
// Share      told / (told + left). Healthy rigs within their tolerances 0.83 to 0.99, every effect
//            of docs/effects.md at its clear size 0.70 or more, a strong spring at the coupling
//            excepted; another rotor 0.0 to 0.8.
// Doubted    share below kLeastShare with kFewest left, and below it with a spring at the coupling
//            too (the one effect that changes as much), whatever its stiffness.
// Noise      of the observer: that of the readings, not the file's, which is another rig's.
// Only       records with a test signal and at a steady speed: without, little has to be told; at
//            changing speed unbalance is left.
// Cost       0.2 s a record, 1 s where it is low. Thread: any; pure. Failure: none.

#include "common/axes.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

inline constexpr double kLeastShare = 0.5;

/// `noise_m`: of the readings, per axis (position_unit.hpp). Adds to `out`.
void FindOtherRig(const RigView& rig, const Columns& columns, const AxisArray& noise_m,
                  RecordErrors& out);

}  // namespace levitas::diagnosis
