// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/picture_patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/colour_map.hpp"

namespace treadmark::io {
namespace {

constexpr int kMaxCells = 96;  // along a side

bool in_contact(const PatchFields& fields, std::size_t i) {
  if (!fields.state.empty()) return fields.state[i] != 0;
  return fields.pressure[i] > 0.0;
}

struct IndexBox {
  int x_low, x_high, y_low, y_high;
  bool empty() const { return x_high < x_low; }
};

IndexBox contact_box(const PatchFields& fields) {
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

CellMask PatchPicture::above(double pressure_limit) const {
  CellMask mask{nx, ny, contact};
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (pressure[i] < pressure_limit) mask.inside[i] = 0;
  return mask;
}

PatchPicture make_patch_picture(const PatchFields& fields) {
  PatchPicture picture;
  if (fields.pressure.empty()) return picture;
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
          if (std::isfinite(fields.pressure[i])) sum += fields.pressure[i];
          ++contact;
          if (!fields.state.empty() && fields.state[i] == 1) ++adhesion;
        }
      picture.pressure.push_back(contact > 0 ? sum / contact : 0.0);
      picture.contact.push_back(2 * contact >= block);
      picture.adhesion.push_back(2 * contact >= block && 2 * adhesion >= contact);
    }
  return picture;
}

std::string step_colour(int step) { return colour((step + 0.5) / kPressureSteps); }

std::string draw_patch(const PatchPicture& picture, double top_pressure, const PanelScale& panel) {
  if (picture.nx == 0) return {};
  const double x0 = (picture.x_low - panel.window.x_low) * panel.scale_x;
  const double y0 = (panel.window.y_high - picture.y_low) * panel.scale_y;
  const double step_x = picture.dx * panel.scale_x, step_y = -picture.dy * panel.scale_y;

  std::string out =
      fmt::format("<g transform=\"translate({:.6g} {:.6g}) scale({:.6g} {:.6g})\">\n", x0, y0, step_x, step_y);
  for (int step = 0; step < kPressureSteps; ++step) {
    const auto loops = outline(picture.above(step == 0 ? 0.0 : top_pressure * step / kPressureSteps));
    if (loops.empty()) break;
    out += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", step_colour(step), path_in_cells(loops));
  }
  out += "</g>\n";
  const auto line = [&](const std::vector<char>& cells, const char* name) {
    const auto loops = outline({picture.nx, picture.ny, cells});
    if (!loops.empty())
      out += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", name, path_at(loops, x0, y0, step_x, step_y));
  };
  line(picture.adhesion, "adhesion");
  line(picture.contact, "contact");
  return out;
}

}  // namespace treadmark::io
