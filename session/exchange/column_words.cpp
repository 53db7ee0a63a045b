#include "session/exchange/column_words.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "session/exchange/csv_head.hpp"

namespace levitas::session {
namespace {

using Words = std::vector<std::string>;
using List = std::span<const std::string_view>;

constexpr std::array<std::string_view, 6> kTime{"time", "t", "zeit", "timestamp", "clock", "temps"};
constexpr std::array<std::string_view, 6> kAngle{"angle",  "phi",   "theta",
                                                 "winkel", "phase", "azimuth"};
constexpr std::array<std::string_view, 7> kSpeed{"speed", "rpm",     "omega",  "drehzahl",
                                                 "revs",  "rotfreq", "vitesse"};
constexpr std::array<std::string_view, 11> kLength{
    "pos",    "position", "disp", "displacement", "weg",        "probe",
    "sensor", "gap",      "prox", "deflection",   "deplacement"};
constexpr std::array<std::string_view, 7> kCurrent{"current", "curr", "i",      "ic",
                                                   "strom",   "amps", "courant"};
constexpr std::array<std::string_view, 8> kExcitation{
    "exc", "excitation", "inj", "injection", "disturbance", "dist", "excit", "anregung"};
/// What is neither the motion nor the command of an axis.
constexpr std::array<std::string_view, 9> kOther{"coil", "temp",  "temperature", "volt", "voltage",
                                                 "bias", "force", "acc",         "spule"};
constexpr std::array<std::string_view, 15> kFirst{"a",     "1",     "left", "l",     "front",
                                                  "upper", "drive", "de",   "top",   "vorn",
                                                  "vorne", "links", "oben", "avant", "gauche"};
constexpr std::array<std::string_view, 14> kSecond{
    "b",   "2",      "right",  "r",      "rear",  "lower",   "nondrive",
    "nde", "bottom", "hinten", "rechts", "unten", "arriere", "droite"};

bool Any(const Words& words, List of) {
  return std::ranges::any_of(
      words, [of](const std::string& word) { return std::ranges::find(of, word) != of.end(); });
}

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool IsCapital(char c) { return c >= 'A' && c <= 'Z'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Short words of an axis, a bearing and a leading i for current fall into their letters.
void Add(std::string word, Words& words) {
  std::ranges::transform(word, word.begin(), [](char c) {
    return IsCapital(c) ? static_cast<char>(c - 'A' + 'a') : c;
  });
  const bool short_word = word.size() > 1 && word.size() <= 3;
  const auto letters = std::string_view("xyabi");
  const bool has_axis = word.find_first_of("xy") != std::string::npos;
  if (short_word && has_axis && word.find_first_not_of(letters) == std::string::npos) {
    for (const char c : word) words.emplace_back(1, c);
  } else if (!word.empty()) {
    words.push_back(std::move(word));
  }
}

/// Letters with accents as those without: "déplacement" is one word.
std::string WithoutAccents(std::string text) {
  constexpr std::array<std::pair<std::string_view, char>, 11> kAccents{{{"é", 'e'},
                                                                        {"è", 'e'},
                                                                        {"ê", 'e'},
                                                                        {"à", 'a'},
                                                                        {"â", 'a'},
                                                                        {"ä", 'a'},
                                                                        {"ô", 'o'},
                                                                        {"ö", 'o'},
                                                                        {"û", 'u'},
                                                                        {"ü", 'u'},
                                                                        {"ç", 'c'}}};
  for (const auto& [accent, letter] : kAccents) {
    for (auto at = text.find(accent); at != std::string::npos; at = text.find(accent)) {
      text.replace(at, accent.size(), 1, letter);
    }
  }
  return text;
}

Words WordsOf(const std::string& written) {
  const std::string name = WithoutAccents(written);
  Words words;
  std::string word;
  char before = ' ';
  for (const char c : name) {
    const bool starts = (IsCapital(c) && IsLetter(before) && !IsCapital(before)) ||
                        (IsDigit(c) != IsDigit(before) && (IsLetter(c) || IsLetter(before)));
    if (starts || (!IsLetter(c) && !IsDigit(c))) {
      Add(word, words);
      word.clear();
    }
    if (IsLetter(c) || IsDigit(c)) word += c;
    before = c;
  }
  Add(word, words);
  return words;
}

/// A unit at the end of a name, in brackets or behind the last _ or blank; what is left of it.
std::string TakeUnit(std::string& name) {
  std::string trimmed = name;
  while (trimmed.ends_with(' ')) trimmed.pop_back();
  const bool bracketed = trimmed.ends_with(']') || trimmed.ends_with(')');
  const auto from = trimmed.find_last_of(bracketed ? "[(" : "_ ");
  if (from == std::string::npos || from == 0) return {};
  const std::string unit = UnitWord(trimmed.substr(bracketed ? from : from + 1));
  // The _a of exc_x_a may be the bearing A as well as amperes: with another unit nowhere, amperes.
  if (!unit.empty() || bracketed) name = trimmed.substr(0, from);
  return unit;
}

Dimension DimensionOf(const std::string& unit) {
  const auto is = [&unit](auto... words) { return ((unit == words) || ...); };
  if (is("s", "ms", "us", "ns")) return Dimension::kTime;
  if (is("m", "mm", "um", "nm")) return Dimension::kLength;
  if (is("a", "ma")) return Dimension::kCurrent;
  if (is("rad", "deg", "turn")) return Dimension::kAngle;
  if (is("rpm", "hz", "rad_per_s")) return Dimension::kSpeed;
  return Dimension::kNone;
}

Dimension DimensionOf(const Words& words, bool has_axis) {
  if (Any(words, kTime)) return Dimension::kTime;
  if (Any(words, kAngle)) return Dimension::kAngle;
  if (Any(words, kSpeed)) return Dimension::kSpeed;
  if (Any(words, kCurrent) || Any(words, kExcitation)) return Dimension::kCurrent;
  // A letter of an axis alone is a position: nobody names a current so.
  return Any(words, kLength) || has_axis ? Dimension::kLength : Dimension::kNone;
}

std::optional<std::size_t> BearingOf(const Words& words, const RigNumbers& rig) {
  for (std::size_t b = 0; b < rig.bearings.size(); ++b) {
    if (std::ranges::find(words, rig.bearings[b]) != words.end()) return b;
  }
  if (rig.bearings.size() == 1) return 0;
  if (Any(words, kFirst)) return 0;
  if (Any(words, kSecond)) return 1;
  return std::nullopt;
}

std::optional<std::size_t> AxisOf(const Words& words, const RigNumbers& rig) {
  for (std::size_t axis = 0; axis < rig.channels.size(); ++axis) {
    const Words own = WordsOf(rig.channels[axis]);
    const bool all = std::ranges::all_of(own, [&words](const std::string& word) {
      return std::ranges::find(words, word) != words.end();
    });
    if (all) return axis;
  }
  const bool x = std::ranges::find(words, "x") != words.end();
  const bool y = std::ranges::find(words, "y") != words.end();
  const auto bearing = BearingOf(words, rig);
  if (x == y || !bearing || rig.channels.size() != 2 * rig.bearings.size()) return std::nullopt;
  return 2 * *bearing + (y ? 1 : 0);
}

}  // namespace

NameMeaning MeaningOf(const std::string& name, const std::string& unit, const RigNumbers& rig) {
  NameMeaning meaning;
  std::string rest = name;
  const std::string own_unit = TakeUnit(rest);
  meaning.unit = unit.empty() ? own_unit : unit;
  const Words words = WordsOf(rest);
  meaning.axis = AxisOf(words, rig);
  if (!meaning.axis && own_unit == "a") meaning.axis = AxisOf(WordsOf(name), rig);
  meaning.excitation = Any(words, kExcitation);
  meaning.gap = Any(words, std::array<std::string_view, 1>{"gap"});
  if (Any(words, kOther)) return meaning;
  meaning.dimension = DimensionOf(meaning.unit);
  if (meaning.dimension == Dimension::kNone) {
    meaning.unit.clear();
    meaning.dimension = DimensionOf(words, meaning.axis.has_value());
  }
  return meaning;
}

}  // namespace levitas::session
