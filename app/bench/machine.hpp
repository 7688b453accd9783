// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace treadmark::app {

/// Processor, number of its cores, and the instructions that the kernels use: "Name of a processor, 2 cores, AVX2".
std::string machine_name();

/// Now, in UTC: "2026-01-31T12:00:00Z".
std::string date_now();

/// Compiler with version and kind of build: "GNU 12.2.0, Release".
std::string compiler_name();

/// Name and version of the libraries that this program was built with.
std::vector<std::pair<std::string, std::string>> library_versions();

/// Median time of one call [s]: a first call does not count, then calls until the given seconds have passed and there
/// are at least three. Where one thread is allowed its processor time counts, which other programs lengthen less, else
/// the time of day.
double median_time(const std::function<void()>& call, double seconds);

}  // namespace treadmark::app
