// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// A figure as SVG pictures that need neither scripts nor other files; several where one would be too large.
/// Thread-safe. Errors: Error(configuration) for sets that are not there and fields that do not match their grid.
std::vector<std::string> static_figure(const Figure& figure, const Page& page);

/// A chart as one SVG picture; step: of a chart whose curves change with the step.
std::string chart_svg(const ChartView& view, const Page& page, const std::string& title, std::size_t step = 0);

}  // namespace treadmark::app::report
