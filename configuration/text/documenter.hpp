#pragma once
// Writes the documentation of a file kind from its table: one Markdown table per group of keys.

#include <string>
#include <vector>

#include "configuration/schema/visitor.hpp"

namespace levitas::configuration {

class Documenter : public Visitor {
 public:
  Documenter() { Open("", "First level of the file."); }

  void Number(const NumberField& field, double& si) override;
  void Name(const NameField& field, std::string& value) override;
  void Choice(const ChoiceField& field, std::size_t& index) override;
  void Words(const WordsField& field, std::uint32_t& mask) override;
  void Variant(const ChoiceField& field, std::size_t& index,
               const std::function<void(std::size_t)>& body) override;
  void OneOf(std::string_view what, std::span<const Form> forms, std::size_t& chosen) override;
  void When(bool condition, std::string_view when, const std::function<void()>& body) override;
  void RefuseIf(bool, std::string_view, const std::string&) override {}

  /// The tables, in the order the groups were met; a group whose rows equal an earlier one's refers
  /// to it.
  [[nodiscard]] std::string Markdown() const;

 protected:
  void WideInteger(const IntegerField& field, std::int64_t& value) override;
  bool BeginGroup(std::string_view key, std::string_view meaning, bool* optional,
                  bool present) override;
  void EndGroup() override;
  std::size_t BeginList(const ListField& field, std::size_t size) override;
  void BeginItem(std::size_t) override {}
  void EndList() override {}

 private:
  struct Section {
    std::string path;
    std::string meaning;
    std::string rows;
  };

  void Open(const std::string& path, const std::string& meaning);
  void Row(std::string_view key, std::string_view unit, std::string_view allowed,
           std::string_view fallback, std::string_view meaning);

  std::vector<Section> sections_;
  std::vector<std::size_t> open_;
  std::string condition_;  ///< appended to the meaning of the fields inside OneOf and When
};

/// docs/configuration.md as it must read for the present tables.
[[nodiscard]] std::string ConfigurationDocument();

}  // namespace levitas::configuration
