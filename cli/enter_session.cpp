#include "cli/enter_session.hpp"

#include <fmt/core.h>

#include <exception>
#include <functional>

#include "controller/rt/say.hpp"
#include "session_index/catalogue.hpp"
#include "session_index/catalogue_path.hpp"
#include "session_index/describe_session.hpp"

namespace levitas::cli {
namespace {

void Enter(const std::vector<std::string>& tags,
           const std::function<catalogue::Entry()>& describe) noexcept {
  try {
    const auto path = catalogue::CataloguePath();
    if (!path) return;
    catalogue::Entry entry = describe();
    entry.tags = tags;
    catalogue::Catalogue(*path).Put(entry);
  } catch (const std::exception& error) {
    rt::Say("amb: not entered in the catalogue of sessions:");
    rt::Say(error.what());
  }
}

}  // namespace

void EnterRun(const std::string& path, const verdict::Verdict& verdict,
              const std::vector<std::string>& tags) noexcept {
  Enter(tags, [&] { return catalogue::DescribeRun(path, verdict); });
}

void EnterSession(const std::string& path, const std::vector<std::string>& tags) noexcept {
  Enter(tags, [&] { return catalogue::DescribeSession(path); });
}

}  // namespace levitas::cli
