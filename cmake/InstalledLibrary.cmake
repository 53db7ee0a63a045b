# What a program of somebody else's is built with: one archive, the headers that it may include, and
# find_package(Levitas), which gives the target levitas::levitas (examples/README.md).
#
#   levitas_installed_library(USES cycle plant HEADERS controller/cycle/control_cycle.hpp)
#
# Archive   all that the named libraries use, as one object whose weak symbols are its own: an inline
#           function of the standard library, of fmt or of ours is compiled into many objects and the
#           linker keeps one. Were that the other program's, compiled with other switches, our
#           arithmetic would no longer give the same bits, and Eigen could free what it has not
#           allocated. What is hidden cannot be exchanged.
# Headers   the named ones and all that they include; found at installation, so that none is missing.
# Not made  under a sanitizer: its objects need its own runtime in the program they are linked to.
function(levitas_installed_library)
  cmake_parse_arguments(A "" "" "USES;HEADERS" ${ARGN})
  levitas_archives_of(libraries ${A_USES})
  list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
  set(archive ${PROJECT_BINARY_DIR}/lib/liblevitas.a)
  list(JOIN files "," joined)
  add_custom_command(
    OUTPUT ${archive}
    COMMAND ${CMAKE_COMMAND} -DOUT=${archive} "-DFILES=${joined}" -DLD=${CMAKE_LINKER} -DNM=${CMAKE_NM}
            -DOBJCOPY=${CMAKE_OBJCOPY} -DAR=${CMAKE_AR} -P ${PROJECT_SOURCE_DIR}/cmake/WriteArchive.cmake
    DEPENDS ${libraries} ${files} ${PROJECT_SOURCE_DIR}/cmake/WriteArchive.cmake
    COMMENT "lib/liblevitas.a"
    VERBATIM)
  add_custom_target(installed_library DEPENDS ${archive})
  add_dependencies(programs installed_library)

  include(CMakePackageConfigHelpers)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/lib/LevitasConfigVersion.cmake
                                   VERSION ${PROJECT_VERSION} COMPATIBILITY ExactVersion)
  install(FILES ${PROJECT_BINARY_DIR}/lib/LevitasConfigVersion.cmake
                ${PROJECT_SOURCE_DIR}/cmake/LevitasConfig.cmake
          DESTINATION lib/cmake/Levitas COMPONENT development)
  install(FILES ${archive} DESTINATION lib COMPONENT development)
  install(CODE "
    set(source \"${PROJECT_SOURCE_DIR}\")
    set(to \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/include/levitas\")
    set(headers \"${A_HEADERS}\")
    include(\"${PROJECT_SOURCE_DIR}/cmake/InstallHeaders.cmake\")" COMPONENT development)
endfunction()
