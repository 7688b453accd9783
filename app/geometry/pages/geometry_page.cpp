// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/geometry/pages/geometry_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/row_blocks.hpp"

namespace treadmark::app {
namespace {

using geometry::Position;
using report::ChartView;
using report::Figure;
using report::Panel;
using report::Series;

/// Rows of the slider: every second one or fewer, so that the page stays small; the least and the greatest shift count.
std::vector<const Position*> steps_of(const geometry::ContactFunctions& f) {
  constexpr std::size_t kMost = 160;
  const std::size_t every = std::max<std::size_t>(1, (f.rows.size() + kMost - 1) / kMost);
  std::vector<const Position*> out;
  for (std::size_t i = 0; i < f.rows.size(); i += every) out.push_back(&f.rows[i]);
  return out;
}

/// Forces and pressures of the steps, which are rows.
void add_load_panels(ChartView& view, const GeometryResult& result, const std::vector<const Position*>& steps) {
  const auto both = [&](const char* label, const char* unit, double factor, double geometry::LoadedSide::*value) {
    Panel panel{label, unit, false, {Series{"right", {}}, Series{"left", {}}}};
    for (const Position* p : steps) {
      const auto row = static_cast<std::size_t>(p - result.analysis.functions.rows.data());
      const geometry::LoadedPosition& at = result.load->rows[row];
      panel.series[0].y.push_back(factor * (at.right.*value));
      panel.series[1].y.push_back(factor * (at.left.*value));
    }
    view.panels.push_back(std::move(panel));
  };
  both("normal force", "kN", 1e-3, &geometry::LoadedSide::normal_force);
  both("largest pressure", "MPa", kMega, &geometry::LoadedSide::pressure);
}

/// Rail and wheel of one side where they are at each step.
ChartView side_view(const geometry::WheelsetOnTrack& wheelset, const std::vector<const Position*>& steps, bool right) {
  constexpr double kInside = 85.0, kOutside = 65.0, kStep = 0.75, kLowest = 42.0, kHighest = -16.0;  // shown [mm]
  const geometry::SideInput& side = wheelset.side(right);
  const double sign = right ? 1.0 : -1.0, z_top = geometry::rail_top(*side.rail, 0.0).z_top;
  ChartView view;
  view.to_scale = true;
  view.x = report::Axis{"y on the track", "mm"};
  view.panels.push_back({"height", "mm", false, {Series{"rail", {}}, Series{"wheel", {}}, Series{"contact", {}}}});
  view.panels[0].series[2].marks = Series::Marks::points;
  const auto shown = [&](double z_mm) { return z_mm < kLowest && z_mm > kHighest ? -z_mm : kNaN; };
  for (const Position* p : steps) {
    const geometry::Touch& touch = right ? p->right : p->left;
    ChartView::Curves curves;
    curves.y.assign(1, std::vector<std::vector<double>>(3));
    std::vector<double> across;  // outwards from the middle of the track [mm]
    for (double y = -kInside; y <= kOutside; y += kStep) across.push_back(kMilli * side.rail_y + y);
    across.push_back(kMilli * touch.track_y);
    ranges::sort(across);
    for (const double y : across) {
      // the wheel where it is: shifted, rolled, and lowered by its gap; the roll is small, so heights are turned at y
      const double own = kMillimetre * y - sign * p->y - side.wheel_y;
      const double wheel = side.wheel->at(own).z - wheelset.nominal_radius() + sign * p->roll * kMillimetre * y;
      curves.x.push_back(sign * y);
      curves.y[0][0].push_back(shown(kMilli * (side.rail->at(kMillimetre * y - side.rail_y).z - z_top)));
      curves.y[0][1].push_back(shown(kMilli * (wheel + touch.gap)));
      curves.y[0][2].push_back(y == kMilli * touch.track_y ? -kMilli * touch.track_z : kNaN);
    }
    if (!right) {
      ranges::reverse(curves.x);
      for (std::vector<double>& y : curves.y[0]) ranges::reverse(y);
    }
    view.by_step.push_back(std::move(curves));
  }
  return view;
}

/// Quantities of the steps, beside the slider.
ChartView functions_view(const std::vector<const Position*>& steps) {
  ChartView view;
  view.linked = true;
  const auto series = [&](const char* name, auto value) {
    Series s{name, {}};
    for (const Position* p : steps) s.y.push_back(value(*p));
    return s;
  };
  const auto both = [&](const char* label, const char* unit, double factor, double geometry::Touch::*value) {
    view.panels.push_back({label,
                           unit,
                           false,
                           {series("right", [&](const Position& p) { return factor * (p.right.*value); }),
                            series("left", [&](const Position& p) { return factor * (p.left.*value); })}});
  };
  view.panels.push_back({"rolling radius difference", "mm", false, {series("", [](const Position& p) {
                           return kMilli * p.radius_difference();
                         })}});
  both("contact on the rails", "mm", kMilli, &geometry::Touch::rail_y);
  both("contact on the wheels", "mm", kMilli, &geometry::Touch::wheel_y);
  both("contact angle", "°", 180.0 / kPi, &geometry::Touch::angle);
  view.panels.push_back({"lift", "mm", false, {series("", [](const Position& p) { return -kMilli * p.z; })}});
  return view;
}

ChartView conicity_view(const geometry::Analysis& a, const std::optional<geometry::Analysis>& with_new) {
  ChartView view;
  report::Axis x{"amplitude", "mm"};
  Series integral{"integral method", {}}, harmonic{"harmonic linearization", {}};
  harmonic.dashed = true;
  for (std::size_t i = 0; i < a.conicity.size(); ++i) {
    x.values.push_back(kMilli * a.conicity[i].amplitude);
    integral.y.push_back(a.conicity[i].tan_gamma);
    if (!a.harmonic.empty()) harmonic.y.push_back(a.harmonic[i]);
  }
  view.x = std::move(x);
  Panel panel{"equivalent conicity tan γₑ", "", false, {std::move(integral)}};
  if (!harmonic.y.empty()) panel.series.push_back(std::move(harmonic));
  if (with_new) {
    Series fresh{"new profiles, integral method", {}};
    for (const geometry::Conicity& c : with_new->conicity) fresh.y.push_back(c.tan_gamma);
    panel.series.push_back(std::move(fresh));
  }
  view.panels.push_back(std::move(panel));
  return view;
}

ChartView sweep_view(const GaugeSweep& sweep) {
  ChartView view;
  report::Axis x{"gauge", "mm"};
  Series series{"3 mm", {}};
  series.marks = Series::Marks::both;
  for (std::size_t g = 0; g < sweep.gauges.size(); ++g) {
    x.values.push_back(kMilli * sweep.gauges[g]);
    series.y.push_back(sweep.trouble[g].empty() ? sweep.at_3mm[g].tan_gamma : kNaN);
  }
  view.x = std::move(x);
  view.panels.push_back({"equivalent conicity tan γₑ at 3 mm", "", false, {std::move(series)}});
  return view;
}

}  // namespace

report::Page geometry_page(const GeometryResult& result) {
  const geometry::Analysis& a = result.analysis;
  const GeometryRequest& r = result.request;
  const auto file = [](const std::string& name) { return std::filesystem::path(name).filename().string(); };
  const geometry::WheelsetOnTrack wheelset =
      geometry::place(result.right, result.left, result.placement, r.settings.roll, r.settings.yaw);
  const std::vector<const Position*> steps = steps_of(a.functions);
  report::Page page{"geometry", fmt::format("{} on {}", file(r.wheel), file(r.rail)),
                    result.load ? fmt::format("Contact geometry of a wheelset on its track, axle load {:g} kN",
                                              1e-3 * result.load->load.weight)
                                : "Contact geometry of a wheelset on its track, without forces"};
  report::Timeline timeline{"shift"};
  report::Axis shift{"lateral displacement to the right", "mm"};
  for (const Position* p : steps) shift.values.push_back(kMilli * p->y);
  timeline.start = static_cast<std::size_t>(
      ranges::min_element(steps, {}, [](const Position* p) { return std::fabs(p->y); }) - steps.begin());
  timeline.axes.push_back(std::move(shift));
  page.timeline = std::move(timeline);

  report::Section overview{"overview", "Overview"};
  for (const std::string& note : result.notes)
    overview.blocks.emplace_back(report::Banner{report::Banner::Kind::note, "Note:", note});
  report::Cards cards;
  report::Facts facts;
  report::add_cards(cards, result);
  report::add_facts(facts, result);
  if (result.load) {
    report::add_cards(cards, *result.load);
    report::add_facts(facts, *result.load);
  }
  overview.blocks.emplace_back(std::move(cards));
  overview.blocks.emplace_back(std::move(facts));
  page.sections.push_back(std::move(overview));
  report::Section contact{"contact", "Contact"};
  contact.blocks.emplace_back(Figure{"left", "Left side, seen along the track", side_view(wheelset, steps, false)});
  contact.blocks.emplace_back(Figure{"right", "Right side", side_view(wheelset, steps, true)});
  ChartView functions = functions_view(steps);
  if (result.load) add_load_panels(functions, result, steps);
  contact.blocks.emplace_back(Figure{"functions", "Over the lateral displacement", std::move(functions)});
  page.sections.push_back(std::move(contact));
  report::Section conicity{"conicity", "Conicity"};
  if (!a.conicity.empty())
    conicity.blocks.emplace_back(
        Figure{"conicity-chart", "Equivalent conicity over the amplitude", conicity_view(a, result.with_new)});
  if (result.sweep)
    conicity.blocks.emplace_back(Figure{"gauges", "Equivalent conicity over the gauge", sweep_view(*result.sweep)});
  if (!a.functions.jumps.empty())
    conicity.blocks.emplace_back(report::table_of("jumps", "Jumps of contact points", a.functions.jumps));
  if (!conicity.blocks.empty()) page.sections.push_back(std::move(conicity));
  page.document = geometry_json(result);
  return page;
}

}  // namespace treadmark::app
