// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// Solvers keep influence coefficients: finished ones are handed to the next case with the same bodies. Thread-safe.
class PairPool {
 public:
  struct Lease {
    wheelrail::Geometry geometry;
    std::unique_ptr<wheelrail::Pair> pair;
  };

  /// Without history.
  Lease take(const wheelrail::Geometry& geometry);
  void give_back(Lease lease);

 private:
  std::mutex mutex_;
  std::map<std::pair<const Surface*, const Surface*>, std::vector<std::unique_ptr<wheelrail::Pair>>> idle_;
};

}  // namespace treadmark::app
