# hookpoint_add_controller(NAME SOURCE...): builds libNAME.so, a plugin that a .hook file names as `Plugin "libNAME.so";`. Further libraries
# go to it by target_link_libraries(NAME PRIVATE ...). What it needs of hookpoint it finds in the program that loads it.
function(hookpoint_add_controller name)
  if(NOT ARGN)
    message(FATAL_ERROR "hookpoint_add_controller(${name} ...) needs at least one source file")
  endif()
  add_library(${name} MODULE ${ARGN} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/hookpoint_plugin_abi.cpp)
  target_link_libraries(${name} PRIVATE hookpoint::controller)
  # Hidden: two plugins may use the same names inside, and neither meets those of the program.
  set_target_properties(${name} PROPERTIES PREFIX lib SUFFIX .so CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()
