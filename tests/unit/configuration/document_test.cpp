#include "configuration/text/document.hpp"

#include <gtest/gtest.h>

namespace levitas::configuration {
namespace {

TEST(ReadDocument, RemembersWhereKeysAndValuesStand) {
  const Document document = ReadDocument("# comment\na: 1\nb:\n  - x\n  - {c: 'two'}\n");
  ASSERT_FALSE(document.problem);
  const Node& root = document.root;
  ASSERT_EQ(root.kind, Node::Kind::kMap);
  ASSERT_EQ(root.keys.size(), 2U);
  EXPECT_EQ(root.keys[0].first, "a");
  EXPECT_EQ(root.keys[0].second, (Place{2, 1}));
  EXPECT_EQ(root.items[0].text, "1");
  EXPECT_EQ(root.items[0].place, (Place{2, 4}));
  EXPECT_FALSE(root.items[0].quoted);
  const Node& list = root.items[1];
  ASSERT_EQ(list.items.size(), 2U);
  EXPECT_EQ(list.items[0].place, (Place{4, 5}));
  EXPECT_EQ(list.items[1].items[0].text, "two");
  EXPECT_TRUE(list.items[1].items[0].quoted);
}

TEST(ReadDocument, KeepsDuplicateKeys) {
  const Document document = ReadDocument("a: 1\na: 2\n");
  ASSERT_EQ(document.root.keys.size(), 2U);
  EXPECT_EQ(document.root.keys[1].second, (Place{2, 1}));
}

TEST(ReadDocument, KeepsAnEmptyValueAsEmpty) {
  const Document document = ReadDocument("a:\nb: ~\n");
  EXPECT_EQ(document.root.items[0].kind, Node::Kind::kEmpty);
}

TEST(ReadDocument, RefusesATextThatIsTooLargeBeforeItIsParsed) {
  for (const char* begin : {"name: ", "# "}) {
    const std::string most = begin + std::string(kMostBytes - std::string(begin).size(), 'x');
    EXPECT_EQ(ReadDocument(most).problem.has_value(), *begin == '#');  // a comment alone is empty
    const Document document = ReadDocument(most + "x");
    ASSERT_TRUE(document.problem);
    EXPECT_NE(document.problem->text.find("allowed 4 MB"), std::string::npos);
  }
}

TEST(ReadDocument, ReadsWindowsLineEndsAndAByteOrderMark) {
  const Document document = ReadDocument(
      "\xEF\xBB\xBF"
      "a: 1\r\nb: 2\r\n");
  ASSERT_FALSE(document.problem);
  EXPECT_EQ(document.root.items[0].text, "1");
  EXPECT_EQ(document.root.keys[1].second.line, 2);
}

struct Refusal {
  const char* text;
  Place place;
  const char* words;
};

class ReadDocumentRefuses : public testing::TestWithParam<Refusal> {};
INSTANTIATE_TEST_SUITE_P(
    All, ReadDocumentRefuses,
    testing::Values(Refusal{"", {1, 1}, "the file is empty"},
                    Refusal{"# only a comment\n", {1, 1}, "the file is empty"},
                    Refusal{"a: 1\nb: [1, 2\n", {3, 1}, "not valid YAML"},
                    Refusal{"a: &x 1\nb: *x\n", {1, 4}, "anchors (&name) are not allowed"},
                    Refusal{"a: {b: *x}\n", {1, 8}, "not valid YAML"},
                    Refusal{"a: !!float 1\n", {1, 4}, "tags (tag:yaml.org,2002:float)"},
                    Refusal{"[a, b]: 1\n", {1, 1}, "a key must be a word"},
                    Refusal{"a: 1\n---\nb: 2\n", {2, 1}, "a second document begins here"},
                    Refusal{"a:\n\t- 1\n", {2, 2}, "not valid YAML"}));

TEST_P(ReadDocumentRefuses, WithPlaceAndWords) {
  const Document document = ReadDocument(GetParam().text);
  ASSERT_TRUE(document.problem) << GetParam().text;
  EXPECT_EQ(document.problem->place.line, GetParam().place.line);
  EXPECT_EQ(document.problem->place.column, GetParam().place.column);
  EXPECT_NE(document.problem->text.find(GetParam().words), std::string::npos)
      << document.problem->text;
}

TEST(ReadDocument, SurvivesDeepNesting) {
  const Document document = ReadDocument(std::string(100'000, '['));
  EXPECT_TRUE(document.problem);
}

}  // namespace
}  // namespace levitas::configuration
