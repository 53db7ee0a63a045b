#include "session_index/catalogue_path.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace levitas::session_index {
namespace {

/// An environment variable as it was before, once the test is over.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name); old != nullptr) old_ = old;
    value == nullptr ? unsetenv(name) : setenv(name, value, 1);
  }
  ~Variable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(CataloguePath, IsWhatTheVariableNames) {
  const Variable told("LEVITAS_CATALOGUE", "/somewhere/mine.db");
  EXPECT_EQ(CataloguePath(), "/somewhere/mine.db");
}

TEST(CataloguePath, IsNoneWhenTheVariableIsEmpty) {
  const Variable told("LEVITAS_CATALOGUE", "");
  const Variable home("HOME", "/home/anna");
  EXPECT_EQ(CataloguePath(), std::nullopt);
}

TEST(CataloguePath, IsInTheFolderForDataOfUsers) {
  const Variable told("LEVITAS_CATALOGUE", nullptr);
  const Variable home("HOME", "/home/anna");
  {
    const Variable data("XDG_DATA_HOME", "/data");
    EXPECT_EQ(CataloguePath(), "/data/levitas/sessions.db");
  }
  // The base directory specification: a relative path is not to be heard.
  for (const char* unusable : {"", "relative/folder"}) {
    const Variable data("XDG_DATA_HOME", unusable);
    EXPECT_EQ(CataloguePath(), "/home/anna/.local/share/levitas/sessions.db") << unusable;
  }
}

TEST(CataloguePath, IsNoneWithoutAHome) {
  const Variable told("LEVITAS_CATALOGUE", nullptr);
  const Variable data("XDG_DATA_HOME", nullptr);
  const Variable home("HOME", nullptr);
  EXPECT_EQ(CataloguePath(), std::nullopt);
}

}  // namespace
}  // namespace levitas::session_index
