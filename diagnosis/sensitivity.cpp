#include "diagnosis/sensitivity.hpp"

#include <Eigen/Core>
#include <cmath>

#include "plant_sim/plant/mode_step.hpp"

namespace levitas::diagnosis {
namespace {

using Lane = std::array<float, kLanes>;

inline void AddScaled(Lane& to, float scale, const Lane& from) noexcept {
  for (std::size_t l = 0; l < kLanes; ++l) to[l] += scale * from[l];
}

/// One term: what it adds with and without the step.
struct Probe {
  Term now, stepped;
  double theta{}, step{}, scale{};
  bool linear{};
};

struct BearingNumbers {
  std::vector<float> actuator, sensor;  ///< shapes
  float coil_decay{}, coil_mean{};
  float sensor_decay{}, sensor_start{}, sensor_end{};
};

}  // namespace

struct SensitivityBlock::Impl {
  Impl(const RigView& view, std::shared_ptr<const analysis::ObserverGain> observer,
       const std::vector<Term>& terms, const std::vector<double>& theta,
       std::vector<std::size_t> which)
      : rig(view), gain(std::move(observer)), chosen(std::move(which)) {
    for (const std::size_t i : chosen) {
      Probe probe{terms[i], terms[i], theta[i], terms[i].step, terms[i].scale(), terms[i].linear};
      probes.push_back(std::move(probe));
    }
    const plant::StateLayout& at = rig.model->layout();
    const auto axes = static_cast<Eigen::Index>(rig.axes);
    const auto rows = static_cast<Eigen::Index>(4 * rig.modes);
    k_modal = gain->state.topRows(rows).cast<float>();
    k_coil = gain->state.middleRows(static_cast<Eigen::Index>(at.coil_current), axes).cast<float>();
    k_sensor = gain->state.middleRows(static_cast<Eigen::Index>(at.sensor), axes).cast<float>();
    k_force = gain->force_n_per_m.cast<float>();
    for (std::size_t m = 0; m < rig.modes; ++m) {
      steps.push_back(
          plant::MakeModeStep(rig.omega_rad_per_s[m], rig.damping_ratio[m], rig.period_s));
      halves.push_back(
          plant::MakeModeStep(rig.omega_rad_per_s[m], rig.damping_ratio[m], 0.5 * rig.period_s));
    }
    for (std::size_t b = 0; b < rig.axes / 2; ++b) AddBearing(b);
    for (const double g : rig.model->gyroscopic()) gyroscopic.push_back(static_cast<float>(g));
    Clear();
  }

  void AddBearing(std::size_t b) {
    const auto& config = rig.model->config().bearings[b];
    const auto& model = rig.model->bearings()[b];
    BearingNumbers n;
    n.actuator = {model.actuator_shape.begin(), model.actuator_shape.end()};
    n.sensor = {model.sensor_shape.begin(), model.sensor_shape.end()};
    const auto amplifier = amplifier::MakeStep(config.amplifier.bandwidth_hz, 0.0, rig.period_s);
    n.coil_decay = static_cast<float>(amplifier.decay);
    n.coil_mean =
        static_cast<float>((1.0 - amplifier.decay) * amplifier.tau_s / amplifier.duration_s);
    const auto filter =
        sensor::MakeFilterStep(config.sensor.bandwidth_hz, config.sensor.gain, rig.period_s);
    n.sensor_decay = static_cast<float>(filter.decay);
    n.sensor_start = static_cast<float>(filter.start);
    n.sensor_end = static_cast<float>(filter.end);
    bearings.push_back(std::move(n));
  }

  void Clear() noexcept {
    for (auto* block : {&q, &v}) {
      for (Lane& lane : *block) lane = {};
    }
    coil = sensor = force = reading_next = {};
  }

  /// d(addition)/d(theta) of every probe, into the lanes.
  template <class Call>
  void Derive(Call call) noexcept {
    for (std::size_t l = 0; l < probes.size(); ++l) {
      Probe& p = probes[l];
      Addition d;
      auto scale = static_cast<float>(p.scale);
      if (p.linear) {
        if (!call(p.now, 1.0, d)) continue;
      } else {
        Addition base;
        if (!call(p.stepped, p.theta + p.step, d)) continue;
        call(p.now, p.theta, base);
        Subtract(d, base);
        scale = static_cast<float>(p.scale / p.step);
      }
      for (std::size_t a = 0; a < rig.axes; ++a) {
        add_force[a][l] = scale * static_cast<float>(d.force_n[a]);
        add_coil_end[a][l] = scale * static_cast<float>(d.coil_end_a[a]);
        add_coil_mean[a][l] = scale * static_cast<float>(d.coil_mean_a[a]);
        add_reading[a][l] += scale * static_cast<float>(d.reading_m[a]);
      }
      if (!d.has_modal) continue;
      for (std::size_t i = 0; i < 2 * rig.modes; ++i) {
        add_modal[i][l] = scale * static_cast<float>(d.modal[i]);
      }
    }
  }

  void Subtract(Addition& d, const Addition& base) const noexcept {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      d.force_n[a] -= base.force_n[a];
      d.coil_end_a[a] -= base.coil_end_a[a];
      d.coil_mean_a[a] -= base.coil_mean_a[a];
      d.reading_m[a] -= base.reading_m[a];
    }
    for (std::size_t i = 0; i < 2 * rig.modes; ++i) d.modal[i] -= base.modal[i];
    d.has_modal = d.has_modal || base.has_modal;
  }

  void Step(const Moment& m, float* derivative) noexcept {
    if (m.restarted) Clear();
    add_reading = reading_next;
    Derive([&](Term& term, double theta, Addition& add) {
      if (!term.read) return false;
      term.read(m, theta, add);
      return true;
    });
    std::array<Lane, kMaxAxes> e{};
    for (std::size_t a = 0; a < rig.axes; ++a) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        e[a][l] = -(sensor[a][l] + add_reading[a][l]);
        derivative[a * kLanes + l] = e[a][l];
      }
    }
    Correct(e);
    add_force = add_coil_end = add_coil_mean = add_reading = {};
    for (Lane& lane : add_modal) lane = {};
    Derive([&](Term& term, double theta, Addition& add) {
      if (!term.drive) return false;
      term.drive(m, theta, add);
      return true;
    });
    reading_next = add_reading;
    Advance(m);
  }

  void Correct(const std::array<Lane, kMaxAxes>& e) noexcept {
    const std::size_t modal = 2 * rig.modes;
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const auto column = static_cast<Eigen::Index>(a);
      for (std::size_t i = 0; i < modal; ++i) {
        AddScaled(q[i], k_modal(static_cast<Eigen::Index>(i), column), e[a]);
        AddScaled(v[i], k_modal(static_cast<Eigen::Index>(modal + i), column), e[a]);
      }
      for (std::size_t i = 0; i < rig.axes; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        AddScaled(coil[i], k_coil(row, column), e[a]);
        AddScaled(sensor[i], k_sensor(row, column), e[a]);
        AddScaled(force[i], k_force(row, column), e[a]);
      }
    }
  }

  void Advance(const Moment& m) noexcept {
    // Forces that follow the motion are taken in the middle of the period: at its start they would
    // feed the fast modes.
    for (std::size_t i = 0; i < 2 * rig.modes; ++i) {
      const plant::ModeStep& s = halves[i % rig.modes];
      q_mid[i] = v_mid[i] = {};
      AddScaled(q_mid[i], static_cast<float>(s.xx), q[i]);
      AddScaled(q_mid[i], static_cast<float>(s.xv), v[i]);
      AddScaled(v_mid[i], static_cast<float>(s.vx), q[i]);
      AddScaled(v_mid[i], static_cast<float>(s.vv), v[i]);
    }
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const BearingNumbers& b = bearings[a / 2];
      const std::size_t plane = (a % 2) * rig.modes;
      Lane x{};
      Lane p{};
      for (std::size_t i = 0; i < rig.modes; ++i) {
        AddScaled(x, b.actuator[i], q_mid[plane + i]);
        AddScaled(p, b.sensor[i], q[plane + i]);
      }
      Lane f;
      for (std::size_t l = 0; l < kLanes; ++l) {
        const float mean = coil[a][l] * b.coil_mean + add_coil_mean[a][l];
        f[l] = m.force_per_a[a] * mean + m.force_per_m[a] * x[l] + force[a][l] + add_force[a][l];
        coil[a][l] = coil[a][l] * b.coil_decay + add_coil_end[a][l];
        sensor[a][l] = sensor[a][l] * b.sensor_decay + b.sensor_start * p[l];
      }
      for (std::size_t i = 0; i < rig.modes; ++i) AddScaled(add_modal[plane + i], b.actuator[i], f);
    }
    if (m.speed_rad_per_s != 0.0F) AddGyroscopic(m.speed_rad_per_s);
    for (std::size_t i = 0; i < 2 * rig.modes; ++i) {
      const plant::ModeStep& s = steps[i % rig.modes];
      const auto xx = static_cast<float>(s.xx);
      const auto xv = static_cast<float>(s.xv);
      const auto vx = static_cast<float>(s.vx);
      const auto vv = static_cast<float>(s.vv);
      const auto x0 = static_cast<float>(s.x0);
      const auto v0 = static_cast<float>(s.v0);
      for (std::size_t l = 0; l < kLanes; ++l) {
        const float before = q[i][l];
        const float f = add_modal[i][l];
        q[i][l] = xx * before + xv * v[i][l] + x0 * f;
        v[i][l] = vx * before + vv * v[i][l] + v0 * f;
      }
    }
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const BearingNumbers& b = bearings[a / 2];
      for (std::size_t i = 0; i < rig.modes; ++i) {
        AddScaled(sensor[a], b.sensor_end * b.sensor[i], q[(a % 2) * rig.modes + i]);
      }
    }
  }

  void AddGyroscopic(float speed) noexcept {
    const std::size_t modes = rig.modes;
    for (std::size_t c = 0; c < modes; ++c) {
      for (std::size_t i = 0; i < modes; ++i) {
        const float g = speed * gyroscopic[c * modes + i];
        AddScaled(add_modal[i], -g, v_mid[modes + c]);
        AddScaled(add_modal[modes + i], g, v_mid[c]);
      }
    }
  }

  const RigView& rig;
  std::shared_ptr<const analysis::ObserverGain> gain;
  std::vector<std::size_t> chosen;
  std::vector<Probe> probes;
  Eigen::MatrixXf k_modal, k_coil, k_sensor, k_force;
  std::vector<plant::ModeStep> steps, halves;
  std::vector<BearingNumbers> bearings;
  std::vector<float> gyroscopic;
  std::array<Lane, 2 * kMaxModes> q{}, v{}, q_mid{}, v_mid{}, add_modal{};
  std::array<Lane, kMaxAxes> coil{}, sensor{}, force{}, reading_next{};
  std::array<Lane, kMaxAxes> add_force{}, add_coil_end{}, add_coil_mean{}, add_reading{};
};

SensitivityBlock::SensitivityBlock(const RigView& rig,
                                   std::shared_ptr<const analysis::ObserverGain> gain,
                                   const std::vector<Term>& terms, const std::vector<double>& theta,
                                   std::vector<std::size_t> chosen)
    : impl_(std::make_unique<Impl>(rig, std::move(gain), terms, theta, std::move(chosen))) {}
SensitivityBlock::~SensitivityBlock() = default;
SensitivityBlock::SensitivityBlock(SensitivityBlock&&) noexcept = default;

void SensitivityBlock::Step(const Moment& moment, float* derivative_m) noexcept {
  impl_->Step(moment, derivative_m);
}
const std::vector<std::size_t>& SensitivityBlock::chosen() const noexcept { return impl_->chosen; }

}  // namespace levitas::diagnosis
