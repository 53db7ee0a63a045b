#include "diagnosis/levitator/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnosis/inference/diagnose.hpp"

namespace levitas::levitator {
namespace {

constexpr int kSteps = 8;
constexpr int kScreenSteps = 4;
constexpr std::size_t kRefitted = 5;

CauseSet Without(const CauseSet& set, std::size_t cause) {
  CauseSet rest;
  for (const std::size_t c : set) {
    if (c != cause) rest.push_back(c);
  }
  return rest;
}

CauseSet With(CauseSet set, std::size_t cause) {
  set.push_back(cause);
  return set;
}

bool SameEffect(const CauseSet& set, std::size_t cause) {
  return std::any_of(set.begin(), set.end(),
                     [&](std::size_t c) { return Causes()[c].effect == Causes()[cause].effect; });
}

/// The best few by their screened gain, of effects that are not in the set.
std::vector<std::size_t> Nearest(const std::vector<double>& gain, const CauseSet& set,
                                 std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < gain.size(); ++c) {
    if (std::isfinite(gain[c]) && !SameEffect(set, c)) order.push_back(c);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return gain[a] > gain[b]; });
  order.resize(std::min(order.size(), count));
  return order;
}

class ForwardSelection {
 public:
  ForwardSelection(const Misfit& data, const SearchSettings& settings)
      : fitter_(data), settings_(settings), now_() {
    now_.theta = Zeros(data.series().size());
  }

  void Calibrate() {
    filters_ = fitter_.Noise();
    if (settings_.progress) settings_.progress(0.05, "calibrating");
    now_ = fitter_.Fit({}, now_.theta, filters_, 2 * kSteps);
  }

  /// Adds the best cause; false when none is decisive.
  bool Forward() {
    const std::vector<double> gain = fitter_.Screen(set_, now_, filters_);
    double best = -std::numeric_limits<double>::infinity();
    Fitted found;
    CauseSet chosen;
    for (const std::size_t c : Nearest(gain, set_, kRefitted)) {
      const CauseSet with = With(set_, c);
      Fitted fitted = fitter_.Fit(with, now_.theta, filters_, kScreenSteps);
      if (fitted.evidence <= best) continue;
      best = fitted.evidence;
      found = std::move(fitted);
      chosen = with;
    }
    if (chosen.empty()) return false;
    Fitted settled = fitter_.Fit(chosen, found.theta, filters_, kSteps);
    if (settled.evidence > best) found = std::move(settled);
    const double gained = found.evidence - now_.evidence;
    if (!(gained > std::max(diagnosis::kDecisive, settings_.form_share * explained_))) return false;
    explained_ += gained;
    (set_.empty() ? first_ : further_) = set_.empty() ? gained : std::max(further_, gained);
    Become(chosen, std::move(found));
    Tell(chosen.back());
    return true;
  }

  /// Drops causes that the others explain.
  void Backward() {
    for (bool dropped = true; dropped && set_.size() > 1;) {
      dropped = false;
      for (const std::size_t c : set_) {
        if (now_.evidence - FitWithout(c).evidence > diagnosis::kDecisive) continue;
        Become(Without(set_, c), FitWithout(c));
        dropped = true;
        break;
      }
    }
  }

  /// Until no further cause is decisive.
  void Run() {
    while (set_.size() < settings_.most_causes && Forward()) Backward();
  }
  /// The same with a given first cause, of a selection that has none.
  void RunFrom(std::size_t cause) {
    Fitted fitted = fitter_.Fit({cause}, now_.theta, filters_, kSteps);
    first_ = explained_ = fitted.evidence - now_.evidence;
    Become({cause}, std::move(fitted));
    if (first_ > diagnosis::kDecisive) Run();
  }
  /// A chain of small causes behind the first one is the mark of a wrong first one.
  [[nodiscard]] bool HasSmallOnesBehind() const {
    constexpr double kSmall = 0.1;
    return set_.size() > 1 && further_ < kSmall * first_;
  }
  void Become(const CauseSet& set, Fitted now) {
    set_ = set;
    now_ = std::move(now);
    without_.clear();
  }
  /// The others without this one of the set, fitted once.
  [[nodiscard]] const Fitted& FitWithout(std::size_t cause) const {
    const auto [at, is_new] = without_.try_emplace(cause);
    if (is_new) at->second = fitter_.Fit(Without(set_, cause), now_.theta, filters_, kSteps);
    return at->second;
  }

  [[nodiscard]] const CauseSet& set() const { return set_; }
  [[nodiscard]] const Fitted& now() const { return now_; }
  [[nodiscard]] const Filters& filters() const { return filters_; }
  [[nodiscard]] const Fitter& fitter() const { return fitter_; }

 private:
  void Tell(std::size_t cause) const {
    if (!settings_.progress) return;
    const double share = 0.1 + 0.06 * static_cast<double>(set_.size());
    settings_.progress(std::min(0.7, share), "found " + Causes()[cause].effect);
  }

  Fitter fitter_;
  const SearchSettings& settings_;
  CauseSet set_;
  Fitted now_;
  mutable std::map<std::size_t, Fitted> without_;
  Filters filters_;
  double explained_{};
  double first_{};    ///< [nat] gained by the first cause
  double further_{};  ///< by the strongest of the others
};

double ValidationEvidence(const Misfit* validation, const Filters& filters, const Theta& with,
                          const Theta& without) {
  if (validation == nullptr) return std::numeric_limits<double>::quiet_NaN();
  return 0.5 * GainOn(*validation, filters, with, without).value;
}

/// Forward from other first causes where small ones follow; the best chain stays.
void ReconsiderFirst(const ForwardSelection& calibrated, ForwardSelection& selection) {
  if (!selection.HasSmallOnesBehind()) return;
  constexpr std::size_t kOthers = 3;
  const std::vector<double> gain =
      calibrated.fitter().Screen({}, calibrated.now(), calibrated.filters());
  for (const std::size_t c : Nearest(gain, {selection.set().front()}, kOthers)) {
    ForwardSelection other = calibrated;
    other.RunFrom(c);
    if (other.now().evidence > selection.now().evidence) {
      selection.Become(other.set(), other.now());
    }
  }
}

/// Drops the weakest cause as long as validation data refute it; not the last one where the data
/// are the user's: that they refute it is worth saying. A strong one that loses there with a weaker
/// one beside it stays, which would stand in its place otherwise.
void DropRefuted(const Misfit& validation, std::size_t kept, ForwardSelection& selection) {
  while (selection.set().size() > kept) {
    const CauseSet& set = selection.set();
    const std::size_t weakest =
        *std::max_element(set.begin(), set.end(), [&](std::size_t a, std::size_t b) {
          return selection.FitWithout(a).evidence < selection.FitWithout(b).evidence;
        });
    const Fitted& rest = selection.FitWithout(weakest);
    if (GainOn(validation, selection.filters(), selection.now().theta, rest.theta).value >= 0.0)
      return;
    selection.Become(Without(set, weakest), rest);
  }
}

/// Keeps of every effect what comes nearest to the cause in whose place it stands.
void KeepNearest(std::vector<Score>& scores, const Score& score) {
  const auto same = std::find_if(scores.begin(), scores.end(), [&](const Score& s) {
    return Causes()[s.cause].effect == Causes()[score.cause].effect;
  });
  if (same == scores.end()) {
    scores.push_back(score);
  } else if (score.refitted && !same->refitted
                 ? score.cause == same->cause || score.behind_nat < same->behind_nat
                 : score.refitted == same->refitted && score.behind_nat < same->behind_nat) {
    *same = score;
  }
}

/// What others would add in the place of a cause that adds `nat` to `rest`.
void RankInPlace(const ForwardSelection& selection, const Misfit* validation, const CauseSet& rest,
                 const Fitted& base, std::size_t of, double nat, std::vector<Score>& others) {
  constexpr std::size_t kNearest = 4;
  const Fitter& fitter = selection.fitter();
  const std::vector<double> gain = fitter.Screen(rest, base, selection.filters());
  for (std::size_t c = 0; c < gain.size(); ++c) {
    if (SameEffect(selection.set(), c)) continue;
    KeepNearest(others, {c, gain[c], std::nan(""), nat - gain[c], false, false, of});
  }
  std::vector<std::size_t> near = Nearest(gain, selection.set(), kNearest);
  for (std::size_t c = 0; c < gain.size() && of < gain.size(); ++c) {
    const bool tried = std::find(near.begin(), near.end(), c) != near.end();
    if (!tried && !SameEffect(selection.set(), c) &&
        Alike(Causes()[of].effect, Causes()[c].effect)) {
      near.push_back(c);
    }
  }
  for (const std::size_t c : near) {
    if (gain[c] < 0.0) continue;
    // Starts from the nuisances fitted with all causes; without this cause they are driven to their
    // bounds.
    const Fitted fitted =
        fitter.Fit(With(rest, c), selection.now().theta, selection.filters(), kSteps);
    const double gained = fitted.evidence - base.evidence;
    KeepNearest(
        others,
        {c, gained, ValidationEvidence(validation, selection.filters(), fitted.theta, base.theta),
         nat - gained, false, true, of});
  }
}

/// What each named cause adds to the others, and what all others would add in its place.
std::vector<Score> Rank(const ForwardSelection& selection, const Misfit* validation,
                        CauseSet& order) {
  const std::size_t none = Causes().size();
  std::vector<Score> named;
  std::vector<Score> others;
  if (selection.set().empty())
    RankInPlace(selection, validation, {}, selection.now(), none, 0.0, others);
  for (const std::size_t c : selection.set()) {
    const CauseSet rest = Without(selection.set(), c);
    const Fitted& base = selection.FitWithout(c);
    const double nat = selection.now().evidence - base.evidence;
    named.push_back(
        {c, nat,
         ValidationEvidence(validation, selection.filters(), selection.now().theta, base.theta),
         0.0, true, true, none});
    RankInPlace(selection, validation, rest, base, c, nat, others);
  }
  const auto higher = [](const Score& a, const Score& b) { return a.nat > b.nat; };
  std::sort(named.begin(), named.end(), higher);
  std::sort(others.begin(), others.end(), higher);
  order.clear();
  for (const Score& score : named) order.push_back(score.cause);
  named.insert(named.end(), others.begin(), others.end());
  return named;
}

}  // namespace

diagnosis::FitGain GainOn(const Misfit& validation, const Filters& filters, const Theta& with,
                          const Theta& without) {
  const std::size_t records = validation.series().size();
  std::vector<double> gain = validation.BlockSums(SharedPart(without, records), filters);
  const std::vector<double> left = validation.BlockSums(SharedPart(with, records), filters);
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] -= left[i];
  return diagnosis::GainOfBlocks(gain);
}

Theta SharedPart(const Theta& theta, std::size_t records) {
  Theta out = Zeros(records);
  const std::size_t from = (theta.size() - kParameters) / kOwnParameters;
  for (const OwnParameter own : {kOwnResistance, kOwnOffset}) {
    double mean = 0.0;
    for (std::size_t i = 0; i < from; ++i) mean += theta[Own(i, own)] / static_cast<double>(from);
    for (std::size_t i = 0; i < records; ++i) out[Own(i, own)] = mean;
  }
  std::copy(theta.begin(), theta.begin() + static_cast<std::ptrdiff_t>(kParameters), out.begin());
  return out;
}

Found Search(const Misfit& data, const Misfit* validation, const SearchSettings& settings) {
  ForwardSelection selection(data, settings);
  if (settings.progress) settings.progress(0.02, "calibrating");
  selection.Calibrate();
  Found found;
  found.calibrated = selection.now();
  const ForwardSelection calibrated = selection;
  selection.Run();
  ReconsiderFirst(calibrated, selection);
  if (validation != nullptr) {
    DropRefuted(*validation, settings.own_validation ? 0 : 1, selection);
  }
  if (settings.progress) settings.progress(0.75, "ranking");
  found.scores = Rank(selection, validation, found.causes);
  found.extended = selection.now();
  found.filters = selection.filters();
  const Fitted bare =
      selection.fitter().Fit({}, found.calibrated.theta, selection.filters(), kScreenSteps);
  found.judged = validation != nullptr;
  if (found.judged) {
    found.validation =
        GainOn(*validation, found.filters, found.extended.theta, found.calibrated.theta);
  }
  found.evidence = found.extended.evidence - bare.evidence;
  if (settings.progress) settings.progress(1.0, "done");
  return found;
}

}  // namespace levitas::levitator
