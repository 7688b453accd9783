// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/point_sums.hpp"
#if defined(__AVX2__)
#include "treadmark/scans/fit/point_sums_kernel.hpp"

namespace treadmark::scans {

const PointSums kPointSumsAvx2{sums_of_functions, sums_of_products, subtract_functions};

}  // namespace treadmark::scans
#endif
