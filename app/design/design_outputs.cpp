// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "treadmark/app/design/run_design.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/text_of.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark {
namespace {

using access::flag;
using access::of;
using unit::kOne;

constexpr Column<app::DesignStep> kSteps[] = {
    {"design", kOne, "", of<&app::DesignStep::design>()},
    {"solutions", kOne, "", of<&app::DesignStep::solutions>(), "of cases up to here"},
    {"objective", kOne, "", of<&app::DesignStep::objective>(), "sum of the goals"},
    {"violation", kOne, "", of<&app::DesignStep::violation>(), "of limits, over their size"},
    {"best", kOne, "", flag<&app::DesignStep::best>(), "better than all before it"},
    {"failed", kOne, "", of<&app::DesignStep::failed>(), "why it has no solution"}};

constexpr Column<app::DesignVariable> kVariables[] = {
    {"name", kOne, "", of<&app::DesignVariable::name>(), "", kInTable, "what is sought"},
    {"from", kOne, "", of<&app::DesignVariable::from>(), "", kInTable, "from"},
    {"to", kOne, "", of<&app::DesignVariable::to>(), "", kInTable, "to"},
    {"start", kOne, "", of<&app::DesignVariable::given>(), "", kInTable, "start"},
    {"best", kOne, "", of<&app::DesignVariable::best>(), "", kInTable, "found"},
    {"surfaces_differenced", kOne, "", flag<&app::DesignVariable::surfaces>()}};

constexpr Column<app::DesignedNumber> kNumbers[] = {
    {"quantity", kOne, "", of<&app::DesignedNumber::quantity>(), "", kInTable, "quantity"},
    {"where", kOne, "", of<&app::DesignedNumber::where>(), "", kInTable, "where"},
    {"before", kOne, "", of<&app::DesignedNumber::before>(), "of the base", kInTable, "before"},
    {"after", kOne, "", of<&app::DesignedNumber::after>(), "of the design", kInTable, "after"},
    {"written", kOne, "", of<&app::DesignedNumber::written>(), "of designed.toml", kInTable, "as written"},
    {"derivative", kOne, "", of<&app::DesignedNumber::derivative>(), "from the design towards the start"},
    {"difference", kOne, "", of<&app::DesignedNumber::difference>(), "the same by solutions"},
    {"disagreement", kOne, "", of<&app::DesignedNumber::disagreement>()}};

}  // namespace

template <>
std::span<const Column<app::DesignStep>> columns() {
  return kSteps;
}
template <>
std::span<const Column<app::DesignVariable>> columns() {
  return kVariables;
}
template <>
std::span<const Column<app::DesignedNumber>> columns() {
  return kNumbers;
}

namespace app {
namespace {

using io::Json;

const char* how_found(const DesignResult& result) {
  const bool surfaces = ranges::any_of(result.variables, &DesignVariable::surfaces);
  if (result.conicity_differenced)
    return surfaces ? "contact along its tangent over surfaces that are differenced; conicity by differences"
                    : "contact along its tangent; conicity by differences";
  return surfaces ? "contact along its tangent over surfaces that are differenced" : "contact along its tangent";
}

std::string design_svg(const DesignResult& result) {
  pictures::ChartSheet sheet;
  sheet.title = result.title;
  sheet.width = 620.0, sheet.height = 240.0;
  sheet.gap_y = 70.0, sheet.top = 58.0, sheet.bottom = 66.0;
  const auto add = [&](const char* title, const char* x, const char* y) -> pictures::Chart& {
    pictures::Chart& chart = sheet.charts.emplace_back();
    chart.title = title, chart.x_label = x, chart.y_label = y;
    return chart;
  };
  if (!result.depth.empty()) {
    pictures::Chart& chart = add("depth that is removed, at the places", "y [mm]", "depth [mm]");
    chart.y_down = true;
    pictures::ChartSeries& depth = chart.series.emplace_back();
    for (std::size_t k = 0; k < result.depth.size(); ++k)
      depth.points.push_back({kMilli * result.depth_y[k], kMilli * result.depth[k]});
  }
  pictures::Chart& history = add("designs that were tried, the best so far joined", "design", "sum of the goals");
  pictures::ChartSeries tried, best;
  tried.joined = false, best.style = 1;
  for (const DesignStep& step : result.history)
    (step.best ? best : tried).points.push_back({1.0 * step.design, step.objective});
  history.series = {std::move(tried), std::move(best)};
  sheet.remarks = {fmt::format("{}: {}", result.status, result.message)};
  return pictures::draw_sheet(sheet);
}

}  // namespace

std::string design_json(const DesignResult& result) {
  Json out = {{"treadmark", {{"version", result.version}, {"git", result.git}}},
              {"input", {{"file", result.input_file}, {"sha256", result.input_sha256}}},
              {"title", result.title},
              {"settings", result.settings},
              {"status", result.status},
              {"message", result.message},
              {"method", result.method},
              {"gradients", how_found(result)},
              {"cases", result.cases},
              {"designs", result.history.size()},
              {"solutions", result.solutions},
              {"check_solutions", result.check_solutions},
              {"objective_start", io::number(result.start)},
              {"objective_best", io::number(result.best)},
              {"violation", io::number(result.violation)},
              {"largest_disagreement", io::number(result.disagreement)}};
  for (const auto& [name, value] : result.inputs) out["input"][name] = value;
  out["warnings"] = result.warnings;
  out["files"] = result.files;
  out["variables"] = io::json_of(result.variables);
  std::vector<double> depth_mm, y_mm;
  for (std::size_t k = 0; k < result.depth.size(); ++k)
    y_mm.push_back(kMilli * result.depth_y[k]), depth_mm.push_back(kMilli * result.depth[k]);
  out["depth"] = {{"y_mm", io::numbers(y_mm)}, {"depth_mm", io::numbers(depth_mm)}};
  out["numbers"] = io::json_of(result.numbers);
  out["history"] = io::json_of(result.history);
  return io::dumped(out, 2) + '\n';
}

std::string design_table(const DesignResult& result) {
  std::string text = result.title + '\n' + io::table_of(result.variables) + '\n' + io::table_of(result.numbers);
  text += fmt::format("sum of the goals {:.6g}, at the start {:.6g}; {} designs, {} solutions, {} more to check\n",
                      result.best, result.start, result.history.size(), result.solutions, result.check_solutions);
  if (std::isfinite(result.disagreement))
    text += fmt::format("derivatives ({}) and solutions beside the design disagree by up to {:.2g}\n",
                        how_found(result), result.disagreement);
  return text + fmt::format("{}: {}\n", result.status, result.message);
}

void write_design_folder(const std::filesystem::path& folder, const DesignResult& result) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "history.csv", io::csv_of(result.history));
  write_file(output.path() / "numbers.csv", io::csv_of(result.numbers));
  write_file(output.path() / "design.svg", design_svg(result));
  write_file(output.path() / "design.json", design_json(result));
  output.move_into("design.json");
}

}  // namespace app
}  // namespace treadmark
