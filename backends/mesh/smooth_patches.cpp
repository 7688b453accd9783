// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/smooth_patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/backends/mesh/blend.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel_blocks.hpp"

namespace treadmark::mesh {

namespace {

constexpr double kGrazing = 0.01;  ///< cosine between line and surface normal below which the facet counts
constexpr double kSafety = 1.5;    ///< on the sampled distance between facet and surface
constexpr double kWild = 0.25;     ///< of the longest side: a surface farther off is not believed

/// Barycentric coordinates as jets by x and y of the plane.
template <class Jet>
std::array<Jet, 3> barycentric_jets(const ProjectedTriangle& triangle, const LineHit& hit) {
  const auto& q = triangle.q;
  const double area = (q[1].x() - q[0].x()) * (q[2].y() - q[0].y()) - (q[1].y() - q[0].y()) * (q[2].x() - q[0].x());
  std::array<Jet, 3> b;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = q[(k + 1) % 3], &to = q[(k + 2) % 3];
    b[k] = Jet(hit.b[k], (from.y() - to.y()) / area, (to.x() - from.x()) / area);
  }
  return b;
}

}  // namespace

SmoothPatches::SmoothPatches(const PreparedMesh& mesh, double crease_angle)
    : mesh_(mesh), fits_(fit_vertices(mesh, crease_angle)), bulge_(mesh.triangles.size(), 0.0f) {
  constexpr std::size_t kChunk = 512;
  const std::size_t n = mesh.triangles.size();
  needle_.resize(n);  // bits: no chunk shares a word with another one
  parallel_blocks(n, kChunk, [&](std::size_t from, std::size_t to) {
    for (std::size_t t = from; t < to; ++t) {
      bulge_[t] = std::nextafter(static_cast<float>(sampled_bulge(static_cast<std::uint32_t>(t))),
                                 std::numeric_limits<float>::infinity());
      const Corners& c = mesh.triangles[t];
      needle_[t] = is_sliver(mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]);
    }
  });
  largest_bulge_ = *std::max_element(bulge_.begin(), bulge_.end());
}

PatchSource SmoothPatches::source_of(std::uint32_t triangle) const {
  const Corners& fits = fits_.of(mesh_, triangle);
  PatchSource source{};
  for (std::size_t k = 0; k < 3; ++k) {
    source.fits[k] = &fits_.fits[fits[k]];
    source.corners[k] = mesh_.vertices[mesh_.triangles[triangle][k]].data();
  }
  return source;
}

std::array<VertexFit, 3> SmoothPatches::fits_of(std::uint32_t triangle) const {
  const Corners& fits = fits_.of(mesh_, triangle);
  std::array<VertexFit, 3> out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = restored(fits_.fits[fits[k]], mesh_.vertices[mesh_.triangles[triangle][k]]);
  return out;
}

bool SmoothPatches::prepare(const PatchKernel& kernel, const PlaneLines& lines, std::uint32_t triangle,
                            const double* places, double* patch) const {
  if (needle_[triangle]) return false;
  PatchSource source = source_of(triangle);
  source.places = places;
  source.bulge = static_cast<double>(bulge_[triangle]);
  kernel.prepare(lines, source, patch);
  return true;
}

Vec3 SmoothPatches::mean_of_normals(std::uint32_t triangle) const {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t fit : fits_.of(mesh_, triangle))
    sum += Eigen::Map<const Eigen::Vector3f>(fits_.fits[fit].normal).cast<double>();
  return sum / 3.0;
}

/// t along the line from start where the blend vanishes: a cubic in t, because the weights stay.
bool SmoothPatches::solve(const std::array<VertexFit, 3>& fits, const std::array<double, 3>& w, const Vec3& start,
                          const Vec3& direction, double side, double& t) const {
  double g0 = 0.0, g1 = 0.0, g2 = 0.0, g3 = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (w[k] == 0.0) continue;
    const VertexFit& f = fits[k];
    const Vec3 d = start - f.origin;
    const double u = f.axis_u.dot(d), v = f.axis_v.dot(d), du = f.axis_u.dot(direction), dv = f.axis_v.dot(direction);
    const auto& c = f.c;
    g0 += w[k] * (f.normal.dot(d) - f.height(u, v));
    g1 += w[k] * (f.normal.dot(direction) - f.slope_u(u, v) * du - f.slope_v(u, v) * dv);
    g2 -= w[k] * (0.5 * f.bend_uu(u, v) * du * du + f.bend_uv(u, v) * du * dv + 0.5 * f.bend_vv(u, v) * dv * dv);
    g3 -= w[k] * (du * du * (c[5] * du + c[6] * dv) + dv * dv * (c[7] * du + c[8] * dv));
  }
  t = 0.0;
  constexpr int kMost = 12;
  for (int i = 0; i < kMost; ++i) {
    const double value = g0 + t * (g1 + t * (g2 + t * g3)), slope = g1 + t * (2.0 * g2 + 3.0 * t * g3);
    if (!(side * slope > kGrazing)) return false;
    const double step = value / slope;
    t -= step;
    if (std::fabs(step) <= 1e-16 + 1e-9 * std::fabs(t)) return side * (g1 + t * (2.0 * g2 + 3.0 * t * g3)) > kGrazing;
  }
  return false;
}

bool SmoothPatches::evaluate(const PlaneView& view, const ProjectedTriangle& triangle, const LineHit& hit, double x,
                             double y, int derivatives, Evaluated& out) const {
  const std::array<VertexFit, 3> fits = fits_of(triangle.index);
  const std::array<double, 3> feet = edge_feet(triangle.q);
  const Vec3 direction = view.direction(), start = view.to_local(x, y, hit.z);
  std::array<double, 3> w = blend_weights<double>(hit.b, feet);
  double t = 0.0;
  if (!solve(fits, w, start, direction, view.side, t)) return false;
  if (!(std::fabs(t) <= reach(view, triangle.index))) return false;
  out.z = hit.z + t;
  if (derivatives == 0) return true;

  // weights with derivatives; across a sliver they mean nothing
  std::array<Jet2, 3> jets{w[0], w[1], w[2]};
  if (!needle_[triangle.index]) {
    if (derivatives == 1) {
      const auto first = blend_weights(barycentric_jets<Jet1>(triangle, hit), feet);
      for (std::size_t k = 0; k < 3; ++k) jets[k] = Jet2(w[k], first[k].x, first[k].y);
    } else {
      jets = blend_weights(barycentric_jets<Jet2>(triangle, hit), feet);
    }
  }

  const Vec3 point = start + t * direction;
  Vec3 gradient = Vec3::Zero();  // of G, local; weights held
  double gx = 0.0, gy = 0.0;     // what the weights add
  std::array<double, 3> f{}, su{}, sv{};
  std::array<Vec3, 3> g;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexFit& fit = fits[k];
    const Vec3 d = point - fit.origin;
    const double u = su[k] = fit.axis_u.dot(d), v = sv[k] = fit.axis_v.dot(d);
    f[k] = fit.normal.dot(d) - fit.height(u, v);
    g[k] = fit.normal - fit.slope_u(u, v) * fit.axis_u - fit.slope_v(u, v) * fit.axis_v;
    gradient += w[k] * g[k];
    gx += jets[k].x * f[k];
    gy += jets[k].y * f[k];
  }
  const Mat3 to_plane = view.rotation.transpose();
  const Vec3 G = to_plane * gradient + Vec3(gx, gy, 0.0);
  const double p = out.dzdx = -G.x() / G.z(), q = out.dzdy = -G.y() / G.z();
  if (derivatives == 1) return true;

  Mat3 H = Mat3::Zero();  // second derivatives of G by the plane's x, y, z
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexFit& fit = fits[k];
    const Vec3 a = to_plane * fit.axis_u, b = to_plane * fit.axis_v, slope = to_plane * g[k];
    const Mat3 ab = a * b.transpose();
    H -= w[k] * (fit.bend_uu(su[k], sv[k]) * a * a.transpose() + fit.bend_uv(su[k], sv[k]) * (ab + ab.transpose()) +
                 fit.bend_vv(su[k], sv[k]) * b * b.transpose());
    const Vec3 dw(jets[k].x, jets[k].y, 0.0);
    H += dw * slope.transpose() + slope * dw.transpose();
    H(0, 0) += jets[k].xx * f[k];
    H(0, 1) += jets[k].xy * f[k];
    H(1, 1) += jets[k].yy * f[k];
  }
  out.dzdxx = -(H(0, 0) + 2.0 * H(0, 2) * p + H(2, 2) * p * p) / G.z();
  out.dzdxy = -(H(0, 1) + H(0, 2) * q + H(1, 2) * p + H(2, 2) * p * q) / G.z();
  out.dzdyy = -(H(1, 1) + 2.0 * H(1, 2) * q + H(2, 2) * q * q) / G.z();
  return true;
}

double SmoothPatches::reach(const PlaneView& view, std::uint32_t triangle) const {
  const double cosine = std::fabs(mean_of_normals(triangle).dot(view.direction()));
  return static_cast<double>(bulge_[triangle]) / std::max(cosine, 1.0 / kSteepest);
}

/// Distance between facet and surface along the mean normal, on a lattice of barycentric coordinates.
double SmoothPatches::sampled_bulge(std::uint32_t triangle) const {
  PatchSource source = source_of(triangle);
  source.bulge = std::numeric_limits<double>::infinity();
  const Vec3 direction = mean_of_normals(triangle).normalized();
  const double most = fastest_kernel<PatchKernel>().bulge(source, direction.data());
  const Corners& c = mesh_.triangles[triangle];
  const std::array<Vec3, 3> v{mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]};
  const double longest = std::max({(v[1] - v[0]).norm(), (v[2] - v[1]).norm(), (v[0] - v[2]).norm()});
  if (!(most <= kWild * longest)) return 0.0;
  constexpr double kFloor = 1e-6;  // of the longest side, for surfaces that are flat at the samples
  return kSafety * most + kFloor * longest;
}

}  // namespace treadmark::mesh
