// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace treadmark::testing {

/// How many mutants a test tries: TREADMARK_MUTANTS of the environment, for campaigns, or what the test takes usually.
inline int mutants(int usual) {
  const char* wanted = std::getenv("TREADMARK_MUTANTS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

/// Changes some numbers of a text so that it mostly stays readable: other digits, signs, powers of ten, zeros.
inline std::string with_other_numbers(const std::string& valid, std::mt19937& random) {
  std::string text = valid;
  std::vector<std::size_t> digits;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] >= '0' && text[i] <= '9') digits.push_back(i);
  if (digits.empty()) return text;
  const unsigned changes = 1 + random() % 3;
  for (unsigned k = 0; k < changes; ++k) {
    const std::size_t at = digits[random() % digits.size()];
    if (at >= text.size()) continue;
    switch (random() % 5) {
      case 0:
        text[at] = static_cast<char>('0' + random() % 10);
        break;
      case 1:
        text.insert(at, 1, static_cast<char>('0' + random() % 10));
        break;
      case 2:
        text.insert(at, "-");
        break;
      case 3:
        text.insert(at + 1, random() % 2 == 0 ? "e3" : "e-3");
        break;
      default:
        text.erase(at, 1);
        break;
    }
  }
  return text;
}

/// Drops, repeats or exchanges lines.
inline std::string with_other_lines(const std::string& valid, std::mt19937& random) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < valid.size();) {
    const std::size_t end = valid.find('\n', at);
    lines.push_back(valid.substr(at, end - at));
    at = end == std::string::npos ? valid.size() : end + 1;
  }
  const unsigned changes = 1 + random() % 3;
  for (unsigned k = 0; k < changes && lines.size() > 1; ++k) {
    const auto pick = [&] { return static_cast<std::ptrdiff_t>(random() % lines.size()); };
    const std::ptrdiff_t at = pick();
    switch (random() % 3) {
      case 0:
        lines.erase(lines.begin() + at);
        break;
      case 1:
        lines.insert(lines.begin() + at, std::string(lines[static_cast<std::size_t>(pick())]));
        break;
      default:
        std::swap(lines[static_cast<std::size_t>(at)], lines[static_cast<std::size_t>(pick())]);
        break;
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Bits of text and binary files that readers may stumble over.
inline const std::vector<std::string> kUsualPieces{
    "\n", "-", "1e308", "nan", "99999999999", "\xff\xff\xff\xff", std::string(4, '\0'), "\x7f\xff\xff\xff", "[[", "]",
    "{",  "=", "'",     "."};

/// Any bytes: changes some, inserts or repeats pieces, drops pieces or the end.
inline std::string with_other_bytes(const std::string& valid, std::mt19937& random,
                                    const std::vector<std::string>& pieces = kUsualPieces) {
  std::string bytes = valid;
  const unsigned changes = 1 + random() % 6;
  for (unsigned k = 0; k < changes && !bytes.empty(); ++k) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 6) {
      case 0:
        bytes[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1u << (random() % 8)));
        break;
      case 2:
        bytes.insert(at, pieces[random() % pieces.size()]);
        break;
      case 3:
        bytes.erase(at, 1 + random() % 20);
        break;
      case 4:
        bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 60));
        break;
      default:
        if (random() % 3 == 0) bytes.resize(at);
        break;
    }
  }
  return bytes;
}

}  // namespace treadmark::testing
