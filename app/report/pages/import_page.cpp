// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/import_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/report/html_text.hpp"
#include "treadmark/app/report/pages/folder_files.hpp"
#include "treadmark/app/report/pages/import_figures.hpp"
#include "treadmark/app/report/pages/import_tables.hpp"
#include "treadmark/app/report/pages/page_parts.hpp"
#include "treadmark/io/profiles/read_text.hpp"

namespace treadmark::app::report {
namespace {

constexpr double kMicro = 1e3;  // mm -> µm

std::string in_unit(double value, const char* unit, int digits = 3) {
  return std::isfinite(value) ? fmt::format("{} {}", shown({value, digits}), unit) : "–";
}

std::size_t removed_count(const JsonTree& report) {
  std::size_t sum = 0;
  for (const auto& [reason, count] : report.at("removed").entries()) sum += count.count();
  return sum;
}

void add_banners(const JsonTree& report, Section& overview) {
  for (const std::string& warning : report.at("warnings").texts())
    overview.blocks.emplace_back(Banner{Banner::Kind::warning, "Warning.", warning});
  std::size_t open = 0;
  double widest = 0.0;
  for (const JsonTree& hole : report.at("coverage").at("holes").items()) {
    if (hole.flag("filled")) continue;
    ++open;
    widest = std::fmax(widest, hole.number("diameter_mm"));
  }
  if (open > 0)
    overview.blocks.emplace_back(
        Banner{Banner::Kind::warning, counted(open, "hole") + (open == 1 ? " stays open." : " stay open."),
               fmt::format("There is no surface there; the widest is {} across.", in_unit(widest, "mm"))});
  if (report.flag("from_map"))
    overview.blocks.emplace_back(Banner{Banner::Kind::note, "From a map of deviations.",
                                        "It was not placed: it lies over the nominal profile as it is."});
}

Cards cards_of(const JsonTree& report) {
  const double read = static_cast<double>(report.count("points_read")),
               removed = static_cast<double>(removed_count(report));
  const JsonTree coverage = report.at("coverage"), fit = report.at("fit");
  const auto holes = coverage.at("holes").items();
  const auto damage = report.at("damage").items();
  Cards cards;
  cards.cards = {
      {"Points used", fmt::format("{}", report.count("points_used")),
       fmt::format("of {}", report.count("points_read"))},
      {"Removed", read > 0.0 ? fmt::format("{} %", shown({100.0 * removed / read, 3})) : "–",
       fmt::format("{} points", removed_count(report))},
      {"Residual", in_unit(kMicro * report.number("residual_rms_mm"), "µm"),
       fmt::format("rms; largest {}", in_unit(kMicro * report.number("residual_max_mm"), "µm"))},
      {"Noise", in_unit(kMicro * report.number("noise_mm"), "µm"), "standard deviation of the points"},
      {"Error of the surface", in_unit(kMicro * fit.number("held_out_error_mm"), "µm"), "by points that were held out"},
      {"Holes", fmt::format("{}", holes.size()),
       fmt::format("{} in all", in_unit(coverage.number("hole_area_mm2"), "mm²"))},
      {"Damage", fmt::format("{}", damage.size()),
       damage.empty() ? ""
                      : fmt::format("the largest {} {}", in_unit(std::fabs(damage.front().number("depth_mm")), "mm"),
                                    damage.front().number("depth_mm") < 0.0 ? "high" : "deep")}};
  return cards;
}

Facts import_facts(const JsonTree& report) {
  const JsonTree range = report.at("range"), coverage = report.at("coverage");
  const auto span = [&](const char* key, const char* unit) {
    const auto ends = range.at(key).numbers();
    return ends.size() == 2 ? fmt::format("{} … {} {}", shown({ends[0], 5}), shown({ends[1], 5}), unit)
                            : std::string("–");
  };
  const bool wheel = report.text("body") == "wheel";
  Facts facts;
  facts.entries = {{"Version", report.at("treadmark").text("version")},
                   {"Body", report.text("body") + (range.flag("closed") ? ", all round" : "")},
                   {"Unit of the files", fmt::format("{} (from {})", report.text("unit"), report.text("unit_from"))},
                   {wheel ? "Angles" : "Along the track", wheel ? span("u_deg", "°") : span("u_mm", "mm")},
                   {"Across", span("y_mm", "mm")},
                   {"Distance of points", in_unit(coverage.number("spacing_mm"), "mm")},
                   {"Holes are filled up to", in_unit(coverage.number("hole_limit_mm"), "mm")},
                   {"Damage begins at", in_unit(kMicro * report.number("damage_threshold_mm"), "µm")}};
  return facts;
}

std::string vector_text(const JsonTree& node, int digits) {
  std::string out;
  for (const double value : node.numbers()) out += fmt::format("{}{}", out.empty() ? "" : ", ", shown({value, digits}));
  return fmt::format("({})", out);
}

/// How the surface lies in the scan; nothing for a map.
std::vector<Block> placement_of(const JsonTree& report) {
  const auto frame = report.find("frame");
  if (!frame) return {};
  Facts facts;
  facts.entries = {
      {"Nominal profile", frame->text("nominal_profile") + (frame->flag("turned") ? ", turned" : "")},
      {"Nominal radius", in_unit(frame->number("nominal_radius_mm"), "mm", 6)},
      {"Origin in the scan", vector_text(frame->at("origin_mm"), 7) + " mm"},
      {"x axis in the scan", vector_text(frame->at("x_axis"), 6)},
      {"y axis in the scan", vector_text(frame->at("y_axis"), 6)},
      {"z axis in the scan", vector_text(frame->at("z_axis"), 6)},
      {"Zero along the band", frame->text("zero")},
      {"Standard error of the axis",
       fmt::format("{}, {}", in_unit(kMicro * frame->number("axis_position_error_mm"), "µm"),
                   in_unit(frame->number("axis_direction_error_mrad"), "mrad"))},
      {"Scatter about the section", in_unit(kMicro * frame->number("scatter_mm"), "µm")},
      {"Undamaged points", in_unit(frame->number("undamaged_percent"), "%")},
      {"Section from the nominal profile",
       fmt::format("{} where both agree, {} of it", in_unit(kMicro * frame->number("match_residual_mm"), "µm"),
                   in_unit(frame->number("match_agreeing_percent"), "%"))}};
  if (report.text("body") != "wheel")
    std::erase_if(facts.entries, [](const auto& entry) { return entry.first == "Nominal radius"; });
  std::vector<Block> out{std::move(facts)};
  if (Table passes = pass_table(*frame); passes.rows.size() > 1) {
    out.emplace_back(
        Paragraph{fmt::format("Passes lay {} apart where they overlap (rms), and {} after they were moved.",
                              in_unit(kMicro * frame->number("pass_distance_before_mm"), "µm"),
                              in_unit(kMicro * frame->number("pass_distance_after_mm"), "µm"))});
    out.emplace_back(std::move(passes));
  }
  return out;
}

Section surface_section(const JsonTree& report, const io::ImportMaps& maps, OptionalFiles& files) {
  Section section{"surface", "Surface"};
  const auto [unit, factor] = length_unit_of(maps.fitted);
  append(section.blocks,
         map_figure(maps.fitted, maps.body,
                    {"fitted-map", "Distance of the fitted surface from its section", "distance", unit, factor, true,
                     "Above 0: out of the material. Rectangles: damage, by number and depth; circles: holes."},
                    import_marks(report, maps)));
  section.blocks.emplace_back(damage_table(report));
  section.blocks.emplace_back(hole_table(report));
  append(section.blocks, files.picture("fitted.svg", "fitted", "Fitted surface"));
  return section;
}

Section points_section(const JsonTree& report, const io::ImportMaps& maps, OptionalFiles& files) {
  Section section{"points", "Points"};
  section.blocks.emplace_back(removed_table(report));
  append(section.blocks,
         map_figure(maps.density, maps.body, {"density-map", "Points before cleaning", "points", "1/mm²", 1e-6}));
  append(section.blocks,
         map_figure(maps.removed, maps.body, {"removed-map", "Points that were removed", "points", "1/mm²", 1e-6}));
  append(section.blocks, files.picture("before.svg", "before", "Scan before cleaning"));
  append(section.blocks, files.picture("removed.svg", "removed", "What was removed"));
  return section;
}

Section fit_section(const JsonTree& report, const io::ImportMaps& maps, OptionalFiles& files) {
  Section section{"fit", "Fit"};
  const JsonTree fit = report.at("fit");
  if (const auto kept = fit.find("kept_sections"))
    section.blocks.emplace_back(
        Banner{Banner::Kind::note, "The scan's own sections are the surface.",
               fmt::format("{} sections of {} to {} points; the fit below serves pictures, damage and zero alone.",
                           kept->count("count"), kept->count("fewest_points"), kept->count("most_points"))});
  section.blocks.emplace_back(Paragraph{fmt::format(
      "{} points were fitted, {} held out; these lie {} (rms) from the surface.", fit.count("fitted_points"),
      fit.count("held_out_points"), in_unit(kMicro * fit.number("held_out_rms_mm"), "µm"))});
  append(section.blocks, map_figure(maps.residual, maps.body,
                                    {"residual-map", "Mean residual", "measured less fitted", "µm", 1e6, true}));
  append(section.blocks, map_figure(maps.noise, maps.body, {"noise-map", "Noise", "standard deviation", "µm", 1e6}));
  if (ChartView chart = residual_chart(fit); !chart.panels.empty())
    section.blocks.emplace_back(Figure{"residuals", "Distribution of the residuals", std::move(chart)});
  section.blocks.emplace_back(level_table(report));
  append(section.blocks, files.picture("residual.svg", "residual", "Residuals"));
  return section;
}

}  // namespace

Page import_page(const std::filesystem::path& folder) {
  const JsonTree report = io::read_json_file(folder / "report.json");
  OptionalFiles files(folder);
  io::ImportMaps maps;
  if (files.has("maps.h5", "maps over the band")) maps = io::read_import_maps(files.path("maps.h5"));
  const std::string body = report.text("body");
  Page page{
      "import", fmt::format("Import of {}", report.text("input")),
      fmt::format("A {} from {}", body,
                  report.flag("from_map") ? "a map of deviations" : counted(report.count("points_read"), "point"))};
  page.document = io::profiles::read_text(folder / "report.json", "result", {});

  Section overview{"overview", "Overview"};
  add_banners(report, overview);
  const std::size_t place_of_note = overview.blocks.size();
  overview.blocks.emplace_back(cards_of(report));
  overview.blocks.emplace_back(import_facts(report));
  overview.blocks.emplace_back(input_table(report));
  Section surface = surface_section(report, maps, files), points = points_section(report, maps, files),
          fit = fit_section(report, maps, files);
  Section output{"outputs", "Outputs", {output_table(report)}}, steps{"steps", "Steps"},
      settings{"settings", "Settings"}, summary{"summary", "Summary"};
  if (files.has("times.json", "times of the steps"))
    steps.blocks.emplace_back(step_table(io::read_json_file(files.path("times.json"))));
  settings.blocks.emplace_back(Listing{report.text("settings_toml")});
  if (std::string text = files.text("summary.txt", "the summary"); !text.empty())
    summary.blocks.emplace_back(Listing{std::move(text)});
  std::vector<Block> note = files.note();
  overview.blocks.insert(overview.blocks.begin() + static_cast<std::ptrdiff_t>(place_of_note), note.begin(),
                         note.end());

  Section placement{"placement", "Placement", placement_of(report)};
  for (Section* section : {&overview, &surface, &points, &placement, &fit, &output, &steps, &settings, &summary})
    if (!section->blocks.empty()) page.sections.push_back(std::move(*section));
  return page;
}

}  // namespace treadmark::app::report
