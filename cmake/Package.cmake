# What an installation holds, and the Debian package made of it by `./amb package`.
#
# Places  programs in bin, shipped rigs, controllers, scenarios in share/levitas (looked for above
#         the program, configuration/find_config.cpp), messages and examples in share/levitas too;
#         headers in include/levitas, the archive in lib (InstalledLibrary.cmake).
include(GNUInstallDirs)
include(InstalledLibrary)

if(NOT LEVITAS_SANITIZE)
  levitas_installed_library(
    USES cycle loop plant plant_loop scenario configuration
    HEADERS
      common/problem.hpp common/rotational_speed.hpp
      configuration/rig_file.hpp configuration/shipped_names.hpp
      controller/cycle/control_cycle.hpp controller/law/own_law.hpp controller/loop/control_loop.hpp
      common/rig_link.hpp common/rig_port.hpp
      controller/scenario/scenario_player.hpp controller/supervisor/supervisor.hpp
      plant_sim/plant/plant.hpp plant_sim/plant/command_of.hpp
      plant_sim/loop/plant_loop.hpp)
endif()

function(levitas_install_programs)
  set(programs amb amb-study amb-controller amb-plant amb-rig)
  install(TARGETS ${programs} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  foreach(kind rigs controllers scenarios)
    install(DIRECTORY config/${kind} DESTINATION share/levitas FILES_MATCHING PATTERN "*.yaml")
  endforeach()
  install(DIRECTORY lcmtypes/ DESTINATION share/levitas/lcmtypes FILES_MATCHING PATTERN "*.lcm")
  install(DIRECTORY ${PROJECT_BINARY_DIR}/lcmtypes/python/ DESTINATION share/levitas/python
          FILES_MATCHING PATTERN "*.py")
  install(PROGRAMS scripts/read_session.py DESTINATION share/levitas/examples)
  install(DIRECTORY examples/ DESTINATION share/levitas/examples COMPONENT development)
  install(FILES LICENSE DESTINATION share/doc/levitas RENAME copyright)
  install(DIRECTORY docs/ DESTINATION share/doc/levitas FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")
  # Written by the program itself, so at installation, when it is there.
  install(CODE "
    function(levitas_write option file)
      execute_process(COMMAND \"${PROJECT_BINARY_DIR}/bin/amb\" manual \${option}
                      OUTPUT_FILE \"${PROJECT_BINARY_DIR}/\${file}\" COMMAND_ERROR_IS_FATAL ANY)
    endfunction()
    foreach(program ${programs})
      levitas_write(\"--man;--of;\${program}\" \${program}.1)
    endforeach()
    levitas_write(--bash amb.bash)")
  # bash looks for a file of the program's name.
  foreach(program ${programs})
    install(FILES ${PROJECT_BINARY_DIR}/${program}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${PROJECT_BINARY_DIR}/amb.bash DESTINATION share/bash-completion/completions
            RENAME ${program})
  endforeach()
endfunction()

levitas_install_programs()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME levitas)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION
    "Controller process, simulated rigs over LCM and CAN, recording and replay, identification and diagnosis.")
set(CPACK_PACKAGE_CONTACT "The Levitas developers <levitas@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # exact libraries, found by dpkg-shlibdeps
set(CPACK_DEBIAN_PACKAGE_DEPENDS "xz-utils")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "iproute2, zstd")
# PNG of amb report; programs of one's own (examples/README.md).
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "librsvg2-bin, cmake, g++, libfmt-dev, libyaml-cpp-dev, python3-matplotlib")
include(CPack)
