#include "diagnosis/record_errors/wiring.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

namespace levitas::diagnosis {
namespace {

constexpr double kAgrees = 0.4;     ///< in the sum of logarithms: a third less left on one axis
constexpr double kNoWorse = 0.3;    ///< a delay of one column hardly shows in the plant
constexpr double kAlone = 2.0;      ///< without a broken law
constexpr double kNearNoise = 1.1;  ///< logarithm per axis: three times the expected power
constexpr double kElsewhere = 2.5;  ///< without a test signal twins are within that
constexpr double kOverLimit = 1.05;
constexpr int kRounds = 2;

enum class Which : std::uint8_t { kPositions, kCurrents, kBoth };

struct Hypothesis {
  RecordErrorKind kind{};
  std::vector<std::size_t> axes;
  Which which{};
  double size{};
  std::function<void(ColumnUses&)> apply;
};

double Polarity(const RigView& rig, std::size_t a, std::size_t b, bool position) {
  const AxisArray& of = position ? rig.numbers.sensor_polarity : rig.numbers.actuator_polarity;
  return of[a] * of[b] < 0.0 ? -1.0 : 1.0;
}

void Swap(std::array<ColumnUse, kMaxAxes>& uses, std::size_t a, std::size_t b, double polarity) {
  std::swap(uses[a], uses[b]);
  uses[a].factor *= polarity;
  uses[b].factor *= polarity;
}

class Hypotheses {
 public:
  explicit Hypotheses(const RigView& rig) : rig_(rig) {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      for (std::size_t b = 0; b < a; ++b) Swaps({{b, a}});
    }
    for (std::size_t a = 0; a + 1 < rig.axes; a += 2) {
      for (std::size_t b = 0; b < a; b += 2) Swaps({{b, a}, {b + 1, a + 1}});
    }
    if (rig.axes == 4) Swaps({{0, 1}, {2, 3}});
    for (std::size_t a = 0; a < rig.axes; ++a) {
      for (const Which which : {Which::kPositions, Which::kCurrents, Which::kBoth}) {
        Factor(RecordErrorKind::kReversed, {a}, which, -1.0);
      }
      for (const double factor : {1e3, 1e-3})
        Factor(RecordErrorKind::kUnit, {a}, Which::kCurrents, factor);
      Delays(a);
    }
    std::vector<std::size_t> every;
    for (std::size_t a = 0; a < rig.axes; ++a) every.push_back(a);
    for (const double factor : {1e3, 1e-3})
      Factor(RecordErrorKind::kUnit, every, Which::kCurrents, factor);
    if (rig.axes > 1) Factor(RecordErrorKind::kReversed, every, Which::kCurrents, -1.0);
    if (rig.axes > 1) Factor(RecordErrorKind::kReversed, every, Which::kPositions, -1.0);
  }

  [[nodiscard]] const std::vector<Hypothesis>& all() const { return all_; }

 private:
  void Swaps(const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    for (const Which which : {Which::kPositions, Which::kCurrents, Which::kBoth}) {
      Hypothesis h{RecordErrorKind::kSwapped, {}, which, 0.0, {}};
      for (const auto& [a, b] : pairs) h.axes.insert(h.axes.end(), {a, b});
      h.apply = [this, pairs, which](ColumnUses& uses) {
        for (const auto& [a, b] : pairs) {
          if (which != Which::kCurrents) Swap(uses.position, a, b, Polarity(rig_, a, b, true));
          if (which != Which::kPositions) Swap(uses.current, a, b, Polarity(rig_, a, b, false));
        }
      };
      all_.push_back(std::move(h));
    }
  }

  void Factor(RecordErrorKind kind, const std::vector<std::size_t>& axes, Which which,
              double factor) {
    all_.push_back({kind, axes, which, factor, [axes, which, factor](ColumnUses& uses) {
                      for (const std::size_t a : axes) {
                        if (which != Which::kCurrents) uses.position[a].factor *= factor;
                        if (which != Which::kPositions) uses.current[a].factor *= factor;
                      }
                    }});
  }

  void Delays(std::size_t axis) {
    for (int rows = -kMostShift; rows <= kMostShift; ++rows) {
      if (rows == 0) continue;
      for (const Which which : {Which::kPositions, Which::kCurrents}) {
        all_.push_back({RecordErrorKind::kDelayed,
                        {axis},
                        which,
                        static_cast<double>(rows),
                        [axis, which, rows](ColumnUses& uses) {
                          (which == Which::kPositions ? uses.position : uses.current)[axis].late +=
                              rows;
                        }});
      }
    }
  }

  const RigView& rig_;
  std::vector<Hypothesis> all_;
};

double Logarithm(const Eigen::VectorXd& ratios) {
  return ratios.size() > 0 ? ratios.array().max(1e-12).log().sum() : 0.0;
}

std::vector<std::string> NamesOf(const RigView& rig, const Hypothesis& h) {
  std::vector<std::string> names;
  for (const std::size_t a : h.axes) {
    if (h.which != Which::kCurrents) names.push_back(PositionColumn(rig, a));
  }
  for (const std::size_t a : h.axes) {
    if (h.which != Which::kPositions) names.push_back(CurrentColumn(rig, a));
  }
  return names;
}

std::string Pairs(const RigView& rig, const Hypothesis& h) {
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i + 1 < h.axes.size(); i += 2) {
    for (const bool position : {true, false}) {
      if (h.which == (position ? Which::kCurrents : Which::kPositions)) continue;
      const auto name = [&](std::size_t a) {
        return position ? PositionColumn(rig, a) : CurrentColumn(rig, a);
      };
      pairs.push_back(fmt::format("{} and {}", name(h.axes[i]), name(h.axes[i + 1])));
    }
  }
  return fmt::format("{}", fmt::join(pairs, ", "));
}

RecordError Describe(const RigView& rig, const Hypothesis& h, double times) {
  RecordError error{h.kind, NamesOf(rig, h), h.size, times, {}, {}, true};
  const std::string names = fmt::format("{}", fmt::join(error.columns, ", "));
  const bool one = error.columns.size() == 1;
  switch (h.kind) {
    case RecordErrorKind::kSwapped:
      error.sentence = fmt::format("columns are exchanged: {}", Pairs(rig, h));
      error.mend = "exchange their names";
      break;
    case RecordErrorKind::kReversed:
      error.sentence = fmt::format("{} {} the wrong sign", names, one ? "has" : "have");
      error.mend = "sign: -1 in a map of columns, or the polarity of the rig file";
      break;
    case RecordErrorKind::kUnit:
      error.sentence = fmt::format("{} {} in another unit: numbers are {} times too {}", names,
                                   one ? "is" : "are", 1000, h.size > 1.0 ? "small" : "large");
      error.mend = h.size > 1.0 ? "the unit is a, not ma" : "the unit is ma, not a";
      break;
    case RecordErrorKind::kDelayed:
      error.sentence =
          fmt::format("{} is {} row{} {} the other columns", names, std::abs(h.size),
                      std::abs(h.size) == 1.0 ? "" : "s", h.size > 0.0 ? "behind" : "ahead of");
      error.mend = fmt::format("move its numbers {} row{} {} in the file; no map of columns does",
                               std::abs(h.size), std::abs(h.size) == 1.0 ? "" : "s",
                               h.size > 0.0 ? "up" : "down");
      error.by_map = false;
      break;
    case RecordErrorKind::kRate:
    case RecordErrorKind::kQuantised:
    case RecordErrorKind::kClipped:
    case RecordErrorKind::kHeld:
    case RecordErrorKind::kGaps:
      throw std::logic_error(fmt::format("{}: no error of the wiring", Name(h.kind)));
  }
  return error;
}

struct Judged {
  const Hypothesis* h{};
  ColumnUses uses;
  int breaks{};
  double left{};
  bool elsewhere{};  ///< what the other records of the rig show
};

/// A recorder is late; that a column is ahead instead takes evidence. Files of one recorder have
/// one error: what another record shows is taken where this one can hardly tell.
double Cost(const Judged& judged) {
  const bool early = judged.h->kind == RecordErrorKind::kDelayed && judged.h->size < 0.0;
  return judged.left + (early ? kNoWorse : 0.0) - (judged.elsewhere ? kElsewhere : 0.0);
}

/// Whether coils can carry the currents of a column in another unit, or not those of its own.
bool IsPossible(const RigView& rig, const Columns& columns, const Hypothesis& h,
                const ColumnUses& uses) {
  if (h.kind != RecordErrorKind::kUnit) return true;
  return std::ranges::all_of(h.axes, [&](std::size_t a) {
    const double most_a = kOverLimit * rig.bearing(a).magnet.max_coil_current_a;
    const ColumnUse& use = uses.current[a];
    const auto of = columns.current_a.col(static_cast<Eigen::Index>(use.from));
    const double after_a = std::abs(use.factor) * of.cwiseAbs().maxCoeff();
    return h.size < 1.0 ? after_a / h.size > most_a : !(after_a > most_a);
  });
}

}  // namespace

std::string PositionColumn(const RigView& rig, std::size_t axis) {
  return "position_" + rig.numbers.channels[axis];
}

std::string CurrentColumn(const RigView& rig, std::size_t axis) {
  return "control_current_" + rig.numbers.channels[axis];
}

int Breaks(const std::vector<LawOfColumn>& laws, const ColumnUses& uses, std::size_t axes) {
  // A law that answers a sample later does so on every axis.
  std::vector<int> shifts;
  for (std::size_t a = 0; a < axes; ++a) {
    const LawOfColumn& law = laws[uses.current[a].from];
    if (law.known) shifts.push_back(law.shift - uses.current[a].late + uses.position[a].late);
  }
  if (shifts.empty()) return 0;
  const auto middle = shifts.begin() + static_cast<std::ptrdiff_t>(shifts.size() / 2);
  std::nth_element(shifts.begin(), middle, shifts.end());
  const int usual = std::max(0, *middle);
  int breaks = 0;
  for (std::size_t a = 0; a < axes; ++a) {
    const ColumnUse& current = uses.current[a];
    const ColumnUse& position = uses.position[a];
    const LawOfColumn& law = laws[current.from];
    if (!law.known) continue;
    if (law.position != position.from) {
      ++breaks;
    } else {
      if (law.direct_a_per_m * current.factor * position.factor > 0.0) ++breaks;
      if (law.shift - current.late + position.late != usual) ++breaks;
    }
    if (!law.test) continue;
    if (*law.test != a) {
      ++breaks;
      continue;
    }
    const double factor = law.test_factor * current.factor;
    if (factor < 0.0) ++breaks;
    if (std::abs(factor) > 30.0 || std::abs(factor) < 1.0 / 30.0) ++breaks;
    if (law.test_shift != current.late) ++breaks;
  }
  return breaks;
}

void FindWiring(const RigView& rig, const Columns& columns, const std::vector<LawOfColumn>& laws,
                const PlantFit& plant, const ColumnUses& elsewhere, RecordErrors& out) {
  const Hypotheses hypotheses(rig);
  for (int round = 0; round < kRounds; ++round) {
    const int breaks = Breaks(laws, out.uses, rig.axes);
    const double left = Logarithm(plant.Ratios(out.uses));
    std::optional<Judged> best;
    for (const Hypothesis& h : hypotheses.all()) {
      Judged judged{&h, out.uses, 0, 0.0};
      h.apply(judged.uses);
      judged.breaks = Breaks(laws, judged.uses, rig.axes);
      if (judged.breaks > breaks) continue;
      if (judged.breaks == breaks && !IsPossible(rig, columns, h, judged.uses)) continue;
      if (best && judged.breaks > best->breaks) continue;
      const bool delay = h.kind == RecordErrorKind::kDelayed;
      if (delay && judged.breaks == breaks) continue;
      judged.left = Logarithm(plant.Ratios(judged.uses));
      judged.elsewhere = judged.uses == elsewhere;
      if (best && judged.breaks == best->breaks && Cost(judged) >= Cost(*best)) continue;
      best = judged;
    }
    if (!best) return;
    const bool delay = best->h->kind == RecordErrorKind::kDelayed;
    const double gained = left - best->left;
    const double least = best->elsewhere ? -kElsewhere : delay ? -kNoWorse : kAgrees;
    const bool by_law = best->breaks < breaks && gained > least;
    const bool alone = gained > kAlone && best->left < kNearNoise * static_cast<double>(rig.axes);
    if (!by_law && !alone) return;
    out.uses = best->uses;
    out.errors.push_back(Describe(rig, *best->h, std::exp(gained)));
  }
}

}  // namespace levitas::diagnosis
