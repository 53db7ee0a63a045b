#include "benchmark/accuracy/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "benchmark/accuracy/simulated_rig.hpp"
#include "common/output_file.hpp"
#include "common/probe_map.hpp"
#include "common/rotational_speed.hpp"
#include "controller/scenario/prbs.hpp"
#include "diagnosis/records/load.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "session/exchange/recording_builder.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::accuracy {
namespace {

/// Share of a record's rows in which an axis may be at its current limit. The noise of a lively law
/// takes one there in a twentieth of them; a loop that swings there by itself is not one that
/// anybody records.
constexpr double kAtLimit = 0.1;

struct Motion {
  std::string name;
  double from_rpm{}, to_rpm{};
  std::size_t rows{};
  bool excited{};

  [[nodiscard]] double Rate(double period_s) const {
    return RpmToRadPerS(to_rpm - from_rpm) / (static_cast<double>(rows) * period_s);
  }
};

/// The excitation of a seed: a maximum-length sequence of 2047 bits. Its first bit is the first
/// feedback of the register, which leaves it as many steps later as the register is long.
scenario::Prbs BitsOf(std::uint64_t seed) {
  constexpr int kOrder = 11;
  auto bits = scenario::Prbs::FromRegister(kOrder, static_cast<std::uint32_t>(1 + seed % 2047));
  bits.Skip(kOrder);
  return bits;
}

/// Of the control current, as the cycle has it.
double CurrentLimit(const cycle::CycleConfig& config) {
  const double bias_a = config.rig.bias_current_a;
  const double coils_a = std::min(bias_a, config.rig.max_coil_current_a - bias_a);
  const double law_a = config.law.current_limit_a;
  return law_a > 0.0 ? std::min(coils_a, law_a) : coils_a;
}

/// What disturbs without being modelled, and frames that are lost.
class Trouble final : public RigLine {
 public:
  Trouble(const RigNumbers& rig, Disturbance disturbance, const FrameLoss& loss)
      : probes_(rig), period_s_(rig.period_s()), disturbance_(disturbance), loss_(loss) {}

  /// Until then every frame arrives.
  void BeginLosing() { losing_ = true; }
  /// The latest frame, whether or not it arrived.
  [[nodiscard]] const SensorFrame& sent() const { return sent_; }

  bool Deliver(SensorFrame& frame) override {
    BearingFrame read_m = probes_.Positions({frame.position_m});
    disturbance_.Read(TimeOf(frame), read_m.at);
    frame.position_m = probes_.Readings(read_m).at;
    sent_ = frame;
    return !Lost();
  }

  void Pass(const SensorFrame& frame, plant::PlantCommand& command) override {
    const AxisArray unknown_a =
        probes_
            .Currents({disturbance_.Current(TimeOf(frame), frame.angle_rad, frame.speed_rad_per_s)})
            .at;
    for (std::size_t a = 0; a < frame.axes; ++a) command.control_current_a[a] += unknown_a[a];
  }

 private:
  [[nodiscard]] double TimeOf(const SensorFrame& frame) const {
    return period_s_ * static_cast<double>(frame.cycle);
  }

  bool Lost() {
    if (!losing_ || loss_.probability <= 0.0) return false;
    if (to_lose_ == 0 && chance_.Uniform() < loss_.probability) to_lose_ = loss_.burst;
    if (to_lose_ == 0) return false;
    --to_lose_;
    return true;
  }

  ProbeMap probes_;
  double period_s_;
  Disturbance disturbance_;
  FrameLoss loss_;
  Random chance_{loss_.seed};
  bool losing_{};
  std::size_t to_lose_{0};
  SensorFrame sent_;
};

/// One motion of the rig, from off.
class Run {
 public:
  Run(const std::shared_ptr<const plant::PlantModel>& model, const cycle::CycleConfig& config,
      const CampaignPlan& plan, std::uint64_t seed, Disturbance disturbance)
      : plan_(plan),
        numbers_(config.rig),
        limit_a_(CurrentLimit(config)),
        bits_(BitsOf(seed)),
        trouble_(config.rig, disturbance, plan.loss),
        rig_(config, plant::Plant(model, seed), &trouble_) {}

  /// Whether it was stable throughout; what was recorded until then.
  bool Record(const Motion& motion, double drive_rad_per_s2, diagnosis::Record& out) {
    session::RecordingBuilder rows(motion.name, numbers_);
    const bool stable = Begin(motion, drive_rad_per_s2) && Take(motion, rows);
    out = diagnosis::RecordOf(rows.Finish());
    return stable;
  }

 private:
  bool Begin(const Motion& motion, double drive_rad_per_s2) {
    if (!rig_.Lift()) return false;
    return motion.from_rpm == 0.0 || rig_.SpinUp(RpmToRadPerS(motion.from_rpm), drive_rad_per_s2);
  }

  bool Take(const Motion& motion, session::RecordingBuilder& rows) {
    const double limit_m = motion.to_rpm == 0.0 ? plan_.resting_m : plan_.limit_m;
    std::array<std::size_t, kMaxAxes> at_limit{};
    logged_ = rig_.record();
    trouble_.BeginLosing();
    for (std::size_t n = 0; n < motion.rows; ++n) {
      const cycle::CycleRecord& now = rig_.Step(AskedAt(motion, n));
      if (now.out.fault != Fault::kNone || !Within(limit_m, now.in.frame)) return false;
      for (std::size_t a = 0; a < numbers_.axes(); ++a) {
        if (std::abs(now.out.current.control_current_a[a]) >= limit_a_) ++at_limit[a];
      }
      logged_ = now.in.frame_present || plan_.loss.missing ? now : Repeated(now);
      rows.Take(logged_);
    }
    const auto most = static_cast<std::size_t>(kAtLimit * static_cast<double>(motion.rows));
    return rig_.plant().finite() && *std::max_element(at_limit.begin(), at_limit.end()) <= most;
  }

  [[nodiscard]] cycle::OperatorInput AskedAt(const Motion& motion, std::size_t row) {
    cycle::OperatorInput op;
    if (motion.excited) Excite(motion, row, op.excitation_a);
    if (row == 0 && motion.to_rpm != motion.from_rpm) {
      op.command = OperatorCommand::kSpin;
      op.speed_rad_per_s = RpmToRadPerS(motion.to_rpm);
      op.acceleration_rad_per_s2 = motion.Rate(numbers_.period_s());
    }
    return op;
  }

  /// Once the quiet rows have passed: one axis after the other, each bit for two rows.
  void Excite(const Motion& motion, std::size_t row, AxisArray& excitation_a) {
    const auto quiet = static_cast<std::size_t>(std::llround(plan_.quiet_s / numbers_.period_s()));
    if (row < quiet) return;
    const std::size_t since = row - quiet;
    if (since % 2 == 0) bit_ = bits_.Next();
    const std::size_t per_axis = (motion.rows - quiet) / numbers_.axes();
    const std::size_t axis = std::min(since / per_axis, numbers_.axes() - 1);
    excitation_a[axis] = bit_ ? plan_.excitation_a : -plan_.excitation_a;
  }

  /// The row before with the next count: readings and test signal are the old ones. The currents
  /// are held, and angle and speed come from a device of their own.
  [[nodiscard]] cycle::CycleRecord Repeated(cycle::CycleRecord now) const {
    now.in.frame_present = true;
    now.in.frame = trouble_.sent();
    now.in.frame.position_m = logged_.in.frame.position_m;
    now.in.op.excitation_a = logged_.in.op.excitation_a;
    return now;
  }

  [[nodiscard]] bool Within(double limit_m, const SensorFrame& frame) const {
    return std::all_of(frame.position_m.begin(), frame.position_m.begin() + frame.axes,
                       [limit_m](double read_m) { return std::abs(read_m) < limit_m; });
  }

  const CampaignPlan& plan_;
  const RigNumbers& numbers_;
  double limit_a_;
  scenario::Prbs bits_;
  bool bit_{};
  Trouble trouble_;
  SimulatedRig rig_;
  cycle::CycleRecord logged_;
};

std::vector<Motion> MotionsOf(const CampaignPlan& plan, const RigNumbers& rig) {
  const auto excited_rows = static_cast<std::size_t>(2 * plan.bits_per_axis) * rig.axes() +
                            static_cast<std::size_t>(std::llround(plan.quiet_s / rig.period_s()));
  return {{"standing", 0.0, 0.0, excited_rows, true},
          {"spinning", plan.spinning_rpm, plan.spinning_rpm, excited_rows, true},
          {"runup", plan.runup_from_rpm, plan.runup_to_rpm,
           static_cast<std::size_t>(plan.runup_s / rig.period_s()), false}};
}

/// The rate of a set point that the drive has to be able to follow.
void Hasten(double rate_rad_per_s2, double& drive_rad_per_s2) {
  drive_rad_per_s2 = std::max(drive_rad_per_s2, std::abs(rate_rad_per_s2));
}

}  // namespace

Campaign Record(const plant::PlantParameters& truth, const cycle::CycleConfig& controller,
                const CampaignPlan& plan, Unmodelled outside, double outside_size,
                std::uint64_t outside_seed) {
  plant::PlantParameters parameters = truth;
  cycle::CycleConfig config = controller;
  const double period_s = config.rig.period_s();
  const double drive_rad_per_s2 = parameters.config.drive.max_acceleration_rad_per_s2;
  const std::vector<Motion> motions = MotionsOf(plan, config.rig);
  for (const Motion& motion : motions) {
    Hasten(motion.Rate(period_s), parameters.config.drive.max_acceleration_rad_per_s2);
    Hasten(motion.Rate(period_s), config.rig.max_acceleration_rad_per_s2);
  }
  const auto model = std::make_shared<const plant::PlantModel>(std::move(parameters));
  Campaign campaign;
  std::uint64_t seed = plan.seed;
  for (const Motion& motion : motions) {
    Random random(outside_seed);
    Run run(model, config, plan, seed++,
            Disturbance(outside, outside_size, model->axes(), period_s, random));
    campaign.stable = run.Record(motion, drive_rad_per_s2, campaign.records.emplace_back());
    if (!campaign.stable) break;
  }
  return campaign;
}

bool Lifts(const plant::PlantParameters& truth, const cycle::CycleConfig& controller,
           std::uint64_t seed) {
  const auto model = std::make_shared<const plant::PlantModel>(truth);
  return SimulatedRig(controller, plant::Plant(model, seed)).Lift();
}

namespace {

double TimeOf(const RigNumbers& rig, const diagnosis::Record& record,
              const analysis::RecordedRow& row) {
  return rig.period_s() * static_cast<double>(row.cycle - record.rows.front().cycle);
}

}  // namespace

void WriteCsv(const std::vector<diagnosis::Record>& records, const RigNumbers& rig,
              const std::string& folder) {
  const session::RecordFrame frame(rig);
  for (const diagnosis::Record& record : records) {
    const std::string path = folder + "/" + record.name + ".csv";
    OutputFile file(path);
    file.Write("time_s,rotor_angle_rad");
    for (const char* kind : {"position", "control_current", "excitation"}) {
      for (const std::string& channel : rig.channels) {
        file.Write(fmt::format(",{}_{}_{}", kind, channel, *kind == 'p' ? "m" : "a"));
      }
    }
    file.Write("\n");
    const analysis::RecordedRow* before = nullptr;
    for (const analysis::RecordedRow& row : record.rows) {
      const bool without_frame = before != nullptr && row.cycle == before->cycle;
      before = &row;
      if (without_frame) continue;
      const session::AxisSample wired =
          frame.Wired({row.sample.position_m, row.sample.command.control_current_a});
      file.Write(fmt::format("{:.6f},{:.8g}", TimeOf(rig, record, row), row.sample.angle_rad));
      for (const auto* values : {&wired.position_m, &wired.current_a, &row.excitation_a}) {
        for (std::size_t a = 0; a < rig.axes(); ++a) {
          file.Write(fmt::format(",{:.8g}", (*values)[a]));
        }
      }
      file.Write("\n");
    }
    file.Commit();
  }
}

}  // namespace levitas::accuracy
