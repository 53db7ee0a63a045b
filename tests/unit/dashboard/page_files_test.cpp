#include "dashboard/page_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "tests/support/paths.hpp"

namespace levitas::dashboard {
namespace {

TEST(PageFiles, AreTheFilesOfTheFolderByteForByte) {
  for (const PageFile& file : PageFiles()) {
    const std::string name = file.path == "/" ? "index.html" : std::string(file.path.substr(1));
    std::ifstream stream(test::SourceFolder() + "/dashboard/page/" + name);
    std::stringstream text;
    text << stream.rdbuf();
    ASSERT_TRUE(stream) << name;
    EXPECT_EQ(file.content, text.str()) << name;
  }
}

TEST(PageFiles, HoldEveryPartThatThePageAndItsModulesName) {
  const std::regex named(R"re((?:src|href|from)[= ]+"(?:\./)?([\w/.]+\.(?:js|css))")re");
  int found = 0;
  for (const PageFile& file : PageFiles()) {
    if (file.path.find("third_party") != std::string_view::npos) continue;
    const std::string text(file.content);
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
      ++found;
      EXPECT_NE(FindPageFile("/" + (*it)[1].str()), nullptr) << (*it)[1];
    }
  }
  EXPECT_GT(found, 15);  // the page has that many parts: the search itself works
}

TEST(PageFiles, FetchNothingFromElsewhere) {
  for (const PageFile& file : PageFiles()) {
    if (file.path.find("third_party") != std::string_view::npos)
      continue;  // a comment names its home
    EXPECT_EQ(file.content.find("http://"), std::string_view::npos) << file.path;
    EXPECT_EQ(file.content.find("https://"), std::string_view::npos) << file.path;
  }
}

TEST(PageFiles, AreNotFoundByOtherNames) {
  for (const char* path : {"", "/index.htm", "/../page.css", "//", "/page.css/"}) {
    EXPECT_EQ(FindPageFile(path), nullptr) << path;
  }
}

}  // namespace
}  // namespace levitas::dashboard
