// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace treadmark::io {

/// Base64 text (RFC 4648) of some bytes, padded with '='.
std::string to_base64(std::span<const std::byte> bytes);

}  // namespace treadmark::io
