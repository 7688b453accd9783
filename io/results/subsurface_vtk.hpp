// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/subsurface_block.hpp"

namespace treadmark::io {

/// A block of points as VTK XML structured grid (.vts): points at their places in track axes [m], displacement and
/// stress in track axes too (contact axes for a basic case, whose X_TC is the identity), as point data named with their
/// units. The block has nx ny nz values. Thread-safe.
std::string block_to_vts(const SubsurfaceBlock& block, const Pose& X_TC);

}  // namespace treadmark::io
