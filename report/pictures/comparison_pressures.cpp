// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/report/pictures/comparison_cases.hpp"
#include "treadmark/report/pictures/comparison_pictures.hpp"
#include "treadmark/report/pictures/patch_picture.hpp"

namespace treadmark::pictures {
namespace {

constexpr std::size_t kMostCases = 3, kMostColumns = 8;

// Sizes in pixels.
constexpr double kPanel = 170.0;  // width of a panel
constexpr double kGap = 18.0;     // between panels beside each other
constexpr double kPanelLeft = 62.0, kPanelTop = 16.0, kPanelRight = 116.0;
constexpr double kCaption = 26.0;                  // of a case
constexpr double kBetween = 14.0;                  // two cases
constexpr double kTitle = 14.0;                    // a line above a panel
constexpr double kBelow = 54.0;                    // numbers and words below a panel, and what keeps it from the next
constexpr double kLowest = 0.45, kHighest = 1.25;  // height over width of a panel
constexpr double kPanelMargin = 0.06;              // of the window, around the contact
constexpr double kEqualScale = 4.0;                // windows longer than this get their own scale in each direction
constexpr int kFont = 11;
constexpr double kTitleFont = 13.0;  // a little more than that of the style: it is bold

/// A case through all candidates.
struct Block {
  std::string title;
  std::vector<PatchPanel> panels;
  Window window{0.0, 10.0, 0.0, 10.0};
  double top_pressure = 0.0;
};

/// With a sign and two decimals, one where it is large.
std::string percent(double value) {
  const std::string text = fmt::format("{:+.{}f}", value, std::abs(value) < 9.995 ? 2 : 1);
  return (text == "+0.00" || text == "-0.00" ? "0.00" : text) + " %";
}

PatchPanel make_panel(const io::ComparisonCandidate& candidate, int case_number, bool truth) {
  PatchPanel panel;
  panel.title_y = -6.0;
  if (!candidate.failure.empty()) {
    panel.words = "failed";
    return panel;
  }
  if (const io::ComparisonRow* row = find_row(candidate, case_number); row != nullptr && row->patches > 0) {
    if (std::isfinite(row->pmax)) panel.below = three_digits(row->pmax * 1e-6) + " MPa";
    if (!truth && row->comparable && std::isfinite(row->pmax_error))
      panel.below += ", " + percent(row->pmax_error * 1e2);
  }
  const io::CaseResult* result = find_result(candidate, case_number);
  if (result == nullptr) {
    panel.words = "no fields";
    return panel;
  }
  const std::vector<PatchPicture> pictures = patch_pictures(*result);
  if (const io::PatchResult* patch = main_patch(*result); patch != nullptr && !pictures.empty())
    if (PatchPicture picture = make_patch_picture(patch->fields); picture.nx > 0) panel.patches = {std::move(picture)};
  if (panel.patches.empty()) panel.words = reason_without_patches(*result);
  return panel;
}

Block make_block(const io::Comparison& comparison, int case_number) {
  Block block;
  block.title = fmt::format("case {}", case_number);
  bool any = false, posed = false;
  for (const io::ComparisonCandidate& candidate : comparison.candidates) {
    block.panels.push_back(make_panel(candidate, case_number, &candidate == comparison.candidates.data()));
    const io::CaseResult* result = find_result(candidate, case_number);
    if (result != nullptr && result->has_wheelset && !posed) {
      block.title += ", " + pitch_text(*result);
      posed = true;
    }
    for (const PatchPicture& picture : block.panels.back().patches) {
      block.top_pressure = std::max(block.top_pressure, picture.greatest());
      if (any) block.window.include(picture.extent());
      if (!any) block.window = picture.extent();
      any = true;
    }
  }
  return block;
}

/// Height of a panel: as the window is, within limits.
double panel_height(const Window& window) {
  return kPanel * std::clamp(window.height() / window.width(), kLowest, kHighest);
}

/// The window with a margin, made as wide or high as the panel; its own scale in each direction when it is very long.
PanelScale panel_scale(const Window& window, double panel_height) {
  const double width = window.width() * (1.0 + 2.0 * kPanelMargin),
               height = window.height() * (1.0 + 2.0 * kPanelMargin);
  double scale_x = kPanel / width, scale_y = panel_height / height;
  if (std::max(scale_x, scale_y) <= kEqualScale * std::min(scale_x, scale_y))
    scale_x = scale_y = std::min(scale_x, scale_y);
  const double x = 0.5 * (window.x_low + window.x_high), y = 0.5 * (window.y_low + window.y_high);
  const double half_x = 0.5 * kPanel / scale_x, half_y = 0.5 * panel_height / scale_y;
  return {{x - half_x, x + half_x, y - half_y, y + half_y}, scale_x, scale_y};
}

/// The name of a candidate, in two lines of about the same length where it is long.
std::vector<std::string> title_lines(const std::string& label) {
  if (text_width(label, kTitleFont) <= kPanel + kGap) return {label};
  std::size_t cut = 0;
  const auto longer = [&](std::size_t first) { return std::max(first, label.size() - first); };
  for (std::size_t i = 1; i < label.size(); ++i)
    if ((label[i - 1] == ' ' || label[i - 1] == '+') && (cut == 0 || longer(i) < longer(cut))) cut = i;
  if (cut == 0) return {label};
  const std::size_t end = label[cut - 1] == ' ' ? cut - 1 : cut;
  return {label.substr(0, end), label.substr(cut)};
}

/// Places and names of the panels, the same for each case.
struct Layout {
  ComparisonGrid grid;
  std::vector<std::vector<std::string>> titles;
  std::size_t title_count = 1;  ///< lines of the longest

  explicit Layout(const io::Comparison& comparison) : grid(comparison_grid(comparison, kMostColumns)) {
    for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
      titles.push_back(title_lines(io::candidate_label(comparison, i)));
      title_count = std::max(title_count, titles.back().size());
    }
  }
  /// Row counted over all bands.
  double row(const GridPlace& place) const {
    const auto above = grid.rows.begin() + static_cast<std::ptrdiff_t>(place.band);
    return static_cast<double>(place.row + std::accumulate(grid.rows.begin(), above, std::size_t{0}));
  }
  double title_height() const { return kTitle * static_cast<double>(title_count); }
  double row_height(double panel_height) const { return title_height() + panel_height + kBelow; }
  double width() const { return kPanel * columns() + kGap * (columns() - 1.0); }
  double height(double panel_height) const {
    const std::size_t rows = std::accumulate(grid.rows.begin(), grid.rows.end(), std::size_t{0});
    return kCaption + row_height(panel_height) * static_cast<double>(rows);
  }
  /// No panel beside it on the left.
  bool leftmost(const GridPlace& place) const {
    return std::none_of(grid.places.begin(), grid.places.end(), [&](const GridPlace& other) {
      return other.band == place.band && other.row == place.row && other.column + 1 == place.column;
    });
  }

 private:
  double columns() const { return static_cast<double>(std::max<std::size_t>(1, grid.columns)); }
};

std::string draw_block(Block& block, const Layout& layout, double panel_height) {
  const PanelScale scale = panel_scale(block.window, panel_height);
  const ColourSteps steps = colour_steps({0.0, block.top_pressure});
  std::string out = svg_text(0.0, 8.0, block.title, "start", " class=\"case\"");
  for (std::size_t i = 0; i < block.panels.size(); ++i) {
    const GridPlace& place = layout.grid.places[i];
    const double x = (kPanel + kGap) * static_cast<double>(place.column);
    const double y = kCaption + layout.title_height() + layout.row(place) * layout.row_height(panel_height);
    block.panels[i].titles = layout.titles[i];
    block.panels[i].y_numbers = layout.leftmost(place);
    out += svg_group("panel", x, y, draw_patch_panel(block.panels[i], scale, steps));
    if (i == 0)
      out += turned_text(-46.0, y + 0.5 * panel_height, "y [mm]") +
             svg_text(-14.0, y + panel_height + 14.0, "x [mm]", "end");
  }
  PatchLegend legend = pressure_legend(block.top_pressure);
  legend.lines.clear();
  if (block.top_pressure > 0.0)
    out += svg_group("bar", layout.width() + 20.0, kCaption + layout.title_height(),
                     draw_patch_legend(legend, panel_height));
  return out;
}

}  // namespace

std::string pressures_svg(const io::Comparison& comparison) {
  const Layout layout(comparison);
  double y = kPanelTop;
  std::string blocks;
  for (const int number : telling_cases(comparison, kMostCases)) {
    Block block = make_block(comparison, number);
    const double height = panel_height(block.window);
    blocks += svg_group("block", kPanelLeft, y, draw_block(block, layout, height));
    y += layout.height(height) + kBetween;
  }
  return svg_head(kPanelLeft + layout.width() + kPanelRight, y + kPanelTop, kFont,
                  std::string(kPanelStyle) + ".below{font-size:12px}.case{font-size:14px;font-weight:bold}") +
         blocks + "</svg>\n";
}

}  // namespace treadmark::pictures
