#pragma once
// Coil currents of a record in free run: from the commanded voltages and the measured positions.
//
// Equation   i' = (r k u(a) + c - R i)/(R0 tau) + e i z'/d,   per coil, closed form over a period,
//              tau = L tau0 e^(-(1 - p) z/d)/(1 + s i^2)     inductance, its profile, iron
//              u(a) = v + q v (1 - a/full), v = max(0, a - b)   dead band b, curvature q
//              R = (1 + resistance)(1 + own)(1 + heating t)
//            reading = (1 + g)(i + eddy (i_last - i)) + offset, late by its lag; the other coil's
//            slope enters by the mutual inductance. Signs and symbols: parameters.hpp.
// Source     the law of the rig file (plant_sim/amplifier/voltage_coil.hpp), written anew so that
//            neither can hide an error of the other. Eddy currents as a shorted second winding:
//            Fitzgerald, Kingsley & Umans 2003, Electric Machinery, ch. 2.
// Start      from the first measured current, or where the voltage would hold it. Never corrected.
// Thread     any; pure.

#include "diagnosis/levitator/nominal.hpp"
#include "diagnosis/levitator/parameters.hpp"
#include "diagnosis/levitator/series.hpp"

namespace levitas::levitator {

/// Readings of both current probes, row by row; and the currents behind them.
struct CoilRun {
  std::array<std::vector<double>, 2> reading_a;
  std::array<std::vector<double>, 2> current_a;
};

[[nodiscard]] CoilRun RunCoils(const NominalRig& rig, const Series& series, const Theta& theta,
                               std::size_t record);

/// The position behind a measured one: the sensor's errors undone.
[[nodiscard]] double TruePosition(double measured_m, const Theta& theta, std::size_t record);

}  // namespace levitas::levitator
