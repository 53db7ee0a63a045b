#pragma once
// A visitor that writes a file as Writer does and remembers, for every scalar, its line and what is
// allowed there: tests loop over the tables themselves, so no field can be forgotten.

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "configuration/text/writer.hpp"

namespace levitas::configuration::test {

struct ListedField {
  std::string key;
  int line{};
  bool required{};
  bool number{};
  std::vector<std::string> bad;  ///< texts that must be refused
};

class FieldList : public Writer {
 public:
  /// `form`: which of several ways to give a quantity is written.
  FieldList(std::string_view kind, std::size_t form) : Writer(kind), form_(form) {}

  void Number(const NumberField& field, double& si) override {
    const double low = *ToSi(BoundText(field.low), field.unit);
    const double high = *ToSi(BoundText(field.high), field.unit);
    // Forms that are not the one a struct came from have no value: take the geometric mean.
    const bool usable = si >= low && si <= high && !(inside_form_ && si == 0.0);
    double value = usable ? si : std::sqrt(std::max(low, high * 1e-6) * high);
    Add(KeyOf(field.stem, field.unit), !field.fallback, true,
        {Beyond(field.low, -1.0), Beyond(field.high, 1.0), ".nan", ".inf", "-.inf", "1e999", "word",
         "\"1\"", "", "[1]", "{a: 1}", "1,5", "1 mm"});
    Writer::Number(field, value);
  }
  void Name(const NameField& field, std::string& value) override {
    Add(std::string(field.key), true, false,
        {"", field.also.empty() ? "UPPER" : "semi;colon", "two words", "[a]",
         std::string(33, 'a')});
    Writer::Name(field, value);
  }
  void Choice(const ChoiceField& field, std::size_t& index) override {
    Add(std::string(field.key), !field.fallback, false, {"", "no_such_word", "[a]", "{a: 1}"});
    Writer::Choice(field, index);
  }
  void OneOf(std::string_view what, std::span<const Form> forms, std::size_t& chosen) override {
    chosen = form_;
    inside_form_ = true;
    Writer::OneOf(what, forms, chosen);
    inside_form_ = false;
  }
  [[nodiscard]] const std::vector<ListedField>& fields() const { return fields_; }

 protected:
  void WideInteger(const IntegerField& field, std::int64_t& value) override {
    Add(std::string(field.key), !field.fallback, true,
        {std::to_string(field.low - 1), std::to_string(field.high + 1), ".nan", ".inf", "word",
         "1.5", "\"1\"", "", "[1]", "99999999999999999999"});
    Writer::WideInteger(field, value);
  }

 private:
  /// A text just beyond a bound: by a part in a billion, or by 1e-12 of the unit at zero.
  static std::string Beyond(double bound, double direction) {
    return BoundText(bound + direction * std::max(std::abs(bound) * 1e-9, 1e-12));
  }
  void Add(std::string key, bool required, bool number, std::vector<std::string> bad) {
    const auto line = static_cast<int>(std::count(text().begin(), text().end(), '\n')) + 1;
    fields_.push_back({std::move(key), line, required, number, std::move(bad)});
  }

  std::size_t form_;
  bool inside_form_{};
  std::vector<ListedField> fields_;
};

/// Moves every number a little, at random, and so gives it a full mantissa of digits.
class Jitter : public Writer {
 public:
  explicit Jitter(std::uint64_t seed) : Writer("none"), state_(seed) {}
  void Number(const NumberField& field, double& si) override {
    const double low = *ToSi(BoundText(field.low), field.unit);
    const double high = *ToSi(BoundText(field.high), field.unit);
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    const double moved = si * (1.0 + 1e-7 * static_cast<double>(state_ >> 11) * 0x1p-53);
    // The period is a whole number of nanoseconds, and must stay one.
    if (field.stem != "period" && moved >= low && moved <= high) si = moved;
    Writer::Number(field, si);
  }
  void OneOf(std::string_view, std::span<const Form> forms, std::size_t&) override {
    forms.front().describe();
  }

 private:
  std::uint64_t state_;
};

/// The bits of every number, in the order of the table.
class Bits : public Writer {
 public:
  Bits() : Writer("none") {}
  void Number(const NumberField& field, double& si) override {
    all.push_back(std::bit_cast<std::uint64_t>(si));
    Writer::Number(field, si);
  }
  std::vector<std::uint64_t> all;

 protected:
  void WideInteger(const IntegerField& field, std::int64_t& value) override {
    all.push_back(static_cast<std::uint64_t>(value));
    Writer::WideInteger(field, value);
  }
};

}  // namespace levitas::configuration::test
