# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: cmake -DLIBRARY=... -DNAME=... -DSTRIP=... -DTO=... -DLICENCES=file;... -P gather_libraries.cmake
# What goes into every FMU: TO/binaries with the shared library and those that it needs beyond the C and C++ run time, the same compressed in
# TO/binaries.zip, TO/licenses.
file(REMOVE_RECURSE "${TO}")
file(MAKE_DIRECTORY "${TO}/binaries" "${TO}/licenses")
execute_process(COMMAND "${STRIP}" --strip-unneeded -o "${TO}/binaries/${NAME}.so" "${LIBRARY}" COMMAND_ERROR_IS_FATAL ANY)
file(GET_RUNTIME_DEPENDENCIES LIBRARIES "${LIBRARY}" RESOLVED_DEPENDENCIES_VAR needed UNRESOLVED_DEPENDENCIES_VAR missing
  PRE_EXCLUDE_REGEXES "^lib(c|m|dl|rt|pthread|stdc\\+\\+|gcc_s|asan|ubsan|tsan)\\.so" "^ld-linux")
if(missing)
  message(FATAL_ERROR "${LIBRARY} needs what is not there: ${missing}")
endif()
foreach(licence IN LISTS LICENCES)
  file(COPY "${licence}" DESTINATION "${TO}/licenses")
endforeach()
find_program(dpkg_query dpkg-query)
foreach(file IN LISTS needed)
  get_filename_component(name "${file}" NAME)
  file(REAL_PATH "${file}" real)
  file(COPY_FILE "${real}" "${TO}/binaries/${name}")
  # Debian keeps the licence of every package.
  set(package "")
  if(dpkg_query)
    execute_process(COMMAND "${dpkg_query}" -S "*/${name}" OUTPUT_VARIABLE owner ERROR_QUIET)
    string(REGEX MATCH "^[^:,]+" package "${owner}")
  endif()
  if(package AND EXISTS "/usr/share/doc/${package}/copyright")
    file(COPY_FILE "/usr/share/doc/${package}/copyright" "${TO}/licenses/${package}.txt")
  endif()
endforeach()
file(GLOB libraries RELATIVE "${TO}/binaries" "${TO}/binaries/*")
execute_process(COMMAND "${CMAKE_COMMAND}" -E tar cf "${TO}/binaries.zip" --format=zip --mtime=1980-01-01 -- ${libraries}
  WORKING_DIRECTORY "${TO}/binaries" COMMAND_ERROR_IS_FATAL ANY)
