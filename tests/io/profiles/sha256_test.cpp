// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/sha256.hpp"

#include <gtest/gtest.h>

#include <string>

#include "samples.hpp"

namespace treadmark::io {
namespace {

// Digests of the examples that NIST publishes for FIPS 180-4.
TEST(Sha256, AgreesWithThePublishedExamples) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_hex("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmno"
                       "pqrsmnopqrstnopqrstu"),
            "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(sha256_hex(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, Base64IsOfTheSameDigest) {
  EXPECT_EQ(sha256_base64(""), "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(sha256_base64("abc"), "ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
}

TEST(Sha256, FileInPiecesEqualsTextAtOnce) {
  const testing::TemporaryFolder folder;
  for (const std::size_t size : {0u, 55u, 56u, 63u, 64u, 65u, 65536u, 200'003u}) {
    std::string content(size, '\0');
    for (std::size_t i = 0; i < size; ++i) content[i] = static_cast<char>(i * 31 + i / 251);
    EXPECT_EQ(sha256_file(folder.write("data", content)), sha256_hex(content)) << size;
  }
}

TEST(Sha256, MissingFileIsAnError) {
  TREADMARK_EXPECT_ERROR(sha256_file("/nowhere/at.all"), "/nowhere/at.all", 0, 0);
  const testing::TemporaryFolder folder;
  TREADMARK_EXPECT_ERROR(sha256_file(folder.path()), "is a folder", 0, 0);
}

}  // namespace
}  // namespace treadmark::io
