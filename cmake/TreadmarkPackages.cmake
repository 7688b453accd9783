# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Packages for Debian: `cpack -G DEB` in the folder of a build. What is installed belongs to one of the components below. Those of a
# build under the GPL have names of their own and stand in for the others.
set(TREADMARK_PACKAGE_SUFFIX "")
set(TREADMARK_PACKAGE_NOTE "")
if(TREADMARK_GPL)
  set(TREADMARK_PACKAGE_SUFFIX "-gpl")
  set(TREADMARK_PACKAGE_NOTE " (GPL-3.0-or-later, with FFTW or CGAL)")
endif()

# treadmark_package(<component> <name> <section> <summary>): one package; more of it in variables CPACK_DEBIAN_<COMPONENT>_...
set(CPACK_COMPONENTS_ALL "")
macro(treadmark_package component name section summary)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name}${TREADMARK_PACKAGE_SUFFIX})
  if(TREADMARK_GPL)
    foreach(relation IN ITEMS PROVIDES CONFLICTS REPLACES)
      set(CPACK_DEBIAN_${upper}_PACKAGE_${relation} ${name})
    endforeach()
  endif()
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}${TREADMARK_PACKAGE_NOTE}")
  set(documents "${CMAKE_INSTALL_DATADIR}/doc/${name}${TREADMARK_PACKAGE_SUFFIX}")
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${documents}" RENAME copyright COMPONENT ${component})
  install(FILES "${PROJECT_SOURCE_DIR}/NOTICE" DESTINATION "${documents}" COMPONENT ${component})
endmacro()

treadmark_package(program treadmark science "Wheel-rail contact on any 3D surface: the program")
treadmark_package(library libtreadmark${TREADMARK_ABI} libs "Wheel-rail contact on any 3D surface: shared library")
treadmark_package(development libtreadmark-dev libdevel "Wheel-rail contact on any 3D surface: headers for C and C++")
if(TREADMARK_HAVE_PYTHON)
  treadmark_package(python python3-treadmark python "Wheel-rail contact on any 3D surface: package for Python")
  string(REGEX REPLACE ".*cpython-3([0-9]+).*" "\\1" minor "${TREADMARK_PYTHON_SUFFIX}")
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_COMPONENT_PYTHON_DEPENDS library)
endif()

# The module for offsets lies beside the shared library.
set(CPACK_COMPONENT_PROGRAM_DEPENDS library)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
# Programs in C need the shared library alone, those in C++ link static ones.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libeigen3-dev, libfmt-dev, nlohmann-json3-dev, libtomlplusplus-dev, zlib1g-dev")
foreach(part IN LISTS TREADMARK_PARTS)
  string(TOUPPER "${part}" upper)
  # Headers of nanoflann are seen by ours alone.
  if(TREADMARK_HAVE_${upper} AND TREADMARK_${upper}_PACKAGES MATCHES "-dev" AND NOT part MATCHES "^(python|scans)$")
    string(REPLACE " and " ", " packages "${TREADMARK_${upper}_PACKAGES}")
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS ", ${packages}")
  endif()
endforeach()

install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/treadmark/examples" COMPONENT program
  PATTERN CMakeLists.txt EXCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/treadmark/docs" COMPONENT program
  PATTERN "*.in" EXCLUDE PATTERN "*.dox" EXCLUDE)

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
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
include(CPack)
