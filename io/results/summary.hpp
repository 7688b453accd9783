// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// One case as an aligned table for people, units shown (mm, N, MPa, ...), ending in a newline. Thread-safe.
std::string summary(const CaseResult& result);

}  // namespace treadmark::io
