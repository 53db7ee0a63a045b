#include "common/nearest.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <vector>

namespace levitas {

std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string Nearest(std::string_view found, std::span<const std::string> allowed) {
  // A pasted paragraph in place of a word needs no nearest word, and would cost quadratic time.
  if (found.size() > 200) return {};
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string& word : allowed) {
    const std::size_t distance = EditDistance(found, word);
    if (best.empty() || distance < best_distance) {
      best = word;
      best_distance = distance;
    }
  }
  return best;
}

std::string LikelyMeant(std::string_view found, std::span<const std::string> allowed) {
  constexpr std::size_t kBeginning = 3;
  std::vector<std::string> longer;
  std::copy_if(allowed.begin(), allowed.end(), std::back_inserter(longer),
               [found](const std::string& word) { return word.starts_with(found); });
  if (found.size() >= kBeginning && !longer.empty()) return Nearest(found, longer);
  std::string nearest = Nearest(found, allowed);
  // Two typing errors, and one more for every four characters.
  if (nearest.empty() || EditDistance(found, nearest) > 2 + found.size() / 4) return {};
  return nearest;
}

std::string Listed(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

}  // namespace levitas
