// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

namespace treadmark::io::cad {

/// Throws Error(input_data) at the first parameter of a STEP file (ISO 10303-21) that begins as a number or a word and
/// is neither: OpenCASCADE takes "-inf" for 0, and the surface passes through it.
void require_step_numbers(const std::filesystem::path& file);

}  // namespace treadmark::io::cad
