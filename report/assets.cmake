# SPDX-License-Identifier: Apache-2.0
# Style sheet and script of the reports, put into the library as text. The script is bundled from report/web with packages of the npm
# registry; without Node.js reports have static pictures.
set(styles style.css contact.css scene.css live.css)
list(TRANSFORM styles PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
set(script "")
set(solving "")

if(TREADMARK_HAVE_REPORT_SCRIPTS)
  set(web_source "${CMAKE_CURRENT_SOURCE_DIR}/web")
  set(TREADMARK_WEB_DIR "${CMAKE_CURRENT_BINARY_DIR}/web")
  set(script "${TREADMARK_WEB_DIR}/dist/report.js")
  set(solving "${TREADMARK_WEB_DIR}/dist/live.js")
  file(GLOB_RECURSE web_files CONFIGURE_DEPENDS RELATIVE "${web_source}" "${web_source}/src/*" "${web_source}/test/*" "${web_source}/*.json"
    "${web_source}/*.js" "${web_source}/*.mjs")
  list(FILTER web_files EXCLUDE REGEX "^(node_modules|dist)/")
  set(web_copies "")
  foreach(file IN LISTS web_files)
    add_custom_command(OUTPUT "${TREADMARK_WEB_DIR}/${file}"
      COMMAND "${CMAKE_COMMAND}" -E copy "${web_source}/${file}" "${TREADMARK_WEB_DIR}/${file}" DEPENDS "${web_source}/${file}"
      COMMENT "" VERBATIM)
    list(APPEND web_copies "${TREADMARK_WEB_DIR}/${file}")
  endforeach()
  add_custom_command(OUTPUT "${TREADMARK_WEB_DIR}/packages.stamp"
    COMMAND "${TREADMARK_NPM}" ci --ignore-scripts --no-audit --no-fund --loglevel=error
    COMMAND "${CMAKE_COMMAND}" -E touch "${TREADMARK_WEB_DIR}/packages.stamp"
    DEPENDS "${TREADMARK_WEB_DIR}/package.json" "${TREADMARK_WEB_DIR}/package-lock.json" WORKING_DIRECTORY "${TREADMARK_WEB_DIR}"
    COMMENT "Fetching the packages of the report's scripts (without a network: -DTREADMARK_REPORT_SCRIPTS=OFF)" VERBATIM)
  add_custom_command(OUTPUT "${script}" "${solving}"
    COMMAND "${TREADMARK_NODE}" build.mjs --out "${TREADMARK_WEB_DIR}/dist" DEPENDS "${TREADMARK_WEB_DIR}/packages.stamp" ${web_copies}
    WORKING_DIRECTORY "${TREADMARK_WEB_DIR}" COMMENT "Bundling the report's scripts" VERBATIM)
endif()

set(assets "${CMAKE_CURRENT_BINARY_DIR}/assets.cpp")
add_custom_command(OUTPUT "${assets}"
  COMMAND "${CMAKE_COMMAND}" "-DSTYLES=${styles}" "-DSCRIPT=${script}" "-DSOLVING=${solving}" "-DOUT=${assets}" -P "${CMAKE_CURRENT_SOURCE_DIR}/write_assets.cmake"
  DEPENDS ${styles} ${script} ${solving} "${CMAKE_CURRENT_SOURCE_DIR}/write_assets.cmake" VERBATIM)
target_sources(treadmark_report PRIVATE "${assets}")
set_source_files_properties("${assets}" TARGET_DIRECTORY treadmark_report PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
