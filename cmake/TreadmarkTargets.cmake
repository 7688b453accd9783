# SPDX-License-Identifier: Apache-2.0
include(GNUInstallDirs)
# What is installed without a word about it; see TreadmarkPackages.cmake.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
# One spelling of includes everywhere: "treadmark/<folder>/<file>.hpp", in the build tree through a link to the sources.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/include")
if(NOT EXISTS "${PROJECT_BINARY_DIR}/include/treadmark")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}/include/treadmark" SYMBOLIC)
endif()

# GCC clears its memory each time that its heap has grown by what a small machine has: with the headers below that takes a tenth of its time.
add_compile_options("$<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-expand=400;--param=ggc-min-heapsize=1000000>")

# So that a linker can leave out single functions where it is told to (interfaces/fmi); what is made of them is the same.
if(TREADMARK_HAVE_FMU)
  add_compile_options(-ffunction-sections -fdata-sections)
endif()

add_library(treadmark_warnings INTERFACE)
# Sources that are compiled together see each other's names: only alone can those of a whole file be told to be hidden.
target_compile_options(treadmark_warnings INTERFACE -Wall -Wextra -Wpedantic
  $<IF:$<BOOL:${TREADMARK_SHARED_PARSING}>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow> -Wnon-virtual-dtor
  $<$<BOOL:${TREADMARK_WARNINGS_AS_ERRORS}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees bounds in std::string that are not there (its bug 105329), here or there as sources are put together.
  target_compile_options(treadmark_warnings INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict)
endif()

set_property(GLOBAL PROPERTY TREADMARK_LIBRARIES "")
set(TREADMARK_MODULES "${PROJECT_BINARY_DIR}/lib/treadmark")  # core/modules.hpp

# What parsing costs is shared: sources are compiled several at a time, after headers that are parsed once. So names of a folder's
# anonymous namespaces must differ. -DTREADMARK_SHARED_PARSING=OFF compiles every file by itself.
# treadmark_share_parsing(<target> <sources at a time> <how>): how is one of
#   full   optimised as the build type says
#   light  no loop over points or elements is worth the compiler's time
#   tests  as light, and knows GoogleTest
set(TREADMARK_OPTIMISATION_full "")
set(TREADMARK_OPTIMISATION_light $<$<CONFIG:Release>:-O1>)
if(TREADMARK_WEB)  # Clang inlines at -O1, too, which takes a third of its time for keys
  set(TREADMARK_OPTIMISATION_light $<$<CONFIG:Release>:-Oz>)
endif()
set(TREADMARK_OPTIMISATION_tests $<$<CONFIG:Release>:-O1>)
if(TREADMARK_SANITIZE)
  list(APPEND TREADMARK_OPTIMISATION_tests -O0)  # there, optimising takes most of the compiler's time
endif()
function(treadmark_share_parsing target sources how)
  target_compile_options(${target} PRIVATE ${TREADMARK_OPTIMISATION_${how}})
  if(NOT TREADMARK_SHARED_PARSING)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${sources})
  target_precompile_headers(${target} REUSE_FROM treadmark_precompiled_${how})
  # The macros and options with which the headers were parsed: a compiler takes them for no other.
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
  target_include_directories(${target} SYSTEM PRIVATE $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
endfunction()

# Parsed once: what nearly every source includes, nothing of Treadmark's own. The level of optimisation is part of what is kept.
if(TREADMARK_SHARED_PARSING)
  set(common_headers <algorithm> <array> <cmath> <cstddef> <cstdint> <cstring> <filesystem> <functional> <limits> <map> <memory> <numbers>
    <numeric> <optional> <set> <span> <string> <string_view> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)
  set(kinds full light)
  if(TREADMARK_BUILD_TESTS)
    list(APPEND kinds tests)
  endif()
  file(WRITE "${PROJECT_BINARY_DIR}/precompiled.cpp" "// holds the precompiled headers\n")
  foreach(how IN LISTS kinds)
    add_library(treadmark_precompiled_${how} OBJECT "${PROJECT_BINARY_DIR}/precompiled.cpp")
    target_compile_features(treadmark_precompiled_${how} PUBLIC cxx_std_20)
    target_link_libraries(treadmark_precompiled_${how} PRIVATE Eigen3::Eigen fmt::fmt treadmark_warnings)
    target_precompile_headers(treadmark_precompiled_${how} PRIVATE ${common_headers})
    target_compile_options(treadmark_precompiled_${how} PRIVATE ${TREADMARK_OPTIMISATION_${how}})
  endforeach()
  if(TREADMARK_BUILD_TESTS)
    target_link_libraries(treadmark_precompiled_tests PRIVATE GTest::gtest GTest::gmock)
    target_precompile_headers(treadmark_precompiled_tests PRIVATE <gtest/gtest.h> <gmock/gmock.h>)
  endif()
endif()

# treadmark_kernels(<target> <headers...> [AVX2 options...]): compiles each header into the target twice, for every machine and
# with AVX2 and FMA. See core/kernel.hpp.
function(treadmark_kernels target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "AVX2")
  set(kinds AVX2 GENERIC)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    set(kinds NO_AVX2)
  endif()
  set(AVX2_FLAGS -mavx2 -mfma ${ARG_AVX2})
  foreach(header IN LISTS ARG_UNPARSED_ARGUMENTS)
    cmake_path(GET header STEM name)
    file(RELATIVE_PATH header "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}/${header}")
    foreach(kind IN LISTS kinds)
      set(source "${CMAKE_CURRENT_BINARY_DIR}/${name}_${kind}.cpp")
      file(CONFIGURE OUTPUT "${source}" CONTENT "#define TREADMARK_${kind}_KERNELS\n#include \"treadmark/${header}\"\n")
      set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS "${${kind}_FLAGS};-Wno-psabi"
        SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
      target_sources(${target} PRIVATE "${source}")
    endforeach()
  endforeach()
endfunction()

# treadmark_library(<folder> [LIGHT] [ROOMS folders...] [PUBLIC targets...] [PRIVATE targets...])
# A static library treadmark::<folder with _> from the .cpp files in the current folder itself and in those of its folders that
# ROOMS names. LIGHT: see above.
function(treadmark_library folder)
  cmake_parse_arguments(ARG "LIGHT" "" "ROOMS;PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" name "${folder}")
  set(sources "")
  foreach(room IN ITEMS "" LISTS ARG_ROOMS)
    file(GLOB room_sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.cpp")
    file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${room}/*.hpp")
    list(APPEND sources ${room_sources})
    cmake_path(SET place NORMALIZE include/treadmark/${folder}/${room})
    install(FILES ${headers} DESTINATION "${place}")
  endforeach()
  add_library(treadmark_${name} STATIC ${sources})
  add_library(treadmark::${name} ALIAS treadmark_${name})
  set_target_properties(treadmark_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(treadmark_${name} PUBLIC cxx_std_20)
  target_include_directories(treadmark_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(treadmark_${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:treadmark_warnings>)
  set(how full)
  if(ARG_LIGHT)
    set(how light)
  endif()
  set(at_once 8)
  if(TREADMARK_WEB)  # nobody edits there: what takes least
    set(at_once 32)
  endif()
  treadmark_share_parsing(treadmark_${name} ${at_once} ${how})
  set_property(GLOBAL APPEND PROPERTY TREADMARK_LIBRARIES treadmark_${name})
endfunction()

# treadmark_not_in_web(<target> <regular expression>): sources that nothing calls there, as they draw, write files or are about vehicles.
function(treadmark_not_in_web target pattern)
  if(TREADMARK_WEB)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources EXCLUDE REGEX "/${pattern}[^/]*$")
    set_target_properties(${target} PROPERTIES SOURCES "${sources}")
  endif()
endfunction()

# Programs under test share tables of contacts and creep forces, which depend on what is asked and on the program's own code alone.
set(TREADMARK_TEST_ENVIRONMENT "TREADMARK_CACHE=${PROJECT_BINARY_DIR}/tests/tables")

# treadmark_test(<name> LIBS targets...): a GoogleTest program from the .cpp files of the current folder, one ctest entry a test.
function(treadmark_test name)
  cmake_parse_arguments(ARG "" "" "LIBS;SOURCES" ${ARGN})
  if(NOT ARG_SOURCES)
    file(GLOB ARG_SOURCES CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  endif()
  if(NOT ARG_SOURCES)
    return()
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} treadmark_test_support GTest::gtest GTest::gmock GTest::gtest_main
    treadmark_warnings)
  if(TREADMARK_TRAPS)
    target_sources(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests/support/floating_traps.cpp")
  endif()
  treadmark_share_parsing(${name} ${TREADMARK_TESTS_AT_ONCE} tests)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS ${name}
    ENVIRONMENT "${TREADMARK_TEST_ENVIRONMENT}")
endfunction()
