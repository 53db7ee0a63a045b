# One interface target carries warnings and the sanitizer switches of the presets.
set(LEVITAS_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize= (address,undefined | thread)")

add_library(levitas_options INTERFACE)
target_compile_options(levitas_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
if(LEVITAS_SANITIZE)
  add_compile_options(-fsanitize=${LEVITAS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LEVITAS_SANITIZE})
  # GCC 12 sees uninitialised values in its own <regex> and <functional> once they are instrumented.
  add_compile_options(-Wno-maybe-uninitialized)
endif()
# Bit-exact replay: the same source must give the same arithmetic in every program of one build,
# so contraction to fused multiply-add is left off, and -march is fixed rather than "native".
add_compile_options(-ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  add_compile_options(-march=x86-64-v2)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
