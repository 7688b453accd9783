// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/results/atomic_file.hpp"
#include "treadmark/io/results/chart_labels.hpp"
#include "treadmark/io/results/comparison_cases.hpp"
#include "treadmark/io/results/comparison_digest.hpp"
#include "treadmark/io/results/comparison_pictures.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/picture_patch.hpp"
#include "treadmark/io/results/svg_panel.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr std::size_t kMostCases = 3;

// Sizes in pixels.
constexpr double kPanel = 160.0;  // width of a panel
constexpr double kGapX = 34.0, kGapY = 76.0, kLeft = 64.0, kTop = 62.0, kRight = 110.0;
constexpr double kMargin = 0.06;     // of the window, around the contact
constexpr double kEqualScale = 4.0;  // windows longer than this get their own scale in each direction
constexpr const char* kTitle = " class=\"title\"";
constexpr double kLowest = 0.45, kHighest = 1.25;  // height over width of a panel

/// What a panel shows: a map, or words why there is none.
struct Panel {
  PatchPicture picture;
  std::string words;  ///< instead of a map
  std::string below;  ///< largest pressure and its error
};

/// A case through all candidates.
struct Row {
  std::string title;
  std::vector<Panel> panels;
  Window window{0.0, 10.0, 0.0, 10.0};
  double top_pressure = 0.0;
};

/// With a sign and two decimals, one where it is large.
std::string percent(double value) {
  const std::string text = fmt::format("{:+.{}f}", value, std::abs(value) < 9.995 ? 2 : 1);
  return (text == "+0.00" || text == "-0.00" ? "0.00" : text) + " %";
}

Panel make_panel(const ComparisonCandidate& candidate, int case_number, bool truth) {
  Panel panel;
  if (!candidate.failure.empty()) {
    panel.words = "failed";
    return panel;
  }
  if (const ComparisonRow* row = find_row(candidate, case_number); row != nullptr && row->patches > 0) {
    if (std::isfinite(row->pmax)) panel.below = three_digits(row->pmax * 1e-6) + " MPa";
    if (!truth && row->comparable && std::isfinite(row->pmax_error))
      panel.below += ", " + percent(row->pmax_error * 1e2);
  }
  const CaseResult* result = find_result(candidate, case_number);
  if (result == nullptr) {
    panel.words = "no fields";
    return panel;
  }
  int number = 0;
  for (const PatchResult& patch : result->patches) check_field_sizes(patch.fields, case_number, ++number);
  if (const PatchResult* patch = main_patch(*result)) panel.picture = make_patch_picture(patch->fields);
  if (panel.picture.nx > 0) return panel;
  panel.words = result->status == Status::ok ? "no fields" : std::string(to_string(result->status));
  std::replace(panel.words.begin(), panel.words.end(), '_', ' ');
  return panel;
}

Row make_row(const Comparison& comparison, int case_number) {
  Row row;
  row.title = fmt::format("case {}", case_number);
  bool any = false, posed = false;
  for (const ComparisonCandidate& candidate : comparison.candidates) {
    row.panels.push_back(make_panel(candidate, case_number, &candidate == comparison.candidates.data()));
    const CaseResult* result = find_result(candidate, case_number);
    if (result != nullptr && result->has_wheelset && !posed) {
      row.title += fmt::format(", pitch {:.2f}°", result->pitch * 180.0 / std::numbers::pi);
      posed = true;
    }
    const PatchPicture& picture = row.panels.back().picture;
    if (picture.nx == 0) continue;
    row.top_pressure = std::max(row.top_pressure, *std::max_element(picture.pressure.begin(), picture.pressure.end()));
    if (any)
      row.window.include(picture.extent());
    else
      row.window = picture.extent();
    any = true;
  }
  return row;
}

/// Height of all panels over their width: that of the highest window, within limits.
double panel_shape(const std::vector<Row>& rows) {
  double shape = 0.0;
  for (const Row& row : rows) shape = std::max(shape, row.window.height() / row.window.width());
  return std::clamp(shape, kLowest, kHighest);
}

/// The window with a margin, made as wide or high as the panel; its own scale in each direction when it is very long.
PanelScale panel_scale(const Window& window, double panel_height) {
  const double width = window.width() * (1.0 + 2.0 * kMargin), height = window.height() * (1.0 + 2.0 * kMargin);
  double scale_x = kPanel / width, scale_y = panel_height / height;
  if (std::max(scale_x, scale_y) <= kEqualScale * std::min(scale_x, scale_y))
    scale_x = scale_y = std::min(scale_x, scale_y);
  const double x = 0.5 * (window.x_low + window.x_high), y = 0.5 * (window.y_low + window.y_high);
  const double half_x = 0.5 * kPanel / scale_x, half_y = 0.5 * panel_height / scale_y;
  return {{x - half_x, x + half_x, y - half_y, y + half_y}, scale_x, scale_y};
}

std::string draw_panel(const Panel& panel, const PanelScale& scale, double top_pressure, double height, bool first) {
  std::string out = draw_patch(panel.picture, top_pressure, scale);
  if (!panel.words.empty()) out += svg_text(0.5 * kPanel, 0.5 * height, panel.words);
  out += draw_panel_axes(scale);
  if (first)
    out += svg_text(-46.0, 0.5 * height, "y [mm]", "middle",
                    fmt::format(" transform=\"rotate(-90 -46 {:.1f})\"", 0.5 * height).c_str());
  out += svg_text(0.5 * kPanel, height + 27.0, "x [mm]");
  return out + svg_text(0.5 * kPanel, height + 42.0, panel.below, "middle", " class=\"below\"");
}

/// The name over a column, in two lines where it is long.
std::string draw_heading(const std::string& label, double x) {
  std::size_t cut = std::string::npos;
  if (text_width(label, 13.0) > kPanel + kGapX) cut = label.rfind(' ', label.size() / 2 + 4);
  if (cut == std::string::npos) return svg_text(x, 30.0, label, "middle", kTitle);
  return svg_text(x, 16.0, label.substr(0, cut), "middle", kTitle) +
         svg_text(x, 30.0, label.substr(cut + 1), "middle", kTitle);
}

std::string draw_row(const Row& row, double height) {
  const PanelScale scale = panel_scale(row.window, height);
  std::string out = svg_text(0.0, -8.0, row.title, "start", kTitle);
  double x = 0.0;
  for (const Panel& panel : row.panels) {
    out += fmt::format("<g class=\"panel\" transform=\"translate({:.1f} 0)\">\n", x) +
           draw_panel(panel, scale, row.top_pressure, height, &panel == row.panels.data()) + "</g>\n";
    x += kPanel + kGapX;
  }
  if (row.top_pressure > 0.0)
    out += fmt::format("<g transform=\"translate({:.1f} 0)\">\n", x - 8.0) +
           svg_text(0.0, -8.0, "pressure [MPa]", "start") + draw_pressure_bar(row.top_pressure, height) + "</g>\n";
  return out;
}

}  // namespace

std::string pressures_svg(const Comparison& comparison) {
  std::vector<Row> rows;
  for (const int number : telling_cases(comparison, kMostCases)) rows.push_back(make_row(comparison, number));
  const double columns = static_cast<double>(std::max<std::size_t>(1, comparison.candidates.size()));
  const double lines = static_cast<double>(std::max<std::size_t>(1, rows.size()));
  const double panel_height = kPanel * panel_shape(rows);

  std::string out = svg_head(kLeft + columns * (kPanel + kGapX) + kRight, kTop + lines * (panel_height + kGapY), 10,
                             std::string(kPanelStyle) + ".below{font-size:11px}");
  double x = kLeft + 0.5 * kPanel;
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i, x += kPanel + kGapX)
    out += draw_heading(candidate_label(comparison, i), x);
  double y = kTop;
  for (const Row& row : rows) {
    out +=
        fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n", kLeft, y) + draw_row(row, panel_height) + "</g>\n";
    y += panel_height + kGapY;
  }
  return out + "</svg>\n";
}

void write_pressures_svg(const std::filesystem::path& path, const Comparison& comparison) {
  write_text_file(path, pressures_svg(comparison));
}

}  // namespace treadmark::io
