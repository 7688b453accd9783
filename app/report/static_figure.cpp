// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/report/static_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "treadmark/app/report/field_catalogue.hpp"
#include "treadmark/app/report/frame_packer.hpp"
#include "treadmark/app/report/html_text.hpp"
#include "treadmark/app/report/section_picture.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/pictures/chart_draw.hpp"
#include "treadmark/pictures/histories/history_svg.hpp"
#include "treadmark/pictures/outline.hpp"
#include "treadmark/pictures/picture_patch.hpp"
#include "treadmark/pictures/picture_svg.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::app::report {

namespace {

// Sizes in pixels.
constexpr double kFigureLeft = 78.0, kFigureTop = 44.0, kFigureRight = 24.0, kFigureBottom = 50.0;
constexpr double kFigureWidth = 640.0, kFigureHeight = 200.0, kBetween = 18.0, kFigureLegend = 24.0;
constexpr std::size_t kMostPanels = 24;  // of contact patches in a picture

std::string axis_label(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : fmt::format("{} [{}]", label, unit);
}

const Axis* axis_of(const ChartView& view, const Page& page) {
  if (view.linked && page.timeline && !page.timeline->axes.empty()) return &page.timeline->axes.front();
  return view.x ? &*view.x : nullptr;
}

io::ChartSeries drawn(const Series& series, const std::vector<double>& x, const std::vector<double>& y) {
  io::ChartSeries out;
  out.name = series.name;
  const std::size_t count = std::min(x.size(), y.size());
  if (series.marks == Series::Marks::line) {
    for (std::size_t i = 0; i < count; ++i) out.curve.push_back({x[i], y[i]});
  } else {
    out.joined = series.marks == Series::Marks::both;
    for (std::size_t i = 0; i < count; ++i)
      out.points.push_back({x[i], y[i], 3.5, "", i < series.texts.size() ? series.texts[i] : ""});
  }
  return out;
}

io::Chart drawn(const ChartView& view, std::size_t which, const Axis* axis, std::size_t step) {
  const Panel& panel = view.panels[which];
  io::Chart chart;
  chart.y_label = axis_label(panel.label, panel.unit);
  chart.y_scale = panel.logarithmic ? io::AxisScale::log : io::AxisScale::linear;
  chart.x_scale = axis && axis->logarithmic ? io::AxisScale::log : io::AxisScale::linear;
  for (std::size_t k = 0; k < panel.series.size(); ++k) {
    const Series& series = panel.series[k];
    const bool changing = step < view.by_step.size();
    const std::vector<double>& x = changing            ? view.by_step[step].x
                                   : !series.x.empty() ? series.x
                                   : axis              ? axis->values
                                                       : series.x;
    chart.series.push_back(drawn(series, x, changing ? view.by_step[step].y[which][k] : series.y));
    io::set_look(chart.series.back(), k, panel.series.size());
    if (series.dashed) chart.series.back().dashes = "6 4";
  }
  if (!panel.levels.empty()) {
    io::ChartSeries levels;
    levels.style = 4;  // black
    for (const Level& level : panel.levels) {
      levels.levels.push_back(level.value);
      if (!level.label.empty()) levels.name += (levels.name.empty() ? "" : ", ") + level.label;
    }
    chart.series.push_back(std::move(levels));
  }
  return chart;
}

const FrameSet& set_of(const Page& page, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= page.sets.size())
    throw Error(ErrorKind::configuration, fmt::format("the report has no contact fields number {}", index));
  return page.sets[static_cast<std::size_t>(index)];
}

constexpr double kTilt = 35.0;  // of the names of categories [degrees]
constexpr double kSine = 0.574;

/// Room for the names of categories below a chart [px].
double category_height(const Axis* axis) {
  double widest = 0.0;
  if (axis)
    for (const std::string& label : axis->labels) widest = std::max(widest, io::text_width(label, io::kChartFont));
  return widest > 0.0 ? kSine * widest + 8.0 : 0.0;
}

/// Names of categories below the place where each is.
std::string category_names(const Axis& axis, double y) {
  std::string out;
  const double each = kFigureWidth / static_cast<double>(axis.labels.size());
  for (std::size_t i = 0; i < axis.labels.size(); ++i) {
    const double x = kFigureLeft + (static_cast<double>(i) + 0.5) * each + 4.0;
    out += io::svg_text(x, y, axis.labels[i], "end",
                        fmt::format(" transform=\"rotate(-{} {:.1f} {:.1f})\"", kTilt, x, y).c_str());
  }
  return out;
}

bool has_pressure(const io::CaseResult& result) {
  return std::ranges::any_of(result.patches,
                             [](const io::PatchResult& patch) { return !patch.fields.pressure.empty(); });
}

/// All frames or, of many, some at equal distances.
std::string contact_svg(const FrameSet& set) {
  io::RunResult some;
  const std::size_t every = (set.frames.size() + kMostPanels - 1) / kMostPanels;
  for (std::size_t i = 0; i < set.frames.size(); i += std::max<std::size_t>(1, every))
    some.cases.push_back(*set.frames[i].result);
  some.cases_total = static_cast<int>(some.cases.size());
  return io::pressure_svg(some);
}

}  // namespace

std::string chart_svg(const ChartView& view, const Page& page, const std::string& title, std::size_t step) {
  const Axis* axis = axis_of(view, page);
  std::vector<io::Chart> charts;
  double beside = 0.0;
  for (std::size_t i = 0; i < view.panels.size(); ++i) {
    charts.push_back(drawn(view, i, axis, step));
    std::vector<io::ChartSeries> named;
    for (const io::ChartSeries& series : charts.back().series)
      if (!series.name.empty()) named.push_back(series);
    if (named.size() > 1) beside = std::max(beside, kFigureLegend + io::legend_width(named));
  }
  std::vector<double> all_x;
  for (const io::Chart& chart : charts)
    for (const io::ChartSeries& series : chart.series) {
      for (const auto& point : series.curve) all_x.push_back(point[0]);
      for (const auto& point : series.points) all_x.push_back(point.x);
    }
  const double count = static_cast<double>(charts.size());
  const double height =
      kFigureTop + count * kFigureHeight + (count - 1.0) * kBetween + kFigureBottom + category_height(axis);
  std::string out = io::svg_head(kFigureLeft + kFigureWidth + std::max(kFigureRight, beside), height, io::kChartFont,
                                 io::kChartStyle);
  out += io::svg_text(kFigureLeft + 0.5 * kFigureWidth, 22.0, title, "middle", " class=\"title\"");
  const io::ChartAxis range(axis && axis->logarithmic ? io::AxisScale::log : io::AxisScale::linear, all_x);
  double y = kFigureTop - 10.0;
  for (io::Chart& chart : charts) {
    const bool last = &chart == &charts.back();
    const bool categories = axis && !axis->labels.empty();
    chart.x_numbers = last && !categories;
    if (last && axis && !categories) chart.x_label = axis_label(axis->label, axis->unit);
    if (categories)
      chart.x_range = {-0.5, static_cast<double>(axis->labels.size()) - 0.5};
    else if (chart.x_scale == io::AxisScale::linear)
      chart.x_range = {range.low(), range.high()};
    out += io::draw_chart(chart, {kFigureLeft, y, kFigureWidth, kFigureHeight});
    std::vector<io::ChartSeries> named;
    for (const io::ChartSeries& series : chart.series)
      if (!series.name.empty()) named.push_back(series);
    if (named.size() > 1) out += io::draw_chart_legend(named, kFigureLeft + kFigureWidth + kFigureLegend, y + 10.0);
    if (last && categories) out += category_names(*axis, y + kFigureHeight + 16.0);
    y += kFigureHeight + kBetween;
  }
  return out + "</svg>\n";
}

std::vector<std::string> static_figure(const Figure& figure, const Page& page) {
  if (const auto* picture = std::get_if<PictureView>(&figure.view)) return {picture->svg};
  if (const auto* chart = std::get_if<ChartView>(&figure.view)) return {chart_svg(*chart, page, figure.title)};
  if (const auto* map = std::get_if<MapView>(&figure.view)) return {map_svg(*map, figure.title)};
  if (const auto* scene = std::get_if<SceneView>(&figure.view))
    return {section_svg(set_of(page, scene->set), page.surfaces)};
  std::vector<std::string> pictures;
  const std::vector<int>& sets = std::get<ContactView>(figure.view).sets;
  for (const int index : sets) {
    const FrameSet& set = set_of(page, index);
    const bool named = sets.size() > 1 &&
                       std::ranges::any_of(set.frames, [](const Frame& frame) { return has_pressure(*frame.result); });
    pictures.push_back(named ? field_svg(set.frames, *find_field("pressure"), set.name) : contact_svg(set));
  }
  return pictures;
}

namespace {

constexpr double kPanel = 210.0, kGapX = 48.0, kGapY = 56.0, kFieldLeft = 60.0, kFieldTop = 74.0, kFieldBottom = 44.0,
                 kLegend = 150.0;  // [px]
constexpr int kMostColumns = 6, kSteps = 24;
constexpr std::size_t kMostFrames = 24;
constexpr std::array<const char*, 4> kStateColours{"none", "#2b6ca3", "#e8a33d", "#8c2d5a"};
constexpr std::array<const char*, 4> kStateNames{"", "adhesion", "slip", "plastic shear"};

/// The part of a patch that is drawn.
struct Shown {
  const io::PatchResult* patch = nullptr;
  GridPart part;
  std::vector<double> values;  ///< of the whole grid; NaN outside the contact
  io::Window window;           ///< in the picture's plane [mm]
};

Shown shown_patch(const io::PatchResult& patch, const FieldInfo& field) {
  const Grid2& grid = patch.fields.grid;
  Shown out{&patch, shown_part(patch.fields), {}, {}};
  if (field.kind == FieldInfo::Kind::state)
    out.values.assign(patch.fields.state.begin(), patch.fields.state.end());
  else
    out.values = field.values(patch);
  if (out.values.size() != grid.size()) out.values.clear();
  for (std::size_t i = 0; i < out.values.size(); ++i)
    if (patch.fields.state.size() == out.values.size() && patch.fields.state[i] == 0) out.values[i] = NAN;
  const Vec3& origin = patch.fields.X_TC.origin;
  const GridPart& part = out.part;
  out.window = {kMilli * (origin.x() + grid.x(part.ix0) - 0.5 * grid.dx),
                kMilli * (origin.x() + grid.x(part.ix0 + part.nx - 1) + 0.5 * grid.dx),
                kMilli * (origin.y() + grid.y(part.iy0) - 0.5 * grid.dy),
                kMilli * (origin.y() + grid.y(part.iy0 + part.ny - 1) + 0.5 * grid.dy)};
  return out;
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

int step_of(double value, const Range& range) {
  return std::clamp(static_cast<int>(kSteps * (value - range.low) / (range.high - range.low)), 0, kSteps - 1);
}

std::string fill_of(double value, const FieldInfo& field, const Range& range) {
  if (std::isnan(value)) return "";
  if (field.kind == FieldInfo::Kind::state)
    return kStateColours[std::min<std::size_t>(3, static_cast<std::size_t>(value))];
  return io::colour((step_of(value, range) + 0.5) / kSteps);
}

/// Rows of cells, equal neighbours as one rectangle.
std::string cells(const Shown& shown, const FieldInfo& field, const Range& range, const io::PanelScale& panel) {
  std::string out = "<g shape-rendering=\"crispEdges\">\n";  // no seams between neighbours
  const GridPart& part = shown.part;
  const double x0 = (shown.window.x_low - panel.window.x_low) * panel.scale_x,
               y0 = (panel.window.y_high - shown.window.y_low) * panel.scale_y;
  const double width = kMilli * shown.patch->fields.grid.dx * panel.scale_x,
               height = kMilli * shown.patch->fields.grid.dy * panel.scale_y;
  for (int iy = 0; iy < part.ny; ++iy) {
    std::string last;
    int from = 0;
    const auto flush = [&](int to) {
      if (!last.empty())
        out += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                           x0 + from * width, y0 - (iy + 1) * height, (to - from) * width + 0.04, height + 0.04, last);
      from = to;
    };
    for (int ix = 0; ix < part.nx; ++ix) {
      const std::string fill =
          fill_of(shown.values[shown.patch->fields.grid.index(part.ix0 + ix, part.iy0 + iy)], field, range);
      if (fill == last) continue;
      flush(ix);
      last = fill;
    }
    flush(part.nx);
  }
  out += "</g>\n";
  const auto edge = [&](const char* style, auto&& inside) {
    io::CellMask mask{part.nx, part.ny, {}};
    for (int iy = 0; iy < part.ny; ++iy)
      for (int ix = 0; ix < part.nx; ++ix) {
        const std::size_t i = shown.patch->fields.grid.index(part.ix0 + ix, part.iy0 + iy);
        mask.inside.push_back(i < shown.patch->fields.state.size() && inside(shown.patch->fields.state[i]) ? 1 : 0);
      }
    const auto loops = io::outline(mask);
    if (!loops.empty())
      out += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, io::path_at(loops, x0, y0, width, -height));
  };
  edge("adhesion", [](std::uint8_t state) { return state == 1; });
  edge("contact", [](std::uint8_t state) { return state > 0; });
  return out;
}

std::string legend(const FieldInfo& field, const Range& range) {
  std::string out = io::svg_text(
      0.0, -8.0, field.unit.empty() ? std::string(field.label) : fmt::format("{} [{}]", field.label, field.unit),
      "start");
  if (field.kind == FieldInfo::Kind::state) {
    for (std::size_t k = 1; k < kStateNames.size(); ++k) {
      out += fmt::format("<rect x=\"0\" y=\"{}\" width=\"14\" height=\"12\" fill=\"{}\"/>\n", 20 * k - 16,
                         kStateColours[k]);
      out += io::svg_text(22.0, 20.0 * static_cast<double>(k) - 6.0, kStateNames[k], "start");
    }
    return out;
  }
  constexpr double kStep = kPanel / kSteps;
  for (int k = 0; k < kSteps; ++k)
    out += fmt::format("<rect x=\"0\" y=\"{:.2f}\" width=\"14\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                       kPanel - (k + 1) * kStep, kStep + 0.05, io::colour((k + 0.5) / kSteps));
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0})
    out += io::svg_text(20.0, kPanel * (1.0 - part) + 3.5, shown({range.low + part * (range.high - range.low), 3}),
                        "start");
  return out;
}

}  // namespace

std::string field_svg(const std::vector<Frame>& frames, const FieldInfo& field, const std::string& title) {
  const std::size_t every = std::max<std::size_t>(1, (frames.size() + kMostFrames - 1) / kMostFrames);
  std::vector<std::pair<const Frame*, std::vector<Shown>>> panels;
  Range range;
  io::Window all;
  bool any = false;
  for (std::size_t i = 0; i < frames.size(); i += every) {
    auto& panel = panels.emplace_back(&frames[i], std::vector<Shown>());
    for (const io::PatchResult& patch : frames[i].result->patches) {
      Shown one = shown_patch(patch, field);
      if (one.values.empty()) continue;
      for (const double value : one.values) range.include(value);
      if (any)
        all.include(one.window);
      else
        all = one.window;
      any = true;
      panel.second.push_back(std::move(one));
    }
  }
  if (!any) throw Error(ErrorKind::configuration, fmt::format("these results have no {}", field.label));
  if (field.kind == FieldInfo::Kind::diverging) {
    range.high = std::max(std::fabs(range.low), std::fabs(range.high));
    range.low = -range.high;
  } else if (range.low >= 0.0) {
    range.low = 0.0;
  }
  if (!(range.high > range.low)) range.high = range.low + 1.0;

  const double scale = kPanel / std::max(all.width(), all.height());
  const io::PanelScale panel_scale{all, scale, scale};
  const double width = all.width() * scale, height = all.height() * scale;
  const int count = static_cast<int>(panels.size()), columns = std::min(count, kMostColumns),
            rows = (count + columns - 1) / columns;
  std::string out = io::svg_head(kFieldLeft + columns * width + (columns - 1) * kGapX + kLegend,
                                 kFieldTop + std::max(kPanel, rows * height + (rows - 1) * kGapY) + kFieldBottom, 10,
                                 io::kPanelStyle);
  out += io::svg_text(kFieldLeft, 22.0, title, "start", " class=\"title\"");
  for (int k = 0; k < count; ++k) {
    const auto& [frame, patches] = panels[static_cast<std::size_t>(k)];
    out += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n", kFieldLeft + (k % columns) * (width + kGapX),
                       kFieldTop + (k / columns) * (height + kGapY));
    out += io::svg_text(0.0, -8.0, frame->name, "start");
    for (const Shown& one : patches) out += cells(one, field, range, panel_scale);
    if (k + columns >= count) out += io::svg_text(0.5 * width, height + 30.0, "x [mm]");
    if (k % columns == 0)
      out += io::svg_text(-42.0, 0.5 * height, "y [mm]", "middle",
                          fmt::format(" transform=\"rotate(-90 -42 {:.1f})\"", 0.5 * height).c_str());
    if (patches.empty()) out += io::svg_text(0.5 * width, 0.5 * height, std::string(to_string(frame->result->status)));
    out += io::draw_panel_axes(panel_scale) + "</g>\n";
  }
  out += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n",
                     kFieldLeft + columns * width + (columns - 1) * kGapX + 32.0, kFieldTop) +
         legend(field, range) + "</g>\n";
  return out + "</svg>\n";
}

}  // namespace treadmark::app::report
