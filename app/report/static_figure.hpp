// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/report/field_catalogue.hpp"
#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// A figure as SVG pictures that need neither scripts nor other files; several where one would be too large.
/// Thread-safe. Errors: Error(configuration) for sets that are not there and fields that do not match their grid.
std::vector<std::string> static_figure(const Figure& figure, const Page& page);

/// A chart as one SVG picture; step: of a chart whose curves change with the step.
std::string chart_svg(const ChartView& view, const Page& page, const std::string& title, std::size_t step = 0);

/// A quantity of the contact patches of frames as one SVG picture: a panel a frame, the same window size, the same
/// colours in all, with the edges of contact (dark) and adhesion (white). At most 24 frames, at equal distances.
/// Thread-safe. Errors: Error(configuration) where no patch has the quantity.
std::string field_svg(const std::vector<Frame>& frames, const FieldInfo& field, const std::string& title);

}  // namespace treadmark::app::report
