#include "configuration/text/document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>

namespace levitas::configuration {
namespace {

Place At(const YAML::Mark& mark) { return {mark.line + 1, mark.column + 1}; }

struct Refused {
  SyntaxProblem problem;
};

/// Builds the tree from the library's events. A stack of open collections; a scalar directly inside
/// a map is alternately a key and a value.
class Builder : public YAML::EventHandler {
 public:
  explicit Builder(Node& root) : root_(root) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Add({.kind = Node::Kind::kEmpty, .place = At(mark)}, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refused{{At(mark), "aliases (*name) are not allowed: write the value out"}};
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    RefuseTag(mark, tag);
    Add({.kind = Node::Kind::kScalar, .place = At(mark), .text = value, .quoted = tag == "!"},
        anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Open(mark, tag, anchor, Node::Kind::kSequence);
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Open(mark, tag, anchor, Node::Kind::kMap);
  }
  void OnMapEnd() override { Close(); }

 private:
  struct Level {
    Node node;
    bool key_next{true};
  };

  static void RefuseTag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!") {
      throw Refused{{At(mark), "tags (" + tag + ") are not allowed"}};
    }
  }

  void Open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            Node::Kind kind) {
    RefuseTag(mark, tag);
    RefuseAnchor(At(mark), anchor);
    if (!stack_.empty() && stack_.back().node.kind == Node::Kind::kMap && stack_.back().key_next) {
      throw Refused{{At(mark), "a key must be a word, not a list or a map"}};
    }
    stack_.push_back({{.kind = kind, .place = At(mark)}});
  }
  void Close() {
    Node done = std::move(stack_.back().node);
    stack_.pop_back();
    Add(std::move(done), 0);
  }
  void Add(Node node, YAML::anchor_t anchor) {
    RefuseAnchor(node.place, anchor);
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& parent = stack_.back();
    if (parent.node.kind == Node::Kind::kMap && parent.key_next) {
      RefuseMoreKeys(node.place, parent.node.keys.size());
      parent.node.keys.emplace_back(std::move(node.text), node.place);
      parent.key_next = false;
      return;
    }
    parent.node.items.push_back(std::move(node));
    parent.key_next = true;
  }
  /// No group of ours has a tenth of it; each key is compared with those that are known, and with
  /// the others of its group.
  static void RefuseMoreKeys(Place place, std::size_t keys) {
    constexpr std::size_t kMostKeys = 256;
    if (keys >= kMostKeys) {
      throw Refused{
          {place, fmt::format("a group of more than {} keys: no file of ours", kMostKeys)}};
    }
  }
  static void RefuseAnchor(Place place, YAML::anchor_t anchor) {
    if (anchor != 0) throw Refused{{place, "anchors (&name) are not allowed"}};
  }

  Node& root_;
  std::vector<Level> stack_;
};

/// Ignores what it is told but where it stands.
class FirstPlace : public Builder {
 public:
  using Builder::Builder;
  void OnDocumentStart(const YAML::Mark& mark) override { place = At(mark); }
  Place place;
};

/// Line `number` (from 1) of a text, without the blanks around it; cut to a readable length.
std::string LineOf(const std::string& text, int number) {
  std::istringstream stream(text);
  std::string line;
  for (int i = 0; i < number && std::getline(stream, line); ++i) {
  }
  const std::size_t from = std::min(line.find_first_not_of(" \t\r"), line.size());
  const std::size_t to = line.find_last_not_of(" \t\r") + 1;
  line = line.substr(from, to > from ? to - from : 0);
  return line.size() > 60 ? line.substr(0, 57) + "..." : line;
}

/// The library says what confused it; what people got wrong is one of four things.
std::string Explained(const YAML::Exception& error, const std::string& text) {
  const std::string line = LineOf(text, error.mark.line + 1);
  return fmt::format(
      "not valid YAML: {}{}; look here and at the line before: indent with spaces, not tabs, all "
      "keys of a group alike; a space after each colon; quotes and brackets closed",
      error.msg, line.empty() ? "" : fmt::format(" near \"{}\"", line));
}

}  // namespace

Document ReadDocument(const std::string& text) {
  Document document;
  if (text.size() > kMostBytes) {
    document.problem = {{1, 1},
                        fmt::format("more than {} MB; allowed {} MB: a file of ours has some "
                                    "kilobytes, is this one of another kind?",
                                    kMostBytes >> 20U, kMostBytes >> 20U)};
    return document;
  }
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Builder builder(document.root);
    if (!parser.HandleNextDocument(builder)) {
      document.problem = {{1, 1}, "the file is empty"};
      return document;
    }
    Node ignored;
    FirstPlace second(ignored);
    if (parser.HandleNextDocument(second)) {
      document.problem = {second.place, "a second document begins here; one file holds one"};
    }
  } catch (const Refused& refused) {
    document.problem = refused.problem;
  } catch (const YAML::Exception& error) {
    document.problem = {At(error.mark), Explained(error, text)};
  }
  return document;
}

}  // namespace levitas::configuration
