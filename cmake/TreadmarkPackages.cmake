# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Packages for Debian: scripts/packages.sh. What is installed belongs to one of the components below. Those of a build under the GPL
# have names of their own and stand in for the others.
set(CPACK_COMPONENTS_ALL "")

# treadmark_package(<component> <name> <section> <summary> [APART]): one package; more of it in variables CPACK_DEBIAN_<COMPONENT>_...
# APART: nothing under the GPL is in it, whatever the build.
macro(treadmark_package component name section summary)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(package ${name})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "Wheel-rail contact on any 3D surface: ${summary}")
  if(TREADMARK_GPL AND NOT "${ARGN}" STREQUAL "APART")
    set(package ${name}-gpl)
    string(APPEND CPACK_COMPONENT_${upper}_DESCRIPTION " (GPL-3.0-or-later, with FFTW or CGAL)")
    set(CPACK_DEBIAN_${upper}_PACKAGE_PROVIDES "${name} (= ${PROJECT_VERSION})")
    set(CPACK_DEBIAN_${upper}_PACKAGE_CONFLICTS ${name})
    set(CPACK_DEBIAN_${upper}_PACKAGE_REPLACES ${name})
  endif()
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  install(FILES "${PROJECT_SOURCE_DIR}/NOTICE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
endmacro()

treadmark_package(program treadmark science "the program")
treadmark_package(library libtreadmark${TREADMARK_ABI} libs "shared library")
treadmark_package(development libtreadmark-dev libdevel "headers for C and C++")
if(TREADMARK_HAVE_PYTHON)
  treadmark_package(python python3-treadmark python "package for Python")
  string(REGEX REPLACE ".*cpython-3([0-9]+).*" "\\1" minor "${TREADMARK_PYTHON_SUFFIX}")
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
endif()
# Modules (core/modules.hpp), with libraries that the first report does not need.
set(extras "")
foreach(part IN ITEMS cad openvdb)
  string(TOUPPER ${part} upper)
  if(TREADMARK_HAVE_${upper})
    treadmark_package(${part} treadmark-${part} science "what needs ${TREADMARK_${upper}_NAME}" APART)
    list(APPEND extras treadmark-${part})
    set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS
      "treadmark (= ${PROJECT_VERSION}) | libtreadmark${TREADMARK_ABI} (= ${PROJECT_VERSION}) | python3-treadmark (= ${PROJECT_VERSION})")
  endif()
endforeach()
treadmark_package(documents treadmark-doc doc "documents" APART)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_ARCHITECTURE all)
list(JOIN extras ", " extras)
foreach(package IN ITEMS PROGRAM LIBRARY PYTHON)
  set(CPACK_DEBIAN_${package}_PACKAGE_SUGGESTS "${extras}")
endforeach()

set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
# For programs in C++, which link static libraries.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libtomlplusplus-dev, zlib1g-dev")
foreach(part IN ITEMS embree hdf5 tbb fftw cgal expat nlopt)
  string(TOUPPER "${part}" upper)
  if(TREADMARK_HAVE_${upper})
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", ${TREADMARK_${upper}_PACKAGES}")
  endif()
endforeach()

install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/treadmark/examples" COMPONENT program
  PATTERN CMakeLists.txt EXCLUDE)
# The documents as pages for browsers (Debian packages python3-sphinx, python3-myst-parser, furo), with the page that solves where scripts/web.sh
# has made it; installed where they were made.
add_custom_target(site COMMAND "${CMAKE_COMMAND}" -E env "TREADMARK_LIVE_PAGE=${TREADMARK_MODULES}/live.html" /usr/bin/python3 -m sphinx -q -W --keep-going -d "${PROJECT_BINARY_DIR}/site-cache" -c docs . "${PROJECT_BINARY_DIR}/site"
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}" VERBATIM)
install(DIRECTORY "${PROJECT_BINARY_DIR}/site/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/treadmark/html" COMPONENT documents OPTIONAL
  PATTERN .buildinfo EXCLUDE PATTERN objects.inv EXCLUDE)
install(DIRECTORY "${PROJECT_BINARY_DIR}/api/html/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/treadmark/html/api" COMPONENT documents OPTIONAL)

# Of what is loaded at first use no tool sees that it is needed.
if(TREADMARK_HAVE_HDF5)
  execute_process(COMMAND dpkg-query -S "${TREADMARK_HDF5_FILE}" OUTPUT_VARIABLE owner ERROR_QUIET)
  string(REGEX REPLACE "[:\n].*" "" owner "${owner}")
  foreach(package IN ITEMS PROGRAM LIBRARY PYTHON)
    string(JOIN ", " CPACK_DEBIAN_${package}_PACKAGE_DEPENDS ${CPACK_DEBIAN_${package}_PACKAGE_DEPENDS} ${owner})
  endforeach()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME treadmark)
set(CPACK_PACKAGE_VENDOR "Treadmark contributors")
set(CPACK_PACKAGE_CONTACT "Treadmark contributors <contributors@treadmark.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
if(TREADMARK_FOR_PACKAGES)
  set(CPACK_DEBIAN_DEBUGINFO_PACKAGE ON)
else()
  set(CPACK_STRIP_FILES ON)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
include(CPack)
