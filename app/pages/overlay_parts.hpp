// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Parts of pages that lay results over each other. The first result is what the others are compared with.

/// A result, named as on the page.
template <class Result>
struct Overlaid {
  std::string name;
  Result result;
};

/// From one number to another. A difference below 1e-9 of the larger of them is rounding: 0.
struct Change {
  double difference = 0.0;  ///< second minus first; NaN where one is not known
  double percent = 0.0;     ///< of the size of the first; NaN where that is below a thousandth of `scale`
};

/// scale: the largest size that the quantity has anywhere.
Change change(double first, double second, double scale);

/// A card that says a change with its sign. where: of the note, may be empty.
report::Cards::Card change_card(const std::string& label, const Change& change, const std::string& unit,
                                const std::string& where);

/// Columns of a quantity: of each result, then difference and change of each but the first. quantity: before the names
/// of the columns, may be empty. unit: empty where rows have units of their own.
void add_columns(report::Table& table, const std::vector<std::string>& names, const std::string& quantity,
                 const std::string& unit);
/// The cells of these columns. values: of each result.
void add_cells(report::Table::Row& row, std::span<const double> values, double scale);

/// A line of what results say about themselves, a text a result.
struct SaidByAll {
  std::string what;
  std::vector<std::string> texts = {};
};

/// Version, input, settings, geometry files and what was asked for; what only some say is "–" of the others. whole:
/// hashes in full.
std::vector<SaidByAll> origins_of(std::span<const Origin> origins, bool whole);

/// The table of what differs among these lines, or a sentence that nothing does.
report::Block difference_table(const std::vector<std::string>& names, const std::vector<SaidByAll>& lines);

/// Everything about the origin of all results, as the last section.
report::Section origins_section(const std::vector<std::string>& names, std::span<const Origin> origins);

/// A note where versions differ: what differs on the page may come from the program.
void add_version_note(std::span<const Origin> origins, report::Section& overview);

/// "1 to 5, 8"; numbers increase. Of many stretches the first ones.
std::string stretches(std::span<const int> numbers);

/// "before and after", "a, b and c".
std::string joined(const std::vector<std::string>& names);

}  // namespace treadmark::app::pages
