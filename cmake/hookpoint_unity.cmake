# The presets release, ci and tidy read many files as one. These have names in their unnamed namespaces that others of their folder have too.
if(CMAKE_UNITY_BUILD)
  function(hookpoint_read_apart folder)
    list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/${folder}/)
    set_source_files_properties(${ARGN} TARGET_DIRECTORY hookpoint_${folder} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endfunction()
  # A library of macros.
  hookpoint_read_apart(simulation scene/urdf/hull.cpp)
  hookpoint_read_apart(reference ground.cpp bullet/engine.cpp dart/engine.cpp mujoco/engine.cpp mujoco/model.cpp ode/engine.cpp ode/shapes.cpp ode/world.cpp robot_tree.cpp simbody/engine.cpp)
  # One engine or format each, alike in their functions' names.
  file(GLOB targets RELATIVE ${PROJECT_SOURCE_DIR}/translation CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/translation/targets/*.cpp ${PROJECT_SOURCE_DIR}/translation/models/*.cpp)
  hookpoint_read_apart(translation ${targets})
endif()
