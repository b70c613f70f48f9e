# The options of every target of ours: the warnings, and the instruction set, chosen once, here. Warnings are errors in the presets dev
# and ci, and wherever the compiler is the one that continuous integration compiles everything with: another's new warning stops nobody who
# wants to run the program.
if(NOT DEFINED CMAKE_COMPILE_WARNING_AS_ERROR AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
    AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
  set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
endif()

# HOOKPOINT_ISA: `x86-64-v3` compiles for x86-64-v3 (AVX2, FMA); `portable` for the compiler's baseline. The default looks at
# the building machine; a binary for other machines is built with -DHOOKPOINT_ISA=portable (docs/performance.md).
if(NOT DEFINED HOOKPOINT_ISA)
  set(HOOKPOINT_DETECTED_ISA portable)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND EXISTS /proc/cpuinfo)
    file(STRINGS /proc/cpuinfo HOOKPOINT_CPU_FLAGS REGEX "^flags" LIMIT_COUNT 1)
    if(HOOKPOINT_CPU_FLAGS MATCHES " avx2 " AND HOOKPOINT_CPU_FLAGS MATCHES " fma " AND HOOKPOINT_CPU_FLAGS MATCHES " bmi2 ")
      set(HOOKPOINT_DETECTED_ISA x86-64-v3)
    endif()
  endif()
  set(HOOKPOINT_ISA ${HOOKPOINT_DETECTED_ISA} CACHE STRING "instruction set: x86-64-v3 or portable")
endif()

add_library(hookpoint_options INTERFACE)
target_include_directories(hookpoint_options INTERFACE ${PROJECT_SOURCE_DIR})
# A parameter may have a member's name, another local variable's it may not.
target_compile_options(hookpoint_options INTERFACE
  -Wall -Wextra -Wpedantic $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local> -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  -Wcast-align -Wunused -Wdouble-promotion -Wformat=2)
# GCC 12 warns, falsely and only it, of std::string's own operator+ (GCC bugs 105651, 105562) and, at -O3, of Eigen's small vectors.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(hookpoint_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()
# GCC 12 to 14 take the value of an empty std::optional, which nobody reads, for one that is used (GCC bug 80635).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(hookpoint_options INTERFACE -Wno-maybe-uninitialized)
endif()
# clang 13 does not know yet that a macro's `...` may stand for nothing.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  target_compile_options(hookpoint_options INTERFACE -Wno-gnu-zero-variadic-macro-arguments)
endif()
# clang 17 sees std::stable_sort, within GCC 12's library, use what C++17 deprecates.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 17)
  target_compile_options(hookpoint_options INTERFACE -Wno-deprecated-declarations)
endif()
# Position-independent code keeps each function apart, for another library to take its place, and loses its inlining; ours are never replaced.
target_compile_options(hookpoint_options INTERFACE -fno-semantic-interposition)
if(HOOKPOINT_ISA STREQUAL "x86-64-v3")
  target_compile_options(hookpoint_options INTERFACE -march=x86-64-v3)
endif()

# The fastest linker that is there: each of the tests is a program, and half the time that one takes is its linking.
include(CheckLinkerFlag)
foreach(linker lld gold)
  check_linker_flag(CXX -fuse-ld=${linker} HOOKPOINT_HAS_${linker})
  if(HOOKPOINT_HAS_${linker})
    target_link_options(hookpoint_options INTERFACE -fuse-ld=${linker})
    break()
  endif()
endforeach()

# A structure of numbers or packs is larger than GCC keeps in registers or copies by whole registers unless told to; only speed depends on it.
include(CheckCXXCompilerFlag)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  foreach(option --param=sra-max-scalarization-size-Ospeed=4096 -mmove-max=256 -mstore-max=256)
    string(MAKE_C_IDENTIFIER "HOOKPOINT_HAS${option}" has_option)
    check_cxx_compiler_flag(${option} ${has_option})
    if(${has_option})
      list(APPEND HOOKPOINT_STRUCTURE_OPTIONS ${option})
    endif()
  endforeach()
endif()
