// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/import/pages/import_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/app/import/pages/import_figures.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/row_blocks.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

std::string in_unit(double value, const char* unit, int digits = 3) {
  return std::isfinite(value) ? fmt::format("{} {}", shown({value, digits}), unit) : "–";
}

/// Lengths [m] with the digits of report.json.
std::string in_mm(double length, int digits = 3) { return in_unit(in_file(kMilli * length), "mm", digits); }
std::string in_um(double length) { return in_unit(1e3 * in_file(kMilli * length), "µm"); }

std::size_t removed_count(const io::ImportReport& report) {
  std::size_t sum = 0;
  for (const auto& removed : report.removed) sum += removed.count;
  return sum;
}

void add_banners(const io::ImportReport& report, Section& overview) {
  for (const std::string& warning : report.warnings)
    overview.blocks.emplace_back(Banner{Banner::Kind::warning, "Warning.", warning});
  std::size_t open = 0;
  double widest = 0.0;
  for (const auto& hole : report.holes) {
    if (hole.filled) continue;
    ++open;
    widest = std::fmax(widest, hole.diameter);
  }
  if (open > 0)
    overview.blocks.emplace_back(
        Banner{Banner::Kind::warning, counted(open, "hole") + (open == 1 ? " stays open." : " stay open."),
               fmt::format("There is no surface there; the widest is {} across.", in_mm(widest))});
  if (report.from_map)
    overview.blocks.emplace_back(Banner{Banner::Kind::note, "From a map of deviations.",
                                        "It was not placed: it lies over the nominal profile as it is."});
}

Cards cards_of(const io::ImportReport& report) {
  const double read = static_cast<double>(report.points_read), removed = static_cast<double>(removed_count(report));
  const double largest = report.damage.empty() ? 0.0 : report.damage.front().depth;
  Cards cards;
  cards.cards = {{"Points used", fmt::format("{}", report.points_used), fmt::format("of {}", report.points_read)},
                 {"Removed", read > 0.0 ? fmt::format("{} %", shown({100.0 * removed / read, 3})) : "–",
                  fmt::format("{} points", removed_count(report))},
                 {"Residual", in_um(report.residual_rms), fmt::format("rms; largest {}", in_um(report.residual_max))},
                 {"Noise", in_um(report.noise), "standard deviation of the points"},
                 // A fit whose heights show no error may still err in curvatures.
                 {"Error of the surface", io::surface_error_text(report, "\u00b5"),
                  report.errors ? "of heights; results that use it state what this leaves uncertain"
                                : "of heights, by points held out; curvatures and with them pressures err more"},
                 {"Holes", fmt::format("{}", report.holes.size()),
                  fmt::format("{} in all", in_unit(in_file(1e6 * report.hole_area), "mm²"))},
                 {"Damage", fmt::format("{}", report.damage.size()),
                  report.damage.empty()
                      ? ""
                      : fmt::format("the largest {} {}", in_mm(std::fabs(largest)), largest < 0.0 ? "high" : "deep")}};
  if (report.truth)
    cards.cards.push_back({"Error against the reference surface", in_um(report.truth->placed.rms),
                           fmt::format("rms; of the shape alone {}", in_um(report.truth->shape.rms))});
  return cards;
}

Facts import_facts(const io::ImportReport& report) {
  const auto span = [](double from, double to, double factor, const char* unit) {
    return fmt::format("{} … {} {}", shown({in_file(factor * from), 5}), shown({in_file(factor * to), 5}), unit);
  };
  const bool wheel = report.body == Body::wheel;
  Facts facts;
  facts.entries = {{"Version", report.version},
                   {"Body", std::string(body_name(report.body)) + (report.closed ? ", all round" : "")},
                   {"Unit of the files", fmt::format("{} (from {})", report.unit, report.unit_from)},
                   {wheel ? "Angles" : "Along the track",
                    span(report.u_min, report.u_max, wheel ? 180.0 / kPi : kMilli, wheel ? "°" : "mm")},
                   {"Across", span(report.y_min, report.y_max, kMilli, "mm")},
                   {"Distance of points", in_mm(report.spacing)},
                   {"Holes are filled up to", in_mm(report.hole_limit)},
                   {"Damage begins at", in_um(report.damage_threshold)}};
  return facts;
}

std::string vector_text(const Vec3& vector, double factor, int digits) {
  std::string out;
  for (const double value : vector)
    out += fmt::format("{}{}", out.empty() ? "" : ", ", shown({in_file(factor * value), digits}));
  return fmt::format("({})", out);
}

/// How the surface lies in the scan; nothing for a map.
std::vector<Block> placement_of(const io::ImportReport& report) {
  if (report.from_map) return {};
  const Pose& X = report.X_CS;
  Facts facts;
  facts.entries = {
      {"Nominal profile", report.nominal + (report.turned ? ", turned" : "")},
      {"Nominal radius", in_mm(report.nominal_radius, 6)},
      {"Origin in the scan", vector_text(X.origin, kMilli, 7) + " mm"},
      {"x axis in the scan", vector_text(X.rotation.col(0), 1.0, 6)},
      {"y axis in the scan", vector_text(X.rotation.col(1), 1.0, 6)},
      {"z axis in the scan", vector_text(X.rotation.col(2), 1.0, 6)},
      {"Zero along the band", report.zero},
      {"Standard error of the axis", fmt::format("{}, {}", in_um(report.axis_position_error),
                                                 in_unit(in_file(kMilli * report.axis_direction_error), "mrad"))},
      {"Scatter about the section", in_um(report.scatter)},
      {"Undamaged points", in_unit(in_file(100.0 * report.undamaged), "%")},
      {"Section from the nominal profile", fmt::format("{} where both agree, {} of it", in_um(report.match_residual),
                                                       in_unit(in_file(100.0 * report.match_agreeing), "%"))}};
  if (report.body != Body::wheel)
    std::erase_if(facts.entries, [](const auto& entry) { return entry.first == "Nominal radius"; });
  std::vector<Block> out{std::move(facts)};
  if (!report.registrations.empty())
    out.emplace_back(
        report::table_of("registrations", "Scans that were laid on each other first.", report.registrations));
  if (Table passes = pass_table(report); passes.rows.size() > 1) {
    out.emplace_back(
        Paragraph{fmt::format("Passes lay {} apart where they overlap (rms), and {} after they were moved.",
                              in_um(report.pass_before), in_um(report.pass_after))});
    out.emplace_back(std::move(passes));
  }
  return out;
}

Section surface_section(const io::ImportReport& report, OptionalFiles& files) {
  Section section{"surface", "Surface"};
  const auto [unit, factor] = length_unit_of(report.fitted);
  append(section.blocks,
         map_figure(report.fitted, report.body,
                    {"fitted-map", "Distance of the fitted surface from its section", "distance", unit, factor, true,
                     "Above 0: out of the material. Rectangles: damage, by number and depth; circles: holes."},
                    import_marks(report)));
  section.blocks.emplace_back(damage_table(report));
  section.blocks.emplace_back(hole_table(report));
  append(section.blocks, files.picture("fitted.svg", "fitted", "Fitted surface"));
  return section;
}

Section points_section(const io::ImportReport& report, OptionalFiles& files) {
  Section section{"points", "Points"};
  section.blocks.emplace_back(removed_table(report));
  append(section.blocks,
         map_figure(report.density, report.body, {"density-map", "Points before cleaning", "points", "1/mm²", 1e-6}));
  append(section.blocks, map_figure(report.removed_map, report.body,
                                    {"removed-map", "Points that were removed", "points", "1/mm²", 1e-6}));
  append(section.blocks, files.picture("before.svg", "before", "Scan before cleaning"));
  append(section.blocks, files.picture("removed.svg", "removed", "What was removed"));
  return section;
}

/// How far the points lie from the surface: in space, unrolled, and how many.
Section deviation_section(const io::ImportReport& report) {
  Section section{"deviation", "Deviation"};
  append(section.blocks, cloud_figure(report));
  append(section.blocks, map_figure(report.residual, report.body,
                                    {"residual-map", "Mean residual", "measured less fitted", "µm", 1e6, true}));
  append(section.blocks, residual_figure(report));
  return section;
}

/// Gauge and cant of the track of which the rail is the right one.
Section track_section(const io::ImportReport& report) {
  Section section{"track", "Track"};
  if (!report.track) return section;
  section.blocks.emplace_back(Paragraph{
      "This rail is the right one of a track; the folder left-rail has the page of the left one. Gauge: least "
      "distance of the heads down to 14 mm below their tops; cant: left rail above right rail."});
  section.blocks.emplace_back(
      report::table_of("track-places", "Gauge and cant by place along the right rail.", report.track->places, 5));
  return section;
}

Section fit_section(const io::ImportReport& report, OptionalFiles& files) {
  Section section{"fit", "Fit"};
  if (const auto& kept = report.sections)
    section.blocks.emplace_back(
        Banner{Banner::Kind::note,
               kept->smoothed ? "The scan's own sections, smoothed by their noise, are the surface."
                              : "The scan's own sections are the surface.",
               fmt::format("{} sections of {} to {} points; the fit below serves pictures, damage and zero alone.",
                           kept->count, kept->fewest_points, kept->most_points)});
  section.blocks.emplace_back(
      Paragraph{fmt::format("{} points were fitted, {} held out; these lie {} (rms) from the surface.",
                            report.fitted_points, report.held_out_points, in_um(report.held_out_rms))});
  if (report.errors)
    section.blocks.emplace_back(
        Paragraph{fmt::format("The surface is known to {} (rms), at most {} were found. Results that use it have "
                              "standard deviations from this.",
                              in_um(report.errors->rms), in_um(report.errors->largest))});
  if (!report.error_parts.empty())
    section.blocks.emplace_back(report::table_of(
        "error-sources", "What else leaves the surface uncertain: standard deviations, each source by itself.",
        report.error_parts, 3));
  append(section.blocks,
         map_figure(report.error_map, report.body,
                    {"error-map", "Uncertainty of the surface", "standard deviation of heights", "µm", 1e6}));
  append(section.blocks,
         map_figure(report.noise_map, report.body, {"noise-map", "Noise", "standard deviation", "µm", 1e6}));
  if (!report.noise_classes.empty())
    section.blocks.emplace_back(
        report::table_of("noise-classes", "Points that scatter otherwise than usual at their place, and count so.",
                         report.noise_classes));
  section.blocks.emplace_back(level_table(report));
  // its maps and counts are shown above
  if (report.residual.value.empty()) append(section.blocks, files.picture("residual.svg", "residual", "Residuals"));
  return section;
}

}  // namespace

Page import_page(const io::ImportReport& report, std::string document, const std::filesystem::path& folder) {
  OptionalFiles files(folder);
  files.has("maps.h5", "maps over the band");
  Page page{"import", fmt::format("Import of {}", report.inputs.empty() ? "" : report.inputs.front().file),
            fmt::format("A {} from {}", body_name(report.body),
                        report.from_map ? "a map of deviations" : counted(report.points_read, "point"))};
  page.document = std::move(document);

  Section overview{"overview", "Overview"};
  add_banners(report, overview);
  const std::size_t place_of_note = overview.blocks.size();
  overview.blocks.emplace_back(cards_of(report));
  overview.blocks.emplace_back(import_facts(report));
  overview.blocks.emplace_back(input_table(report));
  Section surface = surface_section(report, files), points = points_section(report, files),
          deviation = deviation_section(report), fit = fit_section(report, files), track = track_section(report),
          truth{"truth", "Error against the reference surface", truth_blocks(report)};
  Section output{"outputs", "Outputs", {output_table(report)}}, steps{"steps", "Steps"},
      settings{"settings", "Settings"}, summary{"summary", "Summary"};
  if (files.has("times.json", "times of the steps")) steps.blocks.emplace_back(step_table(report));
  settings.blocks.emplace_back(Listing{report.settings_toml});
  if (std::string text = files.text("summary.txt", "the summary"); !text.empty())
    summary.blocks.emplace_back(Listing{std::move(text)});
  std::vector<Block> note = files.note();
  overview.blocks.insert(overview.blocks.begin() + static_cast<std::ptrdiff_t>(place_of_note), note.begin(),
                         note.end());

  Section placement{"placement", "Placement", placement_of(report)};
  for (Section* section : {&overview, &track, &truth, &surface, &deviation, &points, &placement, &fit, &output, &steps,
                           &settings, &summary})
    if (!section->blocks.empty()) page.sections.push_back(std::move(*section));
  return page;
}

Page import_page(const std::filesystem::path& folder) {
  return import_page(io::read_import_report(folder), io::profiles::read_text(folder / "report.json", "result", {}),
                     folder);
}

namespace {

/// Place along the band: degrees of a wheel, mm of a rail.
report::Column along_column(const io::ImportReport& report) {
  return report.body == Body::wheel ? report::Column{"angle", "°"} : report::Column{"x", "mm"};
}

/// Parts of the band: where they are, and what their rows say.
template <class Part>
Table placed_table(const io::ImportReport& report, Table own, const std::vector<Part>& parts) {
  const double factor = report.body == Body::wheel ? 180.0 / kPi : kMilli;
  const std::vector<report::Column> place{along_column(report), {"y", "mm"}, {"s", "mm"}};
  own.columns.insert(own.columns.begin(), place.begin(), place.end());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::vector<Cell> cells{Number{in_file(factor * parts[i].u), 6}, Number{in_file(kMilli * parts[i].y)},
                                  Number{in_file(kMilli * parts[i].s)}};
    own.rows[i].cells.insert(own.rows[i].cells.begin(), cells.begin(), cells.end());
  }
  return own;
}

}  // namespace

Table input_table(const io::ImportReport& report) {
  return report::table_of("inputs", "Files that were read.", report.inputs);
}

Table removed_table(const io::ImportReport& report) {
  Table table{"removed",
              "Points that are not in the surface, in the order of the steps.",
              {{"reason"}, {"points"}, {"of all", "%"}, {"rule"}}};
  const double all = static_cast<double>(report.points_read);
  for (const auto& [reason, count, why] : io::removed_by_reason(report)) {
    const double points = static_cast<double>(count);
    table.rows.push_back({{reason, Number{points, 12}, Number{all > 0.0 ? 100.0 * points / all : 0.0, 3}, why}});
  }
  return table;
}

Table hole_table(const io::ImportReport& report) {
  return placed_table(report, report::table_of("holes", "Places without points, largest first.", report.holes, 3),
                      report.holes);
}

Table damage_table(const io::ImportReport& report) {
  Table table = placed_table(
      report,
      report::table_of("damage", "Damage, largest first. Negative depths and volumes stand out of the surface.",
                       report.damage),
      report.damage);
  table.columns.insert(table.columns.begin(), {"number"});
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    table.rows[i].cells.insert(table.rows[i].cells.begin(), Number{static_cast<double>(i + 1)});
  return table;
}

Table pass_table(const io::ImportReport& report) {
  return report::table_of("passes", "Passes and what they were moved by, in the axes of the surface.", report.passes,
                          3);
}

Table level_table(const io::ImportReport& report) {
  return report::table_of("levels",
                          "The sum of splines, from coarse to fine along and across. Functions are used only where the "
                          "points call for them.",
                          report.levels);
}

Table output_table(const io::ImportReport& report) {
  return report::table_of("outputs", "Surfaces that were written, read back and compared with the fitted one.",
                          report.outputs, 3);
}

Table step_table(const io::ImportReport& report) {
  return report::table_of("steps", "Steps and their wall-clock times.", report.steps, 3);
}

}  // namespace treadmark::app::pages
