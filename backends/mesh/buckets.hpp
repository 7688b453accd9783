// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/check_point.hpp"
#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::mesh {

/// Values by a number below a limit, each bucket sorted: what a sort by the number would give, in time that grows with
/// the values alone as long as no bucket is large.
template <class Value>
class Buckets {
 public:
  /// each(put) calls put(number, value) for every value; it is called twice and must do the same both times.
  template <class Each>
  Buckets(std::size_t numbers, const Each& each) : begin_(numbers + 1, 0) {
    CheckPoint check;
    each([&](std::uint32_t number, const Value&) {
      check.pass();
      ++begin_[number];
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& b : begin_) sum = b += sum;  // the ends, from which they are filled downwards
    values_.resize(sum);
    each([&](std::uint32_t number, const Value& value) {
      check.pass();
      values_[--begin_[number]] = value;
    });
    constexpr std::size_t kTask = 4096;
    parallel_blocks(numbers, kTask, [&](std::size_t from, std::size_t to) {
      CheckPoint own;
      for (std::size_t k = from; k < to; ++k)
        std::sort(values_.begin() + begin_[k], values_.begin() + begin_[k + 1], [&](const Value& a, const Value& b) {
          own.pass();
          return a < b;
        });
    });
  }

  std::size_t size() const { return begin_.size() - 1; }
  std::span<const Value> operator[](std::size_t number) const {
    return {values_.data() + begin_[number], begin_[number + 1] - begin_[number]};
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<Value> values_;
};

}  // namespace treadmark::mesh
