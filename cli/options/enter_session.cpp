#include "cli/options/enter_session.hpp"

#include <fmt/core.h>

#include <exception>
#include <functional>

#include "rt/say.hpp"
#include "session_index/catalogue.hpp"
#include "session_index/catalogue_path.hpp"
#include "session_index/describe_session.hpp"

namespace levitas::cli {
namespace {

void Enter(const std::vector<std::string>& tags,
           const std::function<session_index::Entry()>& describe) noexcept {
  try {
    const auto path = session_index::CataloguePath();
    if (!path) return;
    session_index::Entry entry = describe();
    entry.tags = tags;
    session_index::Catalogue(*path).Put(entry);
  } catch (const std::exception& error) {
    rt::Say("amb: not entered in the catalogue of sessions:");
    rt::Say(error.what());
  }
}

}  // namespace

void EnterRun(const std::string& path, const verdict::Verdict& verdict,
              const std::vector<std::string>& tags) noexcept {
  Enter(tags, [&] { return session_index::DescribeRun(path, verdict); });
}

void EnterSession(const std::string& path, const std::vector<std::string>& tags) noexcept {
  Enter(tags, [&] { return session_index::DescribeSession(path); });
}

}  // namespace levitas::cli
