// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// A number, vector or text that describes a part of a run, in SI units.
struct Attribute {
  using Value = std::variant<int, double, Vec3, Mat3, std::string, std::vector<std::string>>;
  std::string name;
  Value value;
};

/// What is written at the group of a run, a case and a patch, besides their parts and fields.
std::vector<Attribute> attributes_of(const RunResult& run);
std::vector<Attribute> attributes_of(const CaseResult& result);
std::vector<Attribute> attributes_of(const PatchResult& patch);

}  // namespace treadmark::io
