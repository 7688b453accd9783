// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/backends/displacement/offset_field.hpp"

namespace treadmark::displacement {

/// Offsets across a body that are the same all along it: a natural cubic spline through values [m] at places
/// y = first + k step [m], two at least; beyond them the last value.
std::shared_ptr<const OffsetField> section_offsets(double first, double step, std::vector<double> values);

}  // namespace treadmark::displacement
