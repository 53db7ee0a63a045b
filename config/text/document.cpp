#include "config/text/document.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <sstream>

namespace levitas::config {
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
      parent.node.keys.emplace_back(std::move(node.text), node.place);
      parent.key_next = false;
      return;
    }
    parent.node.items.push_back(std::move(node));
    parent.key_next = true;
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

}  // namespace

Document ReadDocument(const std::string& text) {
  Document document;
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
    document.problem = {At(error.mark), "not valid YAML: " + error.msg};
  }
  return document;
}

}  // namespace levitas::config
