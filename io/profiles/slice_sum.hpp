// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

namespace treadmark::io {

/// How a line begins that holds the check sum of all slices that a slices file names: SHA-256 of the SHA-256 sums of
/// their files as lines of hexadecimal digits, in the order of the slices, and of what follows the line in the file;
/// earlier versions left the latter out. A file without it is not checked.
inline constexpr std::string_view kSumOfSlices = "% SHA-256 of the slices: ";

}  // namespace treadmark::io
