// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace treadmark::io {

/// The known key that an unknown one was probably meant to be; empty when nothing is near.
std::string nearest_key(std::string_view path, std::span<const std::string> known);

}  // namespace treadmark::io
