// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// What can be drawn of a result: quantities of the contact patches, wheel and rail cut across, charts and pictures of
/// its report. (name, meaning) in the order of the report.
std::vector<std::pair<std::string, std::string>> plots_of(const Page& page);

/// One of them as an SVG picture. cases: numbers of the cases that are drawn, of contact patches only; empty = all.
/// Errors: Error(configuration) for names and cases that are not there, with those that are. Thread-safe.
std::string plot(const Page& page, const std::string& what, const std::vector<int>& cases);

}  // namespace treadmark::report
