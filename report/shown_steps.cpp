// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/shown_steps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::report {
namespace {

constexpr std::size_t kMostSteps = 1000;
constexpr std::size_t kMostCells = 40'000;  ///< of all tables
constexpr std::size_t kMostRows = 2000;     ///< of a table without steps

/// Some of them at equal distances, the first and the last among them.
std::vector<std::size_t> evenly(const std::vector<std::size_t>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<std::size_t> some;
  some.reserve(most);
  for (std::size_t k = 0; k < most; ++k)
    some.push_back(all[most > 1 ? k * (all.size() - 1) / (most - 1) : all.size() / 2]);
  return some;
}

template <class Function>
void each_block(Page& page, Function&& use) {
  for (Section& section : page.sections)
    for (Block& block : section.blocks) use(block);
}

/// The curves over the steps of the timeline.
std::vector<RowValue> curves_over(Page& page, std::size_t steps) {
  std::vector<RowValue> curves;
  each_block(page, [&](const Block& block) {
    const auto* figure = std::get_if<Figure>(&block);
    const auto* chart = figure != nullptr ? std::get_if<ChartView>(&figure->view) : nullptr;
    if (chart == nullptr) return;
    for (const Panel& panel : chart->panels)
      for (const Series& series : panel.series) {
        std::vector<double> values(steps, kNaN);
        if (!series.steps.empty()) {
          for (std::size_t i = 0; i < std::min(series.steps.size(), series.y.size()); ++i)
            if (series.steps[i] >= 0.0 && series.steps[i] < static_cast<double>(steps))
              values[to_whole<std::size_t>(series.steps[i])] = series.y[i];
        } else if (chart->linked && series.y.size() == steps) {
          values = series.y;
        } else {
          continue;
        }
        curves.emplace_back([values = std::move(values)](std::size_t row) { return values[row]; });
      }
  });
  return curves;
}

/// Keeps what a page has of these steps.
class StepFilter {
 public:
  StepFilter(std::vector<std::size_t> kept, std::size_t steps) : kept_(std::move(kept)), steps_(steps) {
    for (std::size_t k = 0; k < kept_.size(); ++k) place_[kept_[k]] = k;
  }

  void apply(Page& page) const {
    each_block(page, [&](Block& block) {
      if (auto* table = std::get_if<Table>(&block)) keep_rows(*table);
      auto* figure = std::get_if<Figure>(&block);
      if (figure == nullptr) return;
      if (auto* chart = std::get_if<ChartView>(&figure->view)) keep_curves(*chart);
      if (auto* map = std::get_if<MapView>(&figure->view)) keep(map->by_step);
    });
    keep_frames(page);
    Timeline& timeline = *page.timeline;
    keep(timeline.names);
    keep(timeline.frames);
    for (Axis& axis : timeline.axes) keep(axis.values);
    timeline.start = place_.at(timeline.start);
    timeline.notable.clear();
  }

 private:
  /// Of a list with an entry a step; others stay.
  template <class T>
  void keep(std::vector<T>& list) const {
    if (list.size() != steps_) return;
    std::vector<T> some;
    some.reserve(kept_.size());
    for (const std::size_t step : kept_) some.push_back(std::move(list[step]));
    list = std::move(some);
  }

  void keep_rows(Table& table) const {
    std::vector<Table::Row> rows;
    for (Table::Row& row : table.rows) {
      if (row.step >= 0) {
        const auto at = place_.find(static_cast<std::size_t>(row.step));
        if (at == place_.end()) continue;
        row.step = static_cast<int>(at->second);
      }
      rows.push_back(std::move(row));
    }
    table.rows = std::move(rows);
  }

  void keep_curves(ChartView& chart) const {
    keep(chart.by_step);
    for (Panel& panel : chart.panels)
      for (Series& series : panel.series) {
        if (!series.steps.empty()) {
          keep_points(series);
        } else if (chart.linked) {
          keep(series.y);
          keep(series.x);
          keep(series.texts);
        }
      }
  }

  void keep_points(Series& series) const {
    Series some = series;
    some.y.clear(), some.x.clear(), some.texts.clear(), some.steps.clear();
    for (std::size_t i = 0; i < series.steps.size(); ++i) {
      const auto at = series.steps[i] < 0.0 ? place_.end() : place_.find(to_whole<std::size_t>(series.steps[i]));
      if (at == place_.end()) continue;
      some.steps.push_back(static_cast<double>(at->second));
      some.y.push_back(series.y[i]);
      if (!series.x.empty()) some.x.push_back(series.x[i]);
      if (!series.texts.empty()) some.texts.push_back(series.texts[i]);
    }
    series = std::move(some);
  }

  /// Those that kept steps show, and the nominal ones; the timeline gets their new places.
  void keep_frames(Page& page) const {
    std::vector<int>& shown = page.timeline->frames;
    if (shown.size() != steps_) return;
    std::set<int> wanted;
    for (const std::size_t step : kept_)
      if (shown[step] >= 0) wanted.insert(shown[step]);
    for (const FrameSet& set : page.sets)
      if (set.nominal) wanted.insert(*set.nominal);
    const std::vector<int> order(wanted.begin(), wanted.end());
    const auto place = [&](int frame) { return static_cast<int>(ranges::lower_bound(order, frame) - order.begin()); };
    for (FrameSet& set : page.sets) {
      std::vector<Frame> frames;
      frames.reserve(order.size());
      for (const int frame : order)
        if (static_cast<std::size_t>(frame) < set.frames.size())
          frames.push_back(std::move(set.frames[static_cast<std::size_t>(frame)]));
      set.frames = std::move(frames);
      if (set.nominal) set.nominal = place(*set.nominal);
    }
    for (const std::size_t step : kept_)
      if (shown[step] >= 0) shown[step] = place(shown[step]);
  }

  std::vector<std::size_t> kept_;
  std::size_t steps_;
  std::map<std::size_t, std::size_t> place_;
};

std::size_t cells_of_steps(Page& page) {
  std::size_t cells = 0;
  each_block(page, [&](const Block& block) {
    if (const auto* table = std::get_if<Table>(&block))
      for (const Table::Row& row : table->rows)
        if (row.step >= 0) cells += row.cells.size();
  });
  return cells;
}

std::string where_all_are(const Page& page) {
  return page.full_data.empty() ? "" : " All are in " + page.full_data + ".";
}

/// Below the banners that are there.
void say(Page& page, std::string heading, std::string text) {
  if (page.sections.empty()) return;
  std::vector<Block>& blocks = page.sections.front().blocks;
  const auto after = ranges::find_if_not(blocks, [](const Block& b) { return std::holds_alternative<Banner>(b); });
  blocks.insert(after, Banner{Banner::Kind::note, std::move(heading), std::move(text)});
}

void keep_few_rows(Table& table, const std::string& where) {
  if (table.rows.size() <= kMostRows || ranges::any_of(table.rows, [](const auto& row) { return row.step >= 0; }))
    return;
  const std::size_t count = table.rows.size();
  std::vector<Table::Row> rows;
  rows.reserve(kMostRows);
  for (const std::size_t row : spread_rows(count, kMostRows, {})) rows.push_back(std::move(table.rows[row]));
  table.rows = std::move(rows);
  table.caption += fmt::format(" {} of {} rows, at equal distances.{}", kMostRows, count, where);
}

}  // namespace

std::vector<std::size_t> spread_rows(std::size_t count, std::size_t most, const std::vector<RowValue>& watched,
                                     const std::vector<std::size_t>& wanted) {
  std::vector<std::size_t> all(count);
  for (std::size_t row = 0; row < count; ++row) all[row] = row;
  if (count <= most) return all;
  std::set<std::size_t> kept{0, count - 1};
  for (const std::size_t row : evenly(wanted, most / 2))
    if (kept.size() < most) kept.insert(row);
  const std::size_t each = 2 * watched.size();
  const std::size_t stretches = watched.empty() || kept.size() >= most ? 0 : (most - kept.size()) / each;
  for (std::size_t k = 0; k < stretches; ++k)
    for (const RowValue& value : watched) {
      std::size_t low = count, high = count;
      double least = kInfinity, greatest = -kInfinity;
      for (std::size_t row = k * count / stretches; row < (k + 1) * count / stretches; ++row) {
        const double here = value(row);
        if (here < least) least = here, low = row;
        if (here > greatest) greatest = here, high = row;
      }
      if (low < count) kept.insert({low, high});
    }
  std::vector<std::size_t> others;
  ranges::copy_if(all, std::back_inserter(others), [&](std::size_t row) { return !kept.contains(row); });
  for (const std::size_t row : evenly(others, most - std::min(most, kept.size()))) kept.insert(row);
  return {kept.begin(), kept.end()};
}

Page with_shown_steps(Page page) {
  const std::string where = where_all_are(page);
  each_block(page, [&](Block& block) {
    if (auto* table = std::get_if<Table>(&block)) keep_few_rows(*table, where);
  });
  if (!page.timeline || page.timeline->count() == 0) return page;
  const std::size_t steps = page.timeline->count(), cells = cells_of_steps(page);
  std::size_t most = kMostSteps;
  if (cells > kMostCells) most = std::min(most, std::max<std::size_t>(10, steps * kMostCells / cells));
  if (steps <= most) return page;
  std::vector<std::size_t> wanted = page.timeline->notable;
  wanted.push_back(page.timeline->start);
  ranges::sort(wanted);
  std::vector<std::size_t> kept = spread_rows(steps, most, curves_over(page, steps), wanted);
  if (!ranges::binary_search(kept, page.timeline->start))  // among many notable ones
    kept.insert(ranges::lower_bound(kept, page.timeline->start), page.timeline->start);
  const std::string label = page.timeline->label;
  StepFilter(kept, steps).apply(page);
  say(page, fmt::format("{} of {} {}s are on this page:", kept.size(), steps, label),
      "those that went wrong or have warnings (half of the room at most), the least and greatest values of all curves, "
      "and others at equal distances." +
          where);
  return page;
}

}  // namespace treadmark::report
