// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

namespace treadmark::io::scans {

/// A copy of 264 bytes takes three: more than this many bytes no byte of LZF stands for.
inline constexpr std::size_t kMostOfLzf = 88;

/// Unpacks LZF (the format of liblzf, M. A. Lehmann) into `out`, which has its final size. False where the packed bytes
/// do not give exactly that.
bool unpack_lzf(std::string_view packed, std::string& out);

}  // namespace treadmark::io::scans
