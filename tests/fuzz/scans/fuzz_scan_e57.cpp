// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "fuzz_scan.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/scans/e57_pages.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

/// The input is the content without check sums, which are made here: random ones would end every run at the first page.
TREADMARK_FUZZ_TARGET(fuzz_scan_e57) {
  using namespace treadmark;
  if (!has_part("expat")) return 0;
  constexpr std::size_t kContent = io::scans::E57Pages::kContent;
  std::string content(reinterpret_cast<const char*>(data), size), file;
  content.resize((size + kContent - 1) / kContent * kContent, ' ');
  for (std::size_t at = 0; at < content.size(); at += kContent) {
    const std::string page = content.substr(at, kContent);
    file += page;
    const std::uint32_t sum = io::scans::crc32c(page);
    for (int shift = 24; shift >= 0; shift -= 8) file += static_cast<char>(sum >> shift);
  }
  fuzz::parse_scan(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), io::scans::parse_e57, 8);
  return 0;
}
