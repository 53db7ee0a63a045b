#include "benchmark/accuracy/spoilt_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/reading_noise.hpp"
#include "common/random.hpp"

namespace levitas::accuracy {
namespace {

using LoadedRecord = diagnosis::Record;
using diagnosis::RecordErrorKind;

constexpr double kHalfTurn = std::numbers::pi;

/// What a file of these rows says.
void SetTimes(const configuration::RigFile& rig, std::vector<LoadedRecord>& records) {
  for (LoadedRecord& record : records) {
    record.times_s.clear();
    for (const auto& row : record.rows)
      record.times_s.push_back(rig.numbers.period_s() * static_cast<double>(row.cycle));
  }
}

class Spoiler {
 public:
  Spoiler(const configuration::RigFile& rig, std::uint64_t seed, Spoilt& out)
      : rig_(rig), axes_(rig.numbers.axes()), random_(seed), out_(out) {}

  void Make() {
    switch (out_.kind) {
      case RecordErrorKind::kSwapped:
        return Swap();
      case RecordErrorKind::kReversed:
        return Reverse();
      case RecordErrorKind::kUnit:
        return Unit();
      case RecordErrorKind::kRate:
        return Rate();
      case RecordErrorKind::kQuantised:
        return Quantise();
      case RecordErrorKind::kClipped:
        return Clip();
      case RecordErrorKind::kHeld:
        return Hold();
      case RecordErrorKind::kDelayed:
        return Delay();
      case RecordErrorKind::kGaps:
        return LeaveOut();
    }
  }

 private:
  std::size_t Any() { return random_.Bits() % axes_; }
  static double& Cell(analysis::RecordedRow& row, bool position, std::size_t axis) {
    return position ? row.sample.position_m[axis] : row.sample.command.control_current_a[axis];
  }
  void Name(bool position, std::size_t axis) {
    out_.columns.push_back((position ? "position_" : "control_current_") +
                           rig_.numbers.channels[axis]);
  }
  template <class Change>
  void Each(Change change) {
    for (LoadedRecord& record : out_.records) {
      for (std::size_t n = 0; n < record.rows.size(); ++n) change(record, n);
    }
  }

  void Scale(const std::vector<std::size_t>& axes, bool position, double factor) {
    for (const std::size_t a : axes) {
      Name(position, a);
      Each([&](LoadedRecord& record, std::size_t n) {
        Cell(record.rows[n], position, a) *= factor;
      });
    }
  }

  void Exchange(bool position, std::size_t a, std::size_t b) {
    Name(position, a);
    Name(position, b);
    const AxisArray& polarity =
        position ? rig_.numbers.sensor_polarity : rig_.numbers.actuator_polarity;
    const double sign = polarity[a] * polarity[b] < 0.0 ? -1.0 : 1.0;
    Each([&](LoadedRecord& record, std::size_t n) {
      std::swap(Cell(record.rows[n], position, a), Cell(record.rows[n], position, b));
      Cell(record.rows[n], position, a) *= sign;
      Cell(record.rows[n], position, b) *= sign;
    });
  }

  void Swap() {
    const bool position = random_.Uniform() < 0.5;
    if (axes_ >= 4 && random_.Uniform() < 0.25) {  // two bearings
      Exchange(position, 0, 2);
      Exchange(position, 1, 3);
      return;
    }
    const std::size_t a = Any();
    const std::size_t b = (a + 1 + random_.Bits() % (axes_ - 1)) % axes_;
    Exchange(position, a, b);
  }

  void Reverse() {
    const std::size_t axis = Any();
    const bool position = random_.Uniform() < 0.5;
    out_.size = -1.0;
    Scale({axis}, position, -1.0);
    if (random_.Uniform() < 0.25) Scale({axis}, !position, -1.0);
  }

  void Unit() {
    std::vector<std::size_t> every;
    for (std::size_t a = 0; a < axes_; ++a) every.push_back(a);
    const double factor = random_.Uniform() < 0.5 ? 1e3 : 1e-3;
    switch (random_.Bits() % 6) {
      case 0:
        Scale({Any()}, true, factor);
        break;
      case 1:
        Scale({Any()}, false, factor);
        break;
      case 2:
        Scale(every, true, factor);
        break;
      case 3:
        Scale(every, false, factor);
        break;
      case 4: {
        constexpr std::array kUnits{1.0 / 60.0, 60.0, kHalfTurn / 30.0, 30.0 / kHalfTurn};
        const double by = kUnits.at(random_.Bits() % kUnits.size());
        out_.columns = {"speed"};
        Each([&](LoadedRecord& record, std::size_t n) {
          record.rows[n].sample.speed_rad_per_s *= by;
        });
        out_.size = 1.0 / by;
        return;
      }
      default: {
        // Radians whose column says degrees: the speed follows from the angle.
        out_.columns = {"rotor_angle"};
        Each([&](LoadedRecord& record, std::size_t n) {
          record.rows[n].sample.speed_rad_per_s *= kHalfTurn / 180.0;
          record.rows[n].sample.angle_rad *= kHalfTurn / 180.0;
        });
        out_.size = 180.0 / kHalfTurn;
        return;
      }
    }
    out_.size = 1.0 / factor;
  }

  void Rate() {
    out_.columns = {"time"};
    if (random_.Uniform() < 0.4) {
      out_.size = 2.0;
      for (LoadedRecord& record : out_.records) {
        std::vector<analysis::RecordedRow> half;
        for (std::size_t n = 0; n < record.rows.size(); n += 2) {
          half.push_back(record.rows[n]);
          half.back().cycle = n / 2;
        }
        record.rows = std::move(half);
      }
      SetTimes(rig_, out_.records);
      return;
    }
    const bool drifts = random_.Uniform() < 0.5;
    const double by =
        drifts ? 1.0
               : std::exp(std::copysign(0.01 + 0.19 * random_.Uniform(), random_.Uniform() - 0.5));
    const double drift =
        drifts ? std::copysign(0.01 + 0.05 * random_.Uniform(), random_.Uniform() - 0.5) : 0.0;
    for (LoadedRecord& record : out_.records) {
      auto& times = record.times_s;
      double now = 0.0;
      double before = times.front();
      for (std::size_t n = 0; n < times.size(); ++n) {
        const double step = times[n] - before;
        before = times[n];
        now += step * (by + drift * static_cast<double>(n) / static_cast<double>(times.size()));
        times[n] = now;
      }
    }
    out_.size = by;
  }

  void Quantise() {
    const std::size_t axis = Any();
    const auto& sensor = rig_.plant.bearings[axis / 2].sensor;
    const double own_m =
        sensor.adc_bits > 0 ? 2.0 * sensor.range_m / std::ldexp(1.0, sensor.adc_bits) : 0.0;
    const double step =
        std::max(8.0 * own_m, (2.0 + 8.0 * random_.Uniform()) * analysis::ReadingNoise(sensor));
    Name(true, axis);
    out_.size = step;
    Each([&](LoadedRecord& record, std::size_t n) {
      double& value = Cell(record.rows[n], true, axis);
      value = step * std::round(value / step);
    });
  }

  void Clip() {
    const std::size_t axis = Any();
    const double side = random_.Uniform() < 0.5 ? 1.0 : -1.0;
    const double share = 0.005 + 0.095 * random_.Uniform();
    Name(true, axis);
    std::vector<double> values;
    Each([&](LoadedRecord& record, std::size_t n) {
      values.push_back(side * Cell(record.rows[n], true, axis));
    });
    std::sort(values.begin(), values.end());
    const double most =
        values[static_cast<std::size_t>((1.0 - share) * static_cast<double>(values.size()))];
    out_.size = side * most;
    Each([&](LoadedRecord& record, std::size_t n) {
      double& value = Cell(record.rows[n], true, axis);
      value = side * std::min(side * value, most);
    });
  }

  void Hold() {
    const std::size_t axis = Any();
    const bool position = random_.Uniform() < 0.7;
    const std::size_t period = 2 + random_.Bits() % 5;
    const std::size_t held = 1 + random_.Bits() % (period - 1);
    Name(position, axis);
    out_.size = static_cast<double>(held) / static_cast<double>(period);
    Each([&](LoadedRecord& record, std::size_t n) {
      if (n > 0 && n % period < held) {
        Cell(record.rows[n], position, axis) = Cell(record.rows[n - 1], position, axis);
      }
    });
  }

  void Delay() {
    const std::size_t axis = Any();
    const bool position = random_.Uniform() < 0.6;
    const std::size_t rows = 1 + random_.Bits() % 5;
    Name(position, axis);
    out_.size = static_cast<double>(rows);
    for (LoadedRecord& record : out_.records) {
      for (std::size_t n = record.rows.size(); n-- > rows;) {
        Cell(record.rows[n], position, axis) = Cell(record.rows[n - rows], position, axis);
      }
    }
  }

  void LeaveOut() {
    out_.columns = {"time"};
    const std::size_t places = 1 + random_.Bits() % 6;
    for (LoadedRecord& record : out_.records) {
      const std::uint64_t first = record.rows.front().cycle;
      const std::size_t piece = record.rows.size() / (places + 1);
      std::vector<analysis::RecordedRow> left;
      std::size_t from = 0;
      for (std::size_t place = 1; place <= places; ++place) {
        const std::size_t to = place * piece + random_.Bits() % (piece / 4);
        left.insert(left.end(), record.rows.begin() + static_cast<std::ptrdiff_t>(from),
                    record.rows.begin() + static_cast<std::ptrdiff_t>(to));
        from = to + 2 + random_.Bits() % 199;
      }
      left.insert(left.end(), record.rows.begin() + static_cast<std::ptrdiff_t>(from),
                  record.rows.end());
      for (std::size_t n = 0; n < left.size(); ++n) left[n].cycle = first + n;
      record.rows = std::move(left);
    }
    SetTimes(rig_, out_.records);
    out_.size = static_cast<double>(places);
  }

  const configuration::RigFile& rig_;
  std::size_t axes_;
  Random random_;
  Spoilt& out_;
};

}  // namespace

Spoilt Spoil(const configuration::RigFile& rig, const std::vector<LoadedRecord>& records,
             RecordErrorKind kind, std::uint64_t seed) {
  Spoilt out{kind, {}, 0.0, records};
  SetTimes(rig, out.records);
  Spoiler(rig, seed, out).Make();
  return out;
}

bool IsNamed(const Spoilt& made, const diagnosis::RecordErrors& found) {
  std::vector<std::string> columns = made.columns;
  std::ranges::sort(columns);
  return std::ranges::any_of(found.errors, [&](const diagnosis::RecordError& error) {
    std::vector<std::string> named = error.columns;
    std::ranges::sort(named);
    const bool sized = made.size == 0.0 || std::abs(error.size / made.size - 1.0) < 0.1;
    return error.kind == made.kind && named == columns && sized;
  });
}

}  // namespace levitas::accuracy
