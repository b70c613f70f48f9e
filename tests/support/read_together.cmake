# cmake -DINTO=FILE -P read_together.cmake TEST.cpp...: one source of several tests, whose headers are then read once. What a test keeps in
# its unnamed namespace gets the name of the file, so that two may call things alike; lines are told by the tests' own numbers.
set(text "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(number RANGE ${last})
  set(source "${CMAKE_ARGV${number}}")
  if(source MATCHES "_test\\.cpp$")
    file(READ "${source}" one)
    string(REGEX REPLACE "^.*/([^/]+)/([^/]+)\\.cpp$" "\\1_\\2" name "${source}")
    string(REGEX REPLACE "(^|\n)namespace {" "\\1namespace ${name}_names {" one "${one}")
    string(APPEND text "#line 1 \"${source}\"\n${one}\n")
  endif()
endforeach()
file(WRITE "${INTO}" "${text}")
