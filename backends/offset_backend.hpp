// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/resampling.hpp"

namespace treadmark {

/// The surface less a base, in the region [m or rad, m]. Errors: Error(input_data) where the two do not go together.
offset::OffsetSample offsets_over(Resampling& resampling, const Surface& base, Rectangle region_uy);

}  // namespace treadmark
