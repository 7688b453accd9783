// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/backends/resampling.hpp"

namespace treadmark {

/// A spline through whole sections of a rail that moves aside: at even distances, and closer where it would be more
/// than 0.1 um off on sides steeper than 63 degrees, over which offsets along z grow large. Sections are sampled, or
/// given ones where their features say what corresponds. Errors: Error(input_data) where a section has a gap or hardly
/// any points; those of sampling.
std::shared_ptr<const Surface> following_base(Resampling& resampling);

}  // namespace treadmark
