#include "configuration/text/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "common/nearest.hpp"
#include "common/problem.hpp"

namespace levitas::configuration {
namespace {

/// All keys a number may be written under: its own unit first, then others of the same dimension.
std::vector<std::string> NumberKeys(const NumberField& field) {
  std::vector<std::string> keys{KeyOf(field.stem, field.unit)};
  if (field.unit.dimension.empty()) return keys;
  for (const Unit& unit : AllUnits()) {
    if (unit.dimension == field.unit.dimension && unit.suffix != field.unit.suffix) {
      keys.push_back(KeyOf(field.stem, unit));
    }
  }
  return keys;
}

const Unit& UnitOf(const NumberField& field, const std::string& key) {
  for (const Unit& unit : AllUnits()) {
    if (unit.dimension == field.unit.dimension && KeyOf(field.stem, unit) == key) return unit;
  }
  return field.unit;
}

/// The word that a person probably meant: other languages than this one write yes and no.
std::string WordMeant(const std::string& found, const std::vector<std::string>& words) {
  constexpr std::array kYes{"yes", "on", "y", "1", "True", "TRUE", "Yes", "YES", "On", "ON"};
  if (words == std::vector<std::string>{"false", "true"} &&
      std::ranges::find(kYes, found) != kYes.end()) {
    return "true";
  }
  return Nearest(found, words);
}

std::string WithSymbol(const std::string& number, const Unit& unit) {
  return unit.symbol.empty() ? number : fmt::format("{} {}", number, unit.symbol);
}

/// Bounds in the unit the person used: "0.05 to 5 mm".
std::string Allowed(const NumberField& field, const Unit& used) {
  const auto bound = [&](double value) {
    if (used.suffix == field.unit.suffix) return BoundText(value);
    return fmt::format("{:.6g}", std::stod(FromSi(*ToSi(BoundText(value), field.unit), used)));
  };
  return fmt::format("{} to {}", bound(field.low), WithSymbol(bound(field.high), used));
}

std::string Describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kEmpty:
      return "nothing";
    case Node::Kind::kSequence:
      return "a list";
    case Node::Kind::kMap:
      return "a group of keys";
    case Node::Kind::kScalar:
      break;
  }
  const std::string text = node.text.size() > 60 ? node.text.substr(0, 57) + "..." : node.text;
  return node.quoted ? fmt::format("\"{}\" in quotes", text) : fmt::format("\"{}\"", text);
}

/// The number without the zeros in front of it: "0144" is 144 here and 100 in YAML 1.1 (octal).
std::string WithoutLeadingZeros(const std::string& text) {
  const std::size_t from = text.find_first_not_of("+-");
  std::size_t first = std::min(from, text.size());
  const auto digit = [&text](std::size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  while (digit(first + 1) && text[first] == '0') ++first;
  return text.substr(0, std::min(from, text.size())) + text.substr(first);
}

bool HasLeadingZeros(const std::string& text) {
  return IsDecimal(text) && WithoutLeadingZeros(text) != text;
}

std::string WhyNotANumber(const std::string& text) {
  if (HasLeadingZeros(text)) {
    return fmt::format(
        "not one number to all: with a zero in front it is octal to some programs; write {}",
        WithoutLeadingZeros(text));
  }
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  if (lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos) {
    return "not a finite number";
  }
  std::string with_point = text;
  std::ranges::replace(with_point, ',', '.');
  if (IsDecimal(with_point)) return "the decimal sign is a point";
  const std::size_t space = text.find(' ');
  if (space != std::string::npos && IsDecimal(text.substr(0, space))) {
    return "a number alone: its unit belongs in the key";
  }
  return "not a number";
}

}  // namespace

void Reader::Number(const NumberField& field, double& si) {
  const auto missing = [&] {
    return fmt::format("{}; allowed {}", field.meaning, Allowed(field, field.unit));
  };
  const Entry entry = Take(NumberKeys(field), field.fallback ? Text() : missing);
  if (probing_) return;
  si = std::numeric_limits<double>::quiet_NaN();
  if (entry.value == nullptr) {
    if (field.fallback) si = *ToSi(BoundText(*field.fallback), field.unit);
    return;
  }
  const Unit& unit = UnitOf(field, entry.key);
  const auto allowed = [&] { return Allowed(field, unit); };
  const std::string* text = Scalar(entry, allowed, true);
  if (text == nullptr) return;
  const auto value = HasLeadingZeros(*text) ? std::nullopt : ToSi(*text, unit);
  if (!value) {
    const bool beyond = IsDecimal(*text) && !HasLeadingZeros(*text);
    Report(entry.value->place, entry.key,
           fmt::format("found {}, {}; allowed {}", Describe(*entry.value),
                       beyond ? "beyond what a double can hold" : WhyNotANumber(*text), allowed()));
  } else if (!(*value >= *ToSi(BoundText(field.low), field.unit) &&
               *value <= *ToSi(BoundText(field.high), field.unit))) {
    Report(entry.value->place, entry.key,
           fmt::format("found {}, allowed {}", WithSymbol(*text, unit), allowed()));
  } else {
    si = *value;
  }
}

void Reader::WideInteger(const IntegerField& field, std::int64_t& value) {
  const auto allowed = [&] { return fmt::format("{} to {} (whole)", field.low, field.high); };
  const auto missing = [&] { return fmt::format("{}; allowed {}", field.meaning, allowed()); };
  const Entry entry = Take({std::string(field.key)}, field.fallback ? Text() : missing);
  if (probing_) return;
  value = field.fallback.value_or(field.low);
  if (entry.value == nullptr) return;
  const std::string* text = Scalar(entry, allowed, true);
  if (text == nullptr) return;
  const char* begin = text->data();
  const char* const end = begin + text->size();
  if (text->size() > 1 && *begin == '+') ++begin;
  std::int64_t found{};
  const auto [stop, error] = std::from_chars(begin, end, found);
  const bool zeros = HasLeadingZeros(*text);
  if (zeros || stop != end || error == std::errc::invalid_argument) {
    const bool broken = IsDecimal(*text) && !zeros;
    const std::string why = broken ? "not a whole number" : WhyNotANumber(*text);
    Report(entry.value->place, entry.key,
           fmt::format("found {}, {}; allowed {}", Describe(*entry.value), why, allowed()));
  } else if (error != std::errc{} || found < field.low || found > field.high) {
    Report(entry.value->place, entry.key, fmt::format("found {}, allowed {}", *text, allowed()));
  } else {
    value = found;
  }
}

namespace {
// "-." as ", -, ."
std::string JoinedCharacters(std::string_view characters) {
  std::string text;
  for (const char c : characters) text += fmt::format(", {}", c);
  return text;
}
}  // namespace

void Reader::Name(const NameField& field, std::string& value) {
  const auto allowed = [&] {
    if (field.most_text > 0) return fmt::format("a text of 1 to {} characters", field.most_text);
    return fmt::format("a name of 1 to 32 characters: {}a-z, 0-9, _{}",
                       field.also.empty() ? "" : "A-Z, ", JoinedCharacters(field.also));
  };
  const auto missing = [&] { return fmt::format("{}; allowed {}", field.meaning, allowed()); };
  const Entry entry = Take({std::string(field.key)}, missing);
  if (probing_ || entry.value == nullptr) return;
  const std::string* text = Scalar(entry, allowed, false);
  if (text == nullptr) return;
  const std::size_t most = field.most_text > 0 ? field.most_text : 32;
  const bool good =
      !text->empty() && text->size() <= most && std::ranges::all_of(*text, [&](char c) {
        if (field.most_text > 0) return static_cast<unsigned char>(c) >= ' ' && c != '\x7f';
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
               (!field.also.empty() && c >= 'A' && c <= 'Z') ||
               field.also.find(c) != field.also.npos;
      });
  if (good) {
    value = *text;
  } else {
    Report(entry.value->place, entry.key,
           fmt::format("found {}, allowed {}", Describe(*entry.value), allowed()));
  }
}

void Reader::Choice(const ChoiceField& field, std::size_t& index) {
  const std::vector<std::string> words(field.words.begin(), field.words.end());
  const auto allowed = [&] { return Listed(words); };
  const auto missing = [&] { return fmt::format("{}; allowed {}", field.meaning, allowed()); };
  const Entry entry = Take({std::string(field.key)}, field.fallback ? Text() : missing);
  if (probing_) return;
  const auto position = [&](std::string_view word) {
    return static_cast<std::size_t>(std::ranges::find(words, word) - words.begin());
  };
  index = field.fallback ? position(*field.fallback) : 0;
  if (entry.value == nullptr) return;
  const std::string* text = Scalar(entry, allowed, false);
  if (text == nullptr) return;
  const std::size_t found = position(*text);
  if (found < words.size()) {
    index = found;
  } else if (const std::string known = field.elsewhere ? field.elsewhere(*text) : "";
             !known.empty()) {
    Report(entry.value->place, entry.key, fmt::format("found {}; {}", *text, known));
  } else if (!field.owner.empty()) {
    ReportForeign(field, entry, Describe(*entry.value));
  } else {
    Report(entry.value->place, entry.key,
           fmt::format("found {}, allowed {}; nearest {}", Describe(*entry.value), allowed(),
                       WordMeant(*text, words)));
  }
}

std::vector<std::string> Reader::KeysOf(const std::function<void()>& body) {
  probed_.clear();
  probing_ = true;
  body();
  probing_ = false;
  return probed_;
}

void Reader::OneOf(std::string_view what, std::span<const Form> forms, std::size_t& chosen) {
  if (probing_) {
    for (const Form& form : forms) form.describe();
    return;
  }
  std::vector<std::size_t> given;
  std::string names;
  std::vector<std::vector<std::string>> keys;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    keys.push_back(KeysOf(forms[i].describe));
    names += fmt::format("{}{}", i == 0 ? "" : "; or ", forms[i].name);
    if (std::ranges::any_of(keys.back(), [&](const auto& key) { return Find(key).value; })) {
      given.push_back(i);
    }
  }
  chosen = given.size() == 1 ? given.front() : forms.size();
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (i == chosen) continue;
    for (const std::string& key : keys[i]) Take({key});
  }
  if (given.size() == 1) {
    forms[chosen].describe();
  } else if (given.empty() && top().node != nullptr) {
    Report(top().place, top().name, fmt::format("{} is missing; give {}", what, names));
  } else if (given.empty()) {
    top().expected.push_back({std::string(what), {}, false, "one way of giving it"});
  } else {
    const auto second = std::ranges::find_if(
        keys[given[1]], [&](const auto& key) { return Find(key).value != nullptr; });
    Report(Find(*second).key_place, *second,
           fmt::format("{} is given more than once; give {}", what, names));
  }
}

void Reader::When(bool condition, std::string_view when, const std::function<void()>& body) {
  if (condition || probing_) {
    body();
    return;
  }
  for (const std::string& key : KeysOf(body)) {
    const Entry entry = Take({key});
    if (entry.value != nullptr) {
      Report(entry.key_place, key, fmt::format("only allowed {}", when));
    }
  }
}

void Reader::RefuseIf(bool violated, std::string_view key, const std::string& text) {
  if (!violated || probing_) return;
  Place place = top().place;
  for (const Expected& field : top().expected) {
    if (field.key != key) continue;
    for (const std::string& spelling : field.keys) {
      const Entry entry = Find(spelling);
      if (entry.value == nullptr) continue;
      place = entry.value->kind == Node::Kind::kScalar ? entry.value->place : entry.key_place;
    }
  }
  Report(place, key.empty() ? top().name : std::string(key), text);
}

const std::string* Reader::Scalar(const Entry& entry, const Text& allowed, bool number) {
  const Node& node = *entry.value;
  if (node.kind == Node::Kind::kScalar && !(number && node.quoted)) return &node.text;
  Report(node.kind == Node::Kind::kEmpty ? entry.key_place : node.place, entry.key,
         fmt::format("found {}, allowed {}", Describe(node), allowed()));
  return nullptr;
}

}  // namespace levitas::configuration
