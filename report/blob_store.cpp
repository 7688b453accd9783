// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/blob_store.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/bit_cast.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::report {

namespace {

/// Byte k of all numbers before byte k + 1 of all.
template <class Code>
void append_planes(std::vector<std::byte>& out, std::span<const Code> codes) {
  for (unsigned k = 0; k < sizeof(Code); ++k)
    for (const Code code : codes) out.push_back(static_cast<std::byte>((code >> (8U * k)) & 0xFFU));
}

template <class Code>
void append_quantised(std::vector<std::byte>& out, std::span<const double> values, const Packed& how) {
  constexpr Code kNone = std::numeric_limits<Code>::max();
  std::vector<Code> codes;
  codes.reserve(values.size());
  for (const double value : values) {
    if (!std::isfinite(value))
      codes.push_back(kNone);
    else
      codes.push_back(how.step > 0.0 ? to_whole<Code>(std::round((value - how.low) / how.step)) : Code{0});
  }
  append_planes<Code>(out, codes);
}

}  // namespace

void BlobStore::begin_blob() {
  close_blob();
  open_ = true;
}

std::vector<std::byte>& BlobStore::open_blob() {
  open_ = true;
  return current_;
}

void BlobStore::close_blob() {
  if (open_) texts_.push_back(io::to_base64(deflated(current_)));
  current_.clear();
  open_ = false;
}

Packed BlobStore::add(std::span<const double> values, Precision precision) {
  std::vector<std::byte>& out = open_blob();
  Packed packed{static_cast<int>(texts_.size()), out.size(), values.size(), precision};
  if (precision == Precision::single) {
    std::vector<std::uint32_t> codes;
    for (const double value : values) codes.push_back(bit_cast<std::uint32_t>(static_cast<float>(value)));
    append_planes<std::uint32_t>(out, codes);
    return packed;
  }
  double low = INFINITY, high = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      packed.none = true;
      continue;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double codes = (precision == Precision::byte ? 255.0 : 65535.0) - (packed.none ? 1.0 : 0.0);
  packed.low = std::isfinite(low) ? low : 0.0;
  packed.step = high > low ? (high - low) / codes : 0.0;
  if (low < 0.0 && high > 0.0) {  // zero keeps a code of its own
    packed.step = (high - low) / (codes - 1.0);
    packed.low = -std::ceil(-low / packed.step) * packed.step;
  }
  if (precision == Precision::byte)
    append_quantised<std::uint8_t>(out, values, packed);
  else
    append_quantised<std::uint16_t>(out, values, packed);
  return packed;
}

Packed BlobStore::add_codes(std::span<const unsigned char> codes) {
  std::vector<std::byte>& out = open_blob();
  const Packed packed{static_cast<int>(texts_.size()), out.size(), codes.size(), Precision::byte, 0.0, 1.0};
  for (const unsigned char code : codes) out.push_back(static_cast<std::byte>(code));
  return packed;
}

const std::vector<std::string>& BlobStore::finish() {
  close_blob();
  return texts_;
}

std::size_t BlobStore::text_size() const {
  std::size_t sum = 0;
  for (const std::string& text : texts_) sum += text.size();
  return sum;
}

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
  constexpr int kLevel = 9;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::byte> out(size);
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), kLevel);
  if (status != Z_OK) throw Error(ErrorKind::numerical, "the data of the report could not be compressed");
  out.resize(size);
  return out;
}

}  // namespace treadmark::report
