# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# COUPLED and `PROGRAM simulate FILE` must find the same largest force, within 1 %.
execute_process(COMMAND "${COUPLED}" OUTPUT_VARIABLE coupled RESULT_VARIABLE status)
if(NOT status EQUAL 0 OR NOT coupled MATCHES "largest ([0-9]+)")
  message(FATAL_ERROR "the coupled program ended with ${status}: ${coupled}")
endif()
set(coupled_force ${CMAKE_MATCH_1})
execute_process(COMMAND "${PROGRAM}" simulate "${FILE}" --json - OUTPUT_VARIABLE summary ERROR_QUIET)
if(NOT summary MATCHES "\"q_max_N\": ([0-9]+)")
  message(FATAL_ERROR "no largest force in ${summary}")
endif()
set(force ${CMAKE_MATCH_1})
message("largest force: coupled ${coupled_force} N, simulate ${force} N")
math(EXPR low "99 * ${force} / 100")
math(EXPR high "101 * ${force} / 100")
if(force LESS 100000 OR coupled_force LESS low OR coupled_force GREATER high)
  message(FATAL_ERROR "they differ by more than 1 %")
endif()
