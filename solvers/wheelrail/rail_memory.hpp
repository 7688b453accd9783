// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// What of a rail is the same at every instant, kept from one to the next: its box, the gauge point, from where to
/// where it is seen. What is asked for is the same to the last bit whatever was asked before: answers are kept by
/// everything that they depend on. One per thread.
class RailMemory {
 public:
  /// The rail must outlive this.
  explicit RailMemory(const Surface& rail) : rail_(&rail) {}

  const Box3& box();
  /// As gauge_point().
  GaugePoint gauge(double cant, const Track& track, double x);
  /// As visible_range(), of a rail of one profile from its own place on, which no position along or across the track
  /// changes.
  LateralRange visible(const Pose& X_TS, double x_T);

 private:
  struct GaugeKey {
    double cant = 0.0, height = 0.0, x = 0.0;
    bool at_innermost = false;
    friend bool operator==(const GaugeKey&, const GaugeKey&) = default;
  };
  /// The last few answers; a rail that rolls on its springs asks for ever new ones.
  template <class Key, class Value>
  struct Answers {
    std::array<std::optional<std::pair<Key, Value>>, 4> kept;
    std::size_t next = 0;

    template <class Make>
    Value get(const Key& key, Make&& make) {
      for (const auto& one : kept)
        if (one && one->first == key) return one->second;
      const Value made = make();
      kept[next] = {key, made};
      next = (next + 1) % kept.size();
      return made;
    }
  };

  const Surface* rail_;
  std::optional<Box3> box_;
  Answers<GaugeKey, GaugePoint> gauges_;
  Answers<Mat3, LateralRange> ranges_;
};

}  // namespace treadmark::wheelrail
