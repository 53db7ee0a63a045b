#pragma once
// Writes a described struct as complete YAML: every field, one a line, defaults included.
// Reading the text gives the same bits.

#include <string>

#include "configuration/schema/visitor.hpp"

namespace levitas::configuration {

class Writer : public Visitor {
 public:
  explicit Writer(std::string_view kind) : text_("kind: " + std::string(kind) + "\n") {}

  void Number(const NumberField& field, double& si) override;
  void Name(const NameField& field, std::string& value) override;
  void Choice(const ChoiceField& field, std::size_t& index) override;
  void Words(const WordsField& field, std::uint32_t& mask) override;
  void OneOf(std::string_view what, std::span<const Form> forms, std::size_t& chosen) override;
  void When(bool condition, std::string_view when, const std::function<void()>& body) override;
  void RefuseIf(bool, std::string_view, const std::string&) override {}

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 protected:
  void WideInteger(const IntegerField& field, std::int64_t& value) override;
  bool BeginGroup(std::string_view key, std::string_view meaning, bool* optional,
                  bool present) override;
  void EndGroup() override;
  std::size_t BeginList(const ListField& field, std::size_t size) override;
  void BeginItem(std::size_t index) override;
  void EndList() override;

 private:
  void Line(std::string_view key, std::string_view value);

  std::string text_;
  std::size_t depth_{0};
  bool item_begins_{};  ///< the next line carries the dash
};

}  // namespace levitas::configuration
