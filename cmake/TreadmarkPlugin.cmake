# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# treadmark_plugin(<name> <sources>...): NAME.so for `treadmark --plugin`, which shares no symbols with the program or with others.
function(treadmark_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE treadmark::treadmark)
  set(map "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/treadmark_plugin.map")
  target_link_options(${name} PRIVATE "LINKER:--version-script=${map}" "LINKER:-Bsymbolic" "LINKER:-z,nodelete")
  set_target_properties(${name} PROPERTIES PREFIX "" LINK_DEPENDS "${map}")
endfunction()
