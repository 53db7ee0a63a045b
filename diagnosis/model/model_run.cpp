#include "diagnosis/model/model_run.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/records/recorded_rows.hpp"
#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/model/magnet_means.hpp"
#include "diagnosis/model/observer_scale.hpp"
#include "diagnosis/model/plant_at.hpp"
#include "diagnosis/model/repeated_frames.hpp"
#include "diagnosis/model/turns.hpp"
#include "plant_sim/plant/mode_step.hpp"
#include "plant_sim/plant/time_step.hpp"

namespace levitas::diagnosis {
namespace {

using plant::StateLayout;

/// A term in force with its value.
struct Active {
  Term term;
  double theta;
};

constexpr std::uint64_t kStartRows = 1500;  ///< with the gain for starts

double Sum(const std::vector<double>& shape, const float* modal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) sum += shape[i] * static_cast<double>(modal[i]);
  return sum;
}

class Runner {
 public:
  Runner(const RigView& rig, const ObserverGains& gains, const std::vector<Term>& terms,
         const std::vector<double>& theta, const LinearChange& change)
      : rig_(rig),
        plant_(PlantAt(rig, change)),
        stages_(gains.stages),
        steady_(plant_, gains.stages.front().gain),
        starter_(plant_, gains.start),
        observer_(&steady_),
        at_(rig.model->layout()),
        magnets_(rig) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (theta[i] == 0.0 || terms[i].in_plant) continue;
      active_.push_back({terms[i], theta[i]});
    }
    late_periods_ = static_cast<float>(change.late_periods);
    for (std::size_t a = 0; a < rig.axes; ++a) {
      coil_rate_[a] = static_cast<float>(change.axis[a].coil_rate);
    }
    for (std::size_t m = 0; m < rig.modes; ++m) {
      steps_.push_back(
          plant::MakeModeStep(plant_->frequency()[m], plant_->damping_ratio()[m], rig.period_s));
    }
    for (const auto& bearing : rig.model->config().bearings) {
      filters_.push_back(
          sensor::MakeFilterStep(bearing.sensor.bandwidth_hz, bearing.sensor.gain, rig.period_s));
    }
  }

  void Restart(const analysis::RecordedSample& sample) {
    starter_.Restart(sample.position_m);
    if (rig_.geared()) {
      TurnTo(starter_.mutable_plant(), starter_angle_rad_, sample.angle_rad);
      starter_angle_rad_ = sample.angle_rad;
    }
    observer_ = &starter_;
    since_start_ = 0;
    before_a_ = now_a_ = {};
    next_reading_m_ = {};
  }

  /// `arrived` false: the frame was lost, so the model goes on without correction.
  void Step(const analysis::RecordedRow& row, bool arrived, SamplePoint& moment) {
    if (since_start_++ == kStartRows) {
      steady_.mutable_plant() = starter_.plant();
      observer_ = &steady_;
      stage_ = stages_.begin();
      steady_.Use(stage_->gain);
    }
    moment.starting = observer_ == &starter_;
    if (!moment.starting) NextStage();
    moment.stage = static_cast<std::uint8_t>(stage_ - stages_.begin());
    if (moment.starting) starter_angle_rad_ = row.sample.angle_rad;
    BeforeSample(row, moment);
    moment.late_periods = late_periods_;
    moment.coil_rate = coil_rate_;
    const AxisArray added_m = AddedReadings(moment);
    const analysis::RecordedSample sample = SampleOf(row, arrived, added_m);
    const AxisArray innovation_m = observer_->Step(sample, added_m);
    for (std::size_t i = 0; i < rig_.axes; ++i) {
      moment.innovation_m[i] = static_cast<float>(innovation_m[i]);
    }
    AfterPeriod(moment);
    Drive(row.sample.command.bias_current_a, moment);
  }

 private:
  /// What the terms add to the readings.
  AxisArray AddedReadings(const SamplePoint& moment) {
    Contribution read;
    read.reading_m = next_reading_m_;
    for (Active& a : active_) {
      if (a.term.read) a.term.read(moment, a.theta, read);
    }
    AxisArray added_m{};
    for (std::size_t i = 0; i < rig_.axes; ++i) added_m[i] = read.reading_m[i];
    return added_m;
  }

  /// Of a frame that was lost: what the model foretells.
  analysis::RecordedSample SampleOf(const analysis::RecordedRow& row, bool arrived,
                                    const AxisArray& added_m) const {
    analysis::RecordedSample sample = row.sample;
    if (arrived) return sample;
    const AxisArray predicted_m = observer_->plant().SensorOutput();
    for (std::size_t i = 0; i < rig_.axes; ++i) {
      sample.position_m[i] = predicted_m[i] + added_m[i];
    }
    return sample;
  }

  /// What the terms do to the plant over the period.
  void Drive(double bias_current_a, SamplePoint& moment) {
    // First what moves the currents, since the forces that others look at follow from them.
    Contribution drive;
    for (Active& a : active_) {
      if (a.term.moves_coil) a.term.drive(moment, a.theta, drive);
    }
    magnets_.Fill(bias_current_a, drive, moment);
    for (Active& a : active_) {
      if (a.term.slope) a.term.slope(moment, a.theta, moment.added);
      if (a.term.drive && !a.term.moves_coil) a.term.drive(moment, a.theta, drive);
    }
    next_reading_m_ = drive.reading_m;
    if (!active_.empty()) Apply(drive);
  }

  void NextStage() {
    const auto next = stage_ + 1;
    if (next == stages_.end() || since_start_ - 1 - kStartRows < next->from_row) return;
    stage_ = next;
    steady_.Use(stage_->gain);
  }

  void BeforeSample(const analysis::RecordedRow& row, SamplePoint& moment) {
    const auto state = observer_->plant().state();
    for (std::size_t i = 0; i < rig_.axes; ++i) {
      moment.reading_m[i] = static_cast<float>(state[at_.sensor + i]);
      moment.measured_m[i] = static_cast<float>(row.sample.position_m[i]);
    }
    for (std::size_t i = 0; i < 2 * rig_.modes; ++i) {
      moment.read_q[i] = static_cast<float>(state[at_.q_x + i]);
      moment.read_v[i] = static_cast<float>(state[at_.v_x + i]);
    }
    moment.Turn(row.sample.angle_rad, row.sample.speed_rad_per_s, rig_.period_s);
    moment.acceleration_rad_per_s2 = static_cast<float>(row.sample.acceleration_rad_per_s2);
    for (std::size_t i = 0; i < rig_.axes; ++i) {
      const double commanded_a = row.sample.command.control_current_a[i];
      const double limit_a = rig_.bias_a(i);
      moment.command_before_a[i] = before_a_[i];
      moment.command_now_a[i] = now_a_[i];
      moment.command_next_a[i] = static_cast<float>(std::clamp(commanded_a, -limit_a, limit_a));
    }
    before_a_ = now_a_;
    now_a_ = moment.command_next_a;
    start_.assign(state.begin(), state.end());
    const auto& gain = observer_->gain();
    gain_state_ = &gain.state;
  }

  void AfterPeriod(SamplePoint& m) {
    const auto end = observer_->plant().state();
    // The start after the correction, which the observer does not keep.
    constexpr int kMostStates = 4 * static_cast<int>(kMaxModes) + 4 * static_cast<int>(kMaxAxes);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, static_cast<int>(kMaxAxes), 1> innovation(
        static_cast<Eigen::Index>(rig_.axes));
    for (std::size_t i = 0; i < rig_.axes; ++i) {
      innovation[static_cast<Eigen::Index>(i)] = static_cast<double>(m.innovation_m[i]);
    }
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostStates, 1> correction(gain_state_->rows());
    correction.noalias() = *gain_state_ * innovation;
    const auto start = [&](std::size_t i) {
      return start_[i] + correction[static_cast<Eigen::Index>(i)];
    };
    for (std::size_t i = 0; i < 2 * rig_.modes; ++i) {
      const double q0 = start(at_.q_x + i);
      const double q1 = end[at_.q_x + i];
      const double braked = start(at_.v_x + i) - end[at_.v_x + i];
      m.q[i] = static_cast<float>(0.5 * (q0 + q1) + rig_.period_s / 12.0 * braked);
      m.v[i] = static_cast<float>((q1 - q0) / rig_.period_s);
    }
    const double mid_rad =
        m.angle_rad + 0.5 * rig_.period_s * static_cast<double>(m.speed_rad_per_s);
    for (std::size_t i = 0; i < rig_.meshes.size(); ++i) {
      m.teeth[i] = rig_.meshes[i].At(mid_rad, static_cast<double>(m.speed_rad_per_s), m.q.data(),
                                     m.v.data());
    }
    for (std::size_t a = 0; a < rig_.axes; ++a) {
      m.coil_start_a[a] = static_cast<float>(start(at_.coil_current + a));
      m.coil_end_a[a] = static_cast<float>(end[at_.coil_current + a]);
    }
  }

  void Apply(const Contribution& add) {
    const auto state = observer_->mutable_plant().mutable_state();
    std::vector<double>& acceleration = acceleration_;
    acceleration.assign(add.modal.begin(),
                        add.modal.begin() + static_cast<std::ptrdiff_t>(2 * rig_.modes));
    for (std::size_t a = 0; a < rig_.axes; ++a) {
      state[at_.coil_current + a] += add.coil_end_a[a];
      const double force_n = add.force_n[a] + magnets_.OfAddedCurrent(a);
      const auto& shape = rig_.magnet(a).actuator_shape;
      for (std::size_t i = 0; i < rig_.modes; ++i) {
        acceleration[(a % 2) * rig_.modes + i] += shape[i] * force_n;
      }
    }
    moved_.assign(2 * rig_.modes, 0.0F);
    for (std::size_t i = 0; i < 2 * rig_.modes; ++i) {
      const plant::ModeStep& step = steps_[i % rig_.modes];
      moved_[i] = static_cast<float>(step.x0 * acceleration[i]);
      state[at_.q_x + i] += step.x0 * acceleration[i];
      state[at_.v_x + i] += step.v0 * acceleration[i];
    }
    for (std::size_t a = 0; a < rig_.axes; ++a) {
      state[at_.sensor + a] += filters_[a / 2].end * Sum(rig_.magnet(a).sensor_shape,
                                                         moved_.data() + (a % 2) * rig_.modes);
    }
  }

  const RigView& rig_;
  std::shared_ptr<const plant::PlantModel> plant_;
  const std::vector<GainStage>& stages_;
  std::vector<GainStage>::const_iterator stage_{stages_.begin()};
  analysis::Observer steady_, starter_;
  analysis::Observer* observer_;
  double starter_angle_rad_{0.0};  ///< total angle at which its plant stands, of geared shafts
  std::uint64_t since_start_{0};
  StateLayout at_;
  MagnetMeans magnets_;
  std::vector<Active> active_;
  std::vector<plant::ModeStep> steps_;
  std::vector<sensor::FilterStep> filters_;
  AxisFloats before_a_{}, now_a_{};
  float late_periods_{};
  AxisFloats coil_rate_{};
  std::array<double, kMaxAxes> next_reading_m_{};
  std::vector<double> start_, acceleration_;
  std::vector<float> moved_;
  const Eigen::MatrixXd* gain_state_{nullptr};
};

/// Every sixth stretch; another one in every record.
bool IsValidation(std::uint64_t cycle, std::uint32_t record, double period_s) {
  constexpr double kStretch = 0.05;  // [s]
  constexpr std::uint64_t kEvery = 6;
  const auto rows = static_cast<std::uint64_t>(std::llround(kStretch / period_s));
  return (cycle / rows + 2 * record) % kEvery == kEvery - 1;
}

/// Steps the model along a record and notes which rows count.
class RecordWalk {
 public:
  RecordWalk(const RigView& rig, const Record& record, double settling_s, Runner& runner,
             Trajectory& run)
      : rig_(rig),
        record_(record),
        settling_rows_(static_cast<std::uint64_t>(std::llround(settling_s / rig.period_s))),
        runner_(runner),
        run_(run) {}

  void Step(const analysis::RecordedRow& row, bool arrived, bool restart) {
    SamplePoint& moment = run_.moments.emplace_back();
    moment.record = record_.number;
    moment.time_s = static_cast<double>(row.cycle) * rig_.period_s;
    if (restart) {
      runner_.Restart(row.sample);
      moment.restarted = true;
      since_start_ = 0;
    }
    runner_.Step(row, arrived, moment);
    moment.arrived = arrived;
    moment.settled = since_start_++ >= settling_rows_;
    const bool held =
        record_.keeps_validation && IsValidation(row.cycle, record_.number, rig_.period_s);
    moment.held = moment.settled && arrived && held;
    moment.counts = moment.settled && arrived && !held;
  }

  /// In lost frames the rig holds its current; the shaft turns on.
  void Bridge(const analysis::RecordedRow& last, std::uint64_t lost) {
    analysis::RecordedRow held = last;
    for (std::uint64_t k = 0; k < lost; ++k) {
      ++held.cycle;
      held.sample.angle_rad += held.sample.speed_rad_per_s * rig_.period_s;
      Step(held, false, false);
    }
  }

 private:
  const RigView& rig_;
  const Record& record_;
  std::uint64_t settling_rows_;
  Runner& runner_;
  Trajectory& run_;
  std::uint64_t since_start_{0};
};

}  // namespace

Trajectory RunModel(const RigView& rig, const Record& record, const ObserverGains& gains,
                    const std::vector<Term>& terms, const std::vector<double>& theta,
                    double settling_s) {
  Trajectory run;
  run.gains = Divided(gains, ObserverScale::Of(rig, terms, theta), rig);
  run.moments.reserve(record.rows.size());
  Runner runner(rig, run.gains, terms, theta, ChangeOf(terms, theta));
  RecordWalk walk(rig, record, settling_s, runner, run);
  const bool repeats_are_lost = CountRepeats(record.rows, rig.axes).AreLost();
  const analysis::RecordedRow* previous = nullptr;
  for (const auto& row : record.rows) {
    const auto lost = previous != nullptr && row.cycle > previous->cycle
                          ? row.cycle - previous->cycle - 1
                          : analysis::kMostLost + 1;
    const bool continues = lost <= analysis::kMostLost && previous->levitated;
    if (row.levitated && continues) walk.Bridge(*previous, lost);
    if (row.levitated) {
      const bool lost_one = continues && repeats_are_lost &&
                            Repeats(previous->sample.position_m, row.sample.position_m, rig.axes);
      walk.Step(row, !lost_one, !continues);
    }
    previous = &row;
  }
  return run;
}

}  // namespace levitas::diagnosis
