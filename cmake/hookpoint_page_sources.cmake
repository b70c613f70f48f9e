# hookpoint_page_sources(PAGE FOLDER FILES): the programs in a page of the manual, as sources to compile, so that what the page shows
# is what a test runs. A fenced block that opens with ```cpp file=PATH at the start of a line is written to FOLDER/PATH when the build
# finds the page newer; blocks with the same PATH follow one another in the page's order. FILES names the variable that receives the
# written paths, headers too: a target that lists them as its sources is built again when the page changes.
#
#   hookpoint_page_sources(${PROJECT_SOURCE_DIR}/docs/adding_a_law.md ${CMAKE_CURRENT_BINARY_DIR}/page page_files)
#   add_executable(name_test name_test.cpp ${page_files})
#   target_include_directories(name_test PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/page)

# Calls hookpoint_take_page_block, which the caller defines, with PATH and TEXT of every such block of `page`.
function(hookpoint_each_page_block page)
  file(READ ${page} rest)
  string(PREPEND rest "\n")
  set(fence "\n```cpp file=")
  string(LENGTH "${fence}" fence_length)
  string(FIND "${rest}" "${fence}" start)
  while(NOT start EQUAL -1)
    math(EXPR start "${start} + ${fence_length}")
    string(SUBSTRING "${rest}" ${start} -1 rest)
    string(FIND "${rest}" "\n" line_end)
    string(SUBSTRING "${rest}" 0 ${line_end} path)
    string(SUBSTRING "${rest}" ${line_end} -1 rest)
    string(FIND "${rest}" "\n```" block_end)
    if(block_end EQUAL -1)
      message(FATAL_ERROR "${page}: the block of ${path} does not end")
    endif()
    string(SUBSTRING "${rest}" 1 ${block_end} text)
    hookpoint_take_page_block("${path}" "${text}")
    string(SUBSTRING "${rest}" ${block_end} -1 rest)
    string(FIND "${rest}" "${fence}" start)
  endwhile()
endfunction()

# As a script, cmake -D PAGE=... -D FOLDER=... -P hookpoint_page_sources.cmake: writes the files.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  file(REMOVE_RECURSE ${FOLDER})
  function(hookpoint_take_page_block path text)
    file(APPEND ${FOLDER}/${path} "${text}")
  endfunction()
  hookpoint_each_page_block(${PAGE})
  return()
endif()

set(HOOKPOINT_PAGE_SOURCES_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(hookpoint_page_sources page folder files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})  # its paths are read now
  set_property(GLOBAL PROPERTY HOOKPOINT_PAGE_PATHS "")
  function(hookpoint_take_page_block path text)
    set_property(GLOBAL APPEND PROPERTY HOOKPOINT_PAGE_PATHS ${path})
  endfunction()
  hookpoint_each_page_block(${page})
  get_property(written GLOBAL PROPERTY HOOKPOINT_PAGE_PATHS)
  if(NOT written)
    message(FATAL_ERROR "${page} has no block that opens with ```cpp file=PATH")
  endif()
  list(REMOVE_DUPLICATES written)
  list(TRANSFORM written PREPEND ${folder}/)
  add_custom_command(
    OUTPUT ${written}
    COMMAND ${CMAKE_COMMAND} -D PAGE=${page} -D FOLDER=${folder} -P ${HOOKPOINT_PAGE_SOURCES_SCRIPT}
    DEPENDS ${page} ${HOOKPOINT_PAGE_SOURCES_SCRIPT}
    COMMENT "Sources of ${page}"
    VERBATIM)
  set(${files} ${written} PARENT_SCOPE)
endfunction()
