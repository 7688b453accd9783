// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/results/quantities.hpp"

namespace treadmark::c {

/// A number by its name without unit, in SI.
struct NamedNumber {
  std::string name, unit, meaning;
};

/// A number of a case: a key of case files that holds one.
struct CaseNumber : NamedNumber {
  const io::CaseKey* key = nullptr;
  double si = 1.0;      ///< of one unit of the key
  bool motion = false;  ///< position or velocity of wheelset or rail: no rule about several keys asks for it
};

/// A number of results.
template <class Result>
struct ResultNumber : NamedNumber {
  const io::Quantity<Result>* row = nullptr;
};

/// In the order of the tables that they are made from. Immutable; thread-safe.
std::span<const CaseNumber> case_numbers();
template <class Result>
std::span<const ResultNumber<Result>> result_numbers();
template <>
std::span<const ResultNumber<io::CaseResult>> result_numbers();
template <>
std::span<const ResultNumber<io::PatchResult>> result_numbers();

/// What tables of forces are asked and what they answer, in the order of the arrays of tm_table_evaluate.
std::span<const NamedNumber> motion_numbers();
std::span<const NamedNumber> force_numbers();

/// Index of the number of this name; -1: there is none.
int case_number_named(std::string_view name);

/// Null where there is none.
const ResultNumber<io::CaseResult>* solution_number_named(std::string_view name);
const ResultNumber<io::PatchResult>* patch_number_named(std::string_view name);

}  // namespace treadmark::c
