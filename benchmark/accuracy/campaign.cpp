#include "benchmark/accuracy/campaign.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "analysis/records/recorded_rows.hpp"
#include "common/output_file.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/axis_law.hpp"
#include "controller/scenario/prbs.hpp"
#include "plant_sim/plant/bearing_frame.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::accuracy {
namespace {

constexpr double kSaggingM = 350e-6;  // [m] beyond it the rotor is lost
/// Mean current over a record in shares of its limit, above which an axis counts as saturated and
/// the run as unstable.
constexpr double kHolding = 0.8;
constexpr double kWarmUpS = 1.2;  // [s] in which the integrators find the weight

struct Motion {
  std::string name;
  double from_rpm{}, to_rpm{};
  std::size_t rows{};
  bool excited{};
};

/// The excitation of a seed: a maximum-length sequence of 2047 bits. Its first bit is the first
/// feedback of the register, which leaves it as many steps later as the register is long.
scenario::Prbs BitsOf(std::uint64_t seed) {
  constexpr int kOrder = 11;
  auto bits = scenario::Prbs::FromRegister(kOrder, static_cast<std::uint32_t>(1 + seed % 2047));
  bits.Skip(kOrder);
  return bits;
}

struct TestBits {
  scenario::Prbs sequence;
  bool bit{};
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

  bool Run(const Motion& motion, std::uint64_t seed, diagnosis::Record& out) {
    plant::Plant plant(model_, seed);
    law::LawState state(coefficients_);
    const auto warm_up = static_cast<std::size_t>(kWarmUpS / period_s_);
    const double from = RpmToRadPerS(motion.from_rpm);
    const double slope =
        RpmToRadPerS(motion.to_rpm - motion.from_rpm) / static_cast<double>(motion.rows);
    TestBits bits{BitsOf(seed)};
    analysis::RecordedRow held;
    AxisArray given_a{};
    plant.SetSpeed(from, 0.0);
    out.name = motion.name;
    out.rows.reserve(motion.rows);
    for (std::size_t n = 0; n < warm_up + motion.rows; ++n) {
      const bool recorded = n >= warm_up;
      const double speed = from + slope * (recorded ? static_cast<double>(n - warm_up) : 0.0);
      const double clock_s = period_s_ * static_cast<double>(n);
      analysis::RecordedRow row = Read(plant, speed, clock_s);
      analysis::RecordedSample& sample = row.sample;
      row.cycle = recorded ? n - warm_up : 0;
      if (recorded && motion.excited) Excite(motion, row.cycle, bits, row.excitation_a);
      if (!Within(LimitOf(motion, recorded), sample.position_m)) return false;
      const bool lost = recorded && Lost();
      if (lost) {
        Repeat(held, row);
      } else {
        sample.command.control_current_a =
            law::Step(coefficients_, state, ErrorOf(sample.position_m), row.excitation_a, limit_a_)
                .control_current_a;
      }
      held = row;
      for (std::size_t a = 0; recorded && a < model_->axes(); ++a) {
        given_a[a] += std::abs(sample.command.control_current_a[a]);
      }
      if (recorded && !(lost && plan_.loss.missing)) out.rows.push_back(row);
      plant.Advance(CommandOf(sample, clock_s));
    }
    const double most_a = kHolding * limit_a_ * static_cast<double>(motion.rows);
    return plant.finite() && *std::max_element(given_a.begin(), given_a.end()) < most_a;
  }

 private:
  /// Once the quiet rows have passed: one axis after the other, each bit for two rows.
  void Excite(const Motion& motion, std::size_t row, TestBits& bits,
              AxisArray& excitation_a) const {
    const auto quiet = static_cast<std::size_t>(std::llround(plan_.quiet_s / period_s_));
    if (row < quiet) return;
    const std::size_t since = row - quiet;
    if (since % 2 == 0) bits.bit = bits.sequence.Next();
    const std::size_t per_axis = (motion.rows - quiet) / model_->axes();
    const std::size_t axis = std::min(since / per_axis, model_->axes() - 1);
    excitation_a[axis] = bits.bit ? plan_.excitation_a : -plan_.excitation_a;
  }

  /// Before the integrators hold the weight the rotor sags.
  [[nodiscard]] double LimitOf(const Motion& motion, bool recorded) const {
    if (!recorded) return kSaggingM;
    return motion.to_rpm == 0.0 ? plan_.resting_m : plan_.limit_m;
  }

  /// What a row that was lost says: the one before.
  static void Repeat(const analysis::RecordedRow& held, analysis::RecordedRow& row) {
    row.sample.position_m = held.sample.position_m;
    row.sample.command.control_current_a = held.sample.command.control_current_a;
    row.excitation_a = held.excitation_a;
  }

  /// A row without control current and test signal.
  analysis::RecordedRow Read(plant::Plant& plant, double speed_rad_per_s, double clock_s) {
    plant.SetSpeed(speed_rad_per_s, plant.angle_rad());
    analysis::RecordedRow row;
    row.levitated = true;
    analysis::RecordedSample& sample = row.sample;
    sample.position_m = plant.Sample().position_m;
    disturbance_.Read(clock_s, sample.position_m);
    sample.angle_rad = plant.angle_rad();
    sample.speed_rad_per_s = speed_rad_per_s;
    sample.command.bias_current_a = model_->config().bearings.front().magnet.bias_current_a;
    sample.command.drive_enabled = speed_rad_per_s != 0.0;
    sample.command.speed_set_point_rad_per_s = speed_rad_per_s;
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
      error_m[a] = -position_m[a];
    }
    return error_m;
  }

  /// What the rig is given for this sample: the disturbance's current acts without being recorded.
  plant::PlantCommand CommandOf(const analysis::RecordedSample& sample, double clock_s) {
    plant::PlantCommand command = sample.command;
    command.drive_enabled = true;
    command.acceleration_limit_rad_per_s2 = 1e6;
    const AxisArray unknown_a =
        disturbance_.Current(clock_s, sample.angle_rad, sample.speed_rad_per_s);
    for (std::size_t a = 0; a < model_->axes(); ++a) command.control_current_a[a] += unknown_a[a];
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
  plant::PlantParameters parameters = truth;
  parameters.config = plant::InBearingFrame(truth.config);
  const auto model = std::make_shared<const plant::PlantModel>(std::move(parameters));
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
    campaign.records.back().mean_speed_rad_per_s =
        analysis::MeanSpeed(campaign.records.back().rows);
    if (!campaign.stable) break;
  }
  return campaign;
}

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
    for (const analysis::RecordedRow& row : record.rows) {
      const session::AxisSample wired =
          frame.Wired({row.sample.position_m, row.sample.command.control_current_a});
      file.Write(fmt::format("{:.6f},{:.8g}", rig.period_s() * static_cast<double>(row.cycle),
                             row.sample.angle_rad));
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
