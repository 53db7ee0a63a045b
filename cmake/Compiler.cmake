# One interface target carries warnings and the sanitizer switches of the presets.
set(LEVITAS_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize= (address,undefined | thread)")

add_library(levitas_options INTERFACE)
target_compile_options(levitas_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
# In a batch of sources (CMAKE_UNITY_BUILD) each source is an included file, where the compiler takes a
# member of a type of the unnamed namespace for a mistake of a header.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(levitas_options INTERFACE -Wno-subobject-linkage)
endif()
# clang takes an alias that stands in two sources of a batch for a shadowed one; the preset dev and
# GCC's batches look for what really is.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(levitas_options INTERFACE -Wno-shadow)
endif()
if(LEVITAS_SANITIZE)
  add_compile_options(-fsanitize=${LEVITAS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LEVITAS_SANITIZE})
  # GCC 12 sees uninitialised values in its own <regex> and <functional> once they are instrumented.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
  # What is watched is our code and the standard library in it: with the headers of other libraries
  # instrumented as well, most of the compile time and of the tests' time would go to Eigen's.
  # The list is named from the build's folder, in which the compiler is started, and its text enters
  # the command: the compiler's cache then serves clones, and notices a list that changes.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    set(levitas_not_sanitized ${PROJECT_SOURCE_DIR}/cmake/not_sanitized.txt)
    file(RELATIVE_PATH levitas_list ${CMAKE_BINARY_DIR} ${levitas_not_sanitized})
    file(MD5 ${levitas_not_sanitized} levitas_list_text)
    add_compile_options(-fsanitize-ignorelist=${levitas_list} -DLEVITAS_NOT_SANITIZED=${levitas_list_text})
  endif()
endif()
# GCC searches its memory for what it may free, again and again from 128 MB on: a batch of sources needs
# 700, and 900 with a later start, and takes about a twentieth less time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=400000>)
endif()
# Our libraries are linked into some hundred programs: lld takes a fifth of the time of GNU ld for it.
# clang finds the lld of its own version.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  find_program(LEVITAS_LLD ld.lld-14)
  if(LEVITAS_LLD)
    add_link_options(-fuse-ld=lld)
  endif()
endif()
# For sources that are not hot, tests and commands. With a sanitizer they are compiled like the others:
# an inline function of the standard library or of Eigen that stands in both is linked once, and
# unoptimised, from a test, it made all that calls it several times as slow.
set(levitas_unhot $<$<CONFIG:Release>:-O1>)
# What runs once a run, or waits for people: files, options, pages, the verdict. A first build takes a
# tenth less time with it at -O1, which changes no bit of what it computes.
set(LEVITAS_SELDOM configuration verdict dashboard doctor session_index session_report svg plant_run
    run_support controller_program amb-controller amb-plant amb-rig)
function(levitas_optimise name)
  if(name IN_LIST LEVITAS_SELDOM)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
if(LEVITAS_FUZZ)  # libFuzzer sees which branches an input takes
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
# Bit-exact replay: the same source must give the same arithmetic in every program of one build,
# so contraction to fused multiply-add is left off, and -march is fixed rather than "native".
add_compile_options(-ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  add_compile_options(-march=x86-64-v2)
endif()

# Release programs parse what networks and files bring and may run as root: overflows of buffers that
# the compiler can see end the program instead of being used, the stack carries a canary, the image
# lies at a drawn address, and symbols are bound before main and then read-only. Sanitizer builds
# watch the same and more. What it costs: docs/timing.md.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  add_compile_options(-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -fstack-protector-strong -fPIE)
  add_link_options(-pie -Wl,-z,relro -Wl,-z,now)
endif()
# Checks of every index and iterator of the standard library, but not in the arithmetic that runs
# thousands of times per period or trial: there it costs more than 2 %.
set(LEVITAS_UNCHECKED_ARITHMETIC law rotor magnet amplifier sensor support gear effect plant analysis
    record_analysis identification diagnosis_model diagnosis_terms diagnosis_inference levitator accuracy
    identification_accuracy synthesis dense spectra)
function(levitas_check_indices name)
  if(NOT name IN_LIST LEVITAS_UNCHECKED_ARITHMETIC)
    target_compile_definitions(${name} PRIVATE _GLIBCXX_ASSERTIONS)
  endif()
endfunction()

# Programs name their sources from the folder of the repository, wherever that lies: a clone elsewhere
# compiles to the same bytes, and the compiler's cache serves it.
add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  # Without these words it does not keep what is compiled with precompiled headers.
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
  endif()
endif()

# Headers of the standard library, of fmt and of Eigen are read by nearly every library and cost each
# of its batches one to two seconds: in preset release they are compiled once, for what checks indices
# and for what does not. Other presets see that each source includes what it uses. They are kept
# short on purpose: with the headers of JSON and of the option parser the file of 99 MB grows to 198,
# and reading that costs a batch more than it saves. A library without fmt goes without: GCC takes
# them only where the macros of the command line are the same, and -Winvalid-pch ends the build then.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(levitas_no_code ${PROJECT_BINARY_DIR}/generated/headers.cpp)
  file(CONFIGURE OUTPUT ${levitas_no_code} CONTENT "// What a target needs that has headers only.\n")
  foreach(kind checked unchecked)
    add_library(${kind}_headers OBJECT ${levitas_no_code})
    target_link_libraries(${kind}_headers PRIVATE levitas_options fmt::fmt)
  endforeach()
  target_compile_definitions(checked_headers PRIVATE _GLIBCXX_ASSERTIONS)
  target_precompile_headers(checked_headers PRIVATE <fmt/format.h> <fmt/ranges.h>
    <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <complex> <cstdint> <filesystem> <fstream>
    <functional> <limits> <map> <memory> <mutex> <numbers> <optional> <span> <stdexcept> <string>
    <string_view> <thread> <utility> <variant> <vector>)
  target_link_libraries(unchecked_headers PRIVATE Eigen3::Eigen)
  target_precompile_headers(unchecked_headers PRIVATE <Eigen/Cholesky> <Eigen/LU> <fmt/format.h>
    <algorithm> <array> <cmath> <cstdint> <functional> <memory> <optional> <stdexcept> <string>
    <string_view> <utility> <vector>)
endif()
# For a library or program whose own links are those named.
function(levitas_precompile_headers name)
  if(NOT TARGET checked_headers OR NOT "fmt::fmt" IN_LIST ARGN)
    return()
  endif()
  # In a precompiled header GCC 12 takes the standard library's for ours, and reports what it reports
  # falsely there (its bug 105651: text + std::string). The preset dev, without such headers, and
  # clang look for what is true.
  target_compile_options(${name} PRIVATE -Wno-stringop-overflow -Wno-restrict)
  if(name IN_LIST LEVITAS_UNCHECKED_ARITHMETIC)
    target_precompile_headers(${name} REUSE_FROM unchecked_headers)
  else()
    target_precompile_headers(${name} REUSE_FROM checked_headers)
  endif()
endfunction()
