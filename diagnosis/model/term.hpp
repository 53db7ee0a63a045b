#pragma once
// Perturbation of the model by one parameter in which a rig may differ from its nominal model.
//
// Model      x[n+1] = f(x[n], u[n]) + B a(theta),  y[n] = h(x[n]) + r(theta): a term adds forces at
//            the magnets, modal accelerations and coil currents over a period, and readings at a
//            sample, all evaluated along the run of the model (SamplePoint). theta = 0 is the
//            nominal rig.
// Why        a whole set of causes then costs one run of the nonlinear model, and their
//            sensitivities follow from one linear propagation (sensitivity.hpp). It is written
//            independently of plant_sim/effect, so that neither can hide an error of the other.
// Stateful   terms with memory (eddy currents, hysteresis, supports) keep it in the closure; a copy
//            of the term copies the memory, so that a run starts from a copy of the fresh term.
// Thread     one copy per thread.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/model/location.hpp"
#include "diagnosis/model/sample_point.hpp"
#include "plant_sim/effect/effect_config.hpp"

namespace levitas::diagnosis {

/// Contribution of a term over one period, and to the reading at a sample.
struct Contribution {
  std::array<double, kMaxAxes> force_n{};      ///< at the magnets, held over the period
  std::array<double, kMaxAxes> coil_end_a{};   ///< change of the coil current at the end
  std::array<double, kMaxAxes> coil_mean_a{};  ///< mean change over the period
  std::array<double, kMaxAxes> reading_m{};
  std::array<double, 2 * kMaxModes> modal{};  ///< modal accelerations, held over the period
  bool has_modal{};

  void Modal(std::size_t at, double value) noexcept {
    modal[at] += value;
    has_modal = true;
  }
};

struct TermName {
  /// Of the catalogue; none for a part of the model that healthy rigs differ in (mode shapes).
  std::optional<effect::Id> effect;
  Location location;
  std::string parameter, unit;
};

struct LinearChange;

using TermLaw = std::function<void(const SamplePoint&, double theta, Contribution&)>;

struct Term;

/// Parametric family of force laws: one member represents nearby values of the shape parameters.
struct Family {
  using Shape = std::vector<double>;
  Shape shape;      ///< each > 0; SI units
  Shape log_width;  ///< ln of half the distance to the next member, or of half the usual one
  std::function<Term(const Shape& shape)> member;
};

struct Term {
  std::optional<effect::Id> effect;  ///< none: see TermName
  Location location;
  std::string parameter;
  std::string unit;
  /// Of a law whose forms exclude each other, one that is not the usual: hypotheses hold one form.
  std::string form;
  double healthy_mean{};   ///< prior mean, as healthy records have shown it; 0 without them
  double tolerance{};      ///< prior std of theta on a healthy rig; 0: not a nuisance
  double faulty_std{1.0};  ///< prior std of theta when the effect is present
  double step{1.0};        ///< theta at which a non-linear term is linearised from 0
  bool positive{false};    ///< cannot be negative
  bool linear{true};       ///< contribution is proportional to theta
  bool rotating{false};    ///< adds nothing at rest
  bool moves_coil{false};  ///< its drive adds to the coil current, and to nothing else
  /// The plant is run with it (plant_at.hpp): `drive` serves derivatives alone.
  bool in_plant{false};
  /// Its drive looks at when and how fast coils act (SamplePoint::late_periods).
  bool timed{false};
  std::optional<std::size_t> scales;    ///< axis whose whole reading it makes 1 + theta as large
  std::optional<std::uint32_t> record;  ///< acts in this record alone; none: in all
  /// Over the period that begins at the moment; `reading_m` then belongs to the sample at its end.
  TermLaw drive;
  /// At the sample of the moment.
  TermLaw read;

  Family family;

  /// Its change of the linear model about which derivatives are taken: constant, and at one sample.
  /// Empty: negligible.
  std::function<void(double theta, LinearChange&)> change;
  std::function<void(const SamplePoint&, double theta, AddedSlopes&)> slope;

  /// Name in the catalogue; empty without an effect.
  [[nodiscard]] std::string_view effect_name() const;
  /// theta in units in which every term is of order one.
  [[nodiscard]] double scale() const noexcept { return faulty_std > 0.0 ? faulty_std : tolerance; }
  [[nodiscard]] bool nuisance() const noexcept { return tolerance > 0.0; }
};

[[nodiscard]] Term MakeTerm(TermName name, double tolerance, double faulty_std, TermLaw drive);
/// One that adds to readings only.
[[nodiscard]] Term MakeReading(TermName name, double tolerance, double faulty_std, TermLaw read);

}  // namespace levitas::diagnosis
