// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::io {

/// Colour of a value between 0 and 1 as "#rrggbb": dark violet over blue and green to yellow. Lightness grows evenly,
/// so that order survives in grey print and for colour-blind readers. Values outside are clamped, NaN is grey.
std::string colour(double value);

}  // namespace treadmark::io
