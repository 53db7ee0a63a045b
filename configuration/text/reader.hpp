#pragma once
// Fills a described struct from a document and collects every problem met.
//
// Failure  Finish throws BadInput with all problems in the order of the file; until then a refused
//          number is NaN and nothing is clamped.
// Thread   any; not for the control cycle.

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "configuration/schema/visitor.hpp"
#include "configuration/text/document.hpp"

namespace levitas::configuration {

class Reader : public Visitor {
 public:
  Reader(const Document& document, std::string file_name);

  void Number(const NumberField& field, double& si) override;
  void Name(const NameField& field, std::string& value) override;
  void Choice(const ChoiceField& field, std::size_t& index) override;
  void Words(const WordsField& field, std::uint32_t& mask) override;
  void Variant(const ChoiceField& field, std::size_t& index,
               const std::function<void(std::size_t)>& body) override;
  void OneOf(std::string_view what, std::span<const Form> forms, std::size_t& chosen) override;
  void When(bool condition, std::string_view when, const std::function<void()>& body) override;
  void RefuseIf(bool violated, std::string_view key, const std::string& text) override;

  /// True when the root has no `kind: <kind>`: then the one problem that matters is recorded and
  /// nothing else should be read.
  [[nodiscard]] bool WrongKind(std::string_view kind);
  /// Reports keys nobody asked for at the root, then throws when there was any problem.
  void Finish();
  /// Throws what was found so far, without looking for unknown keys.
  void FinishEarly();

 protected:
  void WideInteger(const IntegerField& field, std::int64_t& value) override;
  bool BeginGroup(std::string_view key, std::string_view meaning, bool* optional,
                  bool present) override;
  void EndGroup() override;
  std::size_t BeginList(const ListField& field, std::size_t size) override;
  void BeginItem(std::size_t index) override;
  void EndList() override;

 private:
  struct Problem {
    Place place;
    std::string text;
  };
  /// A field of the group being read.
  struct Expected {
    std::string key;                ///< as documented
    std::vector<std::string> keys;  ///< the same in other units
    bool found{};
    std::string missing;  ///< what to say when it is required and not there; empty: optional
  };
  struct Frame {
    const Node* node{};  ///< null: the group is absent, defaults apply
    std::string path;    ///< "bearings[0].magnet."
    std::string name;    ///< of the group itself
    Place place;
    std::vector<Expected> expected;
    bool mute{};  ///< what is wrong with it has been said
  };
  /// Words that the owner of a choice does not have: all of them are one problem.
  struct Foreign {
    std::size_t problem{};  ///< index, at the first place
    std::string where;      ///< how its text begins
    std::size_t places{};
    std::vector<std::string> words;  ///< each once
  };
  struct OpenList {
    const Node* node{};
    std::string path;
  };
  struct Entry {
    const Node* value{};  ///< null: absent
    std::string key;
    Place key_place;
  };

  [[nodiscard]] Frame& top() { return frames_.back(); }
  /// Texts of problems are made only when there is one: they cost more than the reading.
  using Text = std::function<std::string()>;

  /// Looks one of `keys` up and notes that it is a key of this group; `missing` is null for a key
  /// that may be left out.
  Entry Take(std::vector<std::string> keys, const Text& missing = nullptr);
  [[nodiscard]] Entry Find(const std::string& key) const;
  /// Scalar text of an entry; reports and returns null when it is something else.
  const std::string* Scalar(const Entry& entry, const Text& allowed, bool number);
  void Report(Place place, const std::string& key, const std::string& text);
  void ReportForeign(const ChoiceField& field, const Entry& entry, const std::string& word);
  void OpenFrame(const Node* node, std::string path, std::string name, Place place);
  void CloseFrame();
  void ReportUnknown(Frame& frame);
  [[nodiscard]] static std::string Meant(const Frame& frame, std::string key);
  void ExplainUnknownKeys();
  void ReportMissing(const Frame& frame);
  void ReportAbsentGroup();
  void ReportDuplicates(const Frame& frame);
  [[nodiscard]] std::vector<std::string> KeysOf(const std::function<void()>& body);

  std::string file_name_;
  std::vector<Frame> frames_;
  std::vector<OpenList> lists_;
  std::vector<Problem> problems_;
  std::map<std::string, std::string> homes_;  ///< every key met, and the first group it is of
  std::vector<std::pair<std::size_t, std::string>> unknown_keys_;  ///< problem and its unknown key
  std::map<std::string, Foreign> foreign_;                         ///< by owner
  bool probing_{};  ///< only the keys of a form are being collected
  std::vector<std::string> probed_;
};

}  // namespace levitas::configuration
