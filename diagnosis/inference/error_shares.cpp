#include "diagnosis/inference/error_shares.hpp"

#include <algorithm>
#include <cmath>

#include "common/each_in_parallel.hpp"

namespace levitas::diagnosis {
namespace {

/// Numbers that changed together.
struct Group {
  ErrorShare share;
  std::vector<std::size_t> terms;
};

Group& GroupOf(std::vector<Group>& groups, std::optional<effect::Id> effect) {
  const auto same = std::find_if(groups.begin(), groups.end(), [effect](const Group& g) {
    return g.share.place.empty() && g.share.effect == effect;
  });
  if (same != groups.end()) return *same;
  return groups.emplace_back(Group{{effect, {}, 0.0}, {}});
}

/// A term that several causes move belongs to the first of them.
std::vector<Group> GroupsOf(const std::vector<Term>& terms, const SearchResult& answer) {
  std::vector<Group> groups;
  for (const Hypothesis& cause : answer.causes) {
    groups.push_back({{cause.effect, cause.place, 0.0}, {}});
  }
  const std::size_t causes = groups.size();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (answer.extended.theta[i] == 0.0) continue;
    std::size_t cause = 0;
    while (cause < causes && !Moves(answer.causes[cause], i)) ++cause;
    Group& group = cause < causes ? groups[cause] : GroupOf(groups, terms[i].effect);
    group.terms.push_back(i);
  }
  std::erase_if(groups, [](const Group& g) { return g.terms.empty(); });
  return groups;
}

}  // namespace

double ProjectedChange(const ChangePair& pair, const std::vector<double>& noise_rms_m) {
  double sum = 0.0;
  for (std::size_t r = 0; r < pair.from_1.size(); ++r) {
    for (std::size_t n = 0; n < pair.from_1[r].moments.size(); ++n) {
      const SamplePoint& from_1 = pair.from_1[r].moments[n];
      if (!from_1.counts) continue;
      const SamplePoint& to_1 = pair.to_1[r].moments[n];
      const SamplePoint& from_2 = pair.from_2[r].moments[n];
      const SamplePoint& to_2 = pair.to_2[r].moments[n];
      for (std::size_t a = 0; a < noise_rms_m.size(); ++a) {
        const auto first = static_cast<double>(from_1.innovation_m[a] - to_1.innovation_m[a]);
        const auto second = static_cast<double>(from_2.innovation_m[a] - to_2.innovation_m[a]);
        sum += first * second / (noise_rms_m[a] * noise_rms_m[a]);
      }
    }
  }
  return sum;
}

std::vector<ErrorShare> ErrorShares(const Search& search, const std::vector<Term>& terms,
                                    const SearchResult& answer, const std::vector<Record>& fitted,
                                    const std::vector<double>& noise_rms_m) {
  const std::vector<Record> records = Spans(fitted, kShareRows, search.rig().period_s);
  const Gains gains = search.DesignGains(records, answer.speed);
  const Point of_file{std::vector<double>(terms.size(), 0.0), answer.extended.shapes};
  const std::vector<Trajectory> file = search.Run(records, gains, of_file);
  const std::vector<Trajectory> model = search.Run(records, gains, answer.extended);
  const double whole = ProjectedChange({file, model, file, model}, noise_rms_m);
  if (!(whole > 0.0)) return {};
  std::vector<Group> groups = GroupsOf(terms, answer);
  EachInParallel(groups.size(), 0, [&](std::size_t g) {
    Point added = of_file;
    Point taken_out = answer.extended;
    for (const std::size_t i : groups[g].terms) std::swap(added.theta[i], taken_out.theta[i]);
    const auto with = search.RunAlone(records, gains, added);
    const double first = ProjectedChange({file, with, file, model}, noise_rms_m);
    const auto without = search.RunAlone(records, gains, taken_out);
    const double last = ProjectedChange({without, model, file, model}, noise_rms_m);
    groups[g].share.share = 0.5 * (first + last) / whole;
  });
  std::vector<ErrorShare> shares;
  for (Group& g : groups) {
    if (std::isfinite(g.share.share)) shares.push_back(std::move(g.share));
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const ErrorShare& a, const ErrorShare& b) { return a.share > b.share; });
  return shares;
}

}  // namespace levitas::diagnosis
