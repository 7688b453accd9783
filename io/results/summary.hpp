// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// One case as an aligned table for people, units shown (mm, N, MPa, ...), ending in a newline. Thread-safe.
std::string summary(const CaseResult& result);

/// A line a case, with a heading, then a line for each message or warning: of each case its pose, forces on the rail in
/// track axes (without wheel and rail: of the patch) and the largest pressure. Thread-safe.
std::string summary_list(std::span<const CaseResult> cases);

/// Message and warnings of a case in one line.
std::string words(const CaseResult& result);

/// One line on a surface that was sampled: how far it lies from what it was sampled from, what it costs.
std::string summary(const SurfaceUse& use);

}  // namespace treadmark::io
