// The part of the reader that walks groups and lists and finds keys that are missing, unknown or
// given twice.
#include <fmt/format.h>

#include <algorithm>

#include "common/nearest.hpp"
#include "common/problem.hpp"
#include "configuration/text/reader.hpp"

namespace levitas::configuration {

Reader::Reader(const Document& document, std::string file_name) : file_name_(std::move(file_name)) {
  const Node* root = &document.root;
  if (document.problem) {
    Report(document.problem->place, "", document.problem->text);
    root = nullptr;
  } else if (root->kind != Node::Kind::kMap) {
    Report(root->place, "", "the file must hold keys (name: value) at its first level");
    root = nullptr;
  }
  OpenFrame(root, "", "", {1, 1});
}

bool Reader::WrongKind(std::string_view kind) {
  if (!problems_.empty()) return true;
  const Entry entry = Take({"kind"});
  const std::string_view article = kind.starts_with('i') ? "an" : "a";  // import_map, ...
  if (entry.value == nullptr) {
    Report({1, 1}, "kind",
           fmt::format("missing; {} {} file begins with `kind: {}`", article, kind, kind));
  } else if (entry.value->kind != Node::Kind::kScalar || entry.value->text != kind) {
    Report(entry.value->place, "kind",
           fmt::format("found \"{}\", but {} {} file is needed here (kind: {})", entry.value->text,
                       article, kind, kind));
  }
  return !problems_.empty();
}

void Reader::Finish() {
  CloseFrame();
  FinishEarly();
}

void Reader::FinishEarly() {
  if (problems_.empty()) return;
  ExplainUnknownKeys();
  std::ranges::stable_sort(problems_, {}, &Problem::place);
  std::string text;
  if (problems_.size() > 1)
    text = fmt::format("{} problems in {}:\n", problems_.size(), file_name_);
  constexpr std::size_t kMostTold = 50;
  const std::size_t told = std::min(problems_.size(), kMostTold);
  for (std::size_t i = 0; i < told; ++i) {
    text += fmt::format("{}{}:{}:{}: {}", i == 0 ? "" : "\n", file_name_, problems_[i].place.line,
                        problems_[i].place.column, problems_[i].text);
  }
  if (problems_.size() > told) text += fmt::format("\nand {} more", problems_.size() - told);
  throw BadInput(text);
}

void Reader::Report(Place place, const std::string& key, const std::string& text) {
  const std::string path = frames_.empty() ? "" : top().path;
  if (key.empty()) {
    problems_.push_back({place, text});
  } else {
    const bool group_itself = !frames_.empty() && key == top().name;
    problems_.push_back(
        {place,
         fmt::format("{}: {}", group_itself ? path.substr(0, path.size() - 1) : path + key, text)});
  }
}

Reader::Entry Reader::Find(const std::string& key) const {
  const Node* node = frames_.back().node;
  if (node == nullptr) return {nullptr, key, {}};
  for (std::size_t i = 0; i < node->keys.size(); ++i) {
    if (node->keys[i].first == key) return {&node->items[i], key, node->keys[i].second};
  }
  return {nullptr, key, {}};
}

Reader::Entry Reader::Take(std::vector<std::string> keys, const Text& missing) {
  if (probing_) {
    probed_.insert(probed_.end(), keys.begin(), keys.end());
    return {};
  }
  Entry taken{nullptr, keys.front(), {}};
  for (const std::string& key : keys) {
    const Entry entry = Find(key);
    if (entry.value == nullptr) continue;
    if (taken.value != nullptr) {
      Report(entry.key_place, key, fmt::format("already given as {}", taken.key));
    } else {
      taken = entry;
    }
  }
  const bool found = taken.value != nullptr;
  const std::string primary = keys.front();
  top().expected.push_back({primary, std::move(keys), found, found || !missing ? "" : missing()});
  return taken;
}

void Reader::OpenFrame(const Node* node, std::string path, std::string name, Place place) {
  frames_.push_back({node, std::move(path), std::move(name), place, {}});
}

void Reader::CloseFrame() {
  Frame& frame = top();
  for (const Expected& field : frame.expected) {
    for (const std::string& key : field.keys) {
      if (!frame.name.empty()) homes_.emplace(key, frame.path.substr(0, frame.path.size() - 1));
    }
  }
  if (frame.node != nullptr) {
    ReportDuplicates(frame);
    ReportUnknown(frame);
    ReportMissing(frame);
  } else if (frames_.size() > 1 && !frame.mute) {
    ReportAbsentGroup();
  }
  frames_.pop_back();
}

// An absent group is one problem, not one for each of its fields; none if all have defaults.
void Reader::ReportAbsentGroup() {
  const Frame& frame = top();
  Frame& parent = frames_[frames_.size() - 2];
  std::string required;
  for (const Expected& field : frame.expected) {
    if (!field.missing.empty()) required += (required.empty() ? "" : ", ") + field.key;
  }
  if (required.empty()) return;
  const std::string text = fmt::format("a group that must hold {}", required);
  for (Expected& field : parent.expected) {
    if (field.key == frame.name) field.missing = text;
  }
}

void Reader::ReportDuplicates(const Frame& frame) {
  const auto& keys = frame.node->keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto first = std::ranges::find(keys.begin(), keys.begin() + static_cast<long>(i),
                                         keys[i].first, &std::pair<std::string, Place>::first);
    if (first != keys.begin() + static_cast<long>(i)) {
      Report(keys[i].second, keys[i].first,
             fmt::format("given twice, first on line {}", first->second.line));
    }
  }
}

// The key a person most likely meant: one that only lacks its unit, else the nearest by edit
// distance; empty when nothing is near.
std::string Reader::Meant(const Frame& frame, std::string key) {
  for (const char* micro : {"\xC2\xB5", "\xCE\xBC"}) {  // the micro sign and the Greek letter
    const std::size_t at = key.find(micro);
    if (at == std::string::npos) continue;
    key = fmt::format("{}u{}", key.substr(0, at), key.substr(at + 2));
  }
  std::vector<std::string> all;
  for (const Expected& field : frame.expected) {
    for (const std::string& spelling : field.keys) {
      if (field.keys.size() > 1 && spelling.starts_with(key + "_")) return field.key;
      all.push_back(spelling);
    }
  }
  return LikelyMeant(key, all);
}

void Reader::ReportUnknown(Frame& frame) {
  for (const auto& entry : frame.node->keys) {
    const auto& key = entry.first;
    const auto& place = entry.second;
    const auto known = [&key](const Expected& field) {
      return std::ranges::find(field.keys, key) != field.keys.end();
    };
    if (std::ranges::any_of(frame.expected, known)) continue;
    const std::string meant = Meant(frame, key);
    if (meant.empty()) {
      std::vector<std::string> documented;
      for (const Expected& field : frame.expected) documented.push_back(field.key);
      unknown_keys_.push_back({problems_.size(), key});
      Report(place, key,
             documented.empty() ? std::string("unknown key; none is allowed here")
                                : fmt::format("unknown key; known here: {}", Listed(documented)));
      continue;
    }
    // The misspelt key explains why the right one is missing: one problem, not two.
    for (Expected& field : frame.expected) {
      if (std::ranges::find(field.keys, meant) != field.keys.end()) field.found = true;
    }
    Report(place, key, fmt::format("unknown key, nearest key {}", meant));
  }
}

// A key that is unknown where it stands but known in another group has usually slipped out of it.
void Reader::ExplainUnknownKeys() {
  for (const auto& [problem, key] : unknown_keys_) {
    const auto home = homes_.find(key);
    if (home != homes_.end())
      problems_[problem].text.append("; it belongs under ").append(home->second);
  }
}

void Reader::ReportMissing(const Frame& frame) {
  for (const Expected& field : frame.expected) {
    if (field.found || field.missing.empty()) continue;
    Report(frame.place, field.key, fmt::format("missing; {}", field.missing));
  }
}

bool Reader::BeginGroup(std::string_view key, std::string_view, bool* optional, bool) {
  const Entry entry = Take({std::string(key)});
  if (probing_) return false;
  if (optional != nullptr) {
    *optional = entry.value != nullptr;
    if (entry.value == nullptr) return false;
  }
  const Node* node = entry.value;
  Place place = node == nullptr ? top().place : entry.key_place;
  const bool wrong = node != nullptr && node->kind != Node::Kind::kMap;
  if (wrong) {
    Report(place, entry.key, "must hold keys of its own (name: value, indented)");
    node = nullptr;
  }
  OpenFrame(node, top().path + entry.key + ".", entry.key, place);
  top().mute = wrong;
  return true;
}

void Reader::EndGroup() { CloseFrame(); }

std::size_t Reader::BeginList(const ListField& field, std::size_t) {
  const std::string allowed = fmt::format("{} to {} items", field.least, field.most);
  const auto missing = [&] { return fmt::format("{}; allowed {}", field.meaning, allowed); };
  const Entry entry = Take({std::string(field.key)}, field.least == 0 ? Text() : missing);
  lists_.push_back({nullptr, top().path + entry.key});
  if (probing_ || entry.value == nullptr) return 0;
  if (entry.value->kind != Node::Kind::kSequence) {
    Report(entry.key_place, entry.key,
           fmt::format("must be a list (lines that begin with -), allowed {}", allowed));
    return 0;
  }
  const std::size_t size = entry.value->items.size();
  if (size < field.least || size > field.most) {
    Report(entry.key_place, entry.key,
           size == 0 ? fmt::format("found an empty list, allowed {}", allowed)
                     : fmt::format("found {} items, allowed {}", size, allowed));
  }
  lists_.back().node = entry.value;
  return std::min(size, field.most);
}

void Reader::BeginItem(std::size_t index) {
  const Node& item = lists_.back().node->items[index];
  const std::string name = fmt::format("{}[{}]", lists_.back().path, index);
  const bool map = item.kind == Node::Kind::kMap;
  OpenFrame(map ? &item : nullptr, name + ".", "", item.place);
  top().mute = !map;
  if (!map) Report(item.place, "", name + ": must hold keys (- name: value)");
}

void Reader::EndList() { lists_.pop_back(); }

}  // namespace levitas::configuration
