#pragma once
// Which contents of the libraries of `amb` a program was linked with (cmake/BuildMark.cmake).
// Thread  any.

namespace levitas {

/// 16 hexadecimal digits: equal in programs that were linked with the same libraries.
[[nodiscard]] const char* BuildMark() noexcept;

}  // namespace levitas
