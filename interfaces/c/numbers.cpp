// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/c/numbers.hpp"

#include <cstddef>
#include <functional>
#include <unordered_map>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::c {
namespace {

struct Hash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
};
using Names = std::unordered_map<std::string, std::size_t, Hash, std::equal_to<>>;

/// Where a name stands twice the first one counts.
template <class Rows>
Names names_of(const Rows& rows) {
  Names names;
  for (std::size_t i = 0; i < rows.size(); ++i) names.emplace(rows[i].name, i);
  return names;
}

bool is_motion(std::string_view name) {
  constexpr std::string_view kMotions[] = {"s",  "y",  "z",     "roll", "yaw",   "pitch",
                                           "vy", "vz", "vroll", "vyaw", "vpitch"};
  constexpr std::string_view kWheelset = "wheelset.";
  if (name.starts_with("track.irregularity_") || name.starts_with("wheelset.deviation_")) return true;
  return name.starts_with(kWheelset) && ranges::find(kMotions, name.substr(kWheelset.size())) != std::end(kMotions);
}

template <class Result>
std::vector<ResultNumber<Result>> named_rows() {
  std::vector<ResultNumber<Result>> rows;
  for (const io::Quantity<Result>& q : io::quantities<Result>()) {
    if (!q.key.empty()) rows.push_back({{io::si_name(q), std::string(q.unit.si), std::string(q.meaning)}, &q});
  }
  return rows;
}

template <class Result>
const ResultNumber<Result>* named(std::string_view name) {
  static const Names names = names_of(result_numbers<Result>());
  const auto found = names.find(name);
  return found == names.end() ? nullptr : &result_numbers<Result>()[found->second];
}

}  // namespace

std::span<const CaseNumber> case_numbers() {
  static const std::vector<CaseNumber> numbers = [] {
    std::vector<CaseNumber> rows;
    for (const io::CaseKey& key : io::case_keys()) {
      if (key.info.type != io::KeyType::number && key.info.type != io::KeyType::integer) continue;
      const io::KeyUnit unit = io::unit_at_end(key.info.path);
      CaseNumber row;
      row.name = key.info.path.substr(0, key.info.path.size() - unit.ending.size());
      row.unit = unit.si_name;
      row.meaning = key.info.doc;
      row.key = &key;
      row.si = unit.si;
      row.motion = is_motion(row.name);
      // a key in degrees beside one in radians is the same number in SI
      if (ranges::find(rows, row.name, &CaseNumber::name) == rows.end()) rows.push_back(std::move(row));
    }
    return rows;
  }();
  return numbers;
}

template <>
std::span<const ResultNumber<io::CaseResult>> result_numbers() {
  static const auto rows = named_rows<io::CaseResult>();
  return rows;
}

template <>
std::span<const ResultNumber<io::PatchResult>> result_numbers() {
  static const auto rows = named_rows<io::PatchResult>();
  return rows;
}

int case_number_named(std::string_view name) {
  static const Names names = names_of(case_numbers());
  const auto found = names.find(name);
  return found == names.end() ? -1 : static_cast<int>(found->second);
}

const ResultNumber<io::CaseResult>* solution_number_named(std::string_view name) { return named<io::CaseResult>(name); }
const ResultNumber<io::PatchResult>* patch_number_named(std::string_view name) { return named<io::PatchResult>(name); }

}  // namespace treadmark::c
