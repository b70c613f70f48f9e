# hookpoint_embed(TARGET NAME FILE...): makes the bytes of files a part of TARGET, so that the installed program needs none of them. NAME is
# a path such as studies/report/page_files: the sources of TARGET, and those that link it, may then
#   #include "studies/report/page_files.h"
# which says of each FILE (report/page/report.css, from the folder of the CMakeLists.txt) one constant, named for the file:
#   namespace hookpoint::page_files { extern const std::string_view report_css; }
# A file that changes is embedded anew by the next build. Needs CMake and the compiler, nothing else.
#
# As a script: cmake -D FILE=... -D NAME=... -D CONSTANT=... -D SOURCE=... -P hookpoint_embed.cmake writes SOURCE, which defines the constant.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${FILE} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  # 32 bytes a line.
  string(REPEAT "...." 32 line)
  string(REGEX REPLACE "(${line})" "\\1\"\n\"" bytes "${bytes}")
  get_filename_component(namespace ${NAME} NAME)
  # A text, which compilers read far faster than a list of its bytes.
  file(WRITE ${SOURCE} "// The bytes of ${FILE}.
#include \"${NAME}.h\"

#pragma GCC diagnostic ignored \"-Woverlength-strings\"

namespace hookpoint::${namespace} {
namespace {
constexpr char bytes_of_${CONSTANT}[] =
\"${bytes}\";
}  // namespace

const std::string_view ${CONSTANT}{bytes_of_${CONSTANT}, sizeof bytes_of_${CONSTANT} - 1};

}  // namespace hookpoint::${namespace}
")
  return()
endif()

function(hookpoint_embed target name)
  set(folder ${PROJECT_BINARY_DIR}/embedded)
  set(constants "")
  foreach(file IN LISTS ARGN)
    get_filename_component(constant ${file} NAME)
    string(MAKE_C_IDENTIFIER ${constant} constant)
    string(APPEND constants "extern const std::string_view ${constant};  ///< ${file}\n")
    set(source ${folder}/${name}_${constant}.cpp)
    set(embed ${CMAKE_COMMAND} -D FILE=${CMAKE_CURRENT_SOURCE_DIR}/${file} -D NAME=${name} -D CONSTANT=${constant} -D SOURCE=${source}
      -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
    # Once now, for who reads the sources without a build (scripts/tidy).
    if(NOT EXISTS ${source})
      execute_process(COMMAND ${embed} COMMAND_ERROR_IS_FATAL ANY)
    endif()
    add_custom_command(OUTPUT ${source}
      COMMAND ${embed}
      DEPENDS ${file} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
      COMMENT "Embedding ${file}" VERBATIM)
    target_sources(${target} PRIVATE ${source})
  endforeach()
  get_filename_component(namespace ${name} NAME)
  # Written only where it says something else than before.
  file(CONFIGURE OUTPUT ${folder}/${name}.h @ONLY CONTENT "// Files that the program brings along (cmake/hookpoint_embed.cmake).
#pragma once

#include <string_view>

namespace hookpoint::@namespace@ {

@constants@
}  // namespace hookpoint::@namespace@
")
  target_include_directories(${target} PUBLIC ${folder})
endfunction()
