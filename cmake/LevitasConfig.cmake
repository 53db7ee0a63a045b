# find_package(Levitas REQUIRED)
# target_link_libraries(my_program PRIVATE levitas::levitas)
#
# Needs the development packages libfmt-dev and libyaml-cpp-dev. GCC 12 or later, C++20, x86-64-v2;
# no promise between versions: a program is compiled anew with each (examples/README.md).
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(fmt)
find_dependency(yaml-cpp)

if(NOT TARGET levitas::levitas)
  # The real path, for /lib is a link to /usr/lib.
  get_filename_component(_levitas_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." REALPATH)
  # yaml-cpp 0.7 of Debian defines the target without its namespace.
  set(_levitas_yaml yaml-cpp::yaml-cpp)
  if(NOT TARGET yaml-cpp::yaml-cpp)
    set(_levitas_yaml yaml-cpp)
  endif()
  add_library(levitas::levitas STATIC IMPORTED)
  set_target_properties(levitas::levitas PROPERTIES
    IMPORTED_LOCATION ${_levitas_prefix}/lib/liblevitas.a
    IMPORTED_LINK_INTERFACE_LANGUAGES CXX
    INTERFACE_INCLUDE_DIRECTORIES ${_levitas_prefix}/include/levitas
    INTERFACE_COMPILE_FEATURES cxx_std_20
    INTERFACE_LINK_LIBRARIES "${_levitas_yaml};fmt::fmt;Threads::Threads")
  unset(_levitas_prefix)
  unset(_levitas_yaml)
endif()
