// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/key_info.hpp"

#include <algorithm>
#include <charconv>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/io/settings/nearest_key.hpp"

namespace treadmark::io {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct UnitEnding {
  std::string_view ending;
  double si;
};
// Longer endings first.
constexpr UnitEnding kUnits[] = {
    {"_mm_per_MPa", 1e-9}, {"_MPa_per_mm", 1e9}, {"_N_per_mm", 1e3}, {"_per_m", 1.0}, {"_rad_s", 1.0}, {"_rad_m", 1.0},
    {"_mm_s", 1e-3},       {"_m_s", 1.0},        {"_mm3", 1e-9},     {"_um", 1e-6},   {"_us", 1e-6},   {"_GPa", 1e9},
    {"_MPa", 1e6},         {"_deg", kDegree},    {"_rad", 1.0},      {"_mm", 1e-3},   {"_N", 1.0},
};

}  // namespace

KeyInfo key_info(std::string path, KeyType type, std::string doc) {
  KeyInfo info;
  info.path = std::move(path);
  info.type = type;
  info.doc = std::move(doc);
  return info;
}

KeyInfo key_info(std::string path, KeyType type, std::string doc, const KeyLimits& limits) {
  KeyInfo info = key_info(std::move(path), type, std::move(doc));
  info.above = limits.above;
  info.at_least = limits.at_least;
  info.at_most = limits.at_most;
  return info;
}

ElementPath split_element_path(const KeyInfo& list, std::string_view rest, const SourcePosition& where) {
  const std::size_t dot = rest.find('.');
  ElementPath place;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + std::min(dot, rest.size()), place.index);
  if (dot == std::string_view::npos || error != std::errc{} || end != rest.data() + dot)
    throw Error(ErrorKind::configuration, fmt::format("{} is a list", list.path), where,
                fmt::format("write {}.0.{}=value", list.path, list.elements.front().path));
  place.key = rest.substr(dot + 1);
  return place;
}

double unit_of_key(std::string_view path) {
  for (const UnitEnding& unit : kUnits)
    if (path.ends_with(unit.ending)) return unit.si;
  return 1.0;
}

std::vector<double> numbers_of(const CaseValue& list, double unit) {
  std::vector<double> numbers;
  for (const CaseValue& one : list.list()) numbers.push_back(one.number() * unit);
  return numbers;
}

void refuse_unknown_key(std::string_view path, const std::vector<std::string>& known, const SourcePosition& where) {
  const std::string near = nearest_key(path, known);
  throw Error(ErrorKind::configuration, fmt::format("unknown key '{}'", path.substr(0, 100)), where,
              near.empty() ? "see docs/case-file.md for all keys" : fmt::format("did you mean '{}'?", near));
}

}  // namespace treadmark::io
