// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/app/measure/numbers.hpp"

namespace treadmark::app {

/// What a limit says, from good to bad; no_limits: there was none to hold.
enum class Verdict { no_limits, within, not_measured, outside };
/// "within", "not measured" ...
std::string word_of(Verdict verdict);

/// A range for one number, in the unit of its key.
struct Limit {
  std::string key;
  std::optional<double> min, max;
};

struct Limits {
  std::string file;  ///< without folders; empty: none
  std::vector<Limit> wheel, rail;
  std::vector<double> roughness;  ///< levels for measures::third_octaves() [dB]; empty: ISO 3095:2013
};

/// Limits from a TOML file: tables [wheel] and [rail] with a key of a number each, whose value is a table with min, max
/// or both; [roughness] with the lists wavelength_mm and level_db. Errors: Error(configuration) at the place for keys
/// that are no numbers of results and for ranges that hold nothing; Error(input_data) for a file that cannot be read.
Limits read_limits(const std::filesystem::path& file);

/// How one number stands to its limit.
struct LimitResult {
  Limit limit;
  double value = measures::kUnknown, uncertainty = measures::kUnknown;  ///< in the unit of the key
  Verdict verdict = Verdict::not_measured;
  bool sure = false;  ///< the limit is farther away than the uncertainty, which is known
};
/// Behind the verdict of a number: ", nearer than its uncertainty", ", its uncertainty is not known"; empty where it is
/// sure.
std::string how_sure(const LimitResult& result);

/// All limits against the numbers.
std::vector<LimitResult> compare_limits(const std::variant<WheelNumbers, RailNumbers>& numbers, const Limits& limits);

}  // namespace treadmark::app
