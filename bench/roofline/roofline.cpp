// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What this machine can do at best: arithmetic as wide as the kernels', and memory read in order.
#include <cmath>
#include <numeric>
#include <vector>

#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/roofline/ceilings.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::bench {
namespace {

constexpr long kTimes = 1000;

std::vector<double> numbers() {
  std::vector<double> x(Ceilings::kNumbers);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1.5 + 0.01 * static_cast<double>(i);
  return x;
}

/// run(x, times) against one number at a time.
template <class Run, class One>
void arithmetic(benchmark::State& state, const Run& run, const One& one) {
  constexpr double kRounding = 1e-12;
  std::vector<double> x = numbers();
  const std::vector<double> before = x;
  run(x.data(), 5);
  for (std::size_t i = 0; i < x.size(); ++i) {
    double expected = before[i];
    for (int n = 0; n < 5; ++n) expected = one(expected);
    if (!(std::fabs(x[i] - expected) <= kRounding * std::fabs(expected))) return refuse(state, "wrong result");
  }
  for (auto _ : state) {
    x = before;
    run(x.data(), kTimes);
    benchmark::DoNotOptimize(x.data());
  }
  state.counters["per_operation"] = time_each(static_cast<std::size_t>(kTimes) * x.size());
}

/// Reads so many bytes again and again.
void read(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0)) / sizeof(double);
  std::vector<double> data(size);
  std::iota(data.begin(), data.end(), 1.0);
  double total = 0.0;
  for (auto _ : state) {
    double sum[8] = {};
    for (std::size_t i = 0; i + 8 <= size; i += 8)
      for (std::size_t k = 0; k < 8; ++k) sum[k] += data[i + k];
    total = std::accumulate(std::begin(sum), std::end(sum), 0.0);
    benchmark::DoNotOptimize(total);
  }
  const auto n = static_cast<double>(size);
  if (!(std::fabs(total - 0.5 * n * (n + 1.0)) <= 1e-9 * total)) return refuse(state, "wrong sum");
  state.SetBytesProcessed(state.iterations() * state.range(0));
}

[[maybe_unused]] const bool entered = [] {
  const auto enter = [](const char* name, auto run) { benchmark::RegisterBenchmark(name, run); };
  enter("multiply_add", [](benchmark::State& state) {
    arithmetic(
        state, [](double* x, long times) { fastest_kernel<Ceilings>().multiply_add(x, 0.75, 0.5, times); },
        [](double x) { return 0.75 * x + 0.5; });
  });
  enter("divide", [](benchmark::State& state) {
    arithmetic(
        state, [](double* x, long times) { fastest_kernel<Ceilings>().divide(x, 3.0, times); },
        [](double x) { return 3.0 / x; });
  });
  enter("root", [](benchmark::State& state) {
    arithmetic(
        state, [](double* x, long times) { fastest_kernel<Ceilings>().root(x, times); },
        [](double x) { return std::sqrt(x); });
  });
  benchmark::RegisterBenchmark("read", read)->Arg(16 << 10)->Arg(1 << 20)->Arg(256 << 20);
  return true;
}();

}  // namespace
}  // namespace treadmark::bench
