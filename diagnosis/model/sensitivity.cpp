#include "diagnosis/model/sensitivity.hpp"

#include <algorithm>
#include <utility>

namespace levitas::diagnosis {
namespace {

/// Ready for the next term; what was not touched is zero already.
void Empty(Contribution& add, std::size_t axes, std::size_t modes) noexcept {
  for (std::size_t a = 0; a < axes; ++a) {
    add.force_n[a] = add.coil_end_a[a] = add.coil_mean_a[a] = add.reading_m[a] = 0.0;
  }
  if (!add.has_modal) return;
  std::fill_n(add.modal.begin(), 2 * modes, 0.0);
  add.has_modal = false;
}

void Subtract(Contribution& from, const Contribution& what, std::size_t axes,
              std::size_t modes) noexcept {
  for (std::size_t a = 0; a < axes; ++a) {
    from.force_n[a] -= what.force_n[a];
    from.coil_end_a[a] -= what.coil_end_a[a];
    from.coil_mean_a[a] -= what.coil_mean_a[a];
    from.reading_m[a] -= what.reading_m[a];
  }
  if (!what.has_modal) return;
  for (std::size_t i = 0; i < 2 * modes; ++i) from.modal[i] -= what.modal[i];
  from.has_modal = true;
}

}  // namespace

SensitivityBlock::SensitivityBlock(const RigView& rig, LaneModels models,
                                   const std::vector<Term>& terms, const std::vector<double>& theta,
                                   std::vector<std::size_t> chosen)
    : models_(std::move(models)), model_(models_.start), chosen_(std::move(chosen)) {
  probes_.reserve(chosen_.size());
  for (const std::size_t i : chosen_) {
    probes_.push_back(
        {terms[i], terms[i], theta[i], terms[i].step, terms[i].scale(), terms[i].linear});
    if (terms[i].moves_coil) AddRetimed(terms, theta, i, probes_.back());
    if (terms[i].scales || terms[i].change) AddRescaled(rig, terms, theta, i);
  }
}

void SensitivityBlock::AddRescaled(const RigView& rig, const std::vector<Term>& terms,
                                   const std::vector<double>& theta, std::size_t chosen) {
  std::vector<double> stepped = theta;
  const double step = 1e-3 * terms[chosen].scale();
  stepped[chosen] += step;
  const ObserverScale now = ObserverScale::Of(rig, terms, theta);
  const ObserverScale then = ObserverScale::Of(rig, terms, stepped);
  Rescaled r;
  r.lane = probes_.size() - 1;
  bool any = false;
  const auto relative = [&](double from, double to, float& out) {
    out = static_cast<float>(terms[chosen].scale() / step * (to - from) / from);
    any = any || out != 0.0F;
  };
  for (std::size_t a = 0; a < rig.axes; ++a) {
    relative(now.readings[a], then.readings[a], r.readings[a]);
  }
  for (std::size_t i = 0; i < 2 * rig.modes; ++i) relative(now.modes[i], then.modes[i], r.modes[i]);
  if (any) rescaled_.push_back(r);
}

void SensitivityBlock::AddRetimed(const std::vector<Term>& terms, const std::vector<double>& theta,
                                  std::size_t chosen, Probe& probe) {
  std::vector<double> stepped = theta;
  stepped[chosen] += probe.step;
  const LinearChange change = ChangeOf(terms, stepped);
  probe.late_periods = static_cast<float>(change.late_periods);
  for (std::size_t a = 0; a < kMaxAxes; ++a) {
    probe.coil_rate[a] = static_cast<float>(change.axis[a].coil_rate);
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].timed && theta[i] != 0.0) probe.retimed.push_back({terms[i], terms[i], theta[i]});
  }
}

void SensitivityBlock::Clear() noexcept {
  state_ = LaneState{};
  reading_ = {};
}

template <class Call>
float SensitivityBlock::Difference(Probe& p, Call call) noexcept {
  Empty(difference_, model_->axes, model_->modes);
  if (p.linear) {
    call(p.now, 1.0, difference_);
    return static_cast<float>(p.scale);
  }
  Empty(base_, model_->axes, model_->modes);
  call(p.stepped, p.theta + p.step, difference_);
  call(p.now, p.theta, base_);
  Subtract(difference_, base_, model_->axes, model_->modes);
  return static_cast<float>(p.scale / p.step);
}

void SensitivityBlock::Read(const SamplePoint& m, float* derivative_m) noexcept {
  for (std::size_t l = 0; l < probes_.size(); ++l) {
    if (!probes_[l].now.read) continue;
    const float scale = Difference(probes_[l], [&m](Term& term, double theta, Contribution& add) {
      term.read(m, theta, add);
    });
    for (std::size_t a = 0; a < model_->axes; ++a) {
      reading_[a].value[l] += scale * static_cast<float>(difference_.reading_m[a]);
    }
  }
  std::array<Lane, kMaxAxes> e{};
  Reading(*model_, m, state_, e);
  for (std::size_t a = 0; a < model_->axes; ++a) {
    e[a].value = -(e[a].value + reading_[a].value);
    if (!m.arrived) e[a] = Lane{};
    for (std::size_t l = 0; l < kLanes; ++l) derivative_m[a * kLanes + l] = e[a].value[l];
    reading_[a] = Lane{};
  }
  if (!m.arrived) return;
  // The gain is divided by the scales, which some terms change.
  const TangentBatch& model = models_.At(m);
  for (const Rescaled& r : rescaled_) {
    for (std::size_t a = 0; a < model.axes; ++a) {
      e[a].value[r.lane] -= r.readings[a] * m.innovation_m[a];
    }
  }
  Correct(model, e, state_);
  for (const Rescaled& r : rescaled_) CorrectModes(model, r, m);
}

void SensitivityBlock::CorrectModes(const TangentBatch& model, const Rescaled& r,
                                    const SamplePoint& m) noexcept {
  for (std::size_t i = 0; i < 2 * model.modes; ++i) {
    if (r.modes[i] == 0.0F) continue;
    float q = 0.0F;
    float v = 0.0F;
    for (std::size_t a = 0; a < model.axes; ++a) {
      q += model.correct_q[i * model.axes + a] * m.innovation_m[a];
      v += model.correct_v[i * model.axes + a] * m.innovation_m[a];
    }
    state_.q[i].value[r.lane] -= r.modes[i] * q;
    state_.v[i].value[r.lane] -= r.modes[i] * v;
  }
}

void SensitivityBlock::Drive(const SamplePoint& m) noexcept {
  for (std::size_t l = 0; l < probes_.size(); ++l) {
    if (!probes_[l].now.drive) continue;
    const float scale = Difference(probes_[l], [&m](Term& term, double theta, Contribution& add) {
      term.drive(m, theta, add);
    });
    const Contribution& d = difference_;
    for (std::size_t a = 0; a < model_->axes; ++a) {
      state_.add_force[a].value[l] = scale * static_cast<float>(d.force_n[a]);
      state_.add_coil_end[a].value[l] = scale * static_cast<float>(d.coil_end_a[a]);
      state_.add_coil_mean[a].value[l] = scale * static_cast<float>(d.coil_mean_a[a]);
      reading_[a].value[l] = scale * static_cast<float>(d.reading_m[a]);
    }
    if (!probes_[l].retimed.empty()) DriveRetimed(probes_[l], l, m);
    if (!d.has_modal) continue;
    for (std::size_t i = 0; i < 2 * model_->modes; ++i) {
      state_.add_modal[i].value[l] = scale * static_cast<float>(d.modal[i]);
    }
  }
}

void SensitivityBlock::DriveRetimed(Probe& p, std::size_t lane, const SamplePoint& m) noexcept {
  SamplePoint other = m;
  other.late_periods = p.late_periods;
  other.coil_rate = p.coil_rate;
  const auto scale = static_cast<float>(p.scale / p.step);
  for (Retimed& r : p.retimed) {
    Empty(difference_, model_->axes, model_->modes);
    Empty(base_, model_->axes, model_->modes);
    r.stepped.drive(other, r.theta, difference_);
    r.now.drive(m, r.theta, base_);
    for (std::size_t a = 0; a < model_->axes; ++a) {
      state_.add_force[a].value[lane] +=
          scale * static_cast<float>(difference_.force_n[a] - base_.force_n[a]);
    }
  }
}

void SensitivityBlock::Step(const SamplePoint& m, float* derivative_m) noexcept {
  if (m.restarted) Clear();
  Read(m, derivative_m);
  Drive(m);
  Advance(*model_, m, state_);
}

}  // namespace levitas::diagnosis
