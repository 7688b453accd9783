// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "treadmark/core/pose.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans::scanner {

/// What random numbers are for. Every purpose has its own, so that noise does not move the lines or change what is
/// lost.
enum class Purpose : std::uint64_t { positions = 1, noise, drop_outs, outliers, holes, blobs, registration, frame };

/// Random numbers that depend on nothing but (seed, purpose, pass, line).
class Draws {
 public:
  Draws(std::uint64_t seed, Purpose purpose, std::size_t pass = 0, std::size_t line = 0)
      : random_(mixed(mixed(mixed(seed, static_cast<std::uint64_t>(purpose)), pass), line)) {}

  /// In [0, 1).
  double uniform() { return random_.uniform(); }
  double uniform(double low, double high) { return low + (high - low) * random_.uniform(); }
  /// In [0, count), count > 0.
  std::size_t index(std::size_t count) {
    const auto i = to_whole<std::size_t>(random_.uniform() * static_cast<double>(count));
    return i < count ? i : count - 1;
  }
  /// Mean 0, standard deviation 1 (Box and Muller 1958).
  double gaussian() {
    if (has_other_) {
      has_other_ = false;
      return other_;
    }
    const double r = std::sqrt(-2.0 * std::log(1.0 - random_.uniform())),
                 angle = 2.0 * std::numbers::pi * random_.uniform();
    other_ = r * std::sin(angle);
    has_other_ = true;
    return r * std::cos(angle);
  }
  Vec3 gaussian3() {
    const double x = gaussian(), y = gaussian(), z = gaussian();
    return {x, y, z};
  }

 private:
  static std::uint64_t mixed(std::uint64_t state, std::uint64_t more) {
    return Random(Random(state).bits() + 0x9e3779b97f4a7c15u * more).bits();
  }

  Random random_;
  double other_ = 0.0;
  bool has_other_ = false;
};

}  // namespace treadmark::scans::scanner
