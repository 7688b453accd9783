// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/contact_frame.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

/// Elements of each part of a patch, a little enlarged, and how much the parts feel of each other.
/// Empty for a patch of one part.
kalker::SubPatches sub_patches(const Discretisation& discretisation, const detection::ContactPatch& region,
                               const detection::ContactFrame& frame, const Vec2& reference_C, const Grid2& grid);

}  // namespace treadmark::wheelrail
