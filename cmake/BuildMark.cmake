# A mark of what programs were built from, for programs that start each other.
#
#   levitas_build_mark(amb_build OF amb_commands)
#
# adds an object library with `const char* levitas::BuildMark() noexcept`: 16 hexadecimal digits, the
# same in every program that was linked with these contents of amb_commands and of all that it uses.
function(levitas_build_mark name)
  cmake_parse_arguments(A "" "OF" "" ${ARGN})
  levitas_archives_of(libraries ${A_OF})
  list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
  list(JOIN files "," joined)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DOUT=${source} "-DFILES=${joined}"
            -P ${PROJECT_SOURCE_DIR}/cmake/WriteBuildMark.cmake
    DEPENDS ${libraries} ${PROJECT_SOURCE_DIR}/cmake/WriteBuildMark.cmake
    VERBATIM)
  add_library(${name} OBJECT ${source})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
endfunction()
