// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/grid_heights.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "treadmark/backends/mesh/line_caster.hpp"
#include "treadmark/backends/mesh/point_heights.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::mesh {

namespace {

constexpr std::size_t kWorthThreads = 4000;

/// Columns and rows [x0, x1), [y0, y1) of the grid.
struct Piece {
  int x0, x1, y0, y1;
};

/// What a thread needs, kept between calls: small grids must not pay for it.
struct Workspace {
  static constexpr std::size_t kPoints = static_cast<std::size_t>(Tile::kWide) * Tile::kHigh;
  Tile tile;
  std::array<int, Tile::kSlots + 1> begin;    ///< of the points of every triangle in sorted
  std::array<std::uint16_t, kPoints> sorted;  ///< points (ix + iy * kStride) by triangle
  std::array<double, kPoints> x, y, z, dzdx, dzdy;
};

Workspace& workspace() {
  thread_local const std::unique_ptr<Workspace> own(new Workspace);  // not initialised: most of it is not touched
  return *own;
}

class GridHeights {
 public:
  GridHeights(const PreparedMesh& mesh, const Bvh& bvh, const SmoothPatches* smooth, const PlaneView& view,
              const Grid2& grid, const Results& results)
      : mesh_(mesh),
        arrays_(bvh.arrays()),
        smooth_(smooth),
        view_(view),
        lines_(view.lines()),
        grid_(grid),
        results_(results),
        w_(workspace()),
        caster_(mesh, bvh, nullptr, view),
        points_(mesh, smooth, view, lines_, results) {}

  void run(const Piece& piece) {
    Tile& tile = w_.tile;
    tile.nx = piece.x1 - piece.x0;
    tile.ny = piece.y1 - piece.y0;
    for (int ix = 0; ix < tile.nx + Tile::kPad; ++ix) tile.x[ix] = grid_.x(piece.x0 + ix);
    for (int iy = 0; iy < tile.ny + Tile::kPad; ++iy) tile.y[iy] = grid_.y(piece.y0 + iy);
    tile.inverse_dx = 1.0 / grid_.dx;
    tile.inverse_dy = 1.0 / grid_.dy;
    if (!fastest_kernel<TileKernel>().fill(arrays_, lines_, tile)) return split(piece);
    if (smooth_)
      write_smooth(piece);
    else
      write_facets(piece);
  }

 private:
  /// More triangles over the tile than it can hold.
  void split(const Piece& p) {
    const int nx = p.x1 - p.x0, ny = p.y1 - p.y0;
    if (nx > 1) {
      run({p.x0, p.x0 + nx / 2, p.y0, p.y1});
      run({p.x0 + nx / 2, p.x1, p.y0, p.y1});
    } else if (ny > 1) {
      run({p.x0, p.x1, p.y0, p.y0 + ny / 2});
      run({p.x0, p.x1, p.y0 + ny / 2, p.y1});
    } else {
      look(p, 0, 0);
      points_.finish();
    }
  }

  std::size_t result(const Piece& p, int ix, int iy) const { return grid_.index(p.x0 + ix, p.y0 + iy); }

  /// One point by the hierarchy.
  void look(const Piece& p, int ix, int iy) {
    const double x = grid_.x(p.x0 + ix), y = grid_.y(p.y0 + iy);
    const LineHit hit = caster_.look(x, y);
    if (hit.cover == Cover::front)
      points_.add(result(p, ix, iy), x, y, hit, caster_.triangle(hit));
    else
      results_.miss(result(p, ix, iy));
  }

  /// Number in tile.triangles of what is seen at a point, negative if it is written already.
  std::int64_t seen(const Piece& p, int ix, int iy, int at) {
    const std::int64_t owner = w_.tile.owner[at];
    if (owner == Tile::kRim || (w_.tile.any_asked && w_.tile.asked[at])) {
      look(p, ix, iy);
      return Tile::kNobody;
    }
    if (owner >= 0) return owner;
    results_.miss(result(p, ix, iy));
    return Tile::kNobody;
  }

  void write_facets(const Piece& p) {
    Tile& tile = w_.tile;
    for (int iy = 0; iy < tile.ny; ++iy)
      for (int ix = 0; ix < tile.nx; ++ix) {
        const int at = iy * Tile::kStride + ix;
        const std::int64_t owner = seen(p, ix, iy, at);
        if (owner < 0) continue;
        const double z = view_.side * tile.depth[at];
        if (!results_.slopes) {
          results_.put(result(p, ix, iy), z, 0.0, 0.0);
          continue;
        }
        const double* q = tile.triangles[owner].q;
        ProjectedTriangle triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle.q[k] = Vec3(q[3 * k], q[3 * k + 1], q[3 * k + 2]);
        const Vec2 slopes = triangle.slopes();
        results_.put(result(p, ix, iy), z, slopes.x(), slopes.y());
      }
  }

  void write_smooth(const Piece& p) {
    Tile& tile = w_.tile;
    std::fill_n(w_.begin.begin(), tile.used + 1, 0);
    for (int iy = 0; iy < tile.ny; ++iy)
      for (int ix = 0; ix < tile.nx; ++ix) {
        const int at = iy * Tile::kStride + ix;
        const std::int64_t owner = seen(p, ix, iy, at);
        tile.owner[at] = owner;
        ++w_.begin[static_cast<std::size_t>(owner + 1)];  // those that are written count, too, in front
      }
    int sum = 0;
    for (int i = 0; i <= tile.used; ++i) {
      const int count = w_.begin[static_cast<std::size_t>(i)];
      w_.begin[static_cast<std::size_t>(i)] = sum;
      sum += count;
    }
    for (int iy = 0; iy < tile.ny; ++iy)
      for (int ix = 0; ix < tile.nx; ++ix) {
        const int at = iy * Tile::kStride + ix, to = w_.begin[static_cast<std::size_t>(tile.owner[at] + 1)]++;
        w_.sorted[static_cast<std::size_t>(to)] = static_cast<std::uint16_t>(at);
        w_.x[static_cast<std::size_t>(to)] = tile.x[ix];
        w_.y[static_cast<std::size_t>(to)] = tile.y[iy];
      }
    // each begin has become the end of its points
    for (int i = 0; i < tile.used; ++i)
      write_triangle(p, tile.triangles[i], w_.begin[static_cast<std::size_t>(i)],
                     w_.begin[static_cast<std::size_t>(i + 1)]);
    points_.finish();
  }

  std::size_t sorted_result(const Piece& p, int i) const {
    const int at = w_.sorted[static_cast<std::size_t>(i)];
    return result(p, at % Tile::kStride, at / Tile::kStride);
  }

  /// The points begin to end of sorted.
  void write_triangle(const Piece& p, const TileTriangle& triangle, int begin, int end) {
    if (begin == end) return;
    std::array<double, kPatchEntries> patch;
    if (!smooth_->prepare(fastest_kernel<PatchKernel>(), lines_, triangle.index, triangle.q, patch.data())) {
      for (int i = begin; i < end; ++i) again(p, triangle, i);
      return;
    }
    constexpr int kFew = 2;  // points that share lanes with those of other triangles
    const int rest = (end - begin) % 4 <= kFew ? (end - begin) % 4 : 0;
    for (int i = end - rest; i < end; ++i)
      points_.add(sorted_result(p, i), w_.x[static_cast<std::size_t>(i)], w_.y[static_cast<std::size_t>(i)],
                  triangle.index, patch.data());
    const int own = end - begin - rest;
    if (own == 0) return;
    const auto first = static_cast<std::size_t>(begin);
    fastest_kernel<PatchKernel>().points(patch.data(), lines_.side, &w_.x[first], &w_.y[first], own, &w_.z[first],
                                         results_.slopes ? &w_.dzdx[first] : nullptr, &w_.dzdy[first]);
    for (int i = begin; i < begin + own; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (std::isnan(w_.z[k]))
        again(p, triangle, i);
      else
        results_.put(sorted_result(p, i), w_.z[k], w_.dzdx[k], w_.dzdy[k]);
    }
  }

  void again(const Piece& p, const TileTriangle& triangle, int i) {
    evaluate_again(mesh_, smooth_, view_, results_, sorted_result(p, i), w_.x[static_cast<std::size_t>(i)],
                   w_.y[static_cast<std::size_t>(i)], triangle.index);
  }

  const PreparedMesh& mesh_;
  const MeshArrays arrays_;
  const SmoothPatches* smooth_;
  const PlaneView& view_;
  const PlaneLines lines_;
  const Grid2& grid_;
  const Results& results_;
  Workspace& w_;
  LineCaster caster_;
  PointHeights points_;
};

}  // namespace

void grid_heights(const PreparedMesh& mesh, const Bvh& bvh, const SmoothPatches* smooth, const PlaneView& view,
                  const Grid2& grid, const Results& results) {
  // pieces of about one size
  const auto cut = [](int n, int most) { return (n + most - 1) / most; };
  const int across = cut(grid.nx, Tile::kWide), along = cut(grid.ny, Tile::kHigh);
  const auto piece = [&](std::size_t i) {
    const int column = static_cast<int>(i) % across, row = static_cast<int>(i) / across;
    const auto at = [](int n, int parts, int k) { return static_cast<int>(static_cast<std::int64_t>(n) * k / parts); };
    return Piece{at(grid.nx, across, column), at(grid.nx, across, column + 1), at(grid.ny, along, row),
                 at(grid.ny, along, row + 1)};
  };
  const auto pieces = static_cast<std::size_t>(across) * static_cast<std::size_t>(along);
  if (grid.size() < kWorthThreads) {
    GridHeights work(mesh, bvh, smooth, view, grid, results);
    for (std::size_t i = 0; i < pieces; ++i) work.run(piece(i));
  } else {
    parallel_for(pieces, [&](std::size_t i) { GridHeights(mesh, bvh, smooth, view, grid, results).run(piece(i)); });
  }
}

}  // namespace treadmark::mesh
