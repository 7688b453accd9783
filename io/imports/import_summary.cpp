// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/files/text.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/tables/shown.hpp"

namespace treadmark::io {
namespace {

constexpr std::size_t kLabel = 24, kSummaryLine = 110;  // characters
constexpr std::size_t kMostDamageLines = 5, kMostHoleLines = 3, kMostInputs = 5, kMostClassLines = 12;

/// Control characters become blanks, so that a name cannot break the lines.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return text;
}

/// Lines of "  label   text", long texts broken between words and indented.
class Page {
 public:
  void heading(const std::string& text) { text_ += fmt::format("\n{}\n", one_line(text)); }
  void line(const std::string& text) { text_ += fmt::format("{}\n", one_line(text)); }
  void row(const std::string& label, const std::string& text) {
    const std::string head = one_line(label);
    wrap(fmt::format("  {}{:{}}", head, "", characters_of(head) < kLabel ? kLabel - characters_of(head) : 1), text,
         kLabel + 2);
  }
  void wrap(std::string line, const std::string& text, std::size_t indent) {
    std::string rest = one_line(text);
    bool first = true;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      const std::string word = rest.substr(0, end);
      rest.erase(0, std::min(end + 1, rest.size()));
      if (!first && characters_of(line) + 1 + characters_of(word) > kSummaryLine) {
        text_ += line + "\n";
        line.assign(indent, ' ');
        first = true;
      }
      if (!first) line += ' ';
      line += word;
      first = false;
    }
    text_ += line + "\n";
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add_inputs(Page& page, const ImportReport& report) {
  page.heading("read");
  for (std::size_t i = 0; i < std::min(report.inputs.size(), kMostInputs); ++i) {
    const ImportReport::Input& input = report.inputs[i];
    std::string text = fmt::format("{}, {} points", input.format, grouped(input.points));
    if (input.not_finite > 0) text += fmt::format(" and {} without numbers", grouped(input.not_finite));
    page.row(input.file, text + ", sha256 " + input.sha256.substr(0, 16) + (input.sha256.size() > 16 ? "..." : ""));
  }
  if (report.inputs.size() > kMostInputs)
    page.line(fmt::format("  and {} more files", report.inputs.size() - kMostInputs));
}

void add_points(Page& page, const ImportReport& report) {
  page.heading("points");
  const auto row = [&](const std::string& name, std::size_t count, const std::string& why) {
    const std::string head =
        fmt::format("  {:<{}}{:>14}{:>10}", one_line(name), kLabel, grouped(count), percent(count, report.points_read));
    page.wrap(why.empty() ? head : head + "  ", why, kLabel + 28);
  };
  row("read", report.points_read, "");
  for (const ImportReport::Removed& removed : report.removed)
    row(removed.reason, removed.count, removed.count > 0 ? removed.why : "");
  row("used", report.points_used, "");
}

void add_placement(Page& page, const ImportReport& report) {
  page.heading("placed");
  const Vec3 origin = 1e3 * report.X_CS.origin;
  page.row("origin in the cloud", fmt::format("{}, {}, {} mm", shown_number(origin.x(), 3), shown_number(origin.y(), 3),
                                              shown_number(origin.z(), 3)));
  if (report.body == Body::wheel) {
    page.row("nominal radius",
             shown_number(1e3 * report.nominal_radius, 3) + " mm" +
                 (report.radius_error > 0.0 ? ", known to " + length_text(report.radius_error) + " (standard error)"
                                            : std::string()));
    page.row(
        "axis known to",
        fmt::format("{} and {} mrad (standard errors), from {} of the points", length_text(report.axis_position_error),
                    shown_number(1e3 * report.axis_direction_error, 4), percent(report.undamaged)));
  } else {
    page.row("direction known to",
             fmt::format("{} mrad (standard error), from {} of the points",
                         shown_number(1e3 * report.axis_direction_error, 4), percent(report.undamaged)));
  }
  page.row("scatter about section", length_text(report.scatter));
  page.row("nominal profile", report.nominal.empty() || report.nominal == "none"
                                  ? std::string("none")
                                  : fmt::format("{}; {} of the section agrees, within {}{}", report.nominal,
                                                percent(report.match_agreeing), length_text(report.match_residual),
                                                report.turned ? "; it was turned round" : ""));
  if (!report.zero.empty()) page.row("zero", report.zero);
  if (report.line) {
    page.row("line", line_text(report));
    if (std::isfinite(report.line->given_largest))
      page.row("", fmt::format("{} off the given line at most, {} rms", length_text(report.line->given_largest),
                               length_text(report.line->given_rms)));
  }
  for (const ImportReport::Registration& one : report.registrations)
    page.row(
        fmt::format("scan {} laid on others", one.pass),
        fmt::format("moved by {} and {} mrad (standard errors {}, {} mrad), overlap {}, {} apart there{}",
                    length_text(one.shift.norm()), shown_number(1e3 * one.turn.norm(), 3), length_text(one.shift_error),
                    shown_number(1e3 * one.turn_error, 4), percent(one.overlap), length_text(one.apart),
                    one.open > 0 ? fmt::format("; {} of six directions are not told", one.open) : std::string()));
  if (report.passes.size() > 1)
    page.row("passes", fmt::format("{}, {} apart before and {} after they were joined (rms)", report.passes.size(),
                                   length_text(report.pass_before), length_text(report.pass_after)));
}

std::string extent_text(const ImportReport& report) {
  std::string along = fmt::format("from {} to {}", place_text(report, report.u_min), place_text(report, report.u_max));
  if (report.closed) along = "the whole wheel";
  return fmt::format("{}; y from {} to {} mm", along, shown_number(1e3 * report.y_min, 2),
                     shown_number(1e3 * report.y_max, 2));
}

void add_holes(Page& page, const ImportReport& report) {
  const auto filled = static_cast<std::size_t>(std::count_if(
      report.holes.begin(), report.holes.end(), [](const ImportReport::Hole& hole) { return hole.filled; }));
  page.row("holes", report.holes.empty()
                        ? std::string("none")
                        : fmt::format("{}: {} filled, {} left open (limit {}); {} of {} cm2", report.holes.size(),
                                      filled, report.holes.size() - filled, length_text(report.hole_limit),
                                      percent(report.area > 0.0 ? report.hole_area / report.area : std::nan("")),
                                      shown_number(1e4 * report.area, 1)));
  for (std::size_t i = 0; i < std::min(report.holes.size(), kMostHoleLines); ++i) {
    const ImportReport::Hole& hole = report.holes[i];
    page.row("", fmt::format("at {}, y {} mm: {} across, {} mm2, {}", place_text(report, hole.u),
                             shown_number(1e3 * hole.y, 1), length_text(hole.diameter),
                             shown_number(1e6 * hole.area, 1), hole.filled ? "filled" : "open"));
  }
}

void add_fit(Page& page, const ImportReport& report) {
  page.heading("fitted");
  page.row("extent", extent_text(report));
  if (!report.from_map) {
    page.row("distance of points", fmt::format("{} (along {}, across {})", length_text(report.spacing),
                                               length_text(report.gap_a), length_text(report.gap_s)));
    page.row("noise", length_text(report.noise));
    for (std::size_t i = 0; i < std::min(report.noise_classes.size(), kMostClassLines); ++i) {
      const ImportReport::NoiseClass& one = report.noise_classes[i];
      page.row(
          "", fmt::format("{} times that: {} ({} points)", shown_number(one.factor, 3), one.name, grouped(one.points)));
    }
    if (report.noise_classes.size() > kMostClassLines)
      page.row("", fmt::format("and {} more classes of points", report.noise_classes.size() - kMostClassLines));
  }
  if (report.sections) {
    const ImportReport::Sections& s = *report.sections;
    page.row("sections kept",
             fmt::format("{} of {} points, {} to {} apart; slices are {}, not the fit", s.count,
                         s.fewest_points == s.most_points ? grouped(s.most_points)
                                                          : fmt::format("{} to {}", s.fewest_points, s.most_points),
                         length_text(s.least_gap), length_text(s.widest_gap),
                         s.smoothed ? "smooth curves through these points" : "these points"));
    page.row("", s.smoothed ? fmt::format("smoothed by their noise: points moved by {} (rms)", length_text(*s.smoothed))
                            : fmt::format("smooth slices where they are used; triangles and offsets are smoothed with "
                                          "lambda = {:g} mm3",
                                          1e9 * s.smoothing));
    page.row("fit for damage and zero", "");
  }
  if (!report.levels.empty()) {
    const ImportReport::Level& finest = report.levels.back();
    page.row("finest knots", fmt::format("{} along, {} across; {} functions in {} levels", length_text(finest.knot_a),
                                         length_text(finest.knot_s), grouped(finest.functions), report.levels.size()));
  }
  page.row("residuals", fmt::format("{} rms, {} largest, of {} points", length_text(report.residual_rms),
                                    length_text(report.residual_max), grouped(report.fitted_points)));
  if (report.held_out_points > 0)
    page.row("points held out",
             fmt::format("{} of {} points", length_text(report.held_out_rms), grouped(report.held_out_points)));
  page.row("error of the surface", surface_error_text(report));
  for (const ImportReport::ErrorPart& part : report.error_parts)
    page.row(&part == &report.error_parts.front() ? "uncertain by" : "", error_text(part));
  add_holes(page, report);
}

void add_track(Page& page, const ImportReport& report) {
  if (!report.track) return;
  const ImportReport::Track& track = *report.track;
  const auto known = std::count_if(track.places.begin(), track.places.end(),
                                   [](const auto& place) { return !std::isnan(place.gauge); });
  page.heading("track, of which this is the right rail");
  page.row("gauge",
           std::isnan(track.gauge_mean)
               ? std::string("not known")
               : fmt::format("{} to {} mm, {} mm in the mean of {} of {} places",
                             shown_number(1e3 * track.gauge_least, 2), shown_number(1e3 * track.gauge_greatest, 2),
                             shown_number(1e3 * track.gauge_mean, 2), known, track.places.size()));
  const auto [least, greatest] = std::minmax_element(track.places.begin(), track.places.end(),
                                                     [](const auto& a, const auto& b) { return a.cant < b.cant; });
  page.row("cant", track.places.empty() || std::isnan(least->cant)
                       ? std::string("not known without placement.up")
                       : fmt::format("{} to {} mm, left rail above right rail", shown_number(1e3 * least->cant, 2),
                                     shown_number(1e3 * greatest->cant, 2)));
}

void add_damage(Page& page, const ImportReport& report) {
  page.heading(fmt::format("damage beyond {}: {}", length_text(report.damage_threshold),
                           report.damage.empty() ? std::string("none") : std::to_string(report.damage.size())));
  if (report.damage.empty()) return;
  page.line(fmt::format("  {:>3}{:>14}{:>12}{:>12}{:>12}{:>14}{:>16}", "",
                        report.body == Body::wheel ? "at angle" : "at x", "y", "length", "width", "depth", "volume"));
  for (std::size_t i = 0; i < std::min(report.damage.size(), kMostDamageLines); ++i) {
    const ImportReport::Damage& part = report.damage[i];
    page.line(fmt::format("  {:>3}{:>14}{:>12}{:>12}{:>12}{:>14}{:>16}", i + 1, place_text(report, part.u),
                          shown_number(1e3 * part.y, 1) + " mm", shown_number(1e3 * part.length, 1) + " mm",
                          shown_number(1e3 * part.width, 1) + " mm", length_text(part.depth),
                          shown_number(1e9 * part.volume, 1) + " mm3"));
  }
  if (report.damage.size() > kMostDamageLines)
    page.line(fmt::format("  and {} smaller ones", report.damage.size() - kMostDamageLines));
}

void add_truth(Page& page, const ImportReport& report) {
  if (!report.truth) return;
  const ImportReport::Truth& truth = *report.truth;
  page.heading("error against the reference surface " + truth.file);
  const auto row = [&](const char* name, const ImportReport::Distances& d) {
    page.row(name, fmt::format("{} rms, {} largest; 95 % within {}, 99 % within {}; mean {}", length_text(d.rms),
                               length_text(d.largest), length_text(d.within_95), length_text(d.within_99),
                               length_text(d.mean)));
  };
  row("frame on frame", truth.placed);
  row("best aligned", truth.shape);
  const Vec3 shift = 1e6 * truth.shift_S, turn = 1e6 * truth.turn_S;
  page.row("", fmt::format("by a shift of {}, {}, {} um and turns of {}, {}, {} urad (x, y, z)",
                           shown_number(shift.x(), 2), shown_number(shift.y(), 2), shown_number(shift.z(), 2),
                           shown_number(turn.x(), 2), shown_number(turn.y(), 2), shown_number(turn.z(), 2)));
  page.row("places",
           fmt::format("{}; the reference has none at {} more", grouped(truth.places), grouped(truth.beside)));
}

void add_outputs(Page& page, const ImportReport& report) {
  page.heading("written");
  if (report.outputs.empty()) page.line("  nothing");
  for (const ImportReport::Output& output : report.outputs)
    page.row(output.file, fmt::format("{}{}; {} kB; within {} of the fitted surface ({} rms)", output.kind,
                                      output.details.empty() ? "" : ": " + output.details,
                                      shown_number(1e-3 * static_cast<double>(output.bytes), 1),
                                      length_text(output.height_max), length_text(output.height_rms)));
}

}  // namespace

std::string import_summary(const ImportReport& report) {
  Page page;
  page.line(fmt::format("Treadmark {}: import of a {}{}", report.version, body_name(report.body),
                        report.from_map ? " from a map of deviations" : ""));
  page.line(fmt::format("unit of the file: {}{}", report.unit.empty() ? "unknown" : report.unit,
                        report.unit_from.empty() ? "" : ", from: " + report.unit_from));
  page.heading(report.warnings.empty() ? "no warnings" : fmt::format("WARNINGS: {}", report.warnings.size()));
  for (const std::string& warning : report.warnings) page.wrap("  ! ", warning, 4);
  add_inputs(page, report);
  if (!report.from_map) {
    add_points(page, report);
    add_placement(page, report);
    add_track(page, report);
  }
  add_fit(page, report);
  add_damage(page, report);
  add_truth(page, report);
  add_outputs(page, report);
  if (report.track) page.heading("the left rail");
  return page.take() + (report.track ? import_summary(*report.track->left) : std::string());
}

}  // namespace treadmark::io
