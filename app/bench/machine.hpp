// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::app {

/// Processor, number of its cores, and the instructions that the kernels use: "Name of a processor, 2 cores, AVX2".
std::string machine_name();

/// Now, in UTC: "2026-01-31T12:00:00Z".
std::string date_now();

}  // namespace treadmark::app
