# The Python module (folder python/) is built where pybind11, numpy and the headers of Debian's python3 are; elsewhere it is skipped by name.
# HOOKPOINT_PYTHON tells.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)  # another one on PATH has no headers and no packages of Debian's
endif()
set(HOOKPOINT_PYTHON OFF)
if("${CMAKE_CXX_FLAGS}" MATCHES "fsanitize")
  message(STATUS "python module: skipped, python3 does not load sanitized code")
else()
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  find_package(pybind11 QUIET)
  if(Python_FOUND AND pybind11_FOUND)
    set(HOOKPOINT_PYTHON ON)
  else()
    message(STATUS "python module: skipped, python3-dev, python3-numpy or pybind11-dev is missing")
  endif()
endif()
