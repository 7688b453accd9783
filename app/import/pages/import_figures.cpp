// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/pages/import_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/pictures/imports/import_map.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

constexpr std::size_t kMostAlong = 1000, kMostAcross = 160;  // cells of a map in a page
constexpr std::size_t kMostHoles = 300, kMostDamage = 30;

using Points = std::vector<std::array<double, 2>>;

/// Mean of the known values of a block of cells.
double mean(const io::BandMap& map, std::size_t row0, std::size_t row1, std::size_t column0, std::size_t column1) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = row0; row < row1; ++row)
    for (std::size_t column = column0; column < column1; ++column)
      if (const float value = map.value[row * map.columns + column]; std::isfinite(value)) {
        sum += value;
        count += 1.0;
      }
  return count > 0.0 ? sum / count : std::nan("");
}

/// Greatest size that is shown; infinite where no few values stand far out.
double limit_of(const io::BandMap& map) {
  constexpr double kFew = 1e-3, kFar = 3.0;
  const auto extent = pictures::map_extent(map, kFew);
  if (!extent) return INFINITY;
  const double greatest = std::max(-extent->least, extent->greatest), usual = std::max(-extent->low, extent->high);
  return usual > 0.0 && greatest > kFar * usual ? usual : INFINITY;
}

/// A mark that crosses the seam of a whole wheel stands at both ends.
void add_mark(std::vector<MapView::Mark>& marks, const Points& points, const std::string& label, const io::BandMap& map,
              double round_mm) {
  const double low = kMilli * map.a_min, high = kMilli * map.a_max;
  const std::vector<double> turns = round_mm > 0.0 ? std::vector{0.0, -round_mm, round_mm} : std::vector{0.0};
  for (const double turn : turns) {
    MapView::Mark mark{label, {}};
    bool inside = false;
    for (const auto& [a, s] : points) {
      inside = inside || (a + turn > low && a + turn < high);
      mark.points.push_back({std::clamp(a + turn, low, high), std::clamp(s, kMilli * map.s_min, kMilli * map.s_max)});
    }
    if (inside) marks.push_back(std::move(mark));
  }
}

Points ellipse(double a, double s, double diameter) {
  constexpr int kCorners = 32;
  Points out;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    out.push_back({a + 0.5 * diameter * std::cos(angle), s + 0.5 * diameter * std::sin(angle)});
  }
  return out;
}

Points rectangle(double a, double s, double length, double width) {
  const double l = 0.5 * length, w = 0.5 * width;
  return {{a - l, s - w}, {a + l, s - w}, {a + l, s + w}, {a - l, s + w}, {a - l, s - w}};
}

}  // namespace

std::vector<MapView::Mark> import_marks(const io::ImportReport& report) {
  std::vector<MapView::Mark> marks;
  const io::BandMap& map = report.fitted;
  if (!pictures::is_drawable(map)) return marks;
  const bool wheel = report.body == Body::wheel;
  const double round_mm = wheel && report.closed ? 2.0 * kPi * kMilli * report.nominal_radius : 0.0;
  const auto mm = [](double length) { return in_file(kMilli * length); };
  const auto along = [&](double u) {
    return wheel ? kPi / 180.0 * in_file(180.0 / kPi * u) * kMilli * report.nominal_radius : mm(u);
  };
  for (std::size_t i = 0; i < std::min(report.holes.size(), kMostHoles); ++i) {
    const auto& hole = report.holes[i];
    const double a = along(hole.u), s = mm(hole.s), diameter = mm(hole.diameter);
    if (std::isfinite(a + s) && diameter > 0.0)
      add_mark(marks, ellipse(a, s, diameter), hole.filled ? "" : fmt::format("open, {} mm", shown({diameter, 2})), map,
               round_mm);
  }
  for (std::size_t i = 0; i < std::min(report.damage.size(), kMostDamage); ++i) {
    const auto& damage = report.damage[i];
    const double a = along(damage.u), s = mm(damage.s), length = mm(damage.length), width = mm(damage.width),
                 depth = mm(damage.depth);
    if (std::isfinite(a + s + length + width))
      add_mark(marks, rectangle(a, s, length, width),
               fmt::format("{}: {} mm {}", i + 1, shown({std::fabs(depth), 3}), depth < 0.0 ? "high" : "deep"), map,
               round_mm);
  }
  return marks;
}

std::pair<std::string, double> length_unit_of(const io::BandMap& map) {
  constexpr double kSmall = 0.2e-3;  // [m]
  const auto extent = pictures::map_extent(map, 1e-3);
  if (extent && std::max(-extent->low, extent->high) >= kSmall) return {"mm", 1e3};
  return {"µm", 1e6};
}

std::vector<Block> map_figure(const io::BandMap& map, Body body, MapFigure what, std::vector<MapView::Mark> marks) {
  if (!pictures::is_drawable(map)) return {};
  MapView view;
  view.x = {body == Body::wheel ? "along the circumference" : "along the track", "mm"};
  view.y = {"along the section", "mm"};
  view.label = what.label;
  view.unit = what.unit;
  view.diverging = what.diverging;
  const std::size_t nx = std::min(map.rows, kMostAlong), ny = std::min(map.columns, kMostAcross);
  view.nx = static_cast<int>(nx);
  view.ny = static_cast<int>(ny);
  view.dx = kMilli * (map.a_max - map.a_min) / static_cast<double>(nx);
  view.dy = kMilli * (map.s_max - map.s_min) / static_cast<double>(ny);
  view.x0 = kMilli * map.a_min + 0.5 * view.dx;
  view.y0 = kMilli * map.s_min + 0.5 * view.dy;
  const double limit = limit_of(map);
  bool limited = false;
  for (std::size_t iy = 0; iy < ny; ++iy)
    for (std::size_t ix = 0; ix < nx; ++ix) {
      double value =
          mean(map, ix * map.rows / nx, (ix + 1) * map.rows / nx, iy * map.columns / ny, (iy + 1) * map.columns / ny);
      if (std::fabs(value) > limit) {
        value = std::copysign(limit, value);
        limited = true;
      }
      view.values.push_back(what.factor * value);
    }
  if (ranges::none_of(view.values, [](double value) { return std::isfinite(value); })) return {};
  view.marks = std::move(marks);
  const auto add_note = [&](const std::string& words) { what.note += (what.note.empty() ? "" : " ") + words; };
  if (nx < map.rows || ny < map.columns)
    add_note(fmt::format("Means over {:.2g} mm x {:.2g} mm; maps.h5 has {} x {} cells.", view.dx, view.dy, map.rows,
                         map.columns));
  if (limited)
    add_note(fmt::format("Values of more than {} {} are shown as that.", shown({what.factor * limit, 3}), what.unit));
  return {Figure{what.id, what.title, std::move(view), std::move(what.note)}};
}

std::vector<Block> residual_figure(const io::ImportReport& report) {
  const std::vector<std::size_t>& counts = report.residual_histogram;
  const double range = 1e3 * in_file(kMilli * report.residual_range);  // [µm]
  double total = 0.0;
  for (const std::size_t count : counts) total += static_cast<double>(count);
  if (!(total > 0.0) || !(range > 0.0)) return {};
  const double width = 2.0 * range / static_cast<double>(counts.size());
  Series bars{"points", {}}, bell{"normal distribution of the noise", {}};
  bars.x.push_back(-range);
  bars.y.push_back(0.0);
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (const double edge : {0.0, 1.0}) {
      bars.x.push_back(-range + (static_cast<double>(i) + edge) * width);
      bars.y.push_back(static_cast<double>(counts[i]));
    }
  bars.x.push_back(range);
  bars.y.push_back(0.0);
  ChartView view;
  view.x = Axis{"measured less fitted", "µm"};
  view.panels = {{fmt::format("points in {} µm", shown({width, 3})), "", false, {}, {}}};
  std::string note;
  if (report.residuals) {
    const io::ImportReport::Residuals& residuals = *report.residuals;
    const io::ImportReport::Distances& d = residuals.distances;
    const auto um = [](double metres) { return shown({in_file(kMicro * metres), 3}); };
    total += static_cast<double>(residuals.below + residuals.above);
    note = fmt::format(
        "{} points: mean {} µm, rms {} µm; 95 % of them lie within {} µm of the surface, 99 % within {} µm, all within "
        "{} µm.",
        to_whole<std::size_t>(total), um(d.mean), um(d.rms), um(d.within_95), um(d.within_99), um(d.largest));
    if (residuals.below + residuals.above > 0)
      note += fmt::format(" {} lie below and {} above what is drawn.", residuals.below, residuals.above);
  }
  view.panels.front().series.push_back(std::move(bars));
  if (const double noise = 1e3 * in_file(kMilli * report.noise); noise > 0.0) {
    constexpr int kSteps = 240;
    const double peak = total * width / (noise * std::sqrt(2.0 * kPi));
    for (int i = 0; i <= kSteps; ++i) {
      const double x = range * (2.0 * i / kSteps - 1.0);
      bell.x.push_back(x);
      bell.y.push_back(peak * std::exp(-0.5 * (x / noise) * (x / noise)));
    }
    bell.dashed = true;
    view.panels.front().series.push_back(std::move(bell));
    note += fmt::format("{}Dashed: as many points with the stated noise, a standard deviation of {} µm.",
                        note.empty() ? "" : " ", shown({noise, 3}));
  }
  if (report.sections) note += " The fit is not the surface here: the sections are.";
  return {Figure{"residuals", "Distribution of the residuals", std::move(view), std::move(note)}};
}

namespace {

/// Values in the unit and their colours: of all, or of a share of them where the largest is so many times as far out.
CloudView::Quantity quantity_of(const char* label, const std::vector<float>& metres, double share, double far,
                                std::string& note) {
  constexpr double kSmall = 0.2e-3;
  std::vector<float> sizes;
  sizes.reserve(metres.size());
  for (const float value : metres)
    if (std::isfinite(value)) sizes.push_back(std::fabs(value));
  CloudView::Quantity out{label, "µm", 1e3};
  if (sizes.empty()) return out;
  ranges::sort(sizes);
  const double usual = sizes[to_whole<std::size_t>(share * static_cast<double>(sizes.size() - 1))],
               largest = sizes.back();
  const double span = usual > 0.0 && largest > far * usual ? usual : largest;
  if (span >= kSmall) out.unit = "mm", out.per_mm = 1.0;
  const double factor = kMilli * out.per_mm;
  out.span = span > 0.0 ? factor * span : 1.0;
  const auto beyond = static_cast<std::size_t>(sizes.end() - ranges::upper_bound(sizes, static_cast<float>(span)));
  if (beyond > 0)
    note += fmt::format(" {} points of more than {} {} {} have the colour of that.", beyond, shown({out.span, 3}),
                        out.unit, label);
  out.values.reserve(metres.size());
  for (const float value : metres) out.values.push_back(factor * static_cast<double>(value));
  return out;
}

}  // namespace

std::vector<Block> cloud_figure(const io::ImportReport& report) {
  const io::ImportReport::CloudSample& cloud = report.cloud;
  if (cloud.x.empty()) return {};
  CloudView view;
  view.wheel = report.body == Body::wheel;
  const auto scaled = [](const std::vector<float>& values, double factor) {
    std::vector<double> out;
    out.reserve(values.size());
    for (const float value : values) out.push_back(factor * static_cast<double>(value));
    return out;
  };
  view.x = scaled(cloud.x, kMilli);
  view.y = scaled(cloud.y, kMilli);
  view.z = scaled(cloud.z, kMilli);
  view.tilt = scaled(cloud.tilt, 1.0);
  const auto removed =
      static_cast<std::size_t>(ranges::count_if(cloud.residual, [](float r) { return std::isnan(r); }));
  const std::size_t used = cloud.x.size() - removed;
  std::string note =
      fmt::format("{} of the {} points used and {} of the {} removed ones, chosen evenly and the same each time.", used,
                  cloud.all - cloud.removed, removed, cloud.removed);
  if (cloud.far > 0)
    note += fmt::format(" {} removed points lie more than 100 mm from all others and are not drawn.", cloud.far);
  note += " Above 0: out of the material.";
  view.quantities = {quantity_of("deviation from the surface", cloud.residual, 0.99, 1.5, note),
                     quantity_of("distance from the section", cloud.distance, 0.999, 3.0, note)};
  view.others = "removed points";
  view.caption = {fmt::format("{} of {} points", cloud.x.size(), cloud.all)};
  return {Figure{"cloud-view", "Points in space", std::move(view), std::move(note)}};
}

std::vector<Block> truth_blocks(const io::ImportReport& report) {
  if (!report.truth) return {};
  const io::ImportReport::Truth& truth = *report.truth;
  const bool wheel = report.body == Body::wheel;
  Table table{
      "truth",
      fmt::format("The surface less {}, along the normal; above 0: it stands out of the reference.", truth.surface),
      {{"compared"}, {"rms", "µm"}, {"largest", "µm"}, {"95 % within", "µm"}, {"99 % within", "µm"}, {"mean", "µm"}}};
  for (const auto& [name, d] : {std::pair{"frame on frame", &truth.placed}, {"best aligned", &truth.shape}}) {
    Table::Row row{{std::string(name)}};
    for (const double value : {d->rms, d->largest, d->within_95, d->within_99, d->mean})
      row.cells.emplace_back(Number{in_file(kMicro * value), 3});
    table.rows.push_back(std::move(row));
  }
  const auto vector = [](const Vec3& v, const char* unit) {
    std::string out;
    for (const double value : v) out += (out.empty() ? "" : ", ") + shown({in_file(kMicro * value), 3});
    return fmt::format("({}) {}", out, unit);
  };
  const double along = wheel ? 180.0 / kPi * truth.along : kMilli * truth.along;
  Facts facts;
  facts.entries = {{"Reference", truth.file},
                   {"Shift that lays it on best", vector(truth.shift_S, "µm")},
                   {"Turn that lays it on best", vector(truth.turn_S, "µrad")},
                   {"Zero along the band", fmt::format("at {} {} of the reference{}", shown({in_file(along), 6}),
                                                       wheel ? "°" : "mm", truth.reversed ? ", reversed" : "")},
                   {"Places compared", fmt::format("{}; no reference at {} more", truth.places, truth.beside)}};
  std::vector<Block> out{std::move(table), std::move(facts)};
  append(out, map_figure(report.truth_map, report.body,
                         {"truth-map", "Error of the surface", "surface less reference", "µm", 1e6, true,
                          "After the shift and turn. Above 0: the surface stands out of the reference."}));
  return out;
}

}  // namespace treadmark::app::pages
