// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/patch_memory.hpp"

namespace treadmark::wheelrail {

/// Adds to the forces of patches that go on from the previous instant a damping against their change. Where several
/// patches come of one, each goes on from its part. now: what the patches leave, in their order, with forces without
/// damping.
void add_damping(const Problem& problem, const Instant& previous, const Instant& now, std::span<PatchSolution> patches);

}  // namespace treadmark::wheelrail
