// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string_view>

namespace treadmark::io {

/// Bytes of the UTF-8 character (RFC 3629) at the start of a text that is not empty; 0 where there is none.
std::size_t utf8_length(std::string_view text);

}  // namespace treadmark::io
