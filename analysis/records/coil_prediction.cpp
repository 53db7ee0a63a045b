#include "analysis/records/coil_prediction.hpp"

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "plant_sim/plant/coils_of.hpp"

namespace levitas::analysis {
namespace {

struct CoilPlace {
  amplifier::VoltageCoil coil;
  double warming_1_per_s{};
  double gap_m{};         ///< the rotor centred
  double sign{};          ///< of the displacement in the gap
  double command_sign{};  ///< of the control current in what the coil is asked for
};

CoilPlace PlaceOf(const plant::PlantConfig& rig, std::size_t index) {
  const plant::BearingConfig& bearing = rig.bearings[index / 4];
  if (!bearing.amplifier.voltage) {
    throw BadInput("bearing " + bearing.name + " has current loops, no coils on a voltage");
  }
  const bool towards = index % 2 == 0;
  const double far_m =
      bearing.magnet.exponential ? bearing.magnet.exponential->far_gap_m : bearing.magnet.gap_m;
  return {plant::CoilsOf(bearing)[towards ? 0 : 1], bearing.amplifier.voltage->warming_1_per_s,
          towards ? bearing.magnet.gap_m : far_m, towards ? -1.0 : 1.0, towards ? 1.0 : -1.0};
}

}  // namespace

CoilCurrents PredictCoilCurrents(const plant::PlantConfig& rig,
                                 const std::vector<RecordedRow>& rows) {
  if (rows.empty() || rows.front().coils == 0) {
    throw BadInput("the session holds no measured coil currents");
  }
  const double period_s = static_cast<double>(rig.period_ns) * 1e-9;
  const auto whole = static_cast<std::size_t>(rig.delay_samples);
  const double early_s = (rig.delay_samples - static_cast<double>(whole)) * period_s;
  CoilCurrents predicted(rows.size());
  for (std::size_t index = 0; index < rows.front().coils; ++index) {
    const CoilPlace place = PlaceOf(rig, index);
    const std::size_t axis = index / 2;
    const double limit_a = rig.bearings[axis / 2].magnet.max_coil_current_a;
    const auto position = [&](std::size_t n) { return rows[n].sample.position_m[axis]; };
    double now_a = rows.front().coil_current_a[index];
    predicted.front()[index] = now_a;
    for (std::size_t n = 0; n + 1 < rows.size(); ++n) {
      const bool continues = rows[n + 1].cycle == rows[n].cycle + 1;
      const double rate = place.sign * (position(n + 1) - position(n)) / period_s;
      const double warm =
          amplifier::Warmed(place.warming_1_per_s,
                            static_cast<double>(rows[n].cycle - rows.front().cycle) * period_s);
      const double gap_m = place.gap_m + place.sign * 0.5 * (position(n + 1) + position(n));
      // A fraction of a sample in the delay: the older command acts first.
      const auto follow = [&](std::size_t age, double duration_s) {
        const plant::PlantCommand& command = rows[n >= age ? n - age : 0].sample.command;
        const double asked_a = std::clamp(
            command.bias_current_a + place.command_sign * command.control_current_a[axis], 0.0,
            limit_a);
        return amplifier::Follow(place.coil, now_a, asked_a, command.amplifiers_enabled, gap_m,
                                 rate, duration_s, warm);
      };
      if (!continues) {
        now_a = rows[n + 1].coil_current_a[index];
      } else {
        if (early_s > 0.0) now_a = follow(whole + 1, early_s);
        now_a = follow(whole, period_s - early_s);
      }
      predicted[n + 1][index] = now_a;
    }
  }
  return predicted;
}

std::vector<CoilFit> FitCoils(const std::vector<RecordedRow>& rows, const CoilCurrents& predicted,
                              double period_s, double from_s,
                              const std::vector<std::string>& channels) {
  std::vector<CoilFit> fits;
  const auto skip = static_cast<std::size_t>(std::llround(std::max(from_s, 0.0) / period_s));
  if (skip + 1 >= rows.size()) throw BadInput("nothing of the session is left to compare");
  const auto count = static_cast<double>(rows.size() - skip);
  for (std::size_t index = 0; index < rows.front().coils; ++index) {
    CoilFit fit;
    fit.coil = channels.at(index / 2) + (index % 2 == 0 ? " towards +" : " away from +");
    for (std::size_t n = skip; n < rows.size(); ++n) {
      fit.measured_mean_a += rows[n].coil_current_a[index] / count;
      fit.predicted_mean_a += predicted[n][index] / count;
    }
    double error = 0.0;
    double spread = 0.0;
    for (std::size_t n = skip; n < rows.size(); ++n) {
      error += std::pow(rows[n].coil_current_a[index] - predicted[n][index], 2);
      spread += std::pow(rows[n].coil_current_a[index] - fit.measured_mean_a, 2);
    }
    fit.error_rms_a = std::sqrt(error / count);
    fit.fit_percent = spread > 0.0 ? 100.0 * (1.0 - std::sqrt(error / spread)) : 0.0;
    fits.push_back(std::move(fit));
  }
  return fits;
}

}  // namespace levitas::analysis
