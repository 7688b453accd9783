// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/scans/virtual/draws.hpp"

namespace treadmark::scans::scanner {

/// Which points along a line get lost: half of them one by one, half in runs of 5 to 15. A renewal process in its
/// steady state, so that a share is the same at the ends of a line as inside.
class DropOuts {
 public:
  DropOuts(double share, Draws draws) : draws_(draws) {
    // a point outside runs is lost with p, or starts a run with p / mean length: as many are lost in runs as one by one
    single_ = share / (2.0 - share * (1.0 - 1.0 / kMeanRun));
    start_ = single_ / kMeanRun;
    if (draws_.uniform() < single_ / (single_ + 1.0 - start_)) {
      // a run under way: longer ones are met more often, at any of their points
      double at = draws_.uniform() * kMeanRun * kLengths;
      int length = kShortest;
      while (at >= length && length < kShortest + kLengths - 1) at -= length++;
      left_ = length - static_cast<int>(draws_.index(static_cast<std::size_t>(length)));
    }
  }

  /// Whether the next point is lost.
  bool next() {
    if (left_ == 0) {
      const double u = draws_.uniform();
      if (u >= start_) return u < start_ + single_;
      left_ = kShortest + static_cast<int>(draws_.index(kLengths));
    }
    --left_;
    return true;
  }

 private:
  static constexpr int kShortest = 5, kLengths = 11;
  static constexpr double kMeanRun = 10.0;

  Draws draws_;
  double single_ = 0.0, start_ = 0.0;
  int left_ = 0;  ///< of a run
};

}  // namespace treadmark::scans::scanner
