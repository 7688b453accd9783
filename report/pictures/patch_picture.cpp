// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/patch_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/outline.hpp"

namespace treadmark::pictures {

namespace {

constexpr int kMaxCells = 96;  // along a side

bool in_contact(const io::PatchFields& fields, std::size_t i) {
  if (!fields.state.empty()) return fields.state[i] != 0;
  return fields.pressure[i] > 0.0;
}

struct IndexBox {
  int x_low, x_high, y_low, y_high;
  bool empty() const { return x_high < x_low; }
};

IndexBox contact_box(const io::PatchFields& fields) {
  const Grid2& grid = fields.grid;
  IndexBox box{grid.nx, -1, grid.ny, -1};
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      if (!in_contact(fields, grid.index(ix, iy))) continue;
      box = {std::min(box.x_low, ix), std::max(box.x_high, ix), std::min(box.y_low, iy), std::max(box.y_high, iy)};
    }
  return box;
}

}  // namespace

void Window::include(const Window& other) {
  *this = {std::min(x_low, other.x_low), std::max(x_high, other.x_high), std::min(y_low, other.y_low),
           std::max(y_high, other.y_high)};
}

double PatchPicture::greatest() const { return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end()); }

PatchPicture make_patch_picture(const io::PatchFields& fields) { return make_patch_picture(fields, fields.pressure); }

PatchPicture make_patch_picture(const io::PatchFields& fields, std::span<const double> values, bool states) {
  PatchPicture picture;
  const std::size_t told = fields.state.empty() ? fields.pressure.size() : fields.state.size();  // of contact
  if (values.size() != fields.grid.size() || told != values.size()) return picture;
  const Grid2& grid = fields.grid;
  const IndexBox box = contact_box(fields);
  if (box.empty()) return picture;

  // Blocks of elements become cells; a block is in contact when half of it is.
  const int count_x = box.x_high - box.x_low + 1, count_y = box.y_high - box.y_low + 1;
  const int block_x = (count_x + kMaxCells - 1) / kMaxCells, block_y = (count_y + kMaxCells - 1) / kMaxCells;
  picture.nx = (count_x + block_x - 1) / block_x;
  picture.ny = (count_y + block_y - 1) / block_y;
  picture.dx = block_x * grid.dx * kMilli;
  picture.dy = block_y * grid.dy * kMilli;
  picture.x_low = (fields.X_TC.origin.x() + grid.x(box.x_low) - 0.5 * grid.dx) * kMilli;
  picture.y_low = (fields.X_TC.origin.y() + grid.y(box.y_low) - 0.5 * grid.dy) * kMilli;
  const int block = block_x * block_y;
  for (int jy = 0; jy < picture.ny; ++jy)
    for (int jx = 0; jx < picture.nx; ++jx) {
      double sum = 0.0;
      int contact = 0, adhesion = 0;
      for (int ky = 0; ky < block_y; ++ky)
        for (int kx = 0; kx < block_x; ++kx) {
          const int ix = box.x_low + jx * block_x + kx, iy = box.y_low + jy * block_y + ky;
          if (ix > box.x_high || iy > box.y_high || !in_contact(fields, grid.index(ix, iy))) continue;
          const std::size_t i = grid.index(ix, iy);
          if (std::isfinite(values[i])) sum = states ? std::max(sum, values[i]) : sum + values[i];
          ++contact;
          if (!fields.state.empty() && fields.state[i] == 1) ++adhesion;
        }
      picture.values.push_back(contact > 0 && !states ? sum / contact : sum);
      picture.contact.push_back(2 * contact >= block);
      picture.adhesion.push_back(2 * contact >= block && 2 * adhesion >= contact);
    }
  return picture;
}

std::vector<PatchPicture> patch_pictures(const io::CaseResult& result) {
  std::vector<PatchPicture> out;
  int number = 0;
  for (const io::PatchResult& patch : result.patches) {
    io::check_field_sizes(patch.fields, result.number, ++number);
    if (PatchPicture picture = make_patch_picture(patch.fields); picture.nx > 0) out.push_back(std::move(picture));
  }
  return out;
}

std::optional<Window> window_of(std::span<const PatchPicture> pictures) {
  if (pictures.empty()) return {};
  Window all = pictures.front().extent();
  for (const PatchPicture& one : pictures) all.include(one.extent());
  return all;
}

ColourSteps colour_steps(const ColourScale& scale) {
  ColourSteps out;
  for (std::size_t step = 0; step < kPatchSteps; ++step)
    out.emplace_back(
        step == 0 ? -INFINITY : scale.low + (scale.high - scale.low) * static_cast<double>(step) / kPatchSteps,
        step_colour(step, kPatchSteps, scale.palette));
  return out;
}

std::string contact_path(const PatchPicture& picture, const PanelScale& panel) {
  return path_at(outline({picture.nx, picture.ny, picture.contact}), panel.x(picture.x_low), panel.y(picture.y_low),
                 picture.dx * panel.scale_x, -picture.dy * panel.scale_y);
}

namespace {

std::string draw_patch(const PatchPicture& picture, const ColourSteps& steps, const PanelScale& panel) {
  const double x0 = panel.x(picture.x_low), y0 = panel.y(picture.y_low);
  const double step_x = picture.dx * panel.scale_x, step_y = -picture.dy * panel.scale_y;
  std::string out =
      fmt::format("<g transform=\"translate({:.6g} {:.6g}) scale({:.6g} {:.6g})\">\n", x0, y0, step_x, step_y);
  CellMask mask{picture.nx, picture.ny, picture.contact};
  for (const auto& [threshold, fill] : steps) {
    for (std::size_t i = 0; i < picture.values.size(); ++i)
      if (picture.values[i] < threshold) mask.inside[i] = 0;
    const auto loops = outline(mask);
    if (loops.empty()) break;
    out += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", fill, path_in_cells(loops));
  }
  out += "</g>\n";
  const auto adhesion = outline({picture.nx, picture.ny, picture.adhesion});
  if (!adhesion.empty())
    out += fmt::format("<path class=\"adhesion\" d=\"{}\"/>\n", path_at(adhesion, x0, y0, step_x, step_y));
  return out + fmt::format("<path class=\"contact\" d=\"{}\"/>\n", contact_path(picture, panel));
}

std::string draw_panel_axes(const PanelScale& panel, bool numbers_of_y) {
  const Window& window = panel.window;
  const double width = panel.width(), height = panel.height();
  std::string out;
  for (const AxisTick& tick : ChartAxis(AxisScale::linear, {window.x_low, window.x_high}).ticks()) {
    const double x = tick.at * width;
    out += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v4\"/>\n", x, height);
    out += svg_text(x, height + 14.0, tick.label);
  }
  for (const AxisTick& tick : ChartAxis(AxisScale::linear, {window.y_low, window.y_high}).ticks()) {
    const double y = (1.0 - tick.at) * height;
    out += fmt::format("<path class=\"tick\" d=\"M0 {:.1f}h-4\"/>\n", y);
    if (numbers_of_y) out += svg_text(-6.0, y + 3.5, tick.label, "end");
  }
  return out + fmt::format("<rect class=\"tick\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", width, height);
}

}  // namespace

std::string draw_patch_panel(const PatchPanel& panel, const PanelScale& common, const ColourSteps& steps) {
  PanelScale scale = common;
  if (panel.window) scale.window = *panel.window;
  const double middle = 0.5 * scale.width(), height = scale.height();
  constexpr double kTitleLine = 14.0;
  double y = panel.title_y - kTitleLine * (static_cast<double>(panel.titles.size()) - 1.0);
  std::string out, map;
  for (const std::string& line : panel.titles) {
    out += svg_text(middle, y, line, "middle", " class=\"title\"");
    y += kTitleLine;
  }
  if (!panel.remark.empty()) out += svg_text(middle, -7.0, panel.remark);
  for (const PatchPicture& patch : panel.patches) map += draw_patch(patch, steps, scale);
  out += panel.over.empty() ? map : "<g clip-path=\"url(#panel)\">\n" + map + panel.over + "</g>\n";
  if (!panel.words.empty()) out += svg_text(middle, 0.5 * height, panel.words);
  out += draw_panel_axes(scale, panel.y_numbers);
  if (!panel.y_name.empty()) out += turned_text(-40.0, 0.5 * height, panel.y_name);
  if (!panel.x_name.empty()) out += svg_text(middle, height + 28.0, panel.x_name);
  return panel.below.empty() ? out : out + svg_text(middle, height + 29.0, panel.below, "middle", " class=\"below\"");
}

std::string force_and_pressure(const io::CaseResult& result) {
  double force = 0.0, pressure = 0.0;
  for (const io::PatchResult& patch : result.patches) {
    force += patch.fn;
    pressure = std::max(pressure, patch.pmax);
  }
  return three_digits(force * 1e-3) + " kN, " + three_digits(pressure * 1e-6) + " MPa";
}

std::string reason_without_patches(const io::CaseResult& result) {
  std::string words(result.status == Status::ok ? "no fields" : to_string(result.status));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string pitch_text(const io::CaseResult& result) {
  return fmt::format("pitch {:.2f}°", result.pitch * 180.0 / std::numbers::pi + 0.0);
}

}  // namespace treadmark::pictures
