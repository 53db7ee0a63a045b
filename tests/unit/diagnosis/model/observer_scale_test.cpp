// The observer believes the same of a rotor whatever the scale in which sensors and modes show it.

#include "diagnosis/model/observer_scale.hpp"

#include <gtest/gtest.h>

#include "diagnosis/model/linear_change.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kScale = 0.8;

class ObserverScaleTest : public ::testing::Test {
 protected:
  ObserverScaleTest() {
    auto gain = std::make_shared<const analysis::ObserverGain>(
        analysis::DesignObserver(TheRig().model->config(), {}));
    gains_ = {gain, {{0, gain}}};
  }

  void Set(const std::string& effect, const std::string& place, double value) {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].effect_name() == effect && terms_[i].location.name == place) theta_[i] = value;
    }
  }

  [[nodiscard]] analysis::ObserverGain Gain() const {
    return *Divided(gains_, ObserverScale::Of(TheRig(), terms_, theta_), TheRig())
                .stages.back()
                .gain;
  }

  /// Noise alone on a rig at rest; [sample][axis], in multiples of the sensors' scale.
  [[nodiscard]] std::vector<AxisArray> Noisy(double scale) const {
    Record record;
    Random random(1);
    for (std::uint64_t n = 0; n < 2000; ++n) {
      analysis::RecordedRow& row = record.rows.emplace_back();
      row.cycle = n;
      row.levitated = true;
      row.sample.command.bias_current_a = 1.0;
      if (n == 0) continue;  // where a start places the rotor, scales are not known
      for (std::size_t a = 0; a < 4; ++a) {
        row.sample.position_m[a] = scale * 1e-6 * random.Normal();
      }
    }
    std::vector<AxisArray> innovations;
    for (const SamplePoint& m : RunModel(TheRig(), record, gains_, terms_, theta_, 0.0).moments) {
      AxisArray& innovation = innovations.emplace_back();
      for (std::size_t a = 0; a < 4; ++a) {
        innovation[a] = static_cast<double>(m.innovation_m[a]) / scale;
      }
    }
    return innovations;
  }

  std::vector<Term> terms_ = EveryTerm();
  std::vector<double> theta_ = std::vector<double>(terms_.size(), 0.0);
  ObserverGains gains_;
};

TEST_F(ObserverScaleTest, LeavesTheGainOfTheRigFileAlone) {
  EXPECT_EQ(Gain().state, gains_.steady().state);
  EXPECT_EQ(Gain().force_n_per_m, gains_.steady().force_n_per_m);
}

// Were the correction not divided, smaller readings would make a slower observer.
TEST_F(ObserverScaleTest, SensorsOfAnotherScaleThatShowTheSameRotorHaveTheSameInnovations) {
  const auto plain = Noisy(1.0);
  for (const std::string& channel : TheRig().numbers.channels) {
    Set("sensor_gain", channel, kScale - 1.0);
  }
  const auto scaled = Noisy(kScale);
  ASSERT_EQ(plain.size(), scaled.size());
  for (std::size_t n = 1; n < plain.size(); ++n) {
    for (std::size_t a = 0; a < 4; ++a) EXPECT_NEAR(scaled[n][a], plain[n][a], 1e-9) << n;
  }
}

TEST_F(ObserverScaleTest, AModeThatIsReadLargerIsFedBackAsBefore) {
  for (const char* bearing : {"de", "nde"}) {
    Set("", std::string("sensor ") + bearing + ", mode 1", kScale - 1.0);
  }
  const analysis::ObserverGain gain = Gain();
  const LinearChange change = ChangeOf(terms_, theta_);
  constexpr std::size_t kMode = 2;  // behind the two rigid ones
  const plant::StateLayout& at = TheRig().model->layout();
  for (const std::size_t first : {at.q_x, at.v_x}) {
    const auto row = static_cast<Eigen::Index>(first + kMode);
    double before = 0.0;
    double now = 0.0;
    for (std::size_t a = 0; a < TheRig().axes; a += 2) {
      const double h = TheRig().magnet(a).sensor_shape[kMode];
      const double dh = change.axis[a].sensor_q[kMode];
      ASSERT_NE(dh, 0.0);
      before += gains_.steady().state(row, static_cast<Eigen::Index>(a)) * h;
      now += gain.state(row, static_cast<Eigen::Index>(a)) * (h + dh);
    }
    EXPECT_NEAR(now / before, 1.0, 0.05);
  }
  // Other modes are none of its business.
  const auto other = static_cast<Eigen::Index>(at.q_x + 3);
  EXPECT_EQ(gain.state.row(other), gains_.steady().state.row(other));
}

}  // namespace
}  // namespace levitas::diagnosis
