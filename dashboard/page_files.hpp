#pragma once
// The page's files as they lie inside the program: no folder to find, no network to fetch from.
//
// The table is written at build time by cmake/EmbedFiles.cmake from dashboard/page.

#include <span>
#include <string_view>

namespace levitas::dashboard {

struct PageFile {
  std::string_view path;  ///< "/orbit.js"; the page itself is "/"
  const char* type{};     ///< media type
  std::string_view content;
};

[[nodiscard]] std::span<const PageFile> PageFiles() noexcept;

/// nullptr when there is no such file.
[[nodiscard]] inline const PageFile* FindPageFile(std::string_view path) noexcept {
  for (const PageFile& file : PageFiles()) {
    if (file.path == path) return &file;
  }
  return nullptr;
}

}  // namespace levitas::dashboard
