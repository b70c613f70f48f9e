# cmake --install BUILD --prefix PREFIX: the program, its configs, and what a controller is built with. Everything finds everything else
# relative to itself (apps/shared/installation.cpp), so PREFIX may be moved.
include(CMakePackageConfigHelpers)
include(hookpoint_add_controller)

# What a controller sees: these headers and what they include. tests/unit/control/plugin_abi_test.cpp watches them.
set(HOOKPOINT_CONTROLLER_HEADERS
  control/component.h control/linear_feedback.h control/registry.h control/plugin/plugin_abi.h control/random.h control/first_order.h control/leg_kinematics.h
  math/scalar.h math/vector3.h)

add_library(hookpoint_controller INTERFACE)
add_library(hookpoint::controller ALIAS hookpoint_controller)
set_target_properties(hookpoint_controller PROPERTIES EXPORT_NAME controller)
target_compile_features(hookpoint_controller INTERFACE cxx_std_20)
target_include_directories(hookpoint_controller INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/hookpoint>)

install(TARGETS hookpoint EXPORT hookpointTargets RUNTIME DESTINATION bin)
install(TARGETS hookpoint_controller EXPORT hookpointTargets)
foreach(header IN LISTS HOOKPOINT_CONTROLLER_HEADERS)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION include/hookpoint/${folder})
endforeach()
install(DIRECTORY configs DESTINATION share/hookpoint PATTERN node_modules EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/hookpoint.1 DESTINATION share/man/man1)
install(FILES ${PROJECT_BINARY_DIR}/hookpoint.bash DESTINATION share/bash-completion/completions RENAME hookpoint)
install(DIRECTORY docs DESTINATION share/doc/hookpoint)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION share/doc/hookpoint)
if(TARGET hookpoint_module)
  # PREFIX/lib/python goes on PYTHONPATH; without the module where only the program was built.
  install(TARGETS hookpoint_module LIBRARY DESTINATION lib/python OPTIONAL)
endif()
install(DIRECTORY DESTINATION lib/hookpoint/plugins)

set(HOOKPOINT_PACKAGE lib/cmake/hookpoint)
install(EXPORT hookpointTargets NAMESPACE hookpoint:: DESTINATION ${HOOKPOINT_PACKAGE})
configure_package_config_file(cmake/hookpointConfig.cmake.in ${PROJECT_BINARY_DIR}/hookpointConfig.cmake
  INSTALL_DESTINATION ${HOOKPOINT_PACKAGE} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hookpointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hookpointConfig.cmake ${PROJECT_BINARY_DIR}/hookpointConfigVersion.cmake
  cmake/hookpoint_add_controller.cmake cmake/hookpoint_plugin_abi.cpp DESTINATION ${HOOKPOINT_PACKAGE})
