// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Whether this processor and its system run AVX2 and FMA instructions. Asked once; thread-safe.
///
/// Kernels that gain from them are compiled twice from one header: `<name>_generic.cpp` for every machine,
/// `<name>_avx2.cpp` with these instructions (the build sets the flags by the file's name; elsewhere that file holds no
/// kernel). Such files include no header with inline functions of external linkage (std::vector, Eigen ...): the linker
/// might keep the copy that other processors cannot run. Results of the two differ by rounding only.
bool cpu_has_avx2();

}  // namespace treadmark
