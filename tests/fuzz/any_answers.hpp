// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>

#include "treadmark/core/channel.hpp"

namespace treadmark::fuzz {

/// A program that a file has broken: it answers whatever is asked with these bytes, and from some place on again and
/// again, so that few bytes answer all lines of a section.
class AnyAnswers final : public Channel {
 public:
  AnyAnswers(const std::uint8_t* data, std::size_t size, std::size_t again)
      : data_(data), size_(size), again_(again < size ? again : 0) {}

 protected:
  void put_bytes(const void*, std::size_t) override {}
  void take_bytes(void* data, std::size_t size) override {
    auto* out = static_cast<std::uint8_t*>(data);
    if (size > most_) throw Broken{};
    most_ -= size;
    for (std::size_t k = 0; k < size; ++k) {
      if (at_ == size_) at_ = again_;
      if (at_ == size_) throw Broken{};
      out[k] = data_[at_++];
    }
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, again_, at_ = 0;
  std::size_t most_ = 400'000;
};

}  // namespace treadmark::fuzz
