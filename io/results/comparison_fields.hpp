// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// Absent, a number (not finite = it does not exist), a count or a text.
using FieldValue = std::variant<std::monostate, double, std::int64_t, std::string>;

/// Name with its unit, and the value in that unit: what the JSON and the CSV file say.
struct NamedField {
  std::string_view name;
  FieldValue value;
};

std::vector<NamedField> candidate_fields(const ComparisonCandidate& candidate);
std::vector<NamedField> body_fields(const RepresentedBody& body);

/// Always the same names in the same order. Errors of a row that is not comparable are absent.
std::vector<NamedField> row_fields(const ComparisonCandidate& candidate, const ComparisonRow& row);

}  // namespace treadmark::io
