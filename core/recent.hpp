// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace treadmark {

/// The last few things that were made, by what they were made from. Meant to be thread_local, where objects that
/// threads share make something anew for each direction asked: their keys begin with owner_number(). One object, one
/// thread.
template <class Key, class Value, std::size_t kCount = 4>
class Recent {
 public:
  /// What make() returns, a shared pointer; of equal keys the one that is kept.
  template <class Make>
  std::shared_ptr<const Value> of(const Key& key, const Make& make) {
    for (const Kept& kept : kept_)
      if (kept.value != nullptr && kept.key == key) return kept.value;
    Kept& slot = kept_[oldest_];
    oldest_ = (oldest_ + 1) % kCount;
    slot = {key, make()};
    return slot.value;
  }

 private:
  struct Kept {
    Key key{};
    std::shared_ptr<const Value> value;
  };
  std::array<Kept, kCount> kept_;
  std::size_t oldest_ = 0;
};

/// A number that nobody had before, from 1. Thread-safe.
inline std::uint64_t owner_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace treadmark
