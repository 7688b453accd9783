# SPDX-License-Identifier: Apache-2.0
# cmake -DSTYLES="a.css;b.css" -DSCRIPT=report.js -DSOLVING=live.js -DOUT=assets.cpp -P write_assets.cmake
# Writes the texts as C++ strings; no SCRIPT or SOLVING: an empty one.
set(chunk 15000)  # compilers have limits for one literal

function(add_text name text)
  if(text MATCHES "\\)asset\"")
    message(FATAL_ERROR "${name} contains the end mark of raw strings")
  endif()
  string(LENGTH "${text}" length)
  file(APPEND "${OUT}.new" "constexpr std::string_view k${name}[] = {\n")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} ${chunk} part)
    file(APPEND "${OUT}.new" "R\"asset(${part})asset\",\n")
    math(EXPR at "${at} + ${chunk}")
  endwhile()
  file(APPEND "${OUT}.new" "\"\"};\n")
endfunction()

set(style "")
foreach(file IN LISTS STYLES)
  file(READ "${file}" text)
  string(APPEND style "${text}")
endforeach()
foreach(script IN ITEMS SCRIPT SOLVING)
  set(${script}_code "")
  if(${script})
    file(READ "${${script}}" ${script}_code)
  endif()
endforeach()

file(WRITE "${OUT}.new" "// Made by write_assets.cmake.\n#include \"treadmark/report/write_page.hpp\"\n\n#include <span>\n#include <string_view>\n\nnamespace treadmark::report {\nnamespace {\n\n")
add_text(Style "${style}")
add_text(Script "${SCRIPT_code}")
add_text(Solving "${SOLVING_code}")
file(APPEND "${OUT}.new" "\nstd::string joined(std::span<const std::string_view> parts) {\n  std::string text;\n  for (const std::string_view part : parts) text += part;\n  return text;\n}\n\n}  // namespace\n\nconst std::string& page_style() {\n  static const std::string text = joined(kStyle);\n  return text;\n}\n\nconst std::string& page_script() {\n  static const std::string text = joined(kScript);\n  return text;\n}\n\nconst std::string& solving_script() {\n  static const std::string text = joined(kSolving);\n  return text;\n}\n\n}  // namespace treadmark::report\n")
file(RENAME "${OUT}.new" "${OUT}")
