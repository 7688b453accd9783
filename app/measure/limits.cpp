// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/limits.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/analysis/measures/bands.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/settings/key_info.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::app {
namespace {

[[noreturn]] void refuse_limit(const std::string& what, const SourcePosition& where, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, what, where, advice);
}

double limit_number(const io::CaseValue& value) {
  if (!std::holds_alternative<double>(value.data) && !std::holds_alternative<std::int64_t>(value.data))
    refuse_limit(fmt::format("a number is expected, not {}", value.kind()), value.where);
  return value.number();
}

template <class Numbers>
std::vector<Limit> limit_table(const io::CaseValue& value) {
  if (!value.is_table()) refuse_limit(fmt::format("a table of limits is expected, not {}", value.kind()), value.where);
  std::vector<std::string> known;
  for (const auto& row : number_rows(Numbers{})) known.emplace_back(row.key);
  std::vector<Limit> limits;
  for (const io::CaseEntry& entry : value.table()) {
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      io::refuse_unknown_key(entry.key, known, entry.key_where);
    if (!entry.value.is_table())
      refuse_limit(fmt::format("a limit of {} is a table, not {}", entry.key, entry.value.kind()), entry.value.where,
                   "as in { min = 22, max = 33 }");
    Limit limit{entry.key, {}, {}};
    for (const io::CaseEntry& end : entry.value.table()) {
      if (end.key != "min" && end.key != "max") io::refuse_unknown_key(end.key, {"min", "max"}, end.key_where);
      (end.key == "min" ? limit.min : limit.max) = limit_number(end.value);
    }
    if ((!limit.min && !limit.max) || (limit.min && limit.max && *limit.min > *limit.max))
      refuse_limit(fmt::format("the limit of {} holds nothing", entry.key), entry.value.where, "give min, max or both");
    limits.push_back(std::move(limit));
  }
  return limits;
}

/// Levels for the bands whose middles are named; NaN for the others.
std::vector<double> roughness_limits(const io::CaseValue& value) {
  if (!value.is_table()) refuse_limit("a table with wavelength_mm and level_db is expected", value.where);
  std::vector<double> wavelengths, levels;
  for (const io::CaseEntry& entry : value.table()) {
    if (entry.key != "wavelength_mm" && entry.key != "level_db")
      io::refuse_unknown_key(entry.key, {"wavelength_mm", "level_db"}, entry.key_where);
    if (!entry.value.is_list()) refuse_limit("a list is expected", entry.value.where);
    for (const io::CaseValue& v : entry.value.list())
      (entry.key == "level_db" ? levels : wavelengths).push_back(limit_number(v));
  }
  if (levels.size() != wavelengths.size() || levels.empty())
    refuse_limit("wavelength_mm and level_db need as many numbers as each other", value.where);
  std::vector<double> out(measures::third_octaves().size(), measures::kUnknown);
  for (std::size_t i = 0; i < wavelengths.size(); ++i) {
    constexpr double kSame = 0.02, kMilli = 1e-3;
    const auto bands = measures::third_octaves();
    const auto band = std::find_if(bands.begin(), bands.end(), [&](double nominal) {
      return std::fabs(kMilli * wavelengths[i] / nominal - 1.0) < kSame;
    });
    if (band == bands.end())
      refuse_limit(fmt::format("{:g} mm is no nominal middle of a one-third octave", wavelengths[i]), value.where,
                   "such as 400, 315, 250, 200, 160, 125, 100");
    out[static_cast<std::size_t>(band - bands.begin())] = levels[i];
  }
  return out;
}

template <class Numbers>
std::vector<LimitResult> against_limits(const Numbers& numbers, const std::vector<Limit>& limits) {
  std::vector<LimitResult> results;
  for (const Limit& limit : limits)
    for (const auto& row : number_rows(numbers)) {
      if (limit.key != row.key) continue;
      LimitResult result{limit, row.in_file(numbers), row.uncertainty_in_file(numbers), Verdict::not_measured, false};
      if (row.known(numbers)) {
        const double below = limit.min ? result.value - *limit.min : HUGE_VAL,
                     above = limit.max ? *limit.max - result.value : HUGE_VAL, room = std::min(below, above);
        // what a computer makes of two decimals is no wear
        constexpr double kRounding = 1e-9;
        result.verdict = room < -kRounding * (1.0 + std::fabs(result.value)) ? Verdict::outside : Verdict::within;
        result.sure = std::fabs(room) > result.uncertainty;
      }
      results.push_back(std::move(result));
    }
  return results;
}

}  // namespace

std::string word_of(Verdict verdict) {
  constexpr const char* kWords[] = {"no limits", "within", "not measured", "outside"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::string how_sure(const LimitResult& result) {
  if (result.sure) return {};
  return std::isnan(result.uncertainty) ? ", its uncertainty is not known" : ", nearer than its uncertainty";
}

Limits read_limits(const std::filesystem::path& file) {
  Limits limits;
  limits.file = file.filename().string();
  for (const io::CaseEntry& entry : io::parse_toml(io::profiles::read_text(file, "limits", {}), file.string())) {
    if (entry.key == "wheel")
      limits.wheel = limit_table<WheelNumbers>(entry.value);
    else if (entry.key == "rail")
      limits.rail = limit_table<RailNumbers>(entry.value);
    else if (entry.key == "roughness")
      limits.roughness = roughness_limits(entry.value);
    else
      io::refuse_unknown_key(entry.key, {"wheel", "rail", "roughness"}, entry.key_where);
  }
  return limits;
}

std::vector<LimitResult> compare_limits(const std::variant<WheelNumbers, RailNumbers>& numbers, const Limits& limits) {
  if (const auto* wheel = std::get_if<WheelNumbers>(&numbers)) return against_limits(*wheel, limits.wheel);
  return against_limits(std::get<RailNumbers>(numbers), limits.rail);
}

}  // namespace treadmark::app
