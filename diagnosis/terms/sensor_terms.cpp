// Sensors: scale, offset, characteristic, bandwidth, place, rotation of the axes, mains.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;

constexpr double kLeastLag = 0.05;  ///< of the file's; below it a sensor has none

/// What a shape makes of the motion, behind the sensor's filter: motion is slow beside its lag.
double Seen(const std::vector<double>& shape, const SamplePoint& m, std::size_t at, double lag_s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    sum += shape[i] *
           (static_cast<double>(m.read_q[at + i]) - lag_s * static_cast<double>(m.read_v[at + i]));
  }
  return sum;
}

double Dot(const std::vector<double>& shape, const float* modal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) sum += shape[i] * static_cast<double>(modal[i]);
  return sum;
}

/// By how much a sensor is behind a position that moves steadily between samples: z' = -z/tau - v.
/// Told by the velocity, so that the observer's corrections, which put the rotor elsewhere at once,
/// are no motion that the sensor would have to follow.
class Lag {
 public:
  void Rest() { behind_m_ = 0.0; }
  double Step(double velocity_m_per_s, double tau_s, double period_s) {
    const double decay = std::exp(-period_s / tau_s);
    behind_m_ = decay * behind_m_ - velocity_m_per_s * tau_s * (1.0 - decay);
    return behind_m_;
  }

 private:
  double behind_m_{};
};

/// The lag, not the bandwidth, is the number: it enters nearly linearly. A whole filter, since one
/// that is slow beside the test signal is no mere delay, for which it would be taken.
Term Bandwidth(const RigView& rig, double tolerance, std::size_t a) {
  const double lag_s = SensorLag(rig, a);
  const auto shape = rig.magnet(a).sensor_shape;
  const std::size_t at = (a % 2) * rig.modes;
  struct Both {
    Lag file, other;
  };
  Term term = MakeTerm(
      {Id::kSensorBandwidth, AtAxis(rig.numbers, a), "lag_ratio", "1"}, tolerance, 1.0,
      [=, period_s = rig.period_s, gain = rig.bearing(a).sensor.gain, both = Both{}](
          const SamplePoint& m, double theta, Contribution& add) mutable {
        if (m.restarted) {
          both.file.Rest();
          both.other.Rest();
        }
        const double v = gain * Dot(shape, m.v.data() + at);
        add.reading_m[a] += both.other.Step(v, std::max(kLeastLag, 1.0 + theta) * lag_s, period_s) -
                            both.file.Step(v, lag_s, period_s);
      });
  term.linear = false;
  term.step = 0.05;
  term.change = [a, lag_s, shape](double theta, LinearChange& change) {
    for (std::size_t i = 0; i < shape.size(); ++i) {
      change.axis[a].sensor_v[i] -= lag_s * theta * shape[i];
    }
  };
  return term;
}

void AddOneAxis(const RigView& rig, const Tolerances& t, std::size_t a, std::vector<Term>& terms) {
  constexpr double kReferenceM = 100e-6;  // [m] a2, a3 are shares of it at this reading
  terms.push_back(MakeReading({Id::kSensorGain, AtAxis(rig.numbers, a), "ratio", "1"},
                              t.sensor_gain, 0.1,
                              [a](const SamplePoint& m, double theta, Contribution& add) {
                                add.reading_m[a] += theta * static_cast<double>(m.reading_m[a]);
                              }));
  terms.back().scales = a;
  terms.back().slope = [a](const SamplePoint&, double theta, AddedSlopes& added) {
    added.reading_per_m[a] += static_cast<float>(theta);
  };
  terms.push_back(MakeReading(
      {Id::kSensorOffset, AtAxis(rig.numbers, a), "offset_m", "m"}, t.sensor_offset_m, 50e-6,
      [a](const SamplePoint&, double theta, Contribution& add) { add.reading_m[a] += theta; }));
  terms.push_back(MakeReading({Id::kSensorNonlinearity, AtAxis(rig.numbers, a), "a2", "1/m"}, 0.0,
                              3e3, [a](const SamplePoint& m, double theta, Contribution& add) {
                                const double y = static_cast<double>(m.reading_m[a]);
                                add.reading_m[a] += theta * y * y;
                              }));
  terms.back().slope = [a](const SamplePoint& m, double theta, AddedSlopes& added) {
    added.reading_per_m[a] += static_cast<float>(2.0 * theta) * m.reading_m[a];
  };
  terms.push_back(MakeReading({Id::kSensorNonlinearity, AtAxis(rig.numbers, a), "a3", "1/m^2"}, 0.0,
                              1.0 / (kReferenceM * kReferenceM),
                              [a](const SamplePoint& m, double theta, Contribution& add) {
                                const double y = static_cast<double>(m.reading_m[a]);
                                add.reading_m[a] += theta * y * y * y;
                              }));
  terms.back().slope = [a](const SamplePoint& m, double theta, AddedSlopes& added) {
    added.reading_per_m[a] += static_cast<float>(3.0 * theta) * m.reading_m[a] * m.reading_m[a];
  };
  terms.push_back(Bandwidth(rig, t.sensor_bandwidth, a));
}

void AddPosition(const RigView& rig, const Tolerances& t, std::size_t b, std::vector<Term>& terms) {
  const auto slope = rig.Slope(rig.model->config().bearings[b].sensor_z_m);
  const std::size_t modes = rig.modes;
  const double lag_s = SensorLag(rig, 2 * b);
  terms.push_back(MakeReading(
      {Id::kSensorPosition, AtBearing(rig.numbers, b), "shift_m", "m"}, t.sensor_position_m, 3e-3,
      [b, slope, modes, lag_s](const SamplePoint& m, double theta, Contribution& add) {
        add.reading_m[2 * b] += theta * Seen(slope, m, 0, lag_s);
        add.reading_m[2 * b + 1] += theta * Seen(slope, m, modes, lag_s);
      }));
  terms.back().change = [b, slope, lag_s](double theta, LinearChange& change) {
    for (std::size_t i = 0; i < slope.size(); ++i) {
      for (const std::size_t a : {2 * b, 2 * b + 1}) {
        change.axis[a].sensor_q[i] += theta * slope[i];
        change.axis[a].sensor_v[i] -= theta * slope[i] * lag_s;
      }
    }
  };
}

}  // namespace

double SensorLag(const RigView& rig, std::size_t axis) {
  return 1.0 / (2.0 * std::numbers::pi * rig.bearing(axis).sensor.bandwidth_hz);
}

std::vector<Term> SensorTerms(const RigView& rig, const Tolerances& t) {
  std::vector<Term> terms;
  for (std::size_t a = 0; a < rig.axes; ++a) AddOneAxis(rig, t, a, terms);
  for (std::size_t b = 0; b < rig.axes / 2; ++b) {
    if (!rig.geared()) AddPosition(rig, t, b, terms);
    terms.push_back(
        MakeReading({Id::kAxisRotation, AtSide(rig.numbers, b, true), "angle_rad", "rad"}, 0.0,
                    0.05, [b](const SamplePoint& m, double theta, Contribution& add) {
                      const double x = static_cast<double>(m.reading_m[2 * b]);
                      const double y = static_cast<double>(m.reading_m[2 * b + 1]);
                      add.reading_m[2 * b] += theta * y;
                      add.reading_m[2 * b + 1] -= theta * x;
                    }));
  }
  return terms;
}

namespace {

/// [m] amplitude of a line by the rig file, which knows nothing of its phase.
double KnownAmplitude(const RigView& rig, double hz, std::size_t axis) {
  double amplitude_m = 0.0;
  for (const effect::EffectConfig& entry : rig.by_chance) {
    const bool here = entry.id == effect::Id::kMainsPickup && entry.Acts(axis);
    if (here && entry.values[0] == hz) amplitude_m += entry.values[1];
  }
  return amplitude_m;
}

}  // namespace

std::vector<Term> MainsTerms(const RigView& rig, const std::vector<double>& frequencies_hz,
                             std::size_t records) {
  std::vector<Term> terms;
  for (const double hz : frequencies_hz) {
    const double w = 2.0 * std::numbers::pi * hz;
    for (std::uint32_t record = 0; record < records; ++record) {
      for (std::size_t a = 0; a < rig.axes; ++a) {
        const double known_m = KnownAmplitude(rig, hz, a);
        for (int part = 0; part < 2; ++part) {
          terms.push_back(MakeReading(
              {Id::kMainsPickup, AtLineOf(rig.numbers, hz, a), part == 0 ? "cosine" : "sine", "m"},
              known_m, 2e-6, [=](const SamplePoint& m, double theta, Contribution& add) {
                if (m.record != record) return;
                add.reading_m[a] +=
                    theta * (part == 0 ? std::cos(w * m.time_s) : std::sin(w * m.time_s));
              }));
          terms.back().record = record;
        }
      }
    }
  }
  return terms;
}

}  // namespace levitas::diagnosis
