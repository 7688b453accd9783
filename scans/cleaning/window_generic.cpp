// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/window_kernel.hpp"

namespace treadmark::scans {

const WindowKernel kWindowGeneric{sums_of_window, sizes_of_window};

}  // namespace treadmark::scans
