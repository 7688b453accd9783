// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::app {
namespace {

using geometry::Position;
using pictures::Chart;
using pictures::ChartSeries;

/// A quantity over the shift, interrupted at jumps: of the rows by their index, of a jump's sides by its index.
template <class OfRow, class OfBefore, class OfAfter>
pictures::Curve over_shift(const geometry::ContactFunctions& f, OfRow of_row, OfBefore of_before, OfAfter of_after) {
  pictures::Curve out;
  std::size_t jump = 0;
  for (std::size_t i = 0; i < f.rows.size(); ++i) {
    for (; jump < f.jumps.size() && f.jumps[jump].before.y < f.rows[i].y; ++jump) {
      out.push_back({kMilli * f.jumps[jump].before.y, of_before(jump)});
      out.push_back({kNaN, kNaN});
      out.push_back({kMilli * f.jumps[jump].after.y, of_after(jump)});
    }
    out.push_back({kMilli * f.rows[i].y, of_row(i)});
  }
  return out;
}

template <class Value>
pictures::Curve over_shift(const geometry::ContactFunctions& f, Value value) {
  return over_shift(
      f, [&](std::size_t i) { return value(f.rows[i]); }, [&](std::size_t k) { return value(f.jumps[k].before); },
      [&](std::size_t k) { return value(f.jumps[k].after); });
}

ChartSeries line(std::string name, int style, pictures::Curve curve) {
  ChartSeries series;
  series.name = std::move(name);
  series.style = style;
  series.width = 2.0;
  series.curve = std::move(curve);
  return series;
}

Chart chart_of(const char* title, const char* x, const char* y, std::vector<ChartSeries> series) {
  Chart chart;
  chart.title = title;
  chart.x_label = x;
  chart.y_label = y;
  chart.series = std::move(series);
  return chart;
}

constexpr const char* kShift = "lateral displacement to the right [mm]";

/// One side: rail below, wheel lifted above it, lines between the points that touch.
Chart contact_chart(const GeometryResult& result, const geometry::WheelsetOnTrack& wheelset, bool right) {
  constexpr double kLift = 18.0;     // of the wheel above its place [mm]
  constexpr double kWidth = 90.0;    // [mm]
  constexpr double kEvery = 0.5e-3;  // shifts of the lines [m]
  const double sign = right ? 1.0 : -1.0;
  const geometry::SideInput& side = wheelset.side(right);
  const geometry::RailTop top = geometry::rail_top(*side.rail, 0.0);
  const auto at = [&](double y, double z) { return std::array<double, 2>{sign * kMilli * y, -kMilli * z}; };
  pictures::Curve rail, wheel;
  for (std::size_t i = 0; i < side.rail->size(); ++i)
    rail.push_back(at(side.rail_y + side.rail->y(i), side.rail->z()[i] - top.z_top));
  for (std::size_t i = 0; i < side.wheel->size(); ++i) {
    auto p = at(side.wheel_y + side.wheel->y(i), side.wheel->z()[i] - wheelset.nominal_radius());
    p[1] += kLift;
    wheel.push_back(p);
  }
  Chart chart = chart_of(right ? "right" : "left", "y on the track [mm]", "height [mm]", {});
  ChartSeries lines = line("points in contact", 5, {});
  lines.width = 0.8;
  double next = -kInfinity;
  for (const Position& p : result.analysis.functions.rows) {
    if (p.y < next - 1e-9) continue;
    next = p.y + kEvery;
    const geometry::Touch& t = right ? p.right : p.left;
    const double wheel_z = side.wheel->at(t.wheel_y).z - wheelset.nominal_radius();
    auto above = at(side.wheel_y + t.wheel_y, wheel_z);
    above[1] += kLift;
    // where it touches without the shift of the wheelset, so that lines lean by the shift
    lines.curve.push_back(at(t.track_y, t.track_z));
    lines.curve.push_back(above);
    lines.curve.push_back({kNaN, kNaN});
  }
  chart.series = {line("rail", 0, std::move(rail)), line("wheel, lifted", 1, std::move(wheel)), std::move(lines)};
  const double middle = sign * kMilli * side.rail_y;
  chart.x_range = {middle - 0.5 * kWidth, middle + 0.5 * kWidth};
  chart.y_range = {-32.0, 28.0};
  return chart;
}

}  // namespace

std::string geometry_charts_svg(const GeometryResult& result) {
  const geometry::Analysis& a = result.analysis;
  const geometry::ContactFunctions& f = a.functions;
  pictures::Curve conicity, harmonic;
  for (std::size_t i = 0; i < a.conicity.size(); ++i) {
    conicity.push_back({kMilli * a.conicity[i].amplitude, a.conicity[i].tan_gamma});
    if (!a.harmonic.empty()) harmonic.push_back({kMilli * a.conicity[i].amplitude, a.harmonic[i]});
  }
  pictures::ChartSheet sheet;
  sheet.title = fmt::format("{} on {}", result.request.wheel, result.request.rail);
  sheet.columns = 2;
  sheet.width = 380.0;
  sheet.height = 230.0;
  sheet.gap_x = 90.0;
  sheet.gap_y = 112.0;
  sheet.bottom = 80.0;
  sheet.legend = pictures::ChartSheet::Legend::below;
  const auto both = [&](double factor, double geometry::Touch::*value) {
    const auto of = [&](geometry::Touch Position::*side) {
      return over_shift(f, [=](const Position& p) { return factor * ((p.*side).*value); });
    };
    return std::vector<ChartSeries>{line("right", 0, of(&Position::right)), line("left", 1, of(&Position::left))};
  };
  Chart cone =
      chart_of("equivalent conicity", "amplitude [mm]", "tan gamma_e", {line("integral", 0, std::move(conicity))});
  if (!harmonic.empty()) {
    cone.series.push_back(line("harmonic linearization", 1, std::move(harmonic)));
    cone.series.back().dashes = "5 4";
  }
  if (std::isfinite(a.single.tan_gamma)) {
    ChartSeries single;
    single.name = "by the rule";
    single.style = pictures::kBlack;
    single.joined = false;
    single.points.push_back(
        {kMilli * a.single.amplitude, a.single.tan_gamma, 4.5, fmt::format("{:.3f}", a.single.tan_gamma), a.rule});
    cone.series.push_back(std::move(single));
  }
  sheet.charts = {
      chart_of("rolling radius difference", kShift, "right minus left [mm]",
               {line("", 0, over_shift(f, [](const Position& p) { return kMilli * p.radius_difference(); }))}),
      std::move(cone),
      chart_of("contact on the rails", kShift, "y on the profile [mm]", both(kMilli, &geometry::Touch::rail_y)),
      chart_of("contact on the wheels", kShift, "y on the profile [mm]", both(kMilli, &geometry::Touch::wheel_y)),
      chart_of("contact angles", kShift, "inclination [deg]", both(180.0 / kPi, &geometry::Touch::angle)),
      chart_of("height of the wheelset", kShift, "lift [mm]",
               {line("", 0, over_shift(f, [](const Position& p) { return -kMilli * p.z; }))}),
  };
  if (result.load) {
    const geometry::LoadedFunctions& l = *result.load;
    const auto loaded = [&](const char* title, const char* y, double factor, double geometry::LoadedSide::*value) {
      const auto of = [&](geometry::LoadedSide geometry::LoadedPosition::*side) {
        const auto at = [=](const std::vector<geometry::LoadedPosition>& list) {
          return [=, &list](std::size_t i) { return factor * ((list[i].*side).*value); };
        };
        return over_shift(f, at(l.rows), at(l.before), at(l.after));
      };
      using geometry::LoadedPosition;
      sheet.charts.push_back(
          chart_of(title, kShift, y,
                   {line("right", 0, of(&LoadedPosition::right)), line("left", 1, of(&LoadedPosition::left))}));
    };
    loaded("normal forces", "force [kN]", 1e-3, &geometry::LoadedSide::normal_force);
    loaded("largest pressures by Hertz", "pressure [MPa]", kMega, &geometry::LoadedSide::pressure);
  }
  return pictures::draw_sheet(sheet);
}

std::string contact_points_svg(const GeometryResult& result) {
  const geometry::WheelsetOnTrack wheelset = geometry::place(result.right, result.left, result.placement,
                                                             result.request.settings.roll, result.request.settings.yaw);
  pictures::ChartSheet sheet;
  sheet.title = fmt::format("{} on {}: points that touch, every 0.5 mm of displacement", result.request.wheel,
                            result.request.rail);
  sheet.columns = 2;
  sheet.width = 480.0;
  sheet.height = 320.0;
  sheet.gap_x = 80.0;
  sheet.bottom = 80.0;
  sheet.legend = pictures::ChartSheet::Legend::below;
  sheet.charts = {contact_chart(result, wheelset, false), contact_chart(result, wheelset, true)};
  return pictures::draw_sheet(sheet);
}

std::string gauge_sweep_svg(const GaugeSweep& sweep) {
  constexpr std::array<double, 5> kShown{1e-3, 2e-3, 3e-3, 4e-3, 6e-3};
  Chart chart = chart_of("equivalent conicity over the gauge", "gauge [mm]", "tan gamma_e", {});
  int style = 0;
  for (const double amplitude : kShown) {
    pictures::Curve curve;
    for (std::size_t g = 0; g < sweep.gauges.size(); ++g)
      for (const geometry::Conicity& c : sweep.conicity[g])
        if (std::fabs(c.amplitude - amplitude) < 1e-7) curve.push_back({kMilli * sweep.gauges[g], c.tan_gamma});
    if (!curve.empty())
      chart.series.push_back(line(fmt::format("{:g} mm", kMilli * amplitude), style++, std::move(curve)));
  }
  pictures::ChartSheet sheet;
  sheet.height = 320.0;
  sheet.legend = pictures::ChartSheet::Legend::each;
  sheet.charts = {std::move(chart)};
  return pictures::draw_sheet(sheet);
}

}  // namespace treadmark::app
