# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# The parts that a build may leave out, each said once: options, messages about missing packages, what the program says of itself
# and the package that is installed are made from this table. TREADMARK_HAVE_<PART> says whether a build has it.
set(TREADMARK_PARTS "")
set(TREADMARK_GPL OFF)  # whether this build is

# treadmark_part(<part> <option> <name> <its Debian packages, or ""> <what the option does> [NEEDS <other part>] [GPL])
# GPL: puts what is built with it under the GPL, so that only who asks for it gets it.
macro(treadmark_part part option name packages meaning)
  cmake_parse_arguments(PART "GPL" "NEEDS" "" ${ARGN})
  set(PART_DEFAULT ON)
  if(PART_GPL)
    set(PART_DEFAULT OFF)
  endif()
  option(${option} "${meaning}" ${PART_DEFAULT})
  string(TOUPPER "${part}" upper)
  list(APPEND TREADMARK_PARTS ${part})
  set(TREADMARK_${upper}_OPTION ${option})
  set(TREADMARK_${upper}_NAME "${name}")
  set(TREADMARK_${upper}_PACKAGES "${packages}")
  set(TREADMARK_HAVE_${upper} OFF)
  if(${option})
    set(TREADMARK_HAVE_${upper} ON)
  endif()
  if(PART_NEEDS)
    string(TOUPPER "${PART_NEEDS}" other)
    if(NOT TREADMARK_HAVE_${other})
      set(TREADMARK_HAVE_${upper} OFF)
    endif()
  endif()
  if(PART_GPL AND TREADMARK_HAVE_${upper})
    set(TREADMARK_GPL ON)
  endif()
endmacro()

treadmark_part(embree TREADMARK_WITH_EMBREE "Embree" "libembree-dev"
  "Lists of lines through triangles (backends mesh and mesh-flat) by Embree 3 or 4 instead of our own tree")
treadmark_part(openvdb TREADMARK_WITH_OPENVDB "OpenVDB" "libopenvdb-dev and libboost-iostreams-dev"
  "Level sets (backend level-set) and .vdb files, also of offsets over a base, with OpenVDB")
treadmark_part(nanovdb TREADMARK_WITH_NANOVDB "NanoVDB" "libnanovdb-dev"
  "Offsets over a base that are evaluated where they lie in a file (.nvdb), without OpenVDB, with NanoVDB")
treadmark_part(cad TREADMARK_WITH_OPENCASCADE "OpenCASCADE" "libocct-data-exchange-dev"
  "Surfaces of CAD (.step and .iges files), with OpenCASCADE")
treadmark_part(hdf5 TREADMARK_WITH_HDF5 "HDF5" "libhdf5-dev" "Files of fields and histories (.h5), with HDF5")
treadmark_part(tbb TREADMARK_WITH_TBB "oneTBB" "libtbb-dev" "Threads for loops within loops too, with oneTBB")
treadmark_part(fftw TREADMARK_WITH_FFTW "FFTW 3" "libfftw3-dev" "Fourier transforms by FFTW 3 (GPL) instead of our own" GPL)
treadmark_part(vehicle TREADMARK_VEHICLE "vehicles" "" "Vehicles on their track in time (simulate, assess, sweep, evolve, stability, response, track, table)")
treadmark_part(scans TREADMARK_SCANS "scans" "libnanoflann-dev" "Import of raw scans, virtual scans (import, scan), with nanoflann")
treadmark_part(cgal TREADMARK_WITH_CGAL "CGAL" "libcgal-dev" "Triangles of scans with holes or fewer nodes, and free meshes, with CGAL (GPL)"
  NEEDS scans GPL)
treadmark_part(expat TREADMARK_WITH_EXPAT "Expat" "libexpat1-dev" "Read scans in E57 files and spline surfaces in XML files, with Expat")
treadmark_part(report TREADMARK_REPORT "reports" "" "HTML reports, pictures of result folders, pages that solve (report, plot, live, --report)")
treadmark_part(report_scripts TREADMARK_REPORT_SCRIPTS "report scripts" "nodejs and npm"
  "Bundle the scripts that make HTML reports live (needs Node.js, npm and a network once)" NEEDS report)
treadmark_part(python TREADMARK_PYTHON "Python" "pybind11-dev, python3-dev and python3-numpy"
  "The package treadmark for Python, with pybind11 and NumPy")
treadmark_part(fmu TREADMARK_FMU "FMUs" "libzip-dev" "Export as functional mock-up units (fmu), with libzip")
treadmark_part(nlopt TREADMARK_WITH_NLOPT "NLopt" "libnlopt-dev" "Profiles, grinding and repairs by gradients (design), with NLopt (LGPL)"
  NEEDS vehicle)

# treadmark_missing(<part>): the error of a package that was not found.
function(treadmark_missing part)
  string(TOUPPER "${part}" upper)
  set(option "${TREADMARK_${upper}_OPTION}")
  message(FATAL_ERROR "${option} is on but ${TREADMARK_${upper}_NAME} was not found: install the Debian package "
                      "${TREADMARK_${upper}_PACKAGES} or configure with -D${option}=OFF")
endfunction()

# treadmark_part_sources(<target> <part> <regular expression>): of the target's sources, those that match are the part;
# without_<part>.cpp takes their place in a build without it.
function(treadmark_part_sources target part pattern)
  string(TOUPPER "${part}" upper)
  get_target_property(sources ${target} SOURCES)
  set(kept "")
  foreach(source IN LISTS sources)
    get_filename_component(name "${source}" NAME)
    set(in_part ${TREADMARK_HAVE_${upper}})
    if(name STREQUAL "without_${part}.cpp")
      if(NOT in_part)
        list(APPEND kept "${source}")
      endif()
    elseif(in_part OR NOT name MATCHES "${pattern}")
      list(APPEND kept "${source}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${kept}")
endfunction()
