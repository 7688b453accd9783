// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/pair_pool.hpp"

namespace treadmark::app {

PairPool::Lease PairPool::take(const wheelrail::Geometry& geometry) {
  std::unique_ptr<wheelrail::Pair> pair;
  {
    const std::lock_guard lock(mutex_);
    auto& idle = idle_[{geometry.rail.get(), geometry.wheel.get()}];
    if (!idle.empty()) {
      pair = std::move(idle.back());
      idle.pop_back();
    }
  }
  if (pair)
    pair->reset();
  else
    pair = std::make_unique<wheelrail::Pair>(geometry);
  return {geometry, std::move(pair)};
}

void PairPool::give_back(Lease lease) {
  const std::lock_guard lock(mutex_);
  idle_[{lease.geometry.rail.get(), lease.geometry.wheel.get()}].push_back(std::move(lease.pair));
}

}  // namespace treadmark::app
