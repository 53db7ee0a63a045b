# Generates C++ headers (included as SYSTEM: the generator's code warns under -Wconversion) and
# Python modules from lcmtypes/*.lcm, and the layouts that are checked before anything is decoded.
function(levitas_lcm_types target)
  set(cpp ${PROJECT_BINARY_DIR}/lcmtypes/cpp)
  set(python ${PROJECT_BINARY_DIR}/lcmtypes/python)
  set(outputs "")
  foreach(source IN LISTS ARGN)
    get_filename_component(stem ${source} NAME_WE)
    set(header ${cpp}/levitas_msg/${stem}.hpp)
    add_custom_command(
      OUTPUT ${header} ${python}/levitas_msg/${stem}.py
      COMMAND ${LCM_GEN} --cpp --cpp-hpath ${cpp} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      COMMAND ${LCM_GEN} --python --ppath ${python} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      COMMENT "lcm-gen ${source}"
      VERBATIM)
    list(APPEND outputs ${header})
  endforeach()
  set(layouts ${cpp}/levitas_msg/layouts.hpp)
  set(generator ${PROJECT_SOURCE_DIR}/cmake/lcm_layouts.py)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  add_custom_command(OUTPUT ${layouts} COMMAND ${PYTHON3} -B ${generator} ${layouts} ${sources}
                     DEPENDS ${generator} ${sources} ${outputs} COMMENT "layouts of the messages" VERBATIM)
  list(APPEND outputs ${layouts})
  add_custom_target(${target}_generate DEPENDS ${outputs})
  levitas_library(${target} LAYER 0)
  add_dependencies(${target} ${target}_generate)
  target_include_directories(${target} SYSTEM INTERFACE ${cpp})
  target_link_libraries(${target} INTERFACE lcm)
  # liblcm's inline coder reads and writes doubles through int64_t*, which the optimiser may take
  # for unrelated memory: at -O3 a decoded double was seen to stay 0.
  target_compile_options(${target} INTERFACE -fno-strict-aliasing)
endfunction()
