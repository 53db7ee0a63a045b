#pragma once
// Where the catalogue is.
//
// Order    $LEVITAS_CATALOGUE (empty: no catalogue), else $XDG_DATA_HOME/levitas/sessions.db, else
//          ~/.local/share/levitas/sessions.db; without a home there is none.

#include <optional>
#include <string>

namespace levitas::session_index {

[[nodiscard]] std::optional<std::string> CataloguePath();

}  // namespace levitas::session_index
