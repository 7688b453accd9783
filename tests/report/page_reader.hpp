// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/report/page.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::testing {

/// Parts of a page, found by their names. What is not there is an exception, which fails the test.

const report::Table& table_of(const report::Page& page, const std::string& id);
const report::Figure& figure_of(const report::Page& page, const std::string& id);
bool has_figure(const report::Page& page, const std::string& id);
std::vector<std::string> section_ids(const report::Page& page);
std::string fact_of(const report::Page& page, const std::string& label);
std::string card_of(const report::Page& page, const std::string& label);  ///< value | note

/// "failed: heading text", a line each, of the whole page.
std::string banners_of(const report::Page& page);

/// Cells of a column, by its label.
std::vector<double> numbers_in(const report::Table& table, const std::string& column);
std::vector<std::string> texts_in(const report::Table& table, const std::string& column);

}  // namespace treadmark::testing
