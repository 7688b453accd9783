// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/bench/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>
#include <vector>

#include "treadmark/core/cpu.hpp"
#include "treadmark/core/stopwatch.hpp"

namespace treadmark::app {

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const std::size_t colon = line.find(':'); colon != std::string::npos) {
        const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
        if (begin != std::string::npos) return line.substr(begin);
      }
  return "unknown processor";
}

}  // namespace

std::string machine_name() {
  const unsigned cores = std::thread::hardware_concurrency();
  return fmt::format("{}, {} {}, {}", processor(), cores, cores == 1 ? "core" : "cores",
                     cpu_has_avx2() ? "AVX2" : "no AVX2");
}

std::string date_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

namespace {

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

double median_time(const std::function<void()>& call, double seconds) {
  constexpr std::size_t kLeast = 3, kMost = 100000;
  std::vector<double> times;
  call();
  const double begin = wall_time();
  while (times.size() < kLeast || (wall_time() - begin < seconds && times.size() < kMost)) {
    const double start = used_seconds();
    call();
    times.push_back(used_seconds() - start);
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace treadmark::app
