// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Whether this processor and its system run AVX2 and FMA instructions. Asked once; thread-safe. See core/kernel.hpp.
bool cpu_has_avx2();

}  // namespace treadmark
