# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Installs the libraries as a CMake package: find_package(Treadmark CONFIG) gives treadmark::treadmark, which is all of
# them, one target a folder (treadmark::core, treadmark::io_cases, ...), and treadmark::c, the shared library for C.
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY TREADMARK_LIBRARIES)
add_library(treadmark_umbrella INTERFACE)
add_library(treadmark::treadmark ALIAS treadmark_umbrella)
set_target_properties(treadmark_umbrella PROPERTIES EXPORT_NAME treadmark)
target_link_libraries(treadmark_umbrella INTERFACE ${libraries})

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Treadmark")
install(TARGETS ${libraries} treadmark_umbrella EXPORT TreadmarkTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT TreadmarkTargets NAMESPACE treadmark:: DESTINATION ${package_folder})

set(TREADMARK_PARTS_IN_CONFIG "")
foreach(part IN LISTS TREADMARK_PARTS)
  string(TOUPPER "${part}" part)
  string(APPEND TREADMARK_PARTS_IN_CONFIG "set(Treadmark_HAVE_${part} ${TREADMARK_HAVE_${part}})\n")
endforeach()
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/TreadmarkConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/TreadmarkConfig.cmake" INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/TreadmarkConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/TreadmarkConfig.cmake" "${PROJECT_BINARY_DIR}/TreadmarkConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/TreadmarkPlugin.cmake" "${CMAKE_CURRENT_LIST_DIR}/treadmark_plugin.map"
  DESTINATION ${package_folder})
if(TREADMARK_LIBCXX)
  install(FILES "${CMAKE_CURRENT_LIST_DIR}/libcxx/Findfmt.cmake" "${CMAKE_CURRENT_LIST_DIR}/libcxx/Findtomlplusplus.cmake"
    DESTINATION ${package_folder}/libcxx)
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/NOTICE" DESTINATION ${CMAKE_INSTALL_DOCDIR})
include(TreadmarkPackages)
