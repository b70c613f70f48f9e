# cmake -DINTO=FILE -DROOT=FOLDER -P read_together.cmake TEST.cpp...: one source of several tests, whose headers are then read once. What a test
# keeps in its unnamed namespace gets the name of the file, so that two may call things alike. Messages give the tests' own lines, and paths
# from the project's root, so that the text is the same in every clone.
set(text "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(number RANGE ${last})
  set(source "${CMAKE_ARGV${number}}")
  if(source MATCHES "_test\\.cpp$")
    file(READ "${source}" one)
    string(REGEX REPLACE "^.*/([^/]+)/([^/]+)\\.cpp$" "\\1_\\2" name "${source}")
    string(REGEX REPLACE "(^|\n)namespace {" "\\1namespace ${name}_names {" one "${one}")
    file(RELATIVE_PATH path "${ROOT}" "${source}")
    string(APPEND text "#line 1 \"${path}\"\n${one}\n")
  endif()
endforeach()
file(WRITE "${INTO}" "${text}")
