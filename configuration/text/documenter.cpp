#include "configuration/text/documenter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace levitas::configuration {
namespace {

std::string Code(std::string_view text) { return fmt::format("`{}`", text); }

}  // namespace

void Documenter::Open(const std::string& path, const std::string& meaning) {
  open_.push_back(sections_.size());
  sections_.push_back({path, meaning, ""});
}

void Documenter::Row(std::string_view key, std::string_view unit, std::string_view allowed,
                     std::string_view fallback, std::string_view meaning) {
  sections_[open_.back()].rows += fmt::format("| {} | {} | {} | {} | {}{} |\n", Code(key), unit,
                                              allowed, fallback, meaning, condition_);
}

void Documenter::Number(const NumberField& field, double&) {
  Row(KeyOf(field.stem, field.unit), field.unit.symbol,
      fmt::format("{} to {}", BoundText(field.low), BoundText(field.high)),
      field.fallback ? BoundText(*field.fallback) : "required", field.meaning);
}

void Documenter::WideInteger(const IntegerField& field, std::int64_t&) {
  Row(field.key, "", fmt::format("{} to {}, whole", field.low, field.high),
      field.fallback ? std::to_string(*field.fallback) : "required", field.meaning);
}

void Documenter::Name(const NameField& field, std::string&) {
  std::string allowed = field.also.empty() ? "name: a-z, 0-9, _" : "name: A-Z, a-z, 0-9, _";
  for (const char c : field.also) allowed += std::string(", ") + c;
  if (field.most_text > 0) {
    allowed = "text of at most " + std::to_string(field.most_text) + " characters";
  }
  Row(field.key, "", allowed, "required", field.meaning);
}

void Documenter::Choice(const ChoiceField& field, std::size_t&) {
  std::string words;
  for (const std::string_view word : field.words) {
    words += (words.empty() ? "" : ", ") + Code(word);
  }
  Row(field.key, "", words, field.fallback ? Code(*field.fallback) : "required", field.meaning);
}

void Documenter::Words(const WordsField& field, std::uint32_t&) {
  Row(field.key, "", field.documented, "all", field.meaning);
}

void Documenter::Variant(const ChoiceField& field, std::size_t& index,
                         const std::function<void(std::size_t)>& body) {
  Choice(field, index);
  const std::string outside = condition_;
  for (std::size_t i = 0; i < field.words.size(); ++i) {
    condition_ = fmt::format("{} (`{}: {}`)", outside, field.key, field.words[i]);
    body(i);
  }
  condition_ = outside;
}

void Documenter::OneOf(std::string_view what, std::span<const Form> forms, std::size_t&) {
  const std::string outside = condition_;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    condition_ = fmt::format("{} (way {} of {} to give {})", outside, i + 1, forms.size(), what);
    forms[i].describe();
  }
  condition_ = outside;
}

void Documenter::When(bool, std::string_view when, const std::function<void()>& body) {
  const std::string outside = condition_;
  condition_ = fmt::format("{} (only {})", outside, when);
  body();
  condition_ = outside;
}

bool Documenter::BeginGroup(std::string_view key, std::string_view meaning, bool* optional, bool) {
  Row(key, "", "group of keys", optional == nullptr ? "see its keys" : "may be left out", meaning);
  Open(fmt::format("{}{}{}", sections_[open_.back()].path, open_.size() > 1 ? "." : "", key),
       std::string(meaning));
  return true;
}

void Documenter::EndGroup() { open_.pop_back(); }

std::size_t Documenter::BeginList(const ListField& field, std::size_t) {
  Row(field.key, "", fmt::format("list of {} to {}", field.least, field.most),
      field.least == 0 ? "empty" : "required", field.meaning);
  Open(
      fmt::format("{}{}{}[]", sections_[open_.back()].path, open_.size() > 1 ? "." : "", field.key),
      std::string(field.meaning));
  return 1;
}

std::string Documenter::Markdown() const {
  std::string text;
  for (auto section = sections_.begin(); section != sections_.end(); ++section) {
    if (section != sections_.begin()) {
      text += fmt::format("### {}\n\n", Code(section->path));
    }
    const auto same = std::find_if(sections_.begin(), section, [&](const Section& earlier) {
      return earlier.rows == section->rows;
    });
    if (same != section) {
      text += fmt::format("{}: the same keys as {}.\n\n", section->meaning, Code(same->path));
    } else {
      text += "| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n";
      text += section->rows + "\n";
    }
  }
  return text;
}

}  // namespace levitas::configuration
