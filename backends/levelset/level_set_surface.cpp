// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/level_set_surface.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::levelset {

namespace {

constexpr int kTile = 8;          ///< points of a grid along an edge that share what is looked up
constexpr std::size_t kRow = 32;  ///< points of a list that do
constexpr double kNearby = 16.0;  ///< if they lie so close together [voxels]
constexpr std::size_t kLinesWorthThreads = 500;

void run(std::size_t pieces, std::size_t lines, const std::function<void(std::size_t)>& piece) {
  if (lines >= kLinesWorthThreads) return parallel_for(pieces, piece);
  for (std::size_t k = 0; k < pieces; ++k) piece(k);
}

/// Where a crossing goes among the results.
class Writer {
 public:
  Writer(const DistanceField& field, const LatticeView& view, const HeightsOut& out)
      : field_(field), view_(view), out_(out), slopes_(!out.dzdx.empty() || !out.dzdy.empty()) {}

  void put(DistanceField::Reader& reader, std::size_t i, const Crossing& hit, double x, double y) const {
    double z = kNaN, dzdx = kNaN, dzdy = kNaN;
    if (hit.found() && hit.enters) {
      z = view_.inwards * hit.depth * field_.grid().voxel;
      if (slopes_) {
        const Vec3 xi = view_.at(x, y, hit.depth) - field_.node(hit.block, hit.cell);
        const Vec3 g = view_.rotation.transpose() * cell_gradient(reader.distances(hit.block, hit.cell), xi);
        dzdx = -g.x() / g.z(), dzdy = -g.y() / g.z();
      }
    }
    if (!out_.z.empty()) out_.z[i] = z;
    if (!out_.dzdx.empty()) out_.dzdx[i] = dzdx;
    if (!out_.dzdy.empty()) out_.dzdy[i] = dzdy;
  }

 private:
  const DistanceField& field_;
  const LatticeView& view_;
  const HeightsOut& out_;
  bool slopes_;
};

/// Principal curvatures of a level set from the second derivatives of its function across its normal (Goldman 2005).
std::pair<double, double> curvatures(const CellJet& jet, const Vec3& normal) {
  const Vec3 e = Vec3::Unit(std::fabs(normal.x()) < 0.7 ? 0 : 1);
  const Vec3 t1 = normal.cross(e).normalized(), t2 = normal.cross(t1);
  const double per = 1.0 / jet.gradient.norm();
  const double a = per * t1.dot(jet.hessian * t1), b = per * t1.dot(jet.hessian * t2),
               c = per * t2.dot(jet.hessian * t2);
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  return {mean + spread, mean - spread};
}

}  // namespace

LevelSetSurface::LevelSetSurface(DistanceField field, Facing facing, std::string backend)
    : field_(std::move(field)), facing_(facing), backend_(std::move(backend)) {
  const DistanceGrid& grid = field_.grid();
  const Vec3 centre = grid.place.apply(0.5 * grid.voxel * (field_.low() + field_.high()));
  const Vec3 half = grid.place.rotation.cwiseAbs() * (0.5 * grid.voxel * (field_.high() - field_.low()));
  box_ = {centre - half, centre + half};
}

void LevelSetSurface::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const LatticeView view(field_.grid(), plane_grid.X_SP, facing_);
  const Writer writer(field_, view, out);
  const double per = 1.0 / field_.grid().voxel;
  const int columns = (g.nx + kTile - 1) / kTile, rows = (g.ny + kTile - 1) / kTile;
  run(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), g.size(), [&](std::size_t tile) {
    const int ix0 = kTile * (static_cast<int>(tile) % columns), iy0 = kTile * (static_cast<int>(tile) / columns);
    const int ix1 = std::min(g.nx, ix0 + kTile), iy1 = std::min(g.ny, iy0 + kTile);
    DistanceField::Reader reader(field_);
    std::vector<DistanceField::Candidate> candidates;
    field_.candidates(view, {per * g.x(ix0), per * g.x(ix1 - 1), per * g.y(iy0), per * g.y(iy1 - 1)}, candidates);
    for (int iy = iy0; iy < iy1; ++iy)
      for (int ix = ix0; ix < ix1; ++ix) {
        const double x = per * g.x(ix), y = per * g.y(iy);
        writer.put(reader, g.index(ix, iy), field_.first_crossing(reader, view, candidates, x, y), x, y);
      }
  });
}

void LevelSetSurface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  const LatticeView view(field_.grid(), X_SP, facing_);
  const Writer writer(field_, view, out);
  const double per = 1.0 / field_.grid().voxel;
  run((points_P.size() + kRow - 1) / kRow, points_P.size(), [&](std::size_t row) {
    const std::size_t begin = row * kRow, end = std::min(points_P.size(), begin + kRow);
    DistanceField::Reader reader(field_);
    std::vector<DistanceField::Candidate> candidates;
    Vec2 low = points_P[begin], high = low;
    for (std::size_t i = begin; i < end; ++i) low = low.cwiseMin(points_P[i]), high = high.cwiseMax(points_P[i]);
    const bool together = per * (high - low).maxCoeff() < kNearby;
    if (together) field_.candidates(view, {per * low.x(), per * high.x(), per * low.y(), per * high.y()}, candidates);
    for (std::size_t i = begin; i < end; ++i) {
      const double x = per * points_P[i].x(), y = per * points_P[i].y();
      if (!together) field_.candidates(view, {x, x, y, y}, candidates);
      writer.put(reader, i, field_.first_crossing(reader, view, candidates, x, y), x, y);
    }
  });
}

CellJet LevelSetSurface::jet(DistanceField::Reader& reader, const LatticeView& view, const Crossing& at, double x,
                             double y) const {
  const DistanceGrid& grid = field_.grid();
  CellJet jet = cell_jet(reader.distances(at.block, at.cell), view.at(x, y, at.depth) - field_.node(at.block, at.cell));
  jet.gradient = grid.place.rotation * jet.gradient;
  jet.hessian = grid.place.rotation * jet.hessian * grid.place.rotation.transpose() / grid.voxel;
  return jet;
}

void LevelSetSurface::do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  const LatticeView view(field_.grid(), X_SP, facing_);
  const double voxel = field_.grid().voxel;
  DistanceField::Reader reader(field_);
  std::vector<DistanceField::Candidate> candidates;
  for (std::size_t i = 0; i < points_P.size(); ++i) {
    out[i] = {};
    const double x = points_P[i].x() / voxel, y = points_P[i].y() / voxel;
    field_.candidates(view, {x, x, y, y}, candidates);
    const Crossing hit = field_.first_crossing(reader, view, candidates, x, y);
    if (!hit.found() || !hit.enters) continue;
    SurfacePoint& p = out[i];
    const CellJet found = jet(reader, view, hit, x, y);
    p.position_S = X_SP.apply({points_P[i].x(), points_P[i].y(), view.inwards * hit.depth * voxel});
    p.normal_S = found.gradient.normalized();
    std::tie(p.curvature_1, p.curvature_2) = curvatures(found, p.normal_S);
    p.u = facing_ == Facing::down ? std::atan2(p.position_S.x(), p.position_S.z()) : p.position_S.x();
    p.v = p.position_S.y();
    p.status = LocateStatus::converged;
    // whether it enters once more farther in
    constexpr double kBeyond = 1e-6;
    for (Crossing next = hit; next.found() && p.status == LocateStatus::converged;) {
      next = field_.first_crossing(reader, view, candidates, x, y, next.depth + kBeyond);
      if (next.found() && next.enters) p.status = LocateStatus::ambiguous;
    }
  }
}

HeightBounds LevelSetSurface::do_height_bounds(const Pose& X_SP, const Rectangle& r) const {
  const LatticeView view(field_.grid(), X_SP, facing_);
  const double voxel = field_.grid().voxel, per = 1.0 / voxel;
  double least = 0.0, greatest = 0.0;
  if (!field_.depths(view, {per * r.x_min, per * r.x_max, per * r.y_min, per * r.y_max}, least, greatest))
    return {kNaN, kNaN, true};
  const double a = view.inwards * least * voxel, b = view.inwards * greatest * voxel;
  return {std::min(a, b), std::max(a, b), false};
}

/// Heights over the plane of the station, z of a rail or the radius of a wheel, are a function of u and y whose
/// derivatives follow from those of the field.
void LevelSetSurface::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  const double voxel = field_.grid().voxel;
  DistanceField::Reader reader(field_);
  std::vector<DistanceField::Candidate> candidates;
  for (std::size_t i = 0; i < uv.size(); ++i) {
    out[i] = {};
    if (!uv[i].allFinite()) continue;
    const Pose X_SP = station_plane(facing_, uv[i].x());
    const LatticeView view(field_.grid(), X_SP, facing_);
    const double y = uv[i].y() / voxel;
    field_.candidates(view, {0.0, 0.0, y, y}, candidates);
    const Crossing hit = field_.first_crossing(reader, view, candidates, 0.0, y);
    if (!hit.found() || !hit.enters) continue;
    const CellJet f = jet(reader, view, hit, 0.0, y);
    const double h = view.inwards * hit.depth * voxel;
    const bool turns = facing_ == Facing::down;
    const Vec3 along = X_SP.rotation.col(0), across = X_SP.rotation.col(1), up = X_SP.rotation.col(2);
    // first and second derivatives of the field by u, y and the height; u turns the axes of a wheel
    const double r = turns ? h : 1.0;
    const double fu = r * f.gradient.dot(along), fy = f.gradient.dot(across), fh = f.gradient.dot(up);
    const Vec3 h_along = f.hessian * along, h_across = f.hessian * across, h_up = f.hessian * up;
    const double fuu = r * r * along.dot(h_along) - (turns ? r * fh : 0.0), fuy = r * across.dot(h_along),
                 fyy = across.dot(h_across), fhh = up.dot(h_up), fyh = up.dot(h_across),
                 fuh = r * up.dot(h_along) + (turns ? f.gradient.dot(along) : 0.0);
    const double hu = -fu / fh, hy = -fy / fh;
    const double huu = -(fuu + 2.0 * fuh * hu + fhh * hu * hu) / fh;
    const double huy = -(fuy + fuh * hy + fyh * hu + fhh * hu * hy) / fh;
    const double hyy = -(fyy + 2.0 * fyh * hy + fhh * hy * hy) / fh;
    SurfaceJet& jet = out[i];
    jet.p = X_SP.apply({0.0, uv[i].y(), h});
    jet.pu = hu * up + r * along;
    jet.pv = hy * up + across;
    jet.puu = huu * up;
    jet.puv = huy * up;
    jet.pvv = hyy * up;
    if (turns) {
      jet.puu += 2.0 * hu * along - h * up;
      jet.puv += hy * along;
    }
    jet.outward = jet.pu.cross(jet.pv).dot(f.gradient) < 0.0 ? -1.0 : 1.0;
  }
}

}  // namespace treadmark::levelset
