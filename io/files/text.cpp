// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/platform/to_chars.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::io::profiles {

namespace fs = std::filesystem;

fs::path portable_path(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

namespace {

/// Without what would spoil a terminal.
std::string shown_name(const fs::path& file) {
  std::string name = file.string();
  for (char& c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return name;
}

}  // namespace

std::string read_text(const fs::path& file, const std::string& what, const SourcePosition& referenced_from) {
  check_cancelled();
  const SourcePosition where = referenced_from.file.empty() ? SourcePosition{file.string(), 0, 0} : referenced_from;
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    throw Error(ErrorKind::input_data, fmt::format("the {} file '{}' {}", what, shown_name(file), why), where, advice);
  };

  std::error_code code;
  fs::path actual = file;
  if (!fs::exists(actual, code)) actual = portable_path(file.string());
  const fs::file_status status = fs::status(actual, code);
  if (status.type() == fs::file_type::not_found) {
    throw MissingFile(ErrorKind::input_data, fmt::format("the {} file '{}' does not exist", what, shown_name(file)),
                      where,
                      advice_on_missing(file, referenced_from.file.empty()
                                                  ? ""
                                                  : "names are relative to the folder of the file that mentions them"));
  }
  if (status.type() == fs::file_type::none) refuse("cannot be looked up: " + code.message(), "check its name");
  if (!fs::is_regular_file(status)) refuse("is not a regular file", "name a text file");
  refuse_output_as_input(actual);
  const std::uintmax_t size = fs::file_size(actual, code);
  if (code) refuse("cannot be read: " + code.message(), "check its permissions");
  if (size > kMaxBytes) refuse("is larger than 1 GB", "thin out the points");

  std::ifstream stream(actual, std::ios::binary);
  if (!stream) refuse("cannot be opened", "check its permissions");
  constexpr std::uintmax_t kPiece = std::uintmax_t{1} << 24;
  std::string text;
  text.reserve(static_cast<std::size_t>(size));
  while (stream && text.size() < size) {
    check_cancelled();
    const std::size_t before = text.size();
    text.resize(static_cast<std::size_t>(std::min(size, before + kPiece)));
    stream.read(text.data() + before, static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) refuse("cannot be read to its end", "check the disk");
  return text;
}

namespace {

enum class Utf16 { no, little, big };

/// Without a mark: of a text in Latin letters every second byte is zero.
Utf16 utf16_order(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return Utf16::little;
  if (bytes.starts_with("\xFE\xFF")) return Utf16::big;
  constexpr std::size_t kLooked = 64, kLeast = 4;
  const std::size_t looked = std::min(bytes.size(), kLooked) / 2 * 2;
  if (looked < kLeast) return Utf16::no;
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < looked; ++i)
    if (bytes[i] == '\0') ++zeros[i % 2];
  if (zeros[0] == 0 && zeros[1] == looked / 2) return Utf16::little;
  if (zeros[1] == 0 && zeros[0] == looked / 2) return Utf16::big;
  return Utf16::no;
}

void append_utf8(std::string& text, unsigned code) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0u | code >> 6);
  } else {
    if (code < 0x10000) {
      put(0xE0u | code >> 12);
    } else {
      put(0xF0u | code >> 18);
      put(0x80u | (code >> 12 & 0x3Fu));
    }
    put(0x80u | (code >> 6 & 0x3Fu));
  }
  put(0x80u | (code & 0x3Fu));
}

}  // namespace

std::string from_utf16(std::string_view bytes) {
  const Utf16 order = utf16_order(bytes);
  if (order == Utf16::no) return {};
  constexpr unsigned kReplacement = 0xFFFD, kMark = 0xFEFF;
  const std::size_t low = order == Utf16::little ? 0 : 1;
  const auto unit = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[i + low])) |
           static_cast<unsigned>(static_cast<unsigned char>(bytes[i + 1 - low])) << 8;
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    unsigned code = unit(i);
    const bool high = code >= 0xD800 && code < 0xDC00;
    if (high && i + 3 < bytes.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000) {
      code = 0x10000u + ((code - 0xD800u) << 10) + (unit(i + 2) - 0xDC00u);
      i += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = kReplacement;
    }
    if (i > 0 || code != kMark) append_utf8(text, code);
  }
  return text;
}

}  // namespace treadmark::io::profiles

namespace treadmark::io {

std::string read_input(const std::filesystem::path& file, std::string_view what) {
  require_file(file, what, ErrorKind::configuration);
  const auto refuse = [&](const char* why, const char* advice) {
    throw Error(ErrorKind::configuration, fmt::format("the {} {}", what, why), {file.string()}, advice);
  };
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("cannot be opened", "check its permissions");
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::string text;
  while (stream) {
    check_cancelled();
    const std::size_t before = text.size();
    if (before > profiles::kMaxBytes) refuse("is larger than 1 GB", "is it the right file?");
    text.resize(before + kPiece);
    stream.read(text.data() + before, kPiece);
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) refuse("cannot be read to its end", "is it the right file?");
  return text;
}

std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  unsigned code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const unsigned least = length == 4 ? 0x10000u : length == 3 ? 0x800u : 0x80u;  // no longer than needed
  const bool surrogate = code >= 0xD800u && code < 0xE000u;
  return code < least || code > 0x10FFFFu || surrogate ? 0 : length;
}

std::size_t characters_of(std::string_view text) {
  return static_cast<std::size_t>(ranges::count_if(text, begins_character));
}

std::string_view cut_to_bytes(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && !begins_character(text[most])) --most;
  return text.substr(0, most);
}

double rounded(double value, Digits digits) {
  if (digits == Digits::all || !std::isfinite(value)) return value + 0.0;
  char text[32];
  const char* end = write_digits(text, std::end(text), value, static_cast<int>(digits));
  double rounded = value;
  from_chars(text, end, rounded);
  return rounded + 0.0;
}

int decimals_of(double value, int digits) {
  const auto decimals = [&](double size) {
    return std::max(0, digits - 1 - to_whole<int>(std::floor(std::log10(size))));
  };
  const double size = std::abs(value), scale = std::pow(10.0, decimals(size));
  return decimals(std::round(size * scale) / scale);
}

std::string to_base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  const auto put = [&](std::uint32_t group, std::size_t digits) {
    for (std::size_t k = 0; k < digits; ++k) *out++ = kDigits[group >> (18 - 6 * k) & 63u];
  };
  const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(bytes[i]); };
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3) put(byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2), 4);
  const std::size_t left = bytes.size() - i;
  if (left == 1) put(byte(i) << 16, 2);
  if (left == 2) put(byte(i) << 16 | byte(i + 1) << 8, 3);
  return text;
}

namespace {

/// Whether spreadsheets take a cell for a formula, which may ask for files and programs.
bool is_formula(const std::string& text) {
  if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
  const char* const first = text.data() + (text.front() == '+' ? 1 : 0);
  const char* const end = text.data() + text.size();
  double number = 0.0;
  const auto [stop, failed] = from_chars(first, end, number);
  return failed != std::errc() || stop != end;
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (is_formula(text)) return csv_cell('\'' + text);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      out.back() += '"', ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  for (std::string& cell : out) {
    const auto from = cell.find_first_not_of(" \t\r"), to = cell.find_last_not_of(" \t\r");
    cell = from == std::string::npos ? std::string() : cell.substr(from, to - from + 1);
  }
  return out;
}

std::string csv_number(double value) { return std::isnan(value) ? "nan" : fmt::format("{}", value); }

std::string csv_cell(double value, Digits digits) {
  return std::isfinite(value) ? csv_number(rounded(value, digits)) : std::string();
}

}  // namespace treadmark::io
