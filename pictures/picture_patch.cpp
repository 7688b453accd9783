// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/pictures/picture_patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/result_model.hpp"

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

std::vector<Vec2> row_edges(const PatchFields& fields, double reference_s) {
  const Grid2& grid = fields.grid;
  const double first = grid.y0 - 0.5 * grid.dy;
  std::vector<Vec2> edges;
  if (fields.row_angle.empty()) {
    for (int iy = 0; iy <= grid.ny; ++iy) edges.emplace_back(first + iy * grid.dy, 0.0);
    return edges;
  }
  edges.emplace_back(0.0, 0.0);
  for (const double angle : fields.row_angle)
    edges.push_back(edges.back() + grid.dy * Vec2(std::cos(angle), std::sin(angle)));
  // The reference lies between two edges.
  const double place = std::clamp((reference_s - first) / grid.dy, 0.0, static_cast<double>(grid.ny));
  const auto below = std::min(static_cast<std::size_t>(place), edges.size() - 2);
  const Vec2 reference = edges[below] + (place - static_cast<double>(below)) * (edges[below + 1] - edges[below]);
  for (Vec2& edge : edges) edge += Vec2(reference_s, 0.0) - reference;
  return edges;
}

std::string colour(double value) {
  if (std::isnan(value)) return "#999999";
  struct Anchor {
    double red, green, blue;
  };
  static constexpr std::array<Anchor, 7> kAnchors{
      {{46, 14, 82}, {62, 54, 128}, {50, 96, 144}, {32, 136, 142}, {58, 174, 116}, {146, 208, 76}, {250, 230, 52}}};
  const double position = std::clamp(value, 0.0, 1.0) * (kAnchors.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(position), kAnchors.size() - 2);
  const double part = position - static_cast<double>(lower);
  const Anchor &a = kAnchors[lower], &b = kAnchors[lower + 1];
  const auto mix = [part](double from, double to) { return static_cast<int>(std::lround(from + part * (to - from))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue));
}

}  // namespace treadmark::io
