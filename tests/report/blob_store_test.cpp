// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/blob_store.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "treadmark/core/platform/bit_cast.hpp"

namespace treadmark::report {
namespace {

std::vector<unsigned char> from_base64(const std::string& text) {
  static const std::string kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> out;
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(kLetters.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out.push_back(static_cast<unsigned char>(bits >> held & 0xFFU));
  }
  return out;
}

std::vector<unsigned char> inflated(const std::string& text) {
  const std::vector<unsigned char> bytes = from_base64(text);
  std::vector<unsigned char> out(1U << 22U);
  uLongf size = out.size();
  EXPECT_EQ(uncompress(out.data(), &size, bytes.data(), bytes.size()), Z_OK);
  out.resize(size);
  return out;
}

/// Reads an array back as the report's script does.
std::vector<double> read_back(const Packed& packed, const std::vector<std::string>& blobs) {
  const std::vector<unsigned char> bytes = inflated(blobs.at(static_cast<std::size_t>(packed.blob)));
  const std::size_t width = packed.precision == Precision::byte ? 1 : packed.precision == Precision::two_bytes ? 2 : 4;
  std::vector<double> out;
  for (std::size_t i = 0; i < packed.count; ++i) {
    std::uint32_t code = 0;
    for (std::size_t k = 0; k < width; ++k)
      code |= static_cast<std::uint32_t>(bytes.at(packed.offset + k * packed.count + i)) << (8U * k);
    if (packed.precision == Precision::single)
      out.push_back(bit_cast<float>(code));
    else if (packed.none && code == (width == 1 ? 255U : 65535U))
      out.push_back(NAN);
    else
      out.push_back(packed.low + packed.step * code);
  }
  return out;
}

std::vector<double> noise(std::size_t count, double low, double high) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(low, high);
  std::vector<double> out(count);
  for (double& value : out) value = any(generator);
  return out;
}

void expect_within(const std::vector<double>& back, const std::vector<double>& given, double bound) {
  ASSERT_EQ(back.size(), given.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    if (std::isfinite(given[i]))
      EXPECT_NEAR(back[i], given[i], bound) << i;
    else
      EXPECT_TRUE(std::isnan(back[i])) << i;
}

TEST(BlobStore, KeepsWhatThePrecisionPromises) {
  BlobStore blobs;
  blobs.begin_blob();
  std::vector<double> values = noise(1000, -3.0, 5.0);
  values[17] = NAN;
  values[18] = std::numeric_limits<double>::infinity();
  const Packed byte = blobs.add(values, Precision::byte), two = blobs.add(values, Precision::two_bytes);
  blobs.begin_blob();
  const std::vector<double> whole = noise(300, 1e5, 2e5);
  const Packed single = blobs.add(whole, Precision::single), positive = blobs.add(whole, Precision::two_bytes);
  const auto& texts = blobs.finish();
  ASSERT_EQ(texts.size(), 2u);
  expect_within(read_back(byte, texts), values, 0.5 * 8.0 / 253.0 + 1e-12);
  expect_within(read_back(two, texts), values, 0.5 * 8.0 / 65533.0 + 1e-12);
  expect_within(read_back(single, texts), whole, 2e5 * 6e-8);
  expect_within(read_back(positive, texts), whole, 0.5 * 1e5 / 65535.0 + 1e-9);
}

TEST(BlobStore, ZeroStaysZero) {
  BlobStore blobs;
  std::vector<double> values = noise(200, -0.37, 1.93);
  values[5] = 0.0;
  for (const Precision precision : {Precision::byte, Precision::two_bytes}) {
    const Packed packed = blobs.add(values, precision);
    BlobStore copy = blobs;
    EXPECT_NEAR(read_back(packed, copy.finish())[5], 0.0, 1e-12);
  }
}

TEST(BlobStore, ConstantsNothingAndCodes) {
  BlobStore blobs;
  const Packed constant = blobs.add(std::vector<double>(9, 4.25), Precision::two_bytes);
  const Packed nothing = blobs.add(std::vector<double>(3, NAN), Precision::byte);
  const Packed empty = blobs.add({}, Precision::byte);
  const std::array<unsigned char, 4> codes{0, 1, 2, 255};
  const Packed states = blobs.add_codes(codes);
  const auto& texts = blobs.finish();
  expect_within(read_back(constant, texts), std::vector<double>(9, 4.25), 0.0);
  expect_within(read_back(nothing, texts), std::vector<double>(3, NAN), 0.0);
  EXPECT_TRUE(read_back(empty, texts).empty());
  EXPECT_EQ(read_back(states, texts), (std::vector<double>{0, 1, 2, 255}));
}

}  // namespace
}  // namespace treadmark::report
