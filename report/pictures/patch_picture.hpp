// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/results/result_model.hpp"
#include "treadmark/report/pictures/colours.hpp"

namespace treadmark::pictures {

/// Contact patches in panels, as data and what draws them. All functions are thread-safe.

/// Rectangle in the picture's plane [mm].
struct Window {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0;

  double width() const { return x_high - x_low; }
  double height() const { return y_high - y_low; }
  void include(const Window& other);
};

/// What the picture shows of a patch: the part of its grid that is in contact, coarsened when it is very fine.
struct PatchPicture {
  int nx = 0, ny = 0;               ///< 0 = nothing in contact
  double dx = 0.0, dy = 0.0;        ///< size of a cell [mm]
  double x_low = 0.0, y_low = 0.0;  ///< corner of the first cell [mm]
  std::vector<double> values;       ///< pressure [Pa] or another quantity, 0 outside the contact
  std::vector<char> contact, adhesion;

  Window extent() const { return {x_low, x_low + nx * dx, y_low, y_low + ny * dy}; }
  double greatest() const;
};

PatchPicture make_patch_picture(const io::PatchFields& fields);
/// Of other values, one an element; those of states are not averaged.
PatchPicture make_patch_picture(const io::PatchFields& fields, std::span<const double> values, bool states = false);

/// The pictures of the patches of a case that are in contact. Errors: Error(configuration) for fields that do not match
/// their grids.
std::vector<PatchPicture> patch_pictures(const io::CaseResult& result);

/// What all of them need; nothing without any.
std::optional<Window> window_of(std::span<const PatchPicture> pictures);

/// Where the picture's plane lies on a panel: x_px = (x_mm - window.x_low) scale_x, y_px = (window.y_high - y_mm)
/// scale_y.
struct PanelScale {
  Window window;
  double scale_x = 1.0, scale_y = 1.0;  ///< [px/mm]

  double width() const { return window.width() * scale_x; }
  double height() const { return window.height() * scale_y; }
  double x(double mm) const { return (mm - window.x_low) * scale_x; }
  double y(double mm) const { return (window.y_high - mm) * scale_y; }
};

/// Colours of values from each threshold on, the thresholds growing.
using ColourSteps = std::vector<std::pair<double, std::string>>;

/// kPatchSteps equal ones; the first holds all below too.
ColourSteps colour_steps(const ColourScale& scale);

/// The edge of its contact as path data.
std::string contact_path(const PatchPicture& picture, const PanelScale& panel);

struct PatchPanel {
  std::vector<PatchPicture> patches = {};
  std::optional<Window> window = {};  ///< in place of the common one, of the same size
  std::vector<std::string> titles = {};
  double title_y = -20.0;   ///< of the last line
  std::string remark = {};  ///< between title and frame
  std::string words = {};   ///< in the middle: why there is no patch
  std::string below = {};   ///< the numbers of x
  std::string over = {};    ///< elements over the patches; all are cut off at the frame then
  std::string x_name = {}, y_name = {};
  bool y_numbers = true;
};

/// Filled steps of the values, the edges of contact (dark) and of the adhesion area (white), and axes [mm]; its upper
/// left corner is the origin.
std::string draw_patch_panel(const PatchPanel& panel, const PanelScale& scale, const ColourSteps& steps);

/// What is said beside the panels.
struct PatchLegend {
  struct Line {
    std::string name;  ///< class of the line; empty: a box or only words
    std::string words;
    std::string fill = {};  ///< of the box
  };
  std::string label;
  std::optional<ColourScale> bar = {};  ///< in shown units
  std::vector<Line> lines = {};
  int parts = 0;  ///< see draw_colour_bar
};

/// Colours of pressure up to a largest one [Pa], and the edges.
PatchLegend pressure_legend(double top_pressure);
/// With its upper left corner at the origin and a bar of this height at most; 18 px a line.
std::string draw_patch_legend(const PatchLegend& legend, double height);

/// Panels of the same size in rows, as many beside each other as look well, and a legend to the right.
struct PatchSheet {
  std::string title;
  std::vector<PatchPanel> panels = {};
  PanelScale scale;
  ColourSteps steps = {};
  PatchLegend legend = {};
  std::string x_name = "x [mm]", y_name = "y [mm]";
  bool y_numbers_everywhere = true;
  double least_step = 0.0;  ///< of a panel with its title [px]
  std::string style = {};   ///< further rules
};

/// Gives all panels a window of one size, at one place too if that does not make it much larger, whose longest side has
/// so many pixels.
void place_windows(PatchSheet& sheet, double longest);

/// A whole picture.
std::string draw_patch_sheet(PatchSheet sheet);

/// Rules for the panels of pressure maps.
inline constexpr std::string_view kPanelStyle =
    ".title{font-size:12px;font-weight:bold}.tick{fill:none;stroke:#666666;stroke-width:.7}"
    ".contact{fill:none;stroke:#1a1a2e;stroke-width:1.2}.adhesion{fill:none;stroke:#ffffff;stroke-width:1.2}";

/// "125 kN, 1320 MPa": sum of the normal forces and largest pressure of a case.
std::string force_and_pressure(const io::CaseResult& result);
/// Why a case has no patches: its status, or that there are no fields.
std::string reason_without_patches(const io::CaseResult& result);
/// "pitch -1.25°".
std::string pitch_text(const io::CaseResult& result);

}  // namespace treadmark::pictures
