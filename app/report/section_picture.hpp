// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// Wheel and rail cut across the track at the contact with the largest normal force, with the contact references: an
/// SVG picture in track axes with equal scales, seen along the track (y to the right, z downwards). The frame with the
/// largest normal force is shown. Thread-safe.
std::string section_svg(const FrameSet& set, const std::vector<io::SampledSurface>& surfaces);

/// A map as an SVG picture, averaged where it is finer than the picture; places without values stay empty. Thread-safe.
std::string map_svg(const MapView& map, const std::string& title);

}  // namespace treadmark::app::report
