// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/bit_cast.hpp"
#include "treadmark/core/platform/elliptic_integrals.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/own_from_chars.hpp"
#include "treadmark/core/platform/own_ranges.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/platform/to_chars.hpp"

// What stands in for missing parts of a standard library is tested beside every library. Where this one has the part,
// `ranges` and std are what it is compared with.
namespace treadmark {
namespace {

struct Ranked {
  int rank, place;
  bool is_even() const { return rank % 2 == 0; }
  bool operator==(const Ranked&) const = default;
};

/// Few ranks, so that there are equals.
std::vector<Ranked> some_ranked(std::mt19937& random) {
  std::vector<Ranked> out(random() % 20 + 1);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {static_cast<int>(random() % 7), static_cast<int>(i)};
  return out;
}

TEST(OwnToChars, WritesWhatTheStandardWrites) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const double value = std::ldexp(static_cast<double>(random()) - 9e18, static_cast<int>(random() % 200) - 163);
    for (const int digits : {1, 4, 12, 17}) {
      char own[32], standard[32];
      EXPECT_EQ(std::string(own, platform::own_write_digits(own, std::end(own), value, digits)),
                std::string(standard, write_digits(standard, std::end(standard), value, digits)));
    }
  }
}

TEST(OwnRanges, AnswerAsThoseOfTheStandard) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Ranked> v = some_ranked(random);
    const std::vector<Ranked> w = some_ranked(random);
    const int rank = static_cast<int>(random() % 8);
    const auto below = [rank](int r) { return r < rank; };
    EXPECT_EQ(own_ranges::find(v, rank, &Ranked::rank), ranges::find(v, rank, &Ranked::rank));
    EXPECT_EQ(own_ranges::find_if(v, below, &Ranked::rank), ranges::find_if(v, below, &Ranked::rank));
    EXPECT_EQ(own_ranges::find_if_not(v, &Ranked::is_even), ranges::find_if_not(v, &Ranked::is_even));
    EXPECT_EQ(own_ranges::count(v, rank, &Ranked::rank), ranges::count(v, rank, &Ranked::rank));
    EXPECT_EQ(own_ranges::count_if(v, &Ranked::is_even), ranges::count_if(v, &Ranked::is_even));
    EXPECT_EQ(own_ranges::all_of(v, &Ranked::is_even), ranges::all_of(v, &Ranked::is_even));
    EXPECT_EQ(own_ranges::any_of(v, below, &Ranked::rank), ranges::any_of(v, below, &Ranked::rank));
    EXPECT_EQ(own_ranges::none_of(v, below, &Ranked::rank), ranges::none_of(v, below, &Ranked::rank));
    EXPECT_EQ(own_ranges::min_element(v, {}, &Ranked::rank), ranges::min_element(v, {}, &Ranked::rank));
    EXPECT_EQ(own_ranges::max_element(v, {}, &Ranked::rank), ranges::max_element(v, {}, &Ranked::rank));
    EXPECT_EQ(own_ranges::min(v, std::greater<>(), &Ranked::rank), ranges::min(v, std::greater<>(), &Ranked::rank));
    EXPECT_EQ(own_ranges::max(v, {}, &Ranked::rank), ranges::max(v, {}, &Ranked::rank));
    const auto own = own_ranges::minmax_element(v, {}, &Ranked::rank);
    const auto known = ranges::minmax_element(v, {}, &Ranked::rank);
    EXPECT_EQ(own.min, known.min);
    EXPECT_EQ(own.max, known.max);
    EXPECT_EQ(own_ranges::minmax(v, {}, &Ranked::rank).max, ranges::minmax(v, {}, &Ranked::rank).max);
    EXPECT_EQ(own_ranges::equal(v, w, {}, &Ranked::rank, &Ranked::rank),
              ranges::equal(v, w, {}, &Ranked::rank, &Ranked::rank));
    const auto falls = [](const Ranked& a, const Ranked& b) { return a.rank > b.rank; };
    EXPECT_EQ(own_ranges::adjacent_find(v, falls), ranges::adjacent_find(v, falls));
    std::vector<Ranked> sorted = v;
    own_ranges::stable_sort(v, {}, &Ranked::rank);
    ranges::stable_sort(sorted, {}, &Ranked::rank);
    EXPECT_EQ(v, sorted);
    EXPECT_EQ(own_ranges::lower_bound(v, rank, {}, &Ranked::rank), ranges::lower_bound(v, rank, {}, &Ranked::rank));
    EXPECT_EQ(own_ranges::upper_bound(v, rank, {}, &Ranked::rank), ranges::upper_bound(v, rank, {}, &Ranked::rank));
  }
}

TEST(OwnRanges, SayByHandWhatIsEqualAndFirst) {
  const std::vector<Ranked> v{{3, 0}, {1, 1}, {3, 2}, {1, 3}};
  EXPECT_EQ(own_ranges::max_element(v, {}, &Ranked::rank)->place, 0);
  EXPECT_EQ(own_ranges::min_element(v, {}, &Ranked::rank)->place, 1);
  EXPECT_EQ(own_ranges::minmax(v, {}, &Ranked::rank).min.place, 1);
  EXPECT_EQ(own_ranges::minmax(v, {}, &Ranked::rank).max.place, 2);
  EXPECT_EQ(own_ranges::find_if(v.rbegin(), v.rend(), [](const Ranked& r) { return r.rank == 3; })->place, 2);
  EXPECT_FALSE(own_ranges::equal(v, std::vector<Ranked>(v.begin(), v.end() - 1)));
  const int rising[] = {1, 2, 2, 5};
  EXPECT_EQ(own_ranges::lower_bound(rising, 2), rising + 1);
  EXPECT_EQ(own_ranges::upper_bound(rising, 2), rising + 3);
  EXPECT_TRUE(own_ranges::binary_search(rising, 5));
  EXPECT_FALSE(own_ranges::binary_search(rising, 3));
  EXPECT_TRUE(own_ranges::is_sorted(rising));
  EXPECT_FALSE(own_ranges::is_sorted(rising, std::less_equal<>()));
}

TEST(OwnRanges, ChangeWhatTheyAreGiven) {
  std::vector<int> v{4, 2, 9, 2, 7}, out;
  own_ranges::sort(v, std::greater<>());
  EXPECT_EQ(v, (std::vector{9, 7, 4, 2, 2}));
  own_ranges::reverse(v);
  own_ranges::replace(v, 2, 3);
  own_ranges::replace_if(
      v, [](int x) { return x > 8; }, 0);
  EXPECT_EQ(v, (std::vector{3, 3, 4, 7, 0}));
  own_ranges::copy_if(v, std::back_inserter(out), [](int x) { return x > 3; });
  own_ranges::copy(out, std::back_inserter(v));
  EXPECT_EQ(v, (std::vector{3, 3, 4, 7, 0, 4, 7}));
  own_ranges::transform(out, out.begin(), std::negate<>());
  own_ranges::transform(out, v, out.begin(), std::plus<>());
  EXPECT_EQ(out, (std::vector{-1, -4}));
  own_ranges::for_each(out, [](int& x) { x *= 2; });
  EXPECT_EQ(out, (std::vector{-2, -8}));
  own_ranges::fill(out, 1);
  EXPECT_EQ(out, (std::vector{1, 1}));
  std::vector<int> heap;
  for (const int x : {3, 8, 5}) {
    heap.push_back(x);
    own_ranges::push_heap(heap);
  }
  for (const int largest : {8, 5, 3}) {
    own_ranges::pop_heap(heap);
    EXPECT_EQ(heap.back(), largest);
    heap.pop_back();
  }
  std::vector<int> shuffled{1, 2, 3, 4, 5, 6, 7, 8};
  const std::vector<int> before = shuffled;
  own_ranges::shuffle(shuffled, std::mt19937(3));
  EXPECT_NE(shuffled, before);
  own_ranges::sort(shuffled);
  EXPECT_EQ(shuffled, before);
}

using Reader = std::from_chars_result (*)(const char*, const char*, double&);

/// Ours, and the one that the sources use.
const Reader kReaders[] = {&platform::from_chars, [](const char* first, const char* last, double& value) {
                             return from_chars(first, last, value);
                           }};

TEST(FromChars, TakesOfATextWhatTheStandardSays) {
  constexpr double kUntouched = -7.0;
  struct Row {
    std::string text;
    std::ptrdiff_t taken;  ///< characters; none: no number
    double value;          ///< kUntouched: there is none
  };
  const Row rows[] = {
      {"", 0, kUntouched},
      {"-", 0, kUntouched},
      {".", 0, kUntouched},
      {"-.", 0, kUntouched},
      {"+1", 0, kUntouched},
      {" 1", 0, kUntouched},
      {"e5", 0, kUntouched},
      {".e5", 0, kUntouched},
      {".5", 2, 0.5},
      {"5.", 2, 5.0},
      {"-0.0", 4, -0.0},
      {"00012", 5, 12.0},
      {"1..2", 2, 1.0},
      {"1,5", 1, 1.0},
      {"1_000", 1, 1.0},
      {"0x1p3", 1, 0.0},
      {"1e", 1, 1.0},
      {"1e+", 1, 1.0},
      {"1ex", 1, 1.0},
      {"1.e5", 4, 1e5},
      {"1E+00005", 8, 1e5},
      {"1e5.5", 3, 1e5},
      {"0.1d5", 3, 0.1},
      {"0e99999999999999999999", 22, 0.0},
      {"1.7976931348623157e308", 22, std::numeric_limits<double>::max()},
      {"1.7976931348623159e308", 22, kUntouched},
      {"-1e99999999999999999999", 23, kUntouched},
      {"4e-324", 6, std::numeric_limits<double>::denorm_min()},
      {"2e-324", 6, kUntouched},
      {"1e-99999999999999999999", 23, kUntouched},
      {"2.2250738585072011e-308", 23, 0x0.fffffffffffffp-1022},
      {"9007199254740993", 16, 9007199254740992.0},
      {"9007199254740993.00000000000000000000000000000000000000001", 58, 9007199254740994.0},
      {"123456789012345678901234567890", 30, 123456789012345678901234567890.0},
      {"infinit", 3, kInfinity},
      {"-INFINITYx", 9, -kInfinity},
      {"inf", 3, kInfinity},
      {"nan", 3, kNaN},
      {"NaN(1_a)x", 8, kNaN},
      {"nan(a-b)", 3, kNaN},
      {"nan(", 3, kNaN},
      {"nonsense", 0, kUntouched},
      {"0." + std::string(400, '0') + "1e401", 407, 1.0},
      {"1" + std::string(400, '0') + "e-400", 406, 1.0},
  };
  for (const Reader& read : kReaders)
    for (const Row& row : rows) {
      const std::string text = row.text + std::string("\0", 1);  // nothing beyond the end is looked at
      double value = kUntouched;
      const auto [end, error] = read(text.data(), text.data() + row.text.size(), value);
      EXPECT_EQ(end - text.data(), row.taken) << row.text;
      const bool none = row.value == kUntouched;
      EXPECT_EQ(error == std::errc{}, !none) << row.text;
      if (none) {
        EXPECT_EQ(error, row.taken == 0 ? std::errc::invalid_argument : std::errc::result_out_of_range) << row.text;
      }
      if (std::isnan(row.value))
        EXPECT_TRUE(std::isnan(value)) << row.text;
      else
        EXPECT_EQ(bit_cast<std::uint64_t>(value), bit_cast<std::uint64_t>(row.value)) << row.text;
    }
}

TEST(FromChars, RoundsRightHoweverManyDigits) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 20000; ++trial) {
    const double number = bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    const double usual = std::ldexp(static_cast<double>(random() % 2'000'000) - 1e6, -static_cast<int>(random() % 40));
    for (const double wanted : {number, usual}) {
      char text[1200];
      const int length =
          std::snprintf(text, sizeof text, trial % 2 == 0 ? "%.*e" : "%.*g", static_cast<int>(random() % 25), wanted);
      const double known = std::strtod(text, nullptr);
      for (const Reader& read : kReaders) {
        double value = 0.0;
        const auto [end, error] = read(text, text + length, value);
        EXPECT_EQ(end, text + length) << text;
        if (std::isinf(known))
          EXPECT_EQ(error, std::errc::result_out_of_range) << text;
        else
          EXPECT_EQ(bit_cast<std::uint64_t>(value), bit_cast<std::uint64_t>(known)) << text;
      }
    }
  }
}

TEST(EllipticIntegrals, AreThoseOfTheTrapezoidalRule) {
  for (const double k : {0.0, 1e-5, 0.1, 0.5, 0.9, 0.99}) {
    double first = 0.0, second = 0.0;
    constexpr int kPoints = 400;  // periodic: errors fall like e^-n
    for (int i = 0; i < kPoints; ++i) {
      const double s = k * std::sin(kPi * i / kPoints), root = std::sqrt(1.0 - s * s);
      first += 0.5 * kPi / kPoints / root;
      second += 0.5 * kPi / kPoints * root;
    }
    constexpr double kSums = 1e-13, kGcc = 1e-12;  // of so many terms; of Carlson's iteration in GCC's library
    EXPECT_NEAR(platform::comp_ellint_1(k), first, kSums);
    EXPECT_NEAR(platform::comp_ellint_2(k), second, kSums);
    EXPECT_NEAR(comp_ellint_1(k), first, kGcc);
    EXPECT_NEAR(comp_ellint_2(k), second, kGcc);
  }
  EXPECT_EQ(platform::comp_ellint_2(1.0), 1.0);
  EXPECT_TRUE(std::isnan(platform::comp_ellint_1(1.0)));
  // ln(4/k') + (ln(4/k') - 1) k'^2 / 4 for k' = 1e-3
  const double k = std::sqrt((1.0 - 1e-3) * (1.0 + 1e-3)), large = std::log(4e3);
  EXPECT_NEAR(platform::comp_ellint_1(k), large + 0.25e-6 * (large - 1.0), 1e-9);
}

}  // namespace
}  // namespace treadmark
