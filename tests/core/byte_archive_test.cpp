// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/platform/bit_cast.hpp"

namespace treadmark {
namespace {

enum class Colour : std::uint8_t { red, green, blue };

const std::vector<double> kNumbers{0.1, -0.0, std::numeric_limits<double>::denorm_min(),
                                   std::numeric_limits<double>::infinity(),
                                   bit_cast<double>(std::uint64_t{0x7ff8000000000abc})};

ByteWriter one_of_each() {
  ByteWriter out;
  out.put(true);
  out.put(-7);
  out.put(std::uint64_t{1} << 63);
  out.put(Colour::blue);
  out.put(std::string("z\0x", 3));
  out.put(kNumbers);
  out.put(std::span<const Colour>(std::vector{Colour::green, Colour::red}));
  out.put(std::vector<double>{});
  return out;
}

void read_one_of_each(ByteReader& in) {
  EXPECT_TRUE(in.get<bool>());
  EXPECT_EQ(in.get<int>(), -7);
  EXPECT_EQ(in.get<std::uint64_t>(), std::uint64_t{1} << 63);
  EXPECT_EQ(in.get<Colour>(), Colour::blue);
  std::string text;
  in.get(text);
  EXPECT_EQ(text, std::string("z\0x", 3));
  std::vector<double> numbers{1.0, 2.0};
  in.get(numbers);
  ASSERT_EQ(numbers.size(), kNumbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(bit_cast<std::uint64_t>(numbers[i]), bit_cast<std::uint64_t>(kNumbers[i])) << i;
  std::vector<Colour> colours;
  in.get(colours);
  EXPECT_EQ(colours, (std::vector{Colour::green, Colour::red}));
  in.get(numbers);
  EXPECT_TRUE(numbers.empty());
}

ErrorKind kind_of_error(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "no error";
  return ErrorKind::numerical;
}

TEST(ByteArchive, GivesEveryBitBackInOrder) {
  const ByteWriter out = one_of_each();
  ByteReader in(out.bytes());
  EXPECT_FALSE(in.at_end());
  read_one_of_each(in);
  EXPECT_TRUE(in.at_end());
}

TEST(ByteArchive, RefusesBytesThatEndTooEarlyWhereverTheyEnd) {
  const ByteWriter out = one_of_each();
  for (std::size_t length = 0; length < out.bytes().size(); ++length) {
    ByteReader in(std::span(out.bytes()).first(length));
    EXPECT_EQ(kind_of_error([&] { read_one_of_each(in); }), ErrorKind::input_data) << length;
  }
}

TEST(ByteArchive, RefusesACountBeyondTheBytesBeforeItTakesMemory) {
  for (const std::size_t count : {std::size_t{2}, std::size_t{1} << 61, std::numeric_limits<std::size_t>::max()}) {
    ByteWriter out;
    out.put(count);
    out.put(1.0);
    ByteReader in(out.bytes());
    std::vector<double> numbers;
    EXPECT_EQ(kind_of_error([&] { in.get(numbers); }), ErrorKind::input_data) << count;
  }
}

TEST(ByteArchive, AnyByteThatIsNotZeroIsTrue) {
  ByteWriter out;
  out.put(std::uint8_t{2});
  ByteReader in(out.bytes());
  EXPECT_EQ(static_cast<int>(in.get<bool>()), 1);
}

TEST(GridArchive, GivesAGridAndItsFieldBack) {
  const Grid2 grid{-1.5e-3, 2e-4, 5e-4, 3e-4, 3, 2};
  ByteWriter out;
  write(grid, out);
  write(Grid2{}, out);
  out.put(std::vector<double>{1, 2, 3, 4, 5, 6});
  ByteReader in(out.bytes());
  EXPECT_EQ(read_grid(in), grid);
  EXPECT_EQ(read_grid(in), Grid2{});
  std::vector<double> field;
  read_field(in, grid, false, field);
  EXPECT_EQ(field[5], 6.0);
}

TEST(GridArchive, RefusesWhatIsNoGridAndWhatIsNoFieldOnIt) {
  const double nan = std::nan("");
  const Grid2 good{0.0, 0.0, 1e-3, 1e-3, 2, 2};
  for (const auto& spoil : std::vector<std::function<void(Grid2&)>>{
           [&](Grid2& g) { g.x0 = nan; }, [&](Grid2& g) { g.dx = -g.dx; }, [&](Grid2& g) { g.dy = 0.0; },
           [&](Grid2& g) { g.nx = 0; }, [&](Grid2& g) { g.ny = -3; }}) {
    Grid2 bad = good;
    spoil(bad);
    ByteWriter out;
    write(bad, out);
    ByteReader in(out.bytes());
    EXPECT_EQ(kind_of_error([&] { read_grid(in); }), ErrorKind::input_data);
  }
  for (const auto& [values, may_be_empty] :
       std::vector<std::pair<std::vector<double>, bool>>{{{}, false}, {{1, 2, 3}, true}, {{1, 2, 3, nan}, true}}) {
    ByteWriter out;
    out.put(values);
    ByteReader in(out.bytes());
    std::vector<double> field;
    EXPECT_EQ(kind_of_error([&] { read_field(in, good, may_be_empty, field); }), ErrorKind::input_data);
  }
}

}  // namespace
}  // namespace treadmark
