// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/judge_profile.hpp"
#include "treadmark/io/profiles/read_profile.hpp"

namespace treadmark::fuzz {

/// Feeds the bytes to one reader for both bodies and judges what it reads; an Error is a fair answer, anything else
/// that is thrown is not.
inline void read_both_bodies(const std::uint8_t* data, std::size_t size, io::ProfileFormat format) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const Body body : {Body::rail, Body::wheel}) {
    try {
      io::judge_profile({io::parse_profile(text, "fuzz", format, body, {}), {}}, {-0.07, 0.46});
    } catch (const Error&) {
    }
  }
}

}  // namespace treadmark::fuzz
