# Headers that most files include, read once. A file still includes all that it uses: the presets dev and asan build all
# but the tests without (CMAKE_DISABLE_PRECOMPILE_HEADERS).
set(HOOKPOINT_PRECOMPILED
  <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers>
  <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <unordered_map> <utility> <variant> <vector>)

# hookpoint_precompile(FOLDER...): for the libraries of these folders. They are compiled alike, so they share: one set of headers without fmt,
# one with it (its headers depend on a macro that only those who link it have).
function(hookpoint_precompile)
  foreach(kind std fmt)
    add_library(hookpoint_precompiled_${kind} OBJECT ${PROJECT_SOURCE_DIR}/cmake/hookpoint_precompiled.cpp)
    target_link_libraries(hookpoint_precompiled_${kind} PRIVATE hookpoint_math hookpoint_options)
    target_precompile_headers(hookpoint_precompiled_${kind} PRIVATE ${HOOKPOINT_PRECOMPILED})
  endforeach()
  target_link_libraries(hookpoint_precompiled_fmt PRIVATE fmt::fmt)
  target_precompile_headers(hookpoint_precompiled_fmt PRIVATE <fmt/format.h>)
  foreach(folder IN LISTS ARGN)
    foreach(target hookpoint_${folder} hookpoint_${folder}_classes)
      if(TARGET ${target})
        get_target_property(type ${target} TYPE)
        get_target_property(libraries ${target} LINK_LIBRARIES)
        if(type STREQUAL "STATIC_LIBRARY" AND "fmt::fmt" IN_LIST libraries)
          target_precompile_headers(${target} REUSE_FROM hookpoint_precompiled_fmt)
        elseif(type STREQUAL "STATIC_LIBRARY")
          target_precompile_headers(${target} REUSE_FROM hookpoint_precompiled_std)
        endif()
      endif()
    endforeach()
  endforeach()
endfunction()
