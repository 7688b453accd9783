// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/key_function.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace treadmark::io {
namespace {

TEST(KeyFunction, CallsWhatItHoldsWithTheArgumentsThemselves) {
  double number = 1.0;
  const KeyFunction<double&(double&)> same = [](double& x) -> double& { return x; };
  same(number) = 2.0;
  EXPECT_EQ(number, 2.0);
  // a result that nobody wants, one that is converted, and a function without state
  const KeyFunction<void(double&)> set = [](double& x) { return ++x; };
  set(number);
  EXPECT_EQ(number, 3.0);
  const KeyFunction<double(int)> half = [](int x) { return x / 2; };
  EXPECT_EQ(half(5), 2.0);
  const KeyFunction<std::string(int)> text = static_cast<std::string (*)(int)>(std::to_string);
  EXPECT_EQ(text(7), "7");
}

TEST(KeyFunction, IsNoneUntilItHoldsOneAndCopiesShareIt) {
  KeyFunction<int()> none;
  EXPECT_FALSE(none);
  const auto kept = std::make_shared<int>(4);
  KeyFunction<int()> first = [kept] { return *kept; };
  const KeyFunction<int()> second = first;
  EXPECT_EQ(kept.use_count(), 2);
  first = [before = std::move(first)] { return 1 + before(); };
  EXPECT_EQ(first(), 5);
  EXPECT_EQ(second(), 4);
  first = {};
  EXPECT_FALSE(first);
  EXPECT_TRUE(second);
}

TEST(KeyFunction, IsMadeOfWhatCanBeCalledSoAlone) {
  const auto takes_text = [](const std::string&) { return 1; };
  static_assert(std::is_convertible_v<decltype(takes_text), KeyFunction<int(std::string)>>);
  static_assert(!std::is_convertible_v<decltype(takes_text), KeyFunction<int(double)>>);
  static_assert(!std::is_convertible_v<decltype(takes_text), KeyFunction<std::string(std::string)>>);
}

}  // namespace
}  // namespace treadmark::io
