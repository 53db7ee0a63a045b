#pragma once
// Recorded sessions in one SQLite file: what was run, with which outcome, under which tags.
//
// Holds     descriptions and paths only. The sessions stay where they are; a file that has been
//           moved or deleted keeps its entry until it is forgotten.
// Sharing   several programs at once: each change is a transaction, and a writer waits up to 5 s
//           for another.
// Thread    one at a time for an object.
// Failure   BadInput naming the file: it cannot be opened or written, is no catalogue, or is one
//           of a newer program.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session_index/entry.hpp"

namespace levitas::session_index {

/// What an entry must have to be found; what is empty asks for nothing.
struct Filter {
  std::string rig{};
  std::string outcome{};
  std::vector<std::string> tags{};  ///< all of them
  std::string text{};               ///< within path, controller, scenario or port
  std::optional<std::int64_t> from_utc_ns{};
  std::optional<std::int64_t> before_utc_ns{};
};

class Catalogue {
 public:
  /// Makes the file, and the folders above it, when it is not there.
  explicit Catalogue(const std::string& path);
  ~Catalogue();
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;

  /// Enters a session, or renews what is known of it; tags it already has are kept.
  void Put(const Entry& entry);
  /// Newest first.
  [[nodiscard]] std::vector<Entry> Find(const Filter& filter) const;
  /// False when there is no entry of that path; so the others.
  bool AddTag(const std::string& path, const std::string& tag);
  bool RemoveTag(const std::string& path, const std::string& tag);
  bool Forget(const std::string& path);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session_index
