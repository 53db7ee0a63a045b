#include "diagnosis/model/tangent_batch.hpp"

#include <Eigen/Eigenvalues>

#include "diagnosis/model/train_coupling.hpp"
#include "plant_sim/amplifier/amplifier.hpp"
#include "plant_sim/plant/mode_step.hpp"
#include "plant_sim/sensor/sensor.hpp"

// The bodies are inlined into a version for AVX2 and one for every processor.
#define LEVITAS_INLINE [[gnu::always_inline]] inline  // NOLINT: an attribute cannot be a constant

namespace levitas::diagnosis {
namespace {

using Vector = Lane::Vector;

LEVITAS_INLINE void ReadingBody(const TangentBatch& k, const SamplePoint& m, const LaneState& s,
                                std::array<Lane, kMaxAxes>& reading) noexcept {
  for (std::size_t a = 0; a < k.axes; ++a) {
    const TangentBatch::Axis& axis = k.axis[a];
    Vector y = (1.0F + m.added.reading_per_m[a]) * s.sensor[a].value;
    if (axis.adds) {
      const std::size_t plane = (a % 2) * k.modes;
      for (std::size_t i = 0; i < k.modes; ++i) {
        y += axis.added_q[i] * s.q[plane + i].value + axis.added_v[i] * s.v[plane + i].value;
      }
    }
    reading[a].value = y;
  }
}

LEVITAS_INLINE void CorrectBody(const TangentBatch& k, const std::array<Lane, kMaxAxes>& e,
                                LaneState& s) noexcept {
  for (std::size_t i = 0; i < 2 * k.modes; ++i) {
    Vector q = s.q[i].value;
    Vector v = s.v[i].value;
    for (std::size_t a = 0; a < k.axes; ++a) {
      q += k.correct_q[i * k.axes + a] * e[a].value;
      v += k.correct_v[i * k.axes + a] * e[a].value;
    }
    s.q[i].value = q;
    s.v[i].value = v;
  }
  for (std::size_t i = 0; i < k.axes; ++i) {
    for (std::size_t a = 0; a < k.axes; ++a) {
      s.coil[i].value += k.correct_coil[i * k.axes + a] * e[a].value;
      s.sensor[i].value += k.correct_sensor[i * k.axes + a] * e[a].value;
      s.force[i].value += k.correct_force[i * k.axes + a] * e[a].value;
    }
  }
}

/// Magnets, amplifiers and the start of the sensors' filters.
LEVITAS_INLINE void Magnets(const TangentBatch& k, const SamplePoint& m,
                            const std::array<Lane, 2 * kMaxModes>& q_mid, LaneState& s) noexcept {
  std::array<Lane, kMaxAxes> lead;  // NOLINT(cppcoreguidelines-pro-type-member-init): as above
  for (std::size_t a = 0; a < k.axes; ++a) {
    const TangentBatch::Axis& b = k.axis[a];
    const std::size_t plane = (a % 2) * k.modes;
    Vector x{};
    Vector p{};
    for (std::size_t i = 0; i < k.modes; ++i) {
      x += b.actuator[i] * q_mid[plane + i].value;
      p += b.sensor[i] * s.q[plane + i].value;
    }
    const Vector mean = s.coil[a].value * b.coil_mean + s.add_coil_mean[a].value;
    const float per_a = m.force_per_a[a] + m.added.force_per_a[a];
    lead[a].value = per_a * b.coil_lead * s.coil[a].value;
    const Vector f = per_a * mean + (m.force_per_m[a] + m.added.force_per_m[a]) * x +
                     s.force[a].value + s.add_force[a].value;
    s.coil[a].value = s.coil[a].value * b.coil_decay + s.add_coil_end[a].value;
    s.sensor[a].value = s.sensor[a].value * b.sensor_decay + b.sensor_start * p;
    for (std::size_t i = 0; i < k.modes; ++i) s.add_modal[plane + i].value += b.drive[i] * f;
  }
  for (std::size_t a = 0; a < k.axes; ++a) {
    const std::size_t plane = (a % 2) * k.modes;
    for (std::size_t i = 0; i < k.modes; ++i) {
      s.q[plane + i].value += k.axis[a].drive[i] * lead[a].value;
    }
  }
}

/// What gyroscopic moments make of the velocities in half a period, as if nothing else acted: each
/// of their own directions turns from one plane into the other by its rate times the speed.
LEVITAS_INLINE void TurnHalf(const TangentBatch& k, float speed, LaneState& s) noexcept {
  constexpr float kNone = 1e-6F;  // of half an angle: a hundredth of a radian in 2500 periods
  for (std::size_t d = 0; d < k.modes; ++d) {
    const float half = k.turn_rate[d] * speed;
    if (half < kNone && half > -kNone) continue;
    // Cosine and sine by the tangent of half the angle: whatever its series leaves out, the length
    // of the velocity stays.
    const float t = half * (1.0F + half * half * (1.0F / 3.0F + half * half * (2.0F / 15.0F)));
    const float sine = 2.0F * t / (1.0F + t * t);
    const float less = -t * sine;
    const float* share = k.turning.data() + d * k.modes;
    Vector x{};
    Vector y{};
    for (std::size_t i = 0; i < k.modes; ++i) {
      x += share[i] * s.v[i].value;
      y += share[i] * s.v[k.modes + i].value;
    }
    const Vector add_x = less * x - sine * y;
    const Vector add_y = sine * x + less * y;
    for (std::size_t i = 0; i < k.modes; ++i) {
      s.v[i].value += share[i] * add_x;
      s.v[k.modes + i].value += share[i] * add_y;
    }
  }
}

/// Supports and teeth of geared shafts.
LEVITAS_INLINE void Coupling(const TangentBatch& k, const std::array<Lane, 2 * kMaxModes>& q_mid,
                             const std::array<Lane, 2 * kMaxModes>& v_mid, LaneState& s) noexcept {
  const std::size_t count = 2 * k.modes;
  for (std::size_t i = 0; i < count; ++i) {
    Vector f{};
    for (std::size_t c = 0; c < count; ++c) {
      f +=
          k.coupled_q[i * count + c] * q_mid[c].value + k.coupled_v[i * count + c] * v_mid[c].value;
    }
    s.add_modal[i].value -= f;
  }
}

LEVITAS_INLINE void AdvanceBody(const TangentBatch& k, const SamplePoint& m,
                                LaneState& s) noexcept {
  // Gyroscopic moments turn the velocities half before and half after everything else (Strang
  // 1968, SIAM J. Numer. Anal. 5(3), 506): taken as forces of a known velocity they would feed a
  // mode that a speed W splits by W g with (W g)^2 T/2 per second, more than it is damped.
  if (m.speed_rad_per_s != 0.0F) TurnHalf(k, m.speed_rad_per_s, s);
  // Forces that follow the motion are taken in the middle of the period: at its start they would
  // feed the fast modes.
  // Written below as far as they are read; zeroing the rest costs more than the loop.
  std::array<Lane, 2 * kMaxModes> q_mid;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  for (std::size_t i = 0; i < 2 * k.modes; ++i) {
    const TangentBatch::Mode& n = k.mode[i % k.modes];
    q_mid[i].value = n.half_xx * s.q[i].value + n.half_xv * s.v[i].value;
  }
  std::array<Lane, 2 * kMaxModes> v_mid;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const bool coupled = !k.coupled_q.empty();
  for (std::size_t i = 0; coupled && i < 2 * k.modes; ++i) {
    const TangentBatch::Mode& n = k.mode[i % k.modes];
    v_mid[i].value = n.half_vx * s.q[i].value + n.half_vv * s.v[i].value;
  }
  Magnets(k, m, q_mid, s);
  if (coupled) Coupling(k, q_mid, v_mid, s);
  for (std::size_t i = 0; i < 2 * k.modes; ++i) {
    const TangentBatch::Mode& n = k.mode[i % k.modes];
    const Vector q = s.q[i].value;
    const Vector v = s.v[i].value;
    const Vector f = s.add_modal[i].value;
    s.q[i].value = n.xx * q + n.xv * v + n.x0 * f;
    s.v[i].value = n.vx * q + n.vv * v + n.v0 * f;
    s.add_modal[i].value = Vector{};
  }
  if (m.speed_rad_per_s != 0.0F) TurnHalf(k, m.speed_rad_per_s, s);
  for (std::size_t a = 0; a < k.axes; ++a) {
    const TangentBatch::Axis& b = k.axis[a];
    Vector p{};
    for (std::size_t i = 0; i < k.modes; ++i) {
      p += b.sensor[i] * s.q[(a % 2) * k.modes + i].value;
    }
    s.sensor[a].value += b.sensor_end * p;
    s.add_force[a].value = s.add_coil_end[a].value = s.add_coil_mean[a].value = Vector{};
  }
}

#if defined(__x86_64__)
bool HasAvx2() noexcept {
  static const bool kHas = __builtin_cpu_supports("avx2") != 0;
  return kHas;
}
[[gnu::target("avx2")]] void ReadingAvx2(const TangentBatch& k, const SamplePoint& m,
                                         const LaneState& s,
                                         std::array<Lane, kMaxAxes>& reading) noexcept {
  ReadingBody(k, m, s, reading);
}
[[gnu::target("avx2")]] void CorrectAvx2(const TangentBatch& k, const std::array<Lane, kMaxAxes>& e,
                                         LaneState& s) noexcept {
  CorrectBody(k, e, s);
}
[[gnu::target("avx2")]] void AdvanceAvx2(const TangentBatch& k, const SamplePoint& m,
                                         LaneState& s) noexcept {
  AdvanceBody(k, m, s);
}
#endif

std::vector<float> RowMajor(const Eigen::MatrixXd& matrix) {
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(matrix.size()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      out.push_back(static_cast<float>(matrix(i, k)));
  }
  return out;
}

TangentBatch::Mode ModeOf(double omega_rad_per_s, double damping_ratio, double period_s) {
  const auto whole = plant::MakeModeStep(omega_rad_per_s, damping_ratio, period_s);
  const auto half = plant::MakeModeStep(omega_rad_per_s, damping_ratio, 0.5 * period_s);
  const auto f = [](double value) { return static_cast<float>(value); };
  return {f(whole.xx), f(whole.xv), f(whole.vx), f(whole.vv), f(whole.x0),
          f(whole.v0), f(half.xx),  f(half.xv),  f(half.vx),  f(half.vv)};
}

TangentBatch::Axis AxisOf(const RigView& rig, std::size_t a, const LinearChange& change) {
  const auto& config = rig.bearing(a);
  const auto& model = rig.magnet(a);
  const LinearChange::Axis& changed = change.axis[a];
  TangentBatch::Axis n;
  for (std::size_t i = 0; i < rig.modes; ++i) {
    n.actuator[i] = static_cast<float>(model.actuator_shape[i]);
    n.drive[i] =
        static_cast<float>((model.actuator_shape[i] + changed.drive[i]) * change.mode[i].drive);
    n.sensor[i] = static_cast<float>(model.sensor_shape[i]);
    n.added_q[i] = static_cast<float>(changed.sensor_q[i]);
    n.added_v[i] = static_cast<float>(changed.sensor_v[i]);
    n.adds = n.adds || changed.sensor_q[i] != 0.0 || changed.sensor_v[i] != 0.0;
  }
  const auto amplifier =
      amplifier::MakeStep(config.amplifier.bandwidth_hz * changed.coil_rate, 0.0, rig.period_s);
  n.coil_decay = static_cast<float>(amplifier.decay);
  n.coil_mean =
      static_cast<float>((1.0 - amplifier.decay) * amplifier.tau_s / amplifier.duration_s);
  // Integral of (T/2 - t) exp(-t/tau) over the period.
  const double tau_s = amplifier.tau_s;
  n.coil_lead =
      static_cast<float>(tau_s * ((0.5 * amplifier.duration_s - tau_s) * (1.0 - amplifier.decay) +
                                  amplifier.decay * amplifier.duration_s));
  const auto filter =
      sensor::MakeFilterStep(config.sensor.bandwidth_hz, config.sensor.gain, rig.period_s);
  n.sensor_decay = static_cast<float>(filter.decay);
  n.sensor_start = static_cast<float>(filter.start);
  n.sensor_end = static_cast<float>(filter.end);
  return n;
}

}  // namespace

TangentBatch::TangentBatch(const RigView& rig, const analysis::ObserverGain& gain,
                           const LinearChange& change)
    : axes(rig.axes), modes(rig.modes) {
  const plant::StateLayout& at = rig.model->layout();
  const auto count = static_cast<Eigen::Index>(axes);
  const auto modal = static_cast<Eigen::Index>(2 * modes);
  correct_q = RowMajor(gain.state.topRows(modal));
  correct_v = RowMajor(gain.state.middleRows(modal, modal));
  correct_coil = RowMajor(gain.state.middleRows(static_cast<Eigen::Index>(at.coil_current), count));
  correct_sensor = RowMajor(gain.state.middleRows(static_cast<Eigen::Index>(at.sensor), count));
  correct_force = RowMajor(gain.force_n_per_m);
  for (std::size_t i = 0; i < modes; ++i) {
    const LinearChange::Mode& changed = change.mode[i];
    mode.push_back(ModeOf(rig.omega_rad_per_s[i] * changed.frequency,
                          rig.damping_ratio[i] * changed.damping / changed.frequency,
                          rig.period_s));
  }
  for (std::size_t a = 0; a < axes; ++a) axis.push_back(AxisOf(rig, a, change));
  const Eigen::Map<const Eigen::MatrixXd> per_speed(rig.model->gyroscopic().data(),
                                                    static_cast<Eigen::Index>(modes),
                                                    static_cast<Eigen::Index>(modes));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> own(per_speed);
  turning = RowMajor(own.eigenvectors().transpose());
  for (const double rate : own.eigenvalues()) {
    turn_rate.push_back(static_cast<float>(0.25 * rig.period_s * rate * change.gyroscopic));
  }
  const TrainCoupling coupling = CouplingOf(rig, change);
  coupled_q = RowMajor(coupling.stiffness);
  coupled_v = RowMajor(coupling.damping);
}

void Reading(const TangentBatch& model, const SamplePoint& moment, const LaneState& state,
             std::array<Lane, kMaxAxes>& reading) noexcept {
#if defined(__x86_64__)
  if (HasAvx2()) return ReadingAvx2(model, moment, state, reading);
#endif
  ReadingBody(model, moment, state, reading);
}

void Correct(const TangentBatch& model, const std::array<Lane, kMaxAxes>& e,
             LaneState& state) noexcept {
#if defined(__x86_64__)
  if (HasAvx2()) return CorrectAvx2(model, e, state);
#endif
  CorrectBody(model, e, state);
}

void Advance(const TangentBatch& model, const SamplePoint& moment, LaneState& state) noexcept {
#if defined(__x86_64__)
  if (HasAvx2()) return AdvanceAvx2(model, moment, state);
#endif
  AdvanceBody(model, moment, state);
}

}  // namespace levitas::diagnosis
