// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "treadmark/core/to_whole.hpp"

namespace treadmark {
namespace {

template <class Int>
void expect_held() {
  using Limits = std::numeric_limits<Int>;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {infinity, 1e300, 1e20}) {
    // what the type holds of doubles: beyond 53 bits not its greatest
    EXPECT_GE(static_cast<double>(to_whole<Int>(x)), std::nextafter(static_cast<double>(Limits::max()), 0.0));
    EXPECT_EQ(to_whole<Int>(-x), Limits::min());
  }
  EXPECT_EQ(to_whole<Int>(std::numeric_limits<double>::quiet_NaN()), Limits::min());
  EXPECT_EQ(to_whole<Int>(99.99), 99);
  EXPECT_EQ(to_whole<Int>(-0.99), 0);
  if (Limits::is_signed) {
    EXPECT_EQ(to_whole<Int>(std::floor(-7.5)), static_cast<Int>(-8));
  }
}

TEST(ToWhole, HoldsWhatTheTypeHolds) {
  expect_held<int>();
  expect_held<long>();
  expect_held<std::uint8_t>();
  expect_held<std::int32_t>();
  expect_held<std::int64_t>();
  expect_held<std::uint64_t>();
  EXPECT_EQ(to_whole<int>(2147483647.0), 2147483647);
  EXPECT_EQ(to_whole<int>(2147483648.0), 2147483647);
  EXPECT_EQ(to_whole<int>(-2147483649.0), -2147483647 - 1);
}

TEST(ToWhole, KeepsBetweenBounds) {
  for (const double x : {-1e300, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(to_whole<int>(x, 0.0, 7.0), 0);
  EXPECT_EQ(to_whole<std::size_t>(6.9, 0.0, 7.0), 6u);
  EXPECT_EQ(to_whole<std::size_t>(1e300, 0.0, 7.0), 7u);
}

}  // namespace
}  // namespace treadmark
