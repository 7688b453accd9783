# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# The target api: the reference of the public headers in <build folder>/api/html, made by Doxygen; fails where comments lack something.
include(TreadmarkPublicHeaders)
treadmark_public_headers(public_headers "${PROJECT_SOURCE_DIR}/docs/public-headers.md")
set(TREADMARK_API_INPUT "\"${PROJECT_SOURCE_DIR}/docs/public-headers.md\" \"${PROJECT_SOURCE_DIR}/docs/namespaces.dox\"")
foreach(header IN LISTS public_headers)
  string(APPEND TREADMARK_API_INPUT " \"${PROJECT_BINARY_DIR}/include/treadmark/${header}\"")
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS docs/public-headers.md)

find_package(Python3 QUIET COMPONENTS Interpreter)
find_program(TREADMARK_DOXYGEN doxygen)
configure_file(docs/Doxyfile.in api/Doxyfile @ONLY)
set(TREADMARK_API_COMMAND "${Python3_EXECUTABLE}" -B "${PROJECT_SOURCE_DIR}/cmake/api_reference.py" "${TREADMARK_DOXYGEN}"
  "${PROJECT_BINARY_DIR}/api/Doxyfile")
if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(api COMMAND ${TREADMARK_API_COMMAND} VERBATIM)
endif()
