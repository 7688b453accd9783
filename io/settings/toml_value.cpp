// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/toml_value.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "treadmark/io/files/text.hpp"
#include "treadmark/io/settings/toml_faults.hpp"
#include "treadmark/io/settings/toml_nesting.hpp"

namespace treadmark::io {

namespace {

SourcePosition position(const toml::source_region& region, const std::string& name) {
  return {name, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

CaseTable convert(const toml::table& table, const std::string& name);

CaseValue convert(const toml::node& node, const std::string& name) {
  CaseValue value;
  value.where = position(node.source(), name);
  if (const auto* flag = node.as_boolean())
    value.data = flag->get();
  else if (const auto* integer = node.as_integer())
    value.data = static_cast<std::int64_t>(integer->get());
  else if (const auto* real = node.as_floating_point())
    value.data = real->get();
  else if (const auto* text = node.as_string())
    value.data = text->get();
  else if (const auto* table = node.as_table())
    value.data = convert(*table, name);
  else if (const auto* array = node.as_array()) {
    std::vector<CaseValue> list;
    for (const toml::node& element : *array) list.push_back(convert(element, name));
    value.data = std::move(list);
  } else {
    throw Error(ErrorKind::configuration, "dates and times have no meaning in a case file", value.where);
  }
  return value;
}

CaseTable convert(const toml::table& table, const std::string& name) {
  CaseTable entries;
  for (const auto& [key, node] : table)
    entries.push_back({std::string(key.str()), position(key.source(), name), convert(node, name)});
  // The library sorts by key; messages and cases follow the file.
  std::stable_sort(entries.begin(), entries.end(), [](const CaseEntry& a, const CaseEntry& b) {
    return std::pair(a.key_where.line, a.key_where.column) < std::pair(b.key_where.line, b.key_where.column);
  });
  return entries;
}

void set_place(CaseValue& value, const SourcePosition& where) {
  value.where = where;
  if (auto* list = std::get_if<std::vector<CaseValue>>(&value.data))
    for (CaseValue& one : *list) set_place(one, where);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

}  // namespace

double CaseValue::number() const {
  if (const auto* integer_value = std::get_if<std::int64_t>(&data)) return static_cast<double>(*integer_value);
  return std::get<double>(data) + 0.0;  // -0 would be written as the integer 0
}

std::string_view CaseValue::kind() const {
  constexpr std::string_view kKinds[] = {"true or false", "an integer", "a number", "text", "a list", "a table"};
  return kKinds[data.index()];
}

CaseTable parse_toml(std::string_view text, const std::string& name) {
  const std::string decoded = profiles::from_utf16(text);
  if (!decoded.empty()) text = decoded;
  if (text.find('\0') != std::string_view::npos)
    throw Error(ErrorKind::configuration, "not valid TOML: the file holds zero bytes, which no text does", {name},
                "is it the right file?");
  refuse_deep_toml(text, name);
  try {
    return convert(toml::parse(text, name), name);
  } catch (const toml::parse_error& error) {
    const SourcePosition where = position(error.source(), name);
    TextFault fault = toml_fault(text, where.line, where.column, error.description());
    if (fault.message.empty()) fault.message = error.description();
    throw Error(ErrorKind::configuration, "not valid TOML: " + fault.message, where, std::move(fault.advice));
  }
}

std::string toml_text(const std::string& text) {
  std::ostringstream quoted;
  quoted << toml::value<std::string>(text);
  return quoted.str();
}

CaseOverride parse_override(std::string_view assignment) {
  const SourcePosition where{fmt::format("override '{}'", assignment.substr(0, 200))};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos)
    throw Error(ErrorKind::configuration, "'=' is missing", where, "write key.path=value, for example wheelset.y_mm=3");
  CaseOverride result;
  result.path = trimmed(assignment.substr(0, equals));
  const std::string_view text = trimmed(assignment.substr(equals + 1));
  if (result.path.empty() || text.empty())
    throw Error(ErrorKind::configuration, "key or value is missing", where, "write key.path=value");
  if (text.find('\n') != std::string_view::npos)
    throw Error(ErrorKind::configuration, "a value must stand on one line", where);
  refuse_deep_toml(assignment, where.file);
  result.raw = text;

  try {
    CaseTable parsed = parse_toml(fmt::format("value = {}", text), "");
    result.value = std::move(parsed.at(0).value);
  } catch (const Error& error) {
    // Bare words are text; anything that looks like broken TOML is not.
    if (text.find_first_of("'\"[]{}=#") != std::string_view::npos)
      throw Error(ErrorKind::configuration, "the value is neither a word nor valid TOML", where, error.advice());
    result.value.data = std::string(text);
  }
  set_place(result.value, where);
  return result;
}

}  // namespace treadmark::io
