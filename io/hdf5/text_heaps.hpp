// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

namespace treadmark::io {

/// Whether the heaps in which an HDF5 file keeps texts ("global heaps") are in order. They are the one part of its
/// structure without check sums, and the HDF5 library trusts the sizes in them. True for files without any, and for
/// files that cannot be read. Thread-safe.
bool text_heaps_sound(const std::filesystem::path& file);

}  // namespace treadmark::io
