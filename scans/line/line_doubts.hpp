// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/analysis/measured/section.hpp"
#include "treadmark/scans/line/find_line.hpp"

namespace treadmark::scans {

/// What is doubtful along the line of a rail, by place from its beginning: parts without points that it was taken
/// across, or that end it while points lie beyond ("line_gap"), bends that are shorter than its splines ("line_kink"),
/// rails and other bodies beside it ("several_rails"), rails that come near it ("switch"), and points that go back
/// along it in their order, so that one place was measured twice ("backward_run"; passes are looked at one by one).
/// points, keep, passes: of the cloud, [m] in its frame, before they are straightened; the last two may be empty.
/// Deterministic.
std::vector<measured::Doubt> line_doubts(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                         std::span<const std::uint16_t> passes, const FoundLine& found);

}  // namespace treadmark::scans
