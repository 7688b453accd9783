# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Installs the build to an empty prefix, then configures, builds and runs the project beside this file against it.
# Every public header is compiled from there.
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/TreadmarkPublicHeaders.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/../../cmake/TreadmarkMovedHeaders.cmake")
treadmark_public_headers(public_headers "${CMAKE_CURRENT_LIST_DIR}/../../docs/public-headers.md")
list(APPEND public_headers ${TREADMARK_OLD_HEADERS})
list(JOIN public_headers "," public_headers)
file(REMOVE_RECURSE "${WORK}")
set(sanitize_c "")
if(SANITIZE)
  string(APPEND FLAGS " -fsanitize=${SANITIZE}")
  set(sanitize_c "-DCMAKE_C_FLAGS=-fsanitize=${SANITIZE}")
endif()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}/build" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
  "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DPUBLIC_HEADERS=${public_headers}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/consumer")
# The same as a plug-in of the installed program.
if(NOT SANITIZE)
  file(GLOB_RECURSE program "${WORK}/prefix/bin/treadmark")
  file(WRITE "${WORK}/case.toml" "rail.shape.standard = '60E1'\nrail.backend = 'chebyshev'\nwheel.shape.standard = 'S1002'\ntrack.cant = '1:40'\n\
wheelset.vertical_force_N = 8e4\ndiscretisation = { dx_mm = 1, ds_mm = 1, detector = 'fine-grid' }\n")
  run("${program}" --plugin "${WORK}/build/chebyshev.so" run "${WORK}/case.toml")
endif()

# In C: with CMake, and with pkg-config where that is.
run("${CMAKE_COMMAND}" -S "${SOURCE}/../c_project" -B "${WORK}/build_c" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
  "-DPROGRAM=${PROGRAM_IN_C}" ${sanitize_c})
run("${CMAKE_COMMAND}" --build "${WORK}/build_c")
run("${WORK}/build_c/consumer_in_c")
file(GLOB_RECURSE pc "${WORK}/prefix/treadmark.pc")
get_filename_component(pc_folder "${pc}" DIRECTORY)
find_program(pkg_config pkg-config)
if(pkg_config AND NOT SANITIZE)
  set(ENV{PKG_CONFIG_PATH} "${pc_folder}")
  execute_process(COMMAND "${pkg_config}" --cflags --libs treadmark OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(cc "${PROGRAM_IN_C}" -o "${WORK}/by_pkg_config" ${flags})
  set(ENV{LD_LIBRARY_PATH} "${pc_folder}/..")
  run("${WORK}/by_pkg_config")
endif()

# No installed header may refer to one that is not installed.
file(GLOB_RECURSE headers "${WORK}/prefix/include/*.hpp")
if(NOT headers)
  message(FATAL_ERROR "no headers were installed")
endif()
foreach(header IN LISTS headers)
  file(STRINGS "${header}" includes REGEX "^#include \"treadmark/")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" name "${line}")
    if(NOT EXISTS "${WORK}/prefix/include/${name}")
      message(FATAL_ERROR "${header} includes ${name}, which is not installed")
    endif()
  endforeach()
endforeach()
