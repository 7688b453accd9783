// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/report/field_catalogue.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// A figure as SVG pictures that need neither scripts nor other files; several where one would be too large. step: of
/// what changes with the timeline; without it the one that the page shows first.
/// Thread-safe. Errors: Error(configuration) for sets that are not there and fields that do not match their grid.
std::vector<std::string> static_figure(const Figure& figure, const Page& page, std::optional<std::size_t> step = {});

/// A chart as one SVG picture; step: of a chart whose curves change with the step.
std::string chart_svg(const ChartView& view, const Page& page, const std::string& title, std::size_t step = 0);

/// A quantity of the contact patches of frames as one SVG picture: a panel a frame, the same window size, the same
/// colours in all, with the edges of contact (dark) and adhesion (white). At most 24 frames, at equal distances.
/// Thread-safe. Errors: Error(configuration) where no patch has the quantity.
std::string field_svg(const std::vector<Frame>& frames, const FieldInfo& field, const std::string& title);

/// Wheel and rail cut across the track at the contact with the largest normal force, with the contact references: an
/// SVG picture in track axes with equal scales, seen along the track (y to the right, z downwards). The frame with the
/// largest normal force is shown. Thread-safe.
std::string section_svg(const FrameSet& set, const std::vector<io::SampledSurface>& surfaces);

/// A map as an SVG picture, averaged where it is finer than the picture; places without values stay empty. step: of a
/// map that changes with the step. Thread-safe.
std::string map_svg(const MapView& map, const std::string& title, std::size_t step = 0);

}  // namespace treadmark::report
