// The part of the reader for lists of words, and for a word on which the other keys depend.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/nearest.hpp"
#include "configuration/text/reader.hpp"

namespace levitas::configuration {

void Reader::Words(const WordsField& field, std::uint32_t& mask) {
  const Entry entry = Take({std::string(field.key)});
  if (probing_) return;
  mask = kAllWords;
  if (entry.value == nullptr) return;
  const std::vector<std::string> words(field.words.begin(), field.words.end());
  const std::string allowed = fmt::format("a list of {}", Listed(words));
  if (entry.value->kind != Node::Kind::kSequence || entry.value->items.empty()) {
    Report(entry.key_place, entry.key,
           fmt::format("must be such a list: [{}]; allowed {}", words.empty() ? "" : words.front(),
                       allowed));
    return;
  }
  mask = 0;
  for (const Node& item : entry.value->items) {
    const auto found = std::ranges::find(words, item.text);
    if (item.kind != Node::Kind::kScalar || found == words.end()) {
      const std::string text = item.kind == Node::Kind::kScalar ? item.text : "no word";
      Report(
          item.place, entry.key,
          fmt::format("found \"{}\", allowed {}; nearest {}", text, allowed, Nearest(text, words)));
      continue;
    }
    const auto bit = static_cast<std::uint32_t>(1U << (found - words.begin()));
    if ((mask & bit) != 0U) Report(item.place, entry.key, fmt::format("{} given twice", item.text));
    mask |= bit;
  }
  if (mask == (1U << words.size()) - 1U) mask = kAllWords;
}

void Reader::ReportForeign(const ChoiceField& field, const Entry& entry, const std::string& word) {
  Foreign& foreign = foreign_[std::string(field.owner)];
  if (foreign.places++ == 0) {
    foreign.problem = problems_.size();
    Report(entry.value->place, entry.key, "");
    foreign.where = problems_.back().text;
  }
  if (std::ranges::find(foreign.words, word) == foreign.words.end()) foreign.words.push_back(word);
  const std::vector<std::string> allowed(field.words.begin(), field.words.end());
  std::string& text = problems_[foreign.problem].text;
  const std::string places =
      foreign.places == 1 ? "" : fmt::format(" in {} places, first here", foreign.places);
  if (foreign.words.size() == 1) {
    text = fmt::format("{}found {}{}, allowed {}; nearest {}", foreign.where, word, places,
                       Listed(allowed), Nearest(entry.value->text, allowed));
  } else {
    text = fmt::format(
        "{}found {}{}; {} has {}. The file seems to be written for another rig: "
        "use it with that rig, or change these words",
        foreign.where, fmt::join(foreign.words, ", "), places, field.owner,
        fmt::join(allowed, ", "));
  }
}

void Reader::Variant(const ChoiceField& field, std::size_t& index,
                     const std::function<void(std::size_t)>& body) {
  const std::string key(field.key);
  const std::size_t before = problems_.size();
  if (!probing_ && top().node != nullptr && Find(key).value == nullptr) {
    const auto near = std::ranges::find_if(top().node->keys, [&](const auto& entry) {
      return EditDistance(entry.first, key) == 1;  // so short a word has few neighbours
    });
    if (near == top().node->keys.end()) {
      Report(top().place, key, fmt::format("missing; {}", field.meaning));
    } else {
      Report(near->second, near->first, fmt::format("unknown key, nearest key {}", key));
    }
  }
  Choice(field, index);
  if (problems_.size() > before) {
    // Without the word nobody knows what the other keys mean: nothing more is said about them.
    top().node = nullptr;
    top().mute = true;
  }
  body(index);
}

}  // namespace levitas::configuration
