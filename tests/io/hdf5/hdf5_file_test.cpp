// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using treadmark::testing::content_of;

template <class Action>
ErrorKind kind_of_error(Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_FALSE(error.message().empty());
    return error.kind();
  }
  ADD_FAILURE() << "no error";
  return ErrorKind::numerical;
}

class Hdf5File : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.h5";
};

TEST_F(Hdf5File, ColumnsAreFilledInAnyOrder) {
  using Kind = io::Hdf5Column::Kind;
  constexpr std::size_t kRows = 100000;
  const std::vector<io::Hdf5Column> columns{{"a.b", "m", "length", Kind::number, kRows, 8},
                                            {"code", "1", "0 good", Kind::byte, kRows, 1},
                                            {"text", "1", "said", Kind::text, 3, 12},
                                            {"none", "1", "", Kind::number, 0, 8}};
  const std::vector<io::Attribute> head{{"format", std::string("x")}, {"count", 3}};
  const auto write = [&](const std::filesystem::path& file, std::size_t piece) {
    io::Hdf5ColumnFile out(file, head, columns);
    for (std::size_t end = kRows; end > 0; end -= piece) {  // the last rows first
      std::vector<double> numbers;
      std::vector<std::uint8_t> codes;
      for (std::size_t i = end - piece; i < end; ++i) {
        numbers.push_back(static_cast<double>(i) / 3.0);
        codes.push_back(static_cast<std::uint8_t>(i % 251));
      }
      out.write(0, end - piece, numbers);
      out.write(1, end - piece, codes);
    }
    out.write(2, 2, "größe <12");
    out.write(2, 0, "");
    out.write(2, 1, "twelve bytes");
    out.finish();
  };
  write(path_, 1000);
  {
    const io::Hdf5Reader file(path_);
    EXPECT_EQ(file.root().text("format"), "x");
    EXPECT_EQ(file.root().text_of("a.b", "unit"), "m");
    const std::vector<double> numbers = file.root().numbers("a.b", {kRows});
    const std::vector<std::uint8_t> codes = file.root().bytes("code");
    for (std::size_t i = 0; i < kRows; i += 777) {
      EXPECT_EQ(numbers[i], static_cast<double>(i) / 3.0);
      EXPECT_EQ(codes[i], i % 251);
    }
    EXPECT_TRUE(file.root().numbers("none").empty());
  }
  write(folder_.path() / "other.h5", kRows);
  const std::string bytes = content_of(path_);
  EXPECT_EQ(content_of(folder_.path() / "other.h5"), bytes);
  EXPECT_NE(bytes.find("twelve bytes"), std::string::npos);
  // a changed byte is noticed
  std::string damaged = bytes;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  std::ofstream(path_, std::ios::binary) << damaged;
  EXPECT_EQ(kind_of_error([&] { io::Hdf5Reader{path_}; }), ErrorKind::input_data);
}

TEST_F(Hdf5File, ValuesOfEveryKindComeBack) {
  std::vector<double> numbers;
  for (int i = 0; i < 40000; ++i) numbers.push_back(i / 7.0);  // more than a chunk
  numbers[3] = -std::numeric_limits<double>::infinity();
  const std::vector<std::uint8_t> bytes{0, 255, 7};
  const std::vector<std::string> texts{"", "µ <x>", std::string(100000, 'a')};
  {
    io::Hdf5Writer file(path_);
    const io::Hdf5GroupWriter group = file.root().make_group("group").make_group("inner.one");
    group.add({"word", std::string("größe")});
    group.add({"words", texts});
    group.write({"numbers", {200, 200}, "m", "what they are", true}, numbers);
    group.write({"bytes", {3}, "1", "", true}, bytes);
    group.write({"texts", {3}, "1", ""}, texts);
    group.write({"none", {0}, "1", "", true}, std::span<const double>());
    group.write({"no texts", {0}, "1", ""}, std::vector<std::string>());
    const double one = 5.0;
    group.write({"one", {}, "s", ""}, {&one, 1});
    file.commit();
  }
  const io::Hdf5Reader file(path_);
  EXPECT_TRUE(file.root().has("group"));
  EXPECT_FALSE(file.root().has("inner.one"));
  const io::Hdf5GroupReader group = file.root().open_group("group").open_group("inner.one");
  EXPECT_EQ(group.text("word"), "größe");
  EXPECT_EQ(group.texts("words"), texts);
  EXPECT_EQ(group.numbers("numbers"), numbers);
  EXPECT_EQ(group.text_of("numbers", "meaning"), "what they are");
  EXPECT_EQ(group.bytes("bytes"), bytes);
  EXPECT_EQ(group.strings("texts"), texts);
  EXPECT_TRUE(group.numbers("none").empty());
  EXPECT_TRUE(group.strings("no texts").empty());
  EXPECT_EQ(group.numbers("one"), std::vector<double>{5.0});
}

// The library takes chunks apart that were compressed without it.
TEST_F(Hdf5File, CompressedValuesOfEveryShapeComeBackAndTheirBytesDoNotDependOnThreads) {
  const std::vector<std::vector<std::size_t>> shapes{{1},        {16384},     {16385},       {40000},   {3, 1000},
                                                     {513, 512}, {700, 1100}, {2, 129, 130}, {5, 4, 3}, {3, 2, 150, 9}};
  std::vector<std::vector<double>> numbers(shapes.size());
  std::vector<std::vector<std::uint8_t>> bytes(shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    std::size_t count = 1;
    for (const std::size_t length : shapes[k]) count *= length;
    for (std::size_t i = 0; i < count; ++i) {
      numbers[k].push_back(static_cast<double>(i * i % 1013) / 7.0);
      bytes[k].push_back(static_cast<std::uint8_t>(i * i % 251));
    }
  }
  std::vector<std::string> files;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    io::Hdf5Writer file(path_);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const io::Hdf5GroupWriter group = file.root().make_group(std::to_string(k));
      group.write({"numbers", shapes[k], "m", "", true}, numbers[k]);
      group.write({"bytes", shapes[k], "1", "", true}, bytes[k]);
    }
    file.commit();
    files.push_back(content_of(path_));
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_LT(files[0].size(), 3'000'000u);  // a third of the values
  const io::Hdf5Reader file(path_);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const io::Hdf5GroupReader group = file.root().open_group(std::to_string(k));
    EXPECT_EQ(group.numbers("numbers", shapes[k]), numbers[k]) << k;
    EXPECT_EQ(group.bytes("bytes", shapes[k]), bytes[k]) << k;
  }
}

TEST_F(Hdf5File, ACopiedFileIsAGroup) {
  for (const char* name : {"one.h5", "two.h5"}) {
    io::Hdf5Writer file(folder_.path() / name);
    file.root().add({"name", std::string(name)});
    file.root().make_group("part").write({"texts", {1}, "1", ""}, std::vector<std::string>{name});
    file.commit();
  }
  io::Hdf5Writer file(path_);
  file.root().copy_file(folder_.path() / "one.h5", "first");
  file.root().copy_file(folder_.path() / "two.h5", "second");
  EXPECT_EQ(kind_of_error([&] { file.root().copy_file(folder_.path() / "three.h5", "third"); }), ErrorKind::input_data);
  file.commit();
  const io::Hdf5Reader read(path_);
  EXPECT_EQ(read.root().open_group("second").text("name"), "two.h5");
  EXPECT_EQ(read.root().open_group("first").open_group("part").strings("texts"), std::vector<std::string>{"one.h5"});
}

TEST_F(Hdf5File, WrongNamesShapesAndKindsAreErrors) {
  const std::vector<double> two{1.0, 2.0};
  {
    io::Hdf5Writer file(path_);
    for (const std::string name : {"", ".", "a/b", "/"}) {
      EXPECT_EQ(kind_of_error([&] { file.root().make_group(name); }), ErrorKind::configuration);
      EXPECT_EQ(kind_of_error([&] { file.root().write({name, {2}, "1", ""}, two); }), ErrorKind::configuration);
    }
    EXPECT_EQ(kind_of_error([&] { file.root().write({"two", {3}, "1", ""}, two); }), ErrorKind::configuration);
    EXPECT_EQ(kind_of_error([&] { file.root().write({"two", {}, "1", ""}, two); }), ErrorKind::configuration);
    file.root().write({"two", {2}, "1", ""}, two);
    EXPECT_EQ(kind_of_error([&] { file.root().make_group("two"); }), ErrorKind::configuration);  // there already
    file.root().add({"number", 2});
    file.commit();
  }
  const io::Hdf5Reader file(path_);
  EXPECT_EQ(kind_of_error([&] { file.root().strings("two"); }), ErrorKind::input_data);
  EXPECT_EQ(kind_of_error([&] { file.root().numbers("three"); }), ErrorKind::input_data);
  EXPECT_EQ(kind_of_error([&] { file.root().open_group("two"); }), ErrorKind::input_data);
  EXPECT_EQ(kind_of_error([&] { file.root().text("number"); }), ErrorKind::input_data);
  EXPECT_EQ(kind_of_error([&] { file.root().text("none"); }), ErrorKind::input_data);
  EXPECT_EQ(kind_of_error([&] { io::Hdf5Writer(path_ / "a.h5").commit(); }), ErrorKind::configuration);
}

struct SmallFile {
  std::vector<double> compressed, plain;
  std::string text;
  bool operator==(const SmallFile&) const = default;
};

void write_small(const std::filesystem::path& path, const SmallFile& content) {
  io::Hdf5Writer file(path);
  file.root().add({"text", content.text});
  file.root().write({"compressed", {content.compressed.size() / 4, 4}, "Pa", "numbers", true}, content.compressed);
  file.root().write({"plain", {content.plain.size()}, "m", "numbers"}, content.plain);
  file.commit();
}

SmallFile read_small(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  return {file.root().has("compressed") ? file.root().numbers("compressed") : std::vector<double>(),
          file.root().has("plain") ? file.root().numbers("plain") : std::vector<double>(), file.root().text("text")};
}

SmallFile small_content() {
  SmallFile content{{}, {}, "a text that says something"};
  for (int i = 0; i < 2400; ++i) content.compressed.push_back(1e9 / (1 + i));  // two chunks
  for (int i = 0; i < 20; ++i) content.plain.push_back(0.1 * i);
  return content;
}

/// Reads a file of that content with each of these bits flipped in turn: how often that is refused.
int refused_of(const std::filesystem::path& path, const SmallFile& content, const std::vector<std::size_t>& bits) {
  const std::string sound = content_of(path);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const auto put = [&](std::size_t at, int byte) {
    file.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(byte)).flush();
  };
  int refused = 0;
  for (const std::size_t bit : bits) {
    put(bit / 8, sound[bit / 8] ^ 1 << bit % 8);
    try {
      EXPECT_EQ(read_small(path), content) << "bit " << bit;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data);
      ++refused;
    }
    put(bit / 8, sound[bit / 8]);
  }
  EXPECT_TRUE(file);
  EXPECT_EQ(content_of(path), sound);
  return refused;
}

TEST_F(Hdf5File, NoFlippedBitIsSilent) {
  const SmallFile content = small_content();
  write_small(path_, content);
  std::vector<std::size_t> bits(content_of(path_).size());
  for (std::size_t k = 0; k < bits.size(); ++k) bits[k] = 8 * k + k % 8;
  // all but the name of the check sum, without which nothing is checked
  EXPECT_GE(refused_of(path_, content, bits), static_cast<int>(bits.size()) - 16);
}

TEST_F(Hdf5File, AChunkThatIsLostIsNoZeros) {
  const SmallFile content = small_content();
  write_small(path_, content);
  std::string sound = content_of(path_);
  sound.resize(sound.size() - 24);  // as earlier versions wrote it
  std::ofstream(path_, std::ios::binary) << sound;
  ASSERT_EQ(read_small(path_), content);
  // The nodes of the index (HDF5 File Format Specification, III.A.1), which has no check sum.
  const std::string node{"TREE\1\0", 6};
  int found = 0, refused = 0;
  for (std::size_t at = sound.find(node); at != std::string::npos; at = sound.find(node, at + 1), ++found) {
    constexpr std::size_t kHead = 24, kEntries = 2 * 40 + 32;
    std::vector<std::size_t> bits(8 * kEntries);
    std::iota(bits.begin(), bits.end(), 8 * (at + kHead));
    refused += refused_of(path_, content, bits);
  }
  EXPECT_EQ(found, 1);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace treadmark
