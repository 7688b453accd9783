// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Any bytes as text in UTF-16 of a profile: what is converted goes to every reader.
#include "fuzz_profile.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_utf16_profile) {
  using treadmark::io::ProfileFormat;
  const std::string text = treadmark::io::profiles::from_utf16(treadmark::fuzz::as_text(data, size));
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  for (const ProfileFormat format : {ProfileFormat::simpack, ProfileFormat::miniprof, ProfileFormat::two_column})
    treadmark::fuzz::read_both_bodies(bytes, text.size(), format);
  return 0;
}
