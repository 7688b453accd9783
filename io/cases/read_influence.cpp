// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/read_influence.hpp"

#include <array>
#include <string>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

namespace {

using profiles::LineScanner;
using profiles::Word;

constexpr std::size_t kEntries = 9;
constexpr std::size_t kWords = kEntries + 2;          // with ix and x
constexpr std::size_t kShortestRow = 2 * kWords - 1;  // one digit each, blanks between
constexpr int kMostHeaderLines = 4;
/// nn, nx, ny, xn, xx, xy, yn, yx, yy at -x.
constexpr std::array<double, kEntries> kMirrored{1, -1, 1, -1, 1, -1, 1, -1, 1};

class InfluenceReader {
 public:
  InfluenceReader(std::string_view text, const std::string& name) : scanner_(text, name), size_(text.size()) {}

  NumericalInfluence read() {
    read_header();
    NumericalInfluence table;
    table.nx = 2 * mx_ - 1;
    table.ny = 2 * my_ - 1;
    table.dx = dx_;
    table.dy = dy_;
    table.values.resize(static_cast<std::size_t>(table.nx) * static_cast<std::size_t>(table.ny));
    for (int iy = 0; iy < table.ny; ++iy)
      for (int ix = 0; ix < mx_; ++ix) {
        const auto entries = read_row(ix, iy - my_ + 1);
        const std::size_t middle =
            static_cast<std::size_t>(iy) * static_cast<std::size_t>(table.nx) + static_cast<std::size_t>(mx_ - 1);
        const auto offset = static_cast<std::size_t>(ix);
        table.values[middle + offset] = entries;
        if (ix == 0) continue;
        for (std::size_t k = 0; k < kEntries; ++k) table.values[middle - offset][k] = kMirrored[k] * entries[k];
      }
    return table;
  }

 private:
  void read_header() {
    begin("the line NMATRIX IACONVX");
    only(integer("NMATRIX"), 1, "NMATRIX", "one matrix for all rows is");
    only(integer("IACONVX"), 1, "IACONVX", "1, body 1 is the rail, is");
    begin("the line LQUASID XYZORDR");
    only(integer("LQUASID"), 0, "LQUASID", "0 is");
    only(integer("XYZORDR"), 312, "XYZORDR", "312, the order n, x, y, is");
    begin("the line ISYMMX ISYMMY");
    only(integer("ISYMMX"), 1, "ISYMMX", "1, symmetric in x, is");
    only(integer("ISYMMY"), 0, "ISYMMY", "0, every row is given, is");
    begin("the line MX MY DX DY");
    mx_ = count("MX");
    my_ = count("MY");
    dx_ = step("DX");
    dy_ = step("DY");
    const double rows = static_cast<double>(mx_) * (2.0 * my_ - 1.0);
    if (rows * static_cast<double>(kShortestRow) > static_cast<double>(size_))
      scanner_.fail(fmt::format("{} x {} coefficients do not fit into a file of {} bytes", mx_,
                                2 * static_cast<long>(my_) - 1, size_),
                    0, "check MX and MY, or whether the file is complete");
  }

  /// Moves to the next line that is neither blank nor a comment.
  void begin(const std::string& record) {
    record_ = record;
    while (next_line())
      if (const auto word = peek()) return;
    ends();
  }

  bool next_line() {
    if (!scanner_.next_line()) return false;
    scanner_.cut(scanner_.line().find('%'));
    return true;
  }
  std::optional<Word> peek() {
    const std::size_t offset = scanner_.offset();
    const auto word = scanner_.next_word();
    scanner_.set_offset(offset);
    return word;
  }
  [[noreturn]] void ends() const { scanner_.fail("the file ends where " + record_ + " is expected"); }

  Word word(const std::string& name) {
    const auto found = scanner_.next_word();
    if (!found)
      scanner_.fail(fmt::format("{} is missing in {}", name, record_), static_cast<int>(scanner_.line().size()) + 1);
    column_ = found->column;
    return *found;
  }
  int integer(const std::string& name) { return profiles::to_integer(scanner_, word(name)); }

  void only(int value, int supported, const std::string& name, const std::string& advice) const {
    if (value != supported)
      throw Error(ErrorKind::configuration,
                  fmt::format("{} = {} of a file of influence coefficients is not supported", name, value),
                  scanner_.at(column_), advice);
  }

  int count(const std::string& name) {
    constexpr int kMost = 1000000;
    const int value = integer(name);
    if (value < 1 || value > kMost)
      scanner_.fail(fmt::format("{} = {} lies outside 1 ... {}", name, value, kMost), column_);
    return value;
  }
  double step(const std::string& name) {
    const double value = profiles::to_number(scanner_, word(name)) * kMillimetre;
    if (!(value > 0.0)) scanner_.fail(name + " must be positive", column_);
    return value;
  }

  /// A line that begins with ix = 0 and has a number in every place.
  bool is_first_row() {
    bool first = true;
    for (std::size_t i = 0; i < kWords; ++i) {
      const auto found = scanner_.next_word();
      if (!found || !profiles::looks_numeric(found->text)) return scanner_.set_offset(0), false;
      if (i == 0) first = found->text == "0";
    }
    scanner_.set_offset(0);
    return first;
  }

  std::array<double, kEntries> read_row(int ix, int iy) {
    record_ = fmt::format("row ix = {} of iy = {}", ix, iy);
    if (!next_line()) ends();
    for (int skipped = 0; ix == 0 && !is_first_row(); ++skipped) {
      if (skipped == kMostHeaderLines)
        scanner_.fail(fmt::format("{} is expected here: {} numbers that begin with 0", record_, kWords));
      if (!next_line()) ends();
    }
    if (const int found = integer("ix"); found != ix)
      scanner_.fail(fmt::format("ix = {} stands where {} is expected", found, record_), column_);
    profiles::to_number(scanner_, word("x"));
    std::array<double, kEntries> entries{};
    for (double& one : entries) one = profiles::to_number(scanner_, word("a coefficient")) * kMillimetre;
    return entries;
  }

  LineScanner scanner_;
  std::size_t size_;
  std::string record_;
  int column_ = 0;
  int mx_ = 0, my_ = 0;
  double dx_ = 0.0, dy_ = 0.0;
};

}  // namespace

NumericalInfluence parse_influence(std::string_view text, const std::filesystem::path& name) {
  return InfluenceReader(text, name.string()).read();
}

NumericalInfluence read_influence(const std::filesystem::path& file) {
  return parse_influence(profiles::read_text(file, "influence coefficient", {}), file);
}

}  // namespace treadmark::io
