# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Public headers that moved with 0.2, installed by their old names, too, until 0.3: lines "old new".
set(TREADMARK_MOVED_HEADERS
  "pictures/pressure_svg.hpp report/pictures/pressure_svg.hpp")
foreach(name surface_spec profile length_unit slices spline_surface triangle_mesh defects moving_section surface_difference)
  list(APPEND TREADMARK_MOVED_HEADERS "model/${name}.hpp model/shape/${name}.hpp")
endforeach()
foreach(name material friction contact_settings wheel_on_rail)
  list(APPEND TREADMARK_MOVED_HEADERS "model/${name}.hpp model/contact/${name}.hpp")
endforeach()
foreach(name vehicle_model flexible_axle track_layout assessment driving irregularities)
  list(APPEND TREADMARK_MOVED_HEADERS "model/${name}.hpp model/vehicle/${name}.hpp")
endforeach()
set(TREADMARK_OLD_HEADERS ${TREADMARK_MOVED_HEADERS})
list(TRANSFORM TREADMARK_OLD_HEADERS REPLACE " .*" "")

if(NOT CMAKE_SCRIPT_MODE_FILE)
  foreach(row IN LISTS TREADMARK_MOVED_HEADERS)
    string(REGEX MATCH "^(.*)/([^/ ]+) (.*)$" row "${row}")
    set(header "${PROJECT_BINARY_DIR}/moved/${CMAKE_MATCH_1}/${CMAKE_MATCH_2}")
    file(CONFIGURE OUTPUT "${header}" CONTENT "#pragma once\n#include \"treadmark/${CMAKE_MATCH_3}\"  // this name goes with 0.3\n")
    install(FILES "${header}" DESTINATION "include/treadmark/${CMAKE_MATCH_1}")
  endforeach()
endif()
