// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#if defined(__AVX2__) && defined(__FMA__)
#include "treadmark/bench/roofline/ceilings_kernel.hpp"

namespace treadmark::bench {
const Ceilings* ceilings_avx2() { return &kCeilings; }
}  // namespace treadmark::bench
#else
#include "treadmark/bench/roofline/ceilings.hpp"

namespace treadmark::bench {
const Ceilings* ceilings_avx2() { return nullptr; }
}  // namespace treadmark::bench
#endif
