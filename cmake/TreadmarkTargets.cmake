# SPDX-License-Identifier: Apache-2.0
# One spelling of includes everywhere: "treadmark/<folder>/<file>.hpp", in the build tree through a link to the sources.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/include")
if(NOT EXISTS "${PROJECT_BINARY_DIR}/include/treadmark")
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}/include/treadmark" SYMBOLIC)
endif()

add_library(treadmark_warnings INTERFACE)
target_compile_options(treadmark_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  $<$<BOOL:${TREADMARK_WARNINGS_AS_ERRORS}>:-Werror>)

set_property(GLOBAL PROPERTY TREADMARK_LIBRARIES "")

# Kernels named *_avx2.cpp: see core/cpu.hpp.
function(treadmark_avx2_flags)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    return()
  endif()
  foreach(source IN LISTS ARGN)
    if(source MATCHES "_avx2\\.cpp$")
      set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
    endif()
  endforeach()
endfunction()

# treadmark_library(<folder> [PUBLIC targets...] [PRIVATE targets...])
# A static library treadmark::<folder with _> from the .cpp files directly in the current folder.
function(treadmark_library folder)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" name "${folder}")
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.hpp")
  treadmark_avx2_flags(${sources})
  add_library(treadmark_${name} STATIC ${sources})
  add_library(treadmark::${name} ALIAS treadmark_${name})
  set_target_properties(treadmark_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(treadmark_${name} PUBLIC cxx_std_20)
  target_include_directories(treadmark_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(treadmark_${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:treadmark_warnings>)
  set_property(GLOBAL APPEND PROPERTY TREADMARK_LIBRARIES treadmark_${name})
  install(FILES ${headers} DESTINATION include/treadmark/${folder})
endfunction()

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
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
