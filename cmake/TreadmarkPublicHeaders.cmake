# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors

# treadmark_public_headers(<variable> <docs/public-headers.md>): the headers that the document lists, in its order.
function(treadmark_public_headers variable document)
  file(STRINGS "${document}" rows REGEX "^\\| `[^`]+\\.hpp` \\|")
  set(headers "")
  foreach(row IN LISTS rows)
    string(REGEX REPLACE "^\\| `([^`]+)`.*" "\\1" header "${row}")
    list(APPEND headers "${header}")
  endforeach()
  if(NOT headers)
    message(FATAL_ERROR "${document} lists no headers")
  endif()
  set(${variable} "${headers}" PARENT_SCOPE)
endfunction()
