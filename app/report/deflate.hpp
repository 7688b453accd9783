// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace treadmark::app::report {

/// The bytes as a zlib stream (RFC 1950). The same bytes give the same stream. Thread-safe. Errors: Error(numerical)
/// without memory.
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

}  // namespace treadmark::app::report
