#pragma once
// The table of a file kind is a Describe function that shows every field once to a Visitor: key,
// unit, range, default, meaning. The reader, the writer and the generator of the documentation are
// visitors, so they cannot disagree.
//
// Numbers  low, high and fallback are in the unit of the key; the field itself is SI.
// Bad data the reader leaves NaN in a number it refused, so a cross-field check written as the
//          violation (a > b) stays silent about a field that is already reported.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "configuration/schema/unit.hpp"

namespace levitas::configuration {

inline constexpr std::nullopt_t kRequired = std::nullopt;

struct NumberField {
  std::string_view stem;  ///< the key is stem_suffix: "gap" in mm is gap_mm
  Unit unit;
  double low{};
  double high{};
  std::optional<double> fallback;
  std::string_view meaning;
};

struct IntegerField {
  std::string_view key;
  std::int64_t low{};
  std::int64_t high{};
  std::optional<std::int64_t> fallback;
  std::string_view meaning;
};

struct NameField {
  std::string_view key;
  std::string_view meaning;
  std::string_view also{};  ///< characters allowed beside a-z, 0-9 and _, and then capitals too
  /// Not a name but a text that others chose, of so many characters at most and none of control: a
  /// column of their file, a path. 0: a name.
  std::size_t most_text{};
};

struct ChoiceField {
  std::string_view key;
  std::span<const std::string_view> words;
  std::optional<std::string_view> fallback;
  std::string_view meaning;
  /// Whose words they are ("rig pump"): a file written for another owner is one problem, not one
  /// for each of its words. Empty: words of the program itself.
  std::string_view owner{};
  /// What to do instead of a word that is none of them, but is known elsewhere; empty: not known.
  std::function<std::string(std::string_view)> elsewhere{};
};

struct ListField {
  std::string_view key;
  std::size_t least{};  ///< 0: the key may be left out
  std::size_t most{};
  std::string_view meaning;
};

/// A list of words; left out, it means all of them.
struct WordsField {
  std::string_view key;
  std::span<const std::string_view> words;
  std::string_view documented;  ///< what the words are, for the documentation
  std::string_view meaning;
};
inline constexpr std::uint32_t kAllWords = 0xFFFFFFFFU;

/// One of several ways to give the same quantity.
struct Form {
  std::string_view name;
  std::function<void()> describe;
};

class Visitor {
 public:
  virtual ~Visitor() = default;

  virtual void Number(const NumberField& field, double& si) = 0;
  virtual void Name(const NameField& field, std::string& value) = 0;
  /// `index` into the field's words.
  virtual void Choice(const ChoiceField& field, std::size_t& index) = 0;
  /// Bit i of `mask` stands for word i; all words together are kAllWords.
  virtual void Words(const WordsField& field, std::uint32_t& mask) = 0;
  /// A choice on which the keys shown by `body` depend.
  virtual void Variant(const ChoiceField& field, std::size_t& index,
                       const std::function<void(std::size_t)>& body) {
    Choice(field, index);
    body(index);
  }
  /// Exactly one form is read; `chosen` says which, and which one is written. After a problem it is
  /// the number of forms.
  virtual void OneOf(std::string_view what, std::span<const Form> forms, std::size_t& chosen) = 0;
  /// Fields that exist only when `condition` holds; `when` says so to people.
  virtual void When(bool condition, std::string_view when, const std::function<void()>& body) = 0;
  /// A relation between fields that is violated; reported at `key` of the group being described,
  /// or at the group itself when `key` is empty.
  virtual void RefuseIf(bool violated, std::string_view key, const std::string& text) = 0;

  template <class Whole>
  void Integer(const IntegerField& field, Whole& value) {
    auto wide = static_cast<std::int64_t>(value);
    WideInteger(field, wide);
    value = static_cast<Whole>(wide);
  }

  template <class Body>
  void Group(std::string_view key, std::string_view meaning, Body body) {
    bool present = true;
    if (!BeginGroup(key, meaning, nullptr, present)) return;
    body();
    EndGroup();
  }

  /// A group that may be left out; `present` is set when reading and obeyed when writing.
  template <class Body>
  void OptionalGroup(std::string_view key, std::string_view meaning, bool& present, Body body) {
    if (!BeginGroup(key, meaning, &present, present)) return;
    body();
    EndGroup();
  }

  /// `body(item, index)` describes one item.
  template <class Item, class Body>
  void List(const ListField& field, std::vector<Item>& items, Body body) {
    const std::size_t count = BeginList(field, items.size());
    items.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      BeginItem(i);
      body(items[i], i);
      EndGroup();
    }
    EndList();
  }

 protected:
  virtual void WideInteger(const IntegerField& field, std::int64_t& value) = 0;
  /// False: skip the body (and EndGroup). `optional` is null for a group that must be there.
  virtual bool BeginGroup(std::string_view key, std::string_view meaning, bool* optional,
                          bool present) = 0;
  virtual void EndGroup() = 0;
  virtual std::size_t BeginList(const ListField& field, std::size_t size) = 0;
  virtual void BeginItem(std::size_t index) = 0;
  virtual void EndList() = 0;
};

/// "gap" in mm -> "gap_mm".
[[nodiscard]] inline std::string KeyOf(std::string_view stem, const Unit& unit) {
  std::string key(stem);
  if (!unit.suffix.empty()) key.append("_").append(unit.suffix);
  return key;
}

}  // namespace levitas::configuration
