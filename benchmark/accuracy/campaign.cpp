#include "benchmark/accuracy/campaign.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "analysis/recorded_rows.hpp"
#include "common/output_file.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/axis_law.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

constexpr double kSaggingM = 350e-6;  // [m] beyond it the rotor is lost
/// Of the most current, on the average over a record: an axis that gives more holds nothing any
/// more.
constexpr double kHolding = 0.8;
constexpr double kWarmUpS = 1.2;  // [s] in which the integrators find the weight

struct Motion {
  std::string name;
  double from_rpm{}, to_rpm{};
  std::size_t rows{};
  bool excited{};
};

/// Maximum-length sequence of order 11, x^11 + x^9 + 1.
class BitSequence {
 public:
  explicit BitSequence(std::uint64_t seed) : bits_(1 + seed % 2047) {}
  bool Next() {
    const std::uint64_t bit = ((bits_ >> 10) ^ (bits_ >> 8)) & 1U;
    bits_ = ((bits_ << 1) | bit) & 0x7FFU;
    return bit != 0;
  }

 private:
  std::uint64_t bits_;
};

class Loop {
 public:
  Loop(const std::shared_ptr<const plant::PlantModel>& model, const law::LawConfig& law,
       const CampaignPlan& plan, Disturbance disturbance)
      : model_(model),
        coefficients_(law),
        limit_a_(law.current_limit_a),
        period_s_(law.period_s),
        plan_(plan),
        disturbance_(disturbance),
        loss_(plan.loss.seed) {}

  bool Run(const Motion& motion, std::uint64_t seed, Measured& out) {
    plant::Plant plant(model_, seed);
    law::LawState state(coefficients_);
    const auto warm_up = static_cast<std::size_t>(kWarmUpS / period_s_);
    const auto quiet = static_cast<std::size_t>(std::llround(plan_.quiet_s / period_s_));
    const double from = RpmToRadPerS(motion.from_rpm);
    const double slope =
        RpmToRadPerS(motion.to_rpm - motion.from_rpm) / static_cast<double>(motion.rows);
    BitSequence bits(seed);
    bool bit = false;
    MeasuredRow held;
    AxisArray given_a{};
    plant.SetSpeed(from, 0.0);
    out.name = motion.name;
    out.rows.reserve(motion.rows);
    for (std::size_t n = 0; n < warm_up + motion.rows; ++n) {
      const bool recorded = n >= warm_up;
      const double speed = from + slope * (recorded ? static_cast<double>(n - warm_up) : 0.0);
      plant.SetSpeed(speed, plant.angle_rad());
      const SensorFrame frame = plant.Sample();
      MeasuredRow row;
      row.time_s = recorded ? period_s_ * static_cast<double>(n - warm_up) : 0.0;
      row.angle_rad = plant.angle_rad();
      row.speed_rad_per_s = speed;
      row.position_m = frame.position_m;
      const double clock_s = period_s_ * static_cast<double>(n);
      disturbance_.Read(clock_s, row.position_m);
      if (n >= warm_up + quiet && motion.excited) {
        const std::size_t since = n - warm_up - quiet;
        if (since % 2 == 0) bit = bits.Next();
        const std::size_t per_axis = (motion.rows - quiet) / model_->axes();
        const std::size_t axis = std::min(since / per_axis, model_->axes() - 1);
        row.excitation_a[axis] = bit ? plan_.excitation_a : -plan_.excitation_a;
      }
      // Before the integrators hold the weight the rotor sags.
      const double limit_m = !recorded              ? kSaggingM
                             : motion.to_rpm == 0.0 ? plan_.resting_m
                                                    : plan_.limit_m;
      if (!Within(limit_m, row.position_m)) return false;
      const bool lost = recorded && Lost();
      if (lost) {
        row.position_m = held.position_m;
        row.control_current_a = held.control_current_a;
        row.excitation_a = held.excitation_a;
      } else {
        row.control_current_a =
            law::Step(coefficients_, state, ErrorOf(row.position_m), row.excitation_a, limit_a_)
                .control_current_a;
      }
      held = row;
      for (std::size_t a = 0; recorded && a < model_->axes(); ++a) {
        given_a[a] += std::abs(row.control_current_a[a]);
      }
      if (recorded && !(lost && plan_.loss.missing)) out.rows.push_back(AsSent(row));
      plant.Advance(CommandOf(row, clock_s));
    }
    const double most_a = kHolding * limit_a_ * static_cast<double>(motion.rows);
    return plant.finite() && *std::max_element(given_a.begin(), given_a.end()) < most_a;
  }

 private:
  /// A record holds readings and commands as they are on the wire.
  [[nodiscard]] MeasuredRow AsSent(MeasuredRow row) const {
    for (std::size_t a = 0; a < model_->axes(); ++a) {
      row.control_current_a[a] *= model_->config().actuator_polarity[a];
    }
    return row;
  }

  [[nodiscard]] bool Within(double limit_m, const AxisArray& position_m) const {
    for (std::size_t a = 0; a < model_->axes(); ++a) {
      if (!(std::abs(position_m[a]) < limit_m)) return false;
    }
    return true;
  }

  [[nodiscard]] AxisArray ErrorOf(const AxisArray& position_m) const {
    AxisArray error_m{};
    for (std::size_t a = 0; a < model_->axes(); ++a) {
      error_m[a] = -model_->config().sensor_polarity[a] * position_m[a];
    }
    return error_m;
  }

  /// What the rig is given for this row: the disturbance's current acts without being recorded.
  plant::PlantCommand CommandOf(const MeasuredRow& row, double clock_s) {
    plant::PlantCommand command;
    command.bias_current_a = model_->config().bearings.front().magnet.bias_current_a;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = row.speed_rad_per_s;
    command.acceleration_limit_rad_per_s2 = 1e6;
    const AxisArray unknown_a = disturbance_.Current(clock_s, row.angle_rad, row.speed_rad_per_s);
    for (std::size_t a = 0; a < model_->axes(); ++a) {
      command.control_current_a[a] =
          model_->config().actuator_polarity[a] * (row.control_current_a[a] + unknown_a[a]);
    }
    return command;
  }

  bool Lost() {
    if (plan_.loss.probability <= 0.0) return false;
    if (to_lose_ == 0 && loss_.Uniform() < plan_.loss.probability) to_lose_ = plan_.loss.burst;
    if (to_lose_ == 0) return false;
    --to_lose_;
    return true;
  }

  std::shared_ptr<const plant::PlantModel> model_;
  law::LawCoefficients coefficients_;
  double limit_a_;
  double period_s_;
  const CampaignPlan& plan_;
  Disturbance disturbance_;
  Random loss_;
  std::size_t to_lose_{0};
};

}  // namespace

Campaign Record(const plant::PlantParameters& truth, const law::LawConfig& law,
                const CampaignPlan& plan, Unmodelled outside, double outside_size,
                std::uint64_t outside_seed) {
  const auto model = std::make_shared<const plant::PlantModel>(truth);
  const auto excited_rows = static_cast<std::size_t>(2 * plan.bits_per_axis) * model->axes() +
                            static_cast<std::size_t>(std::llround(plan.quiet_s / law.period_s));
  const std::vector<Motion> motions{
      {"standing", 0.0, 0.0, excited_rows, true},
      {"spinning", plan.spinning_rpm, plan.spinning_rpm, excited_rows, true},
      {"runup", plan.runup_from_rpm, plan.runup_to_rpm,
       static_cast<std::size_t>(plan.runup_s / law.period_s), false}};
  Campaign campaign;
  std::uint64_t seed = plan.seed;
  for (const Motion& motion : motions) {
    Random random(outside_seed);
    Loop loop(model, law, plan,
              Disturbance(outside, outside_size, model->axes(), law.period_s, random));
    campaign.stable = loop.Run(motion, seed++, campaign.records.emplace_back()) && campaign.stable;
    if (!campaign.stable) break;
  }
  return campaign;
}

std::vector<diagnosis::Record> AsRecords(const Campaign& campaign, const RigNumbers& rig) {
  std::vector<diagnosis::Record> records;
  for (const Measured& measured : campaign.records) {
    diagnosis::Record& record = records.emplace_back();
    record.name = measured.name;
    record.rows.reserve(measured.rows.size());
    for (std::size_t n = 0; n < measured.rows.size(); ++n) {
      const MeasuredRow& from = measured.rows[n];
      analysis::RecordedRow row;
      row.cycle = static_cast<std::uint64_t>(std::llround(from.time_s / rig.period_s()));
      row.levitated = true;
      row.sample.position_m = from.position_m;
      row.sample.command.bias_current_a = rig.bias_current_a;
      row.sample.command.control_current_a = from.control_current_a;
      row.sample.command.drive_enabled = from.speed_rad_per_s != 0.0;
      row.sample.command.speed_set_point_rad_per_s = from.speed_rad_per_s;
      row.sample.speed_rad_per_s = from.speed_rad_per_s;
      row.sample.angle_rad = from.angle_rad;
      row.excitation_a = from.excitation_a;
      record.rows.push_back(row);
    }
    record.mean_speed_rad_per_s = analysis::MeanSpeed(record.rows);
  }
  return records;
}

void WriteCsv(const Campaign& campaign, const RigNumbers& rig, const std::string& folder) {
  for (const Measured& measured : campaign.records) {
    const std::string path = folder + "/" + measured.name + ".csv";
    OutputFile file(path);
    file.Write("time_s,rotor_angle_rad");
    for (const char* kind : {"position", "control_current", "excitation"}) {
      for (const std::string& channel : rig.channels) {
        file.Write(fmt::format(",{}_{}_{}", kind, channel, *kind == 'p' ? "m" : "a"));
      }
    }
    file.Write("\n");
    for (const MeasuredRow& row : measured.rows) {
      file.Write(fmt::format("{:.6f},{:.8g}", row.time_s, row.angle_rad));
      for (const auto* values : {&row.position_m, &row.control_current_a, &row.excitation_a}) {
        for (std::size_t a = 0; a < rig.axes(); ++a)
          file.Write(fmt::format(",{:.8g}", (*values)[a]));
      }
      file.Write("\n");
    }
    file.Commit();
  }
}

}  // namespace levitas::accuracy
