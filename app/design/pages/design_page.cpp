// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/design/pages/design_page.hpp"

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/cases/pages/run_overlay_page.hpp"
#include "treadmark/app/pages/plain_page.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

namespace fs = std::filesystem;

/// A list of objects of the result as a table of these members.
Table design_table_of(const io::Json& result, const char* list, const std::string& caption,
                      const std::vector<const char*>& members) {
  Table table{list, caption, {}};
  for (const char* member : members) table.columns.push_back({member});
  const auto found = result.find(list);
  if (found == result.end() || !found->is_array()) return table;
  for (const io::Json& one : *found) {
    if (!one.is_object()) continue;
    Table::Row row;
    for (const char* member : members) {
      const io::Json value = one.value(member, io::Json());
      if (value.is_string())
        row.cells.emplace_back(value.get<std::string>());
      else
        row.cells.emplace_back(Number{value.is_number() ? value.get<double>() : kNaN});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Page design_page(const fs::path& folder) {
  Page plain = plain_page(folder, "design.json", "a design");
  const io::Json result = io::Json::parse(plain.document, nullptr, false);
  Section design{"design", "Design"};
  for (const io::Json& warning : result.value("warnings", io::Json::array()))
    if (warning.is_string())
      design.blocks.emplace_back(Banner{Banner::Kind::warning, "Warning:", warning.get<std::string>()});
  for (Block& block : plain.sections.front().blocks) design.blocks.push_back(std::move(block));
  design.blocks.emplace_back(
      design_table_of(result, "numbers",
                      "Before, of the design, and of the surface that was written; derivatives "
                      "held to solutions, from the design towards where the search started.",
                      {"quantity", "where", "before", "after", "written", "derivative", "difference"}));
  design.blocks.emplace_back(
      design_table_of(result, "variables", "What was sought.", {"name", "from", "to", "start", "best"}));
  plain.sections.front() = std::move(design);
  const fs::path before = folder / "before" / "fields.h5", after = folder / "after" / "fields.h5";
  const bool ended = result.value("status", io::Json()) != "interrupted";  // else runs may be those of another design
  if (!ended || !fs::exists(before) || !fs::exists(after)) return plain;
  std::vector<Overlaid<io::RunResult>> runs;
  runs.push_back({"before", io::read_hdf5(before)});
  runs.push_back({"after", io::read_hdf5(after)});
  Page page = run_overlay_page(std::move(runs));
  page.title = plain.title, page.document = plain.document, page.full_data.clear();
  const auto is_shown = [](const Section& section) { return section.id == "design" || section.id == "pictures"; };
  auto at = page.sections.begin();
  for (Section& section : plain.sections)
    if (is_shown(section)) at = std::next(page.sections.insert(at, std::move(section)));
  return page;
}

}  // namespace treadmark::app::pages
