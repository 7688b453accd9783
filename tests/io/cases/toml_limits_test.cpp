// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string>

#include <fmt/format.h>

#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace {
std::atomic<std::size_t> bytes_taken{0};  // of this whole program
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  bytes_taken += size;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  bytes_taken += size;
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::error_of;

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}
std::string parse_error(const std::string& text) {
  return error_of([&] { parse_toml(text, "a.toml"); });
}

/// A value at a depth, in all the ways in which TOML nests, without and with things that only look like it.
std::string nested(int way, int depth) {
  switch (way) {
    case 0:
      return "a" + repeated(".a", depth - 1) + " = 1\n";
    case 1:
      return "[a" + repeated(".a", depth - 2) + "]\nb = 1.5\n";
    case 2:
      return "[[a" + repeated(".a", depth - 2) + "]]\nb = 1\n";
    case 3:
      return "a = " + repeated("[", depth - 1) + repeated("]", depth - 1) + "\n";
    case 4:
      return "[x.y]\n[a.'b.c']\n" + repeated("a = {b = 1.5, ", (depth - 3)) + "c = 1" + repeated("}", depth - 3) + "\n";
    case 5:
      return "a = [1.5, {'a\"'.\"b\\\".\" = {c" + repeated(".\"d\"", depth - 5) + " = 1 }}, 2.5]\n";
    default:
      return "s = '''[[[ '' a.b\n''''' # [[[ ''' \"\nt = \"\"\"\"[ \\\"\"\" [\"\"\"\n[a.b] # 'x\nc = [ # [[\n" +
             repeated("[", depth - 4) + repeated("]", depth - 4) + "\n]\n";
  }
}

class TomlNesting : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ways, TomlNesting, ::testing::Range(0, 7));

TEST_P(TomlNesting, HasALimit) {
  EXPECT_EQ(parse_error(nested(GetParam(), 100)), "");
  for (const int depth : {101, 200, 20000, 200000})
    EXPECT_THAT(parse_error(nested(GetParam(), depth)), HasSubstr("nested deeper than 100 tables and lists")) << depth;
}

TEST(TomlNestingError, NamesThePlace) {
  EXPECT_EQ(parse_error("a = 1\n" + nested(0, 20000)),
            "configuration: a.toml:2:200: nested deeper than 100 tables and lists");
  EXPECT_EQ(parse_error("[t]\nµ = 'ä' # ö\n\"µ\" = " + repeated("[", 300)),
            "configuration: a.toml:3:105: nested deeper than 100 tables and lists");
}

TEST(TomlNestingError, HoldsForOverrides) {
  for (const std::string& text : {"a" + repeated(".a", 20000) + "=1", "a=" + repeated("[", 20000),
                                  "a=" + repeated("{a=", 20000), "a={a" + repeated(".a", 20000) + "=1}"}) {
    EXPECT_THAT(error_of([&] { parse_override(text); }), HasSubstr("nested deeper than 100")) << text.substr(0, 10);
  }
  EXPECT_EQ(parse_override("file=../a" + repeated(".b", 200)).value.text(), "../a" + repeated(".b", 200));
}

std::size_t bytes_to_read(int count) {
  std::string list, text = "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n[[cases]]\n";
  for (int i = 0; i < count; ++i) list += fmt::format("{}{:.4f}", i > 0 ? ", " : "", 1e-4 * i);
  text += fmt::format("wheelset.vertical_force_N = 1e5\nwheelset.pitch_deg = [{0}]\nwheelset.y_mm = [{0}]\n", list);
  const std::size_t before = bytes_taken;
  EXPECT_EQ(parse_case_text(text, "a.toml").cases.size(), static_cast<std::size_t>(count));
  return bytes_taken - before;
}

TEST(TomlLists, CostMemoryInProportionToTheirLength) {
  bytes_to_read(1);  // what is made at the first use
  EXPECT_LT(bytes_to_read(4000), 3 * bytes_to_read(2000)) << "twice the cases, twice the work";
}

TEST(TomlLists, MayBeLong) { bytes_to_read(20000); }

}  // namespace
}  // namespace treadmark::io
