# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Commit and its time: of the repository, else as scripts/source-archive.sh wrote them down.
set(TREADMARK_GIT_REVISION "unknown")
file(STRINGS "${PROJECT_SOURCE_DIR}/cmake/revision.txt" revision)
find_program(TREADMARK_GIT git)
if(TREADMARK_GIT AND EXISTS "${PROJECT_SOURCE_DIR}/.git")
  execute_process(COMMAND "${TREADMARK_GIT}" -C "${PROJECT_SOURCE_DIR}" log -1 "--format=%H %ct"
    OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(revision MATCHES "^([0-9a-f]+) ([0-9]+)$")
  string(SUBSTRING "${CMAKE_MATCH_1}" 0 8 TREADMARK_GIT_REVISION)
  set(ENV{SOURCE_DATE_EPOCH} "${CMAKE_MATCH_2}")
endif()
string(TIMESTAMP TREADMARK_SOURCE_TIME "%Y-%m-%dT%H:%M:%SZ" UTC)  # of SOURCE_DATE_EPOCH
