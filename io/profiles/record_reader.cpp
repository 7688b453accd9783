// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/record_reader.hpp"

namespace treadmark::io::profiles {
namespace {

constexpr std::size_t kLongestName = 4096;

}  // namespace

bool RecordReader::more() {
  for (;;) {
    const std::string_view line = scanner_.line();
    std::size_t offset = scanner_.offset();
    while (offset < line.size() && is_blank(line[offset])) ++offset;
    if (offset < line.size() && line[offset] != '%') {
      scanner_.set_offset(offset);
      column_ = static_cast<int>(offset + 1);
      return true;
    }
    if (!scanner_.next_line()) return false;
  }
}

Word RecordReader::next(const std::string& what) {
  if (!more()) scanner_.fail("the file ends where " + what + " is expected", 0, "is the file truncated?");
  Word word = *scanner_.next_word();
  if (const std::size_t comment = word.text.find('%'); comment != std::string_view::npos) {
    word.text = word.text.substr(0, comment);
    end_record();
  }
  return word;
}

double RecordReader::number(const std::string& what) {
  const Word word = next(what);
  return to_number(scanner_, word);
}

int RecordReader::integer(const std::string& what) {
  const Word word = next(what);
  return to_integer(scanner_, word);
}

std::string RecordReader::name(const std::string& what) {
  if (!more()) scanner_.fail("the file ends where " + what + " is expected", 0, "is the file truncated?");
  const std::string_view rest = scanner_.line().substr(scanner_.offset());
  if (rest.front() != '\'') fail(what + " in single quotes is expected, this is " + printable(rest));
  const std::size_t end = rest.find('\'', 1);
  if (end == std::string_view::npos) fail("the single quote before " + what + " is not closed");
  if (end == 1) fail(what + " is empty");
  if (end > kLongestName) fail(what + " is longer than 4096 characters");
  scanner_.set_offset(scanner_.offset() + end + 1);
  return std::string(rest.substr(1, end - 1));
}

void RecordReader::end_record() { scanner_.set_offset(scanner_.line().size()); }

}  // namespace treadmark::io::profiles
