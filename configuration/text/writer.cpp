#include "configuration/text/writer.hpp"

#include <algorithm>

namespace levitas::configuration {

void Writer::Line(std::string_view key, std::string_view value) {
  const std::size_t indent = 2 * depth_ - (item_begins_ ? 2 : 0);
  text_.append(indent, ' ').append(item_begins_ ? "- " : "").append(key).append(":");
  if (!value.empty()) text_.append(" ").append(value);
  text_.append("\n");
  item_begins_ = false;
}

void Writer::Number(const NumberField& field, double& si) {
  Line(KeyOf(field.stem, field.unit), FromSi(si, field.unit));
}

void Writer::WideInteger(const IntegerField& field, std::int64_t& value) {
  Line(field.key, std::to_string(value));
}

namespace {
/// Of a letter, then letters, digits and _: no reader of YAML takes it for anything else.
bool IsPlainName(const std::string& value) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  return !value.empty() && letter(value.front()) &&
         std::ranges::all_of(value, [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}
}  // namespace

void Writer::Name(const NameField& field, std::string& value) {
  if (field.most_text == 0 || IsPlainName(value)) return Line(field.key, value);
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  Line(field.key, quoted + "\"");
}

void Writer::Choice(const ChoiceField& field, std::size_t& index) {
  Line(field.key, field.words[index]);
}

void Writer::Words(const WordsField& field, std::uint32_t& mask) {
  std::string list;
  for (std::size_t i = 0; i < field.words.size(); ++i) {
    if (((mask >> i) & 1U) == 0U) continue;
    list.append(list.empty() ? "" : ", ").append(field.words[i]);
  }
  Line(field.key, "[" + list + "]");
}

void Writer::OneOf(std::string_view, std::span<const Form> forms, std::size_t& chosen) {
  forms[chosen].describe();
}

void Writer::When(bool condition, std::string_view, const std::function<void()>& body) {
  if (condition) body();
}

bool Writer::BeginGroup(std::string_view key, std::string_view, bool*, bool present) {
  if (!present) return false;
  Line(key, "");
  ++depth_;
  return true;
}

void Writer::EndGroup() { --depth_; }

std::size_t Writer::BeginList(const ListField& field, std::size_t size) {
  Line(field.key, size == 0 ? "[]" : "");
  ++depth_;
  return size;
}

void Writer::BeginItem(std::size_t) {
  ++depth_;
  item_begins_ = true;
}

void Writer::EndList() { --depth_; }

}  // namespace levitas::configuration
