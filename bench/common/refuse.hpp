// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <benchmark/benchmark.h>

#include <string>

namespace treadmark::bench {

/// Ends a benchmark whose answer is wrong: no time is printed and the program ends with status 1.
void refuse(benchmark::State& state, const std::string& reason);

/// Whether any benchmark was refused so far.
bool any_refused();

/// Counter that shows the time a point (or whatever n counts) takes.
benchmark::Counter time_each(std::size_t n);

}  // namespace treadmark::bench
