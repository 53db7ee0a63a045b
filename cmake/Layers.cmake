# Libraries declare the layer they live in; a use of a higher layer, or of a sibling in the same
# layer, stops the configuration with one sentence. Two digits: the first is the layer of the
# architecture, the second orders parts and their compositions within it (see docs/layers.md).
#
#   levitas_library(law LAYER 10 FOLDER controller/law SOURCES pid.cpp USES common)
#   levitas_program(amb-plant SOURCES main.cpp USES plant)
#
# Programs stand above all libraries (layer 59, above their own parts) and not on each other.
# USES names libraries of ours, LINKS third-party targets visible in our headers, PRIVATE_LINKS
# third-party targets that stay inside the sources.

set_property(GLOBAL PROPERTY LEVITAS_LIBRARIES "")
# What `./amb run` needs: the programs without tests and benchmarks.
add_custom_target(programs)

function(levitas_library name)
  cmake_parse_arguments(A "" "LAYER;FOLDER" "SOURCES;USES;LINKS;PRIVATE_LINKS" ${ARGN})
  if(A_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "levitas_library(${name}): unknown words ${A_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT A_FOLDER)
    file(RELATIVE_PATH A_FOLDER ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  set(visibility PUBLIC)
  if(A_SOURCES)
    add_library(${name} STATIC ${A_SOURCES})
    target_link_libraries(${name} PRIVATE levitas_options ${A_PRIVATE_LINKS})
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
  else()
    set(visibility INTERFACE)
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR})
  endif()
  target_link_libraries(${name} ${visibility} ${A_USES} ${A_LINKS})
  set_target_properties(${name} PROPERTIES LEVITAS_LAYER "${A_LAYER}" LEVITAS_FOLDER "${A_FOLDER}"
                                           LEVITAS_USES "${A_USES}")
  set_property(GLOBAL APPEND PROPERTY LEVITAS_LIBRARIES ${name})
endfunction()

function(levitas_program name)
  cmake_parse_arguments(A "" "" "SOURCES;USES;PRIVATE_LINKS" ${ARGN})
  add_executable(${name} ${A_SOURCES})
  target_link_libraries(${name} PRIVATE levitas_options ${A_USES} ${A_PRIVATE_LINKS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin
                                           LEVITAS_LAYER 59 LEVITAS_FOLDER "${folder}"
                                           LEVITAS_USES "${A_USES}")
  set_property(GLOBAL APPEND PROPERTY LEVITAS_LIBRARIES ${name})
  add_dependencies(programs ${name})
endfunction()

# The library that owns `folder`: the longest declared folder that is a prefix of it.
function(_levitas_owner folder out)
  get_property(all GLOBAL PROPERTY LEVITAS_LIBRARIES)
  set(best "")
  set(best_length -1)
  foreach(library IN LISTS all)
    get_target_property(theirs ${library} LEVITAS_FOLDER)
    string(LENGTH "${theirs}" length)
    string(FIND "${folder}/" "${theirs}/" at)
    if(at EQUAL 0 AND length GREATER best_length)
      set(best ${library})
      set(best_length ${length})
    endif()
  endforeach()
  set(${out} "${best}" PARENT_SCOPE)
endfunction()

function(_levitas_refuse_unless_below library used where)
  get_target_property(own ${library} LEVITAS_LAYER)
  get_target_property(below ${used} LEVITAS_LAYER)
  if(NOT below LESS own)
    message(FATAL_ERROR "${library} (layer ${own}) may not use ${used} (layer ${below})${where}")
  endif()
endfunction()

# Every #include of a file, by folder: whoever owns the folder must live below `library`.
function(_levitas_check_includes library file)
  file(RELATIVE_PATH relative ${PROJECT_SOURCE_DIR} ${file})
  file(STRINGS ${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"][^>\"]+/[^>\"]+[>\"]")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE ".*[<\"](.+)/[^/]+[>\"].*" "\\1" target_folder "${line}")
    _levitas_owner(${target_folder} owner)
    if(owner AND NOT owner STREQUAL library)
      _levitas_refuse_unless_below(${library} ${owner} ": ${relative} has ${line}")
    endif()
  endforeach()
endfunction()

# Checks declared uses and, since a header can be included without being linked, every #include of
# the files in a library's folder and below (as far as no other library owns the subfolder).
function(levitas_check_layers)
  get_property(all GLOBAL PROPERTY LEVITAS_LIBRARIES)
  foreach(library IN LISTS all)
    get_target_property(uses ${library} LEVITAS_USES)
    foreach(used IN LISTS uses)
      if(NOT TARGET ${used})
        message(FATAL_ERROR "${library} uses ${used}, which is not a library of this project")
      endif()
      get_target_property(layer ${used} LEVITAS_LAYER)
      if(layer MATCHES "NOTFOUND")
        message(FATAL_ERROR "${library}: ${used} is not a library of this project; name it in LINKS")
      endif()
      _levitas_refuse_unless_below(${library} ${used} "")
    endforeach()
    get_target_property(folder ${library} LEVITAS_FOLDER)
    file(GLOB_RECURSE files ${PROJECT_SOURCE_DIR}/${folder}/*.hpp ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
    foreach(file IN LISTS files)
      get_filename_component(file_folder ${file} DIRECTORY)
      file(RELATIVE_PATH file_folder ${PROJECT_SOURCE_DIR} ${file_folder})
      _levitas_owner(${file_folder} owner)
      if(owner STREQUAL library)
        _levitas_check_includes(${library} ${file})
      endif()
    endforeach()
  endforeach()
endfunction()
