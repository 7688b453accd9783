// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/conformance/promises.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

#include <fmt/format.h>

#include "treadmark/backends/conformance/shapes.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::conformance {
namespace {

/// Where something was compared: number of the plane (of bounds: of the rectangle), place in it [m].
struct Place {
  int plane;
  double x, y;
};

/// How badly comparisons of one kind end.
class Tally {
 public:
  explicit Tally(const Subject& subject) : brief_(subject.brief) {}

  /// ratio: a violation over what is allowed, NaN counts as infinite.
  void add(double ratio, const Place& at, const char* what, double found = kNaN, double expected = kNaN) {
    if (std::isnan(ratio)) ratio = kInfinity;
    if (ratio > 1.0) ++broken_;
    if (++count_ > 1 && ratio <= worst_) return;
    worst_ = ratio, at_ = at, what_ = what, found_ = found, expected_ = expected;
  }
  void expect(bool holds, const Place& at, const char* what) { add(holds ? 0.0 : kInfinity, at, what); }
  /// The same in another way; one without the other is off by everything.
  void same(double found, double expected, double tolerance, const Place& at, const char* what) {
    const bool both = found == expected || (std::isnan(found) && std::isnan(expected));
    add(both ? 0.0 : std::fabs(found - expected) / tolerance, at, what, found, expected);
  }
  std::size_t count() const { return count_; }

  /// share: so many of all may be broken; 0: none, the worst one decides.
  Finding finding(double share = 0.0) const {
    constexpr double kInBrief = 0.05;
    if (brief_) share = std::max(share, kInBrief);
    std::string where =
        fmt::format("{} at place {}, x = {:.3f} mm, y = {:.3f} mm", what_, at_.plane + 1, 1e3 * at_.x, 1e3 * at_.y);
    if (!std::isnan(found_) || !std::isnan(expected_)) where += fmt::format(": {:.9g}, not {:.9g}", found_, expected_);
    if (share == 0.0) return {worst_, where, count_};
    const double allowed = share * static_cast<double>(count_);
    return {broken_ == 0 ? 0.0 : static_cast<double>(broken_) / allowed,
            fmt::format("{} of {}, worst: {}", broken_, count_, where), count_};
  }

 private:
  bool brief_;
  std::size_t count_ = 0, broken_ = 0;
  double worst_ = 0.0, found_ = kNaN, expected_ = kNaN;
  Place at_{};
  const char* what_ = "nothing";
};

/// The worse of two findings of one promise, which compared so much.
Finding worse(const Finding& a, const Finding& b, std::size_t compared) {
  return b.worst > a.worst ? Finding{b.worst, b.where, compared} : Finding{a.worst, a.where, compared};
}

struct Fields {
  std::vector<double> z, dzdx, dzdy;
  double steep(std::size_t i) const { return 1.0 + dzdx[i] * dzdx[i] + dzdy[i] * dzdy[i]; }
};

Fields fields(const Surface& surface, const Pose& X_SP, const Grid2& grid) {
  Fields f;
  f.z.assign(grid.size(), 0.0);
  f.dzdx = f.dzdy = f.z;
  surface.heights({X_SP, grid}, {f.z, f.dzdx, f.dzdy});
  return f;
}

/// Steps that are odd, so that no point falls on a joint by chance.
Grid2 coarse_grid(const Subject& s) {
  const double step = s.brief ? 3.0 : 1.0;
  return {-0.0197, -0.0293, 0.00131 * step, 0.00193 * step, s.brief ? 11 : 31, s.brief ? 11 : 31};
}
constexpr Grid2 kFineGrid{-0.0197, -0.0293, 0.00062, 0.00094, 65, 63};

/// What is found in another way is the same to within so much [m], per steepness; in brief there is room for what no
/// contact would notice.
double rounding(const Subject& s, double of_all) { return s.brief ? 1e-8 : of_all; }

bool is_wheel(const Subject& s) { return s.surface->facing() == Facing::down; }

/// Whether y [m] lies so near to an end of the profile that tiny errors decide between hit and miss.
bool near_end(const Subject& s, double y, double by = 1e-4) {
  return s.shape != nullptr && (y < s.shape->y_min + by || y > s.shape->y_max - by);
}

/// Whether a height is where the shape is known and has not ended; p: its place in S.
bool seen(const Subject& s, double z, const Vec3& p) {
  return z >= s.shape->r_low && z <= s.shape->r_high && !near_end(s, p.y());
}

/// each(place, pose, fields, index) for each point of the grid in each plane.
template <class Each>
void over_grid(const Subject& s, const Grid2& g, const Each& each) {
  int k = -1;
  for (const Pose& X : s.planes) {
    const Fields f = fields(*s.surface, X, g);
    ++k;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) each(Place{k, g.x(ix), g.y(iy)}, X, f, g.index(ix, iy));
  }
}

Finding name(const Subject& s) {
  Tally tally(s);
  tally.expect(s.backend.empty() || s.surface->backend() == s.backend, {}, "the name of the backend");
  tally.expect(s.surface->memory_bytes() > 0, {}, "the memory");
  tally.expect(s.shape == nullptr || is_wheel(s) == (s.shape->spec.body == Body::wheel), {}, "the way it faces");
  return tally.finding();
}

Finding heights(const Subject& s) {
  constexpr double kGrazing = 0.1;  // a line that only grazes the surface may miss it
  const Shape& shape = *s.shape;
  Tally lines(s), distances(s);
  over_grid(s, coarse_grid(s), [&](const Place& at, const Pose& X, const Fields& f, std::size_t i) {
    const double z = f.z[i], sign = is_wheel(s) ? 1.0 : -1.0;
    const BruteHit hit = brute_force(shape, X, at.x, at.y);
    if (!std::isnan(hit.z) && hit.slant > kGrazing && !near_end(s, hit.y))
      lines.add(sign * (hit.z - z) * hit.slant / s.tolerance.height, at, "the height", z, hit.z);
    const Vec3 p = X.apply({at.x, at.y, z});
    if (!seen(s, z, p)) return;
    const double distance = std::fabs(shape.outside(p)) / gradient(shape, p).norm();
    distances.add(distance / s.tolerance.height, at, "the distance from the shape [m]", distance, 0.0);
  });
  return worse(lines.finding(), distances.finding(), lines.count());
}

Finding normals(const Subject& s) {
  Tally tally(s);
  over_grid(s, coarse_grid(s), [&](const Place& at, const Pose& X, const Fields& f, std::size_t i) {
    const Vec3 p = X.apply({at.x, at.y, f.z[i]});
    if (!seen(s, f.z[i], p)) return;
    const Vec3 normal = (X.rotation * Vec3(-f.dzdx[i], -f.dzdy[i], 1.0)).normalized();
    const double turned = normal.cross(gradient(*s.shape, p).normalized()).norm();
    tally.add(turned / s.tolerance.slope, at, "the turn of the normal [rad]", turned, 0.0);
  });
  return tally.finding(s.exact ? 0.0 : s.shape->kinks);
}

Finding slopes(const Subject& s) {
  // central differences over 2 um: jumps of curvature spoil a few of them, edges 0.5 mm apart more
  constexpr double kStep = 1e-6, kTolerance = 2e-4, kSteep = 3.0;  // differences lose digits where it is steeper
  Tally tally(s);
  const Grid2 grid = coarse_grid(s);
  std::array<Fields, 4> b;
  over_grid(s, grid, [&](const Place& at, const Pose& X, const Fields& f, std::size_t i) {
    for (std::size_t side = 0; i == 0 && side < b.size(); ++side) {
      const double dx = side == 0 ? kStep : side == 1 ? -kStep : 0.0, dy = side == 2 ? kStep : side == 3 ? -kStep : 0.0;
      b[side] = fields(*s.surface, X, {grid.x0 + dx, grid.y0 + dy, grid.dx, grid.dy, grid.nx, grid.ny});
    }
    const double dzdx = (b[0].z[i] - b[1].z[i]) / (2.0 * kStep), dzdy = (b[2].z[i] - b[3].z[i]) / (2.0 * kStep);
    if (std::isnan(f.z[i] + dzdx + dzdy) || std::fabs(f.dzdx[i]) > kSteep || std::fabs(f.dzdy[i]) > kSteep) return;
    const double off = std::max(std::fabs(f.dzdx[i] - dzdx), std::fabs(f.dzdy[i] - dzdy));
    tally.add(off / kTolerance, at, "slopes less differences of heights", off, 0.0);
  });
  return tally.finding(s.brief ? 0.5 : s.creases == Creases::none ? 1.0 / 200.0 : 1.0 / 40.0);
}

Finding points(const Subject& s) {
  Tally tally(s);
  const Grid2 grid = coarse_grid(s);
  std::vector<Vec2> places;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) places.emplace_back(grid.x(ix), grid.y(iy));
  std::vector<double> z(places.size());
  over_grid(s, grid, [&](const Place& at, const Pose& X, const Fields& f, std::size_t i) {
    if (i == 0) s.surface->heights_at(X, places, {z, {}, {}});
    tally.same(z[i], f.z[i], rounding(s, 1e-11) * f.steep(i), at, "the height of a point");
    const bool missed = std::isnan(f.z[i]);
    tally.expect(missed == std::isnan(f.dzdx[i]) && missed == std::isnan(f.dzdy[i]), at, "slopes without a height");
  });
  return tally.finding();
}

Finding tiles(const Subject& s) {
  Tally tally(s);
  const Grid2 g = kFineGrid;
  const int half_x = g.nx / 2, half_y = g.ny / 3;
  std::vector<Fields> whole;
  for (const Pose& X : s.planes) whole.push_back(fields(*s.surface, X, g));
  for (int part = 0; part < 4; ++part) {
    const int bx = part % 2 != 0 ? half_x : 0, by = part / 2 != 0 ? half_y : 0;
    const Grid2 tile{g.x(bx), g.y(by), g.dx, g.dy, bx != 0 ? g.nx - bx : half_x, by != 0 ? g.ny - by : half_y};
    over_grid(s, tile, [&](const Place& at, const Pose&, const Fields& f, std::size_t i) {
      const int ix = static_cast<int>(i) % tile.nx, iy = static_cast<int>(i) / tile.nx;
      // points are reached from other neighbours; a steep surface turns the rounding of x and y into more
      const double steep = 1.0 + std::hypot(f.dzdx[i], f.dzdy[i]);
      tally.same(f.z[i], whole[at.plane].z[g.index(bx + ix, by + iy)], 1e-12 * steep, at, "the height in a tile");
    });
  }
  return tally.finding();
}

Finding threads(const Subject& s) {
  Tally tally(s);
  std::vector<Fields> one;
  for (const Pose& X : s.planes) {
    const ThreadLimit limit(1);
    one.push_back(fields(*s.surface, X, kFineGrid));
  }
  const ThreadLimit limit(4);
  over_grid(s, kFineGrid, [&](const Place& at, const Pose&, const Fields& many, std::size_t i) {
    for (const auto of : {&Fields::z, &Fields::dzdx, &Fields::dzdy})
      tally.same((many.*of)[i], (one[at.plane].*of)[i], 0.0, at, "what four threads give");
  });
  return tally.finding();
}

Finding misses(const Subject& s) {
  Tally tally(s);
  const Box3 box = s.surface->bounds();
  const std::vector<Vec2> places{{0.0, 0.0}, {0.001, 0.002}};
  for (const double y : {(s.shape != nullptr ? s.shape->y_max : box.max.y()) + 0.001,
                         (s.shape != nullptr ? s.shape->y_min : box.min.y()) - 0.006}) {
    if (!std::isfinite(y)) continue;
    Pose X = s.planes.front();
    X.origin.y() = y;
    const Place at{0, 0.0, y};
    const Fields f = fields(*s.surface, X, {0.0, 0.0, 1e-3, 1e-3, 5, 5});
    for (std::size_t i = 0; i < f.z.size(); ++i)
      tally.expect(std::isnan(f.z[i]) && std::isnan(f.dzdx[i]) && std::isnan(f.dzdy[i]), at, "a height");
    tally.expect(std::isnan(height_at(*s.surface, X, {0.001, 0.001})), at, "a single height");
    std::vector<SurfacePoint> found(places.size());
    s.surface->locate(X, places, found);
    for (const SurfacePoint& p : found) tally.expect(p.status == LocateStatus::outside, at, "a point that is located");
    tally.expect(s.surface->height_bounds(X, {0.0, 0.004, 0.0, 0.004}).empty, at, "bounds that are not empty");
  }
  return tally.finding();
}

Finding sections(const Subject& s) {
  constexpr int kParts = 24, kSections = 7;
  constexpr double kAcross = 1.3e-3;  // [m]
  const Shape& shape = *s.shape;
  Tally tally(s);
  const double step = (shape.u_max - shape.u_min) / kParts;
  const Grid2 across{
      0.0, shape.y_min + 0.5e-3, 1.0, kAcross, 1, to_whole<int>((shape.y_max - shape.y_min) / kAcross) - 1};
  std::vector<double> profile;
  int parts = 0;
  for (int part = 0; part < kParts; ++part) {
    const double first = shape.u_min + part * step;
    if (!s.surface->constant_between(first, first + step)) continue;
    ++parts;
    for (int i = 0; i < kSections; ++i) {
      const double u = first + (i + 0.5) * step / kSections;
      const Pose X = is_wheel(s) ? Pose{Vec3::Zero(), rotation_y(u)} : Pose{Vec3(u, 0.0, 0.0), Mat3::Identity()};
      const Fields f = fields(*s.surface, X, across);
      if (profile.empty()) profile = f.z;
      for (int k = 0; k < across.ny; ++k)
        tally.same(f.z[k], profile[k], 1e-12, {part, u, across.y(k)}, "the height of a section");
    }
  }
  tally.expect(shape.spec.defects.empty() || !s.surface->constant_between(shape.u_min, shape.u_max), {},
               "one profile of a damaged shape");
  tally.expect(!s.surface->constant_profile() || parts == kParts, {}, "one profile as a whole, and not in its parts");
  return tally.finding();
}

Finding moved(const Subject& s) {
  constexpr double kTolerance = 1e-11;  // a metre of offset costs rounding of 1e-16 m, times the slope
  constexpr double kDown = 0.0021;      // [m]
  const Pose X_WS{{3.1, -0.7, 0.4}, rotation({0.3, -0.8, 1.9})}, X_PQ{{0.0, 0.0, kDown}, rotation_z(kPi)};
  Tally tally(s);
  const Grid2 g = coarse_grid(s);
  // the plane moved along its normal, and turned half round in itself
  const Grid2 turned{-g.x(g.nx - 1), -g.y(g.ny - 1), g.dx, g.dy, g.nx, g.ny};
  Fields after, other;
  over_grid(s, g, [&](const Place& at, const Pose& X, const Fields& f, std::size_t i) {
    if (i == 0)
      after = fields(*s.surface, X_WS.inverse() * (X_WS * X), g), other = fields(*s.surface, X * X_PQ, turned);
    tally.same(after.z[i], f.z[i], kTolerance * f.steep(i), at, "the height with all moved");
    tally.same(other.z[g.size() - 1 - i] + kDown, f.z[i], kTolerance * f.steep(i), at,
               "the height with the plane moved");
  });
  return tally.finding();
}

/// Bounds of rectangles of random sizes in planes that are turned a little at random, and the heights over them.
/// many: in grids of 4 x 3.
template <bool many>
Finding bounds_of(const Subject& s) {
  std::mt19937 random(many ? 11 : 7);
  const auto unit = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const int trials = many ? (s.brief ? 4 : 60) : (s.brief ? 24 : 400), n = s.brief ? 6 : many ? 8 : 12;
  const double near = s.brief ? 0.3 : 1.0;  // in brief most of what is looked at should be there
  Tally inside(s), close(s);
  std::size_t covered = 0;  // rectangles
  for (int trial = 0; trial < trials; ++trial) {
    Pose X = s.planes[static_cast<std::size_t>(trial) % s.planes.size()];
    if (!many || trial % 3 != 0) {
      const double roll = 0.2 * (unit() - 0.5), yaw = 0.2 * (unit() - 0.5), pitch = 0.2 * (unit() - 0.5);
      X.rotation = X.rotation * rotation({roll, yaw, pitch});
    }
    const auto length = [&] { return std::pow(10.0, many ? -3.5 + 1.5 * unit() : -4.0 + 2.5 * unit()); };
    const double width = length(), height = length(), size = width + height;
    const double x = near * 0.1 * (unit() - 0.5), y = near * 0.15 * (unit() - 0.5);
    RectangleGrid r{{x, x + width, y, y + height}, 1.0, 1.0, many ? 4 : 1, many ? 3 : 1};
    if (many) r.step_x = width * (0.6 + unit()), r.step_y = height * (0.6 + unit());  // some overlap, some leave gaps
    std::vector<HeightBounds> bounds(r.size());
    if (many) s.surface->height_bounds(X, r, bounds);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const Rectangle one = r.at(static_cast<int>(k) % r.nx, static_cast<int>(k) / r.nx);
      const HeightBounds b = many ? bounds[k] : s.surface->height_bounds(X, one);
      const Fields f = fields(*s.surface, X, {one.x_min, one.y_min, width / (n - 1), height / (n - 1), n, n});
      const Place at{trial, one.x_min, one.y_min};
      double z_min = kInfinity, z_max = -kInfinity;
      bool everywhere = true;
      for (const double z : f.z) {
        everywhere = everywhere && !std::isnan(z);
        if (std::isnan(z)) continue;
        z_min = std::min(z_min, z), z_max = std::max(z_max, z);
        const double bound = z < b.z_min ? b.z_min : b.z_max, beyond = std::max({0.0, b.z_min - z, z - b.z_max});
        inside.add(b.empty ? kInfinity : beyond / rounding(s, 1e-10), at, "a height at a bound", z, bound);
      }
      // and they are of use: towards the other body, those of a small rectangle are of its size
      if (everywhere) ++covered;
      if (!everywhere || s.brief || size >= (many ? 4e-3 : 2e-3) || z_max - z_min >= 2.0 * size) continue;
      const double excess = is_wheel(s) ? b.z_max - z_max : z_min - b.z_min;
      close.add(excess / (3.0 * size + 1e-4), at, "from heights of a small rectangle to their bound [m]", excess, 0.0);
    }
  }
  constexpr std::size_t kFewest = 21;
  if (!s.brief && close.count() < (s.shape != nullptr ? kFewest : 1))
    return {kInfinity, fmt::format("only {} small rectangles are wholly on it", close.count()), close.count()};
  return worse(inside.finding(), close.finding(0.1), many ? inside.count() : covered);
}

Finding located(const Subject& s) {
  Tally tally(s);
  const Grid2 g = coarse_grid(s);
  const auto nx = static_cast<std::size_t>(g.nx);
  over_grid(s, g, [&](const Place& at, const Pose& X, const Fields& f, std::size_t i) {
    if (i % nx % 2 != 0 || i / nx % 2 != 0) return;
    SurfacePoint p;
    const Vec2 point(at.x, at.y);
    s.surface->locate(X, {&point, 1}, {&p, 1});
    const bool missed = std::isnan(f.z[i]);
    tally.expect((p.status == LocateStatus::outside) == missed, at, "there for heights or for locate alone");
    if (missed || p.status == LocateStatus::outside) return;
    const double away = (p.position_S - X.apply({at.x, at.y, f.z[i]})).norm();
    tally.add(away / (rounding(s, 1e-11) * f.steep(i)), at, "the distance from its height [m]", away, 0.0);
    tally.same(p.normal_S.norm(), 1.0, 1e-12, at, "the length of the normal");
    for (const Vec3& along : {Vec3(1.0, 0.0, f.dzdx[i]), Vec3(0.0, 1.0, f.dzdy[i])})
      tally.same(p.normal_S.dot((X.rotation * along).normalized()), 0.0, 1e-6, at, "the normal along a slope");
    if (s.shape != nullptr && !near_end(s, p.position_S.y()))
      tally.expect(p.normal_S.dot(gradient(*s.shape, p.position_S)) > 0.0, at, "the normal points into the material");
    tally.expect(p.curvature_1 >= p.curvature_2, at, "the greater curvature is the lesser one");
  });
  return tally.finding();
}

/// each(place, what is located) in the first three planes, every so many columns and rows.
template <class Each>
void over_located(const Subject& s, int columns, int rows, const Each& each) {
  const Grid2 g = coarse_grid(s);
  std::vector<Vec2> at;
  for (int iy = 1; iy < g.ny; iy += rows)
    for (int ix = 1; ix < g.nx; ix += columns) at.emplace_back(g.x(ix), g.y(iy));
  std::vector<SurfacePoint> found(at.size());
  for (int k = 0; k < std::min(3, static_cast<int>(s.planes.size())); ++k) {
    s.surface->locate(s.planes[k], at, found);
    for (std::size_t i = 0; i < at.size(); ++i) each(Place{k, at[i].x(), at[i].y()}, found[i]);
  }
}

Finding parameters(const Subject& s) {
  const bool exact = has_exact_derivatives(*s.surface);
  Tally places(s), turns(s), bends(s);
  std::vector<Vec2> uv;
  std::vector<std::pair<Place, SurfacePoint>> of;
  over_located(s, 6, 4, [&](const Place& at, const SurfacePoint& p) {
    if (p.status != LocateStatus::converged || near_end(s, p.position_S.y(), 4e-4)) return;
    uv.emplace_back(p.u, p.v);
    of.emplace_back(at, p);
  });
  std::vector<SurfaceJet> jets(uv.size());
  evaluate(*s.surface, uv, jets);
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const auto& [at, p] = of[i];
    // smooth meshes depend a little on where they are seen from
    places.add(std::fabs((jets[i].p - p.position_S).dot(p.normal_S)) / (exact ? 1e-11 : 5e-8), at, "another point");
    const SurfaceShape shape = shape_of(jets[i]);
    if (!shape.normal.allFinite()) continue;  // differences reach beyond the end
    places.same(shape.direction_1.dot(shape.direction_2), 0.0, 1e-9, at, "principal directions");
    places.same(shape.direction_1.norm(), 1.0, 1e-9, at, "the length of a principal direction");
    // differences over 0.1 mm: across edges they see another normal, across joints another curvature
    turns.add((shape.normal - p.normal_S).norm() / (exact ? 1e-6 : 1e-4), at, "another normal");
    const double scale = 1.0 + std::fabs(p.curvature_1) + std::fabs(p.curvature_2);
    const double off = std::fabs(shape.curvature_1 - p.curvature_1) + std::fabs(shape.curvature_2 - p.curvature_2);
    bends.add(off / ((exact ? 2e-3 : 2e-2) * scale), at, "the greater curvature", p.curvature_1, shape.curvature_1);
  }
  Finding found = worse(places.finding(), {}, bends.count());
  if (!exact && s.creases != Creases::none) return found;
  return worse(worse(found, turns.finding(exact ? 0.0 : 0.25), 0), bends.finding(1.0 / 6.0), bends.count());
}

Finding curvatures(const Subject& s) {
  // what is interpolated linearly has no curvature of its own, and chords may be as short as the differences
  const bool facets = s.creases == Creases::facets;
  if (s.creases == Creases::cells && (s.brief || (s.shape != nullptr && s.shape->varies)))
    return {.compared = kNotAsked};
  if (s.creases == Creases::chords && s.brief) return {.compared = kNotAsked};
  constexpr double kStep = 5e-5;  // [m] the noise of 1e-16 m heights in the second difference is 4e-8 1/m
  const double side = is_wheel(s) ? 1.0 : -1.0;
  Tally tally(s);
  over_located(s, s.brief ? 2 : 5, s.brief ? 2 : 5, [&](const Place& at, const SurfacePoint& p) {
    if (p.status == LocateStatus::outside) return;
    const double told = std::fabs(p.curvature_1) + std::fabs(p.curvature_2);
    if (facets) return tally.same(told, 0.0, 0.0, at, "curvatures of a facet");  // differences reach across edges
    Pose T;
    T.origin = p.position_S;
    const Vec3 n = side * p.normal_S, e = Vec3::UnitX().cross(n).norm() > 0.1 ? Vec3::UnitX() : Vec3::UnitY();
    T.rotation.col(2) = n;
    T.rotation.col(1) = n.cross(e).normalized();
    T.rotation.col(0) = T.rotation.col(1).cross(n);
    const std::vector<double> z = fields(*s.surface, T, {-kStep, -kStep, kStep, kStep, 3, 3}).z;
    const double hxx = (z[3] - 2 * z[4] + z[5]) / (kStep * kStep), hyy = (z[1] - 2 * z[4] + z[7]) / (kStep * kStep);
    const double hxy = (z[8] - z[6] - z[2] + z[0]) / (4 * kStep * kStep);
    if (std::isnan(hxx + hyy + hxy)) return;
    const double mean = -side * 0.5 * (hxx + hyy), spread = std::hypot(0.5 * (hxx - hyy), hxy);
    const double off = std::max(std::fabs(mean + spread - p.curvature_1), std::fabs(mean - spread - p.curvature_2));
    // in brief a factor of two passes
    const double allowed =
        s.brief ? 1.0 + std::fabs(mean + spread) + std::fabs(mean - spread) : s.tolerance.curvature * (1.0 + told);
    tally.add(off / allowed, at, "the greater curvature [1/m] and that of the heights", p.curvature_1, mean + spread);
  });
  // differences reach across joints, where curvature jumps, and of chords across one edge in five
  return tally.finding(facets ? 0.0 : s.brief ? 0.5 : s.creases == Creases::chords ? 1.0 / 3.0 : 1.0 / 6.0);
}

/// Against the surface with each of a few parameters changed, those on which the heights of some points depend most.
/// Where it has a kink in a parameter, as where parts of a body lie over each other, the derivative may be any between
/// those of both sides.
Finding pulled_back(const Subject& s) {
  constexpr double kSame = 2e-3, kRounding = 1e-12, kLean = 0.3, kManySteps = 1e3;
  constexpr std::size_t kFew = 10000;  // surfaces of more parameters may take a second to make
  constexpr Grid2 kClose{0.2e-3, -0.1e-3, 0.43e-3, 0.39e-3, 3, 3};
  Tally tally(s);
  const std::vector<ShapeParameter> all = s.surface->parameters();
  tally.expect(all.size() == s.surface->parameter_count(), {}, "how many parameters it has");
  const std::size_t each = all.size() > kFew ? 1 : 2;  // of planes, and of parameters in a plane
  for (std::size_t k = 0; k < std::min(each, s.planes.size()) && !all.empty(); ++k) {
    const Pose& X = s.planes[k];
    std::vector<Vec2> points;
    for (int iy = 0; iy < kClose.ny; ++iy)
      for (int ix = 0; ix < kClose.nx; ++ix) points.emplace_back(kClose.x(ix), kClose.y(iy));
    std::vector<SurfacePoint> at(points.size());
    s.surface->locate(X, points, at);
    std::vector<double> weights(points.size(), 0.0), by(all.size(), 0.0), here(points.size());
    for (std::size_t i = 0; i < at.size(); ++i)
      if (at[i].status == LocateStatus::converged && !near_end(s, at[i].position_S.y(), 1e-3) &&
          std::fabs(at[i].normal_S.dot(X.rotation.col(2))) > kLean)
        weights[i] = 1.0 + 0.1 * static_cast<double>(i);
    s.surface->pull_back(X, points, weights, by);
    s.surface->heights_at(X, points, {here, {}, {}});
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto most = order.begin() + static_cast<std::ptrdiff_t>(std::min(each, order.size()));
    std::partial_sort(order.begin(), most, order.end(),
                      [&](std::size_t a, std::size_t b) { return std::fabs(by[a]) > std::fabs(by[b]); });
    for (auto one = order.begin(); one != most && by[*one] != 0.0; ++one) {
      const double amount = kManySteps * all[*one].step;
      std::vector<double> more(points.size()), less(points.size());
      s.surface->changed(*one, amount)->heights_at(X, points, {more, {}, {}});
      s.surface->changed(*one, -amount)->heights_at(X, points, {less, {}, {}});
      double low = 0.0, high = 0.0, size = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (weights[i] == 0.0) continue;
        const double up = weights[i] * (more[i] - here[i]) / amount, down = weights[i] * (here[i] - less[i]) / amount;
        low += std::min(up, down), high += std::max(up, down);
        size += 0.5 * std::fabs(up + down) * kSame + weights[i] * kRounding / amount;
      }
      const double off = std::fabs(by[*one] - std::clamp(by[*one], low, high));
      tally.add((std::isnan(low + high) ? kNaN : off) / size, {static_cast<int>(k), points[4].x(), points[4].y()},
                all[*one].name.c_str(), by[*one], 0.5 * (low + high));
    }
  }
  return tally.finding();
}

constexpr Promise kPromises[] = {
    {"name", "it tells its backend, which way it faces and what it takes", 3, false, true, name},
    {"heights", "lines along the plane's normal meet the shape, where they meet it first", 1001, true, false, heights},
    {"normals", "slopes give the normals of the shape", 1001, true, false, normals},
    {"slopes", "slopes are those of the heights", 1001, false, true, slopes},
    {"points", "heights of points are those of grids, and the same are missing", 5000, false, true, points},
    {"tiles", "a grid in tiles has the heights of the whole", 20000, false, false, tiles},
    {"threads", "any number of threads gives the same bits", 20000, false, false, threads},
    {"misses", "beside the profile there is nothing", 50, false, true, misses},
    {"sections", "what it calls one profile is one", 2, true, false, sections},
    {"moved", "planes moved in themselves or along their normal give the same heights", 5000, false, false, moved},
    {"bounds", "bounds hold every height, those of small rectangles closely", 51, false, true, bounds_of<false>},
    {"many-bounds", "so do bounds of many rectangles at once", 2001, false, true, bounds_of<true>},
    {"locate", "located points lie where the heights are, normals point outwards", 1000, false, true, located},
    {"parameters", "parameters of located points lead back to them", 31, false, false, parameters},
    {"pulled-back", "weights of heights pulled back to its parameters are derivatives", 1, false, false, pulled_back},
    {"curvatures", "principal curvatures are those of the heights", 51, false, true, curvatures},
};

}  // namespace

std::span<const Promise> promises() { return kPromises; }

Finding hold(const Promise& promise, const Subject& subject) try {
  Finding found = promise.worst(subject);
  const std::size_t least = subject.brief || subject.shape == nullptr ? 0 : promise.least;
  if (!found.kept() || found.compared >= least) return found;
  return {kInfinity, fmt::format("only {} of {} numbers could be compared", found.compared, least), found.compared};
} catch (const Error& error) {
  return {kInfinity, fmt::format("it fails: {}", error.what()), 0};
}

std::string broken_promise(const Subject& subject) {
  for (const Promise& promise : kPromises) {
    if ((promise.of_shape && subject.shape == nullptr) || (subject.brief && !promise.in_brief)) continue;
    if (const Finding found = hold(promise, subject); !found.kept())
      return fmt::format("breaks the promise '{}' ({}): {}", promise.name, promise.says, found.where);
  }
  return {};
}

Subject look_at(std::shared_ptr<const Surface> surface, double u, const std::string& backend) {
  constexpr double kFarthest = 0.1;  // of rims that are looked for [m]
  constexpr RollYawPitch kTurned[] = {{0.0, 0.0, 0.0}, {0.07, 0.0, 0.0}, {-0.05, 0.02, 0.03}};
  Subject s;
  s.brief = true;
  for (const Backend* row : backends())
    if (row->name == (backend.empty() ? surface->backend() : backend)) s.creases = row->creases;
  const Box3 box = surface->bounds();
  const double low = std::max(box.min.y(), -kFarthest), high = std::min(box.max.y(), kFarthest);
  const Pose X = station_plane(surface->facing(), u);
  double part = 0.0;
  for (const RollYawPitch& turned : kTurned) {
    part += 0.25;
    const double y = low + part * (high - low), z = height_at(*surface, X, {0.0, y});
    s.planes.push_back({X.apply({0.0, y, std::isnan(z) ? 0.0 : z}), X.rotation * rotation(turned)});
  }
  s.surface = std::move(surface);
  return s;
}

Subject subject_of(const Shape& shape, std::shared_ptr<const Surface> surface, const Backend& backend) {
  return {std::move(surface),        shape.planes, backend.name,   {}, backend.creases,
          std::isinf(backend.order), &shape,       /*brief=*/false};
}

void Record::add(const std::string& name, const Subject& subject) {
  if (rows.empty())
    for (const Promise& promise : promises()) rows.push_back({&promise});
  for (Kept& row : rows) {
    if (row.promise->of_shape && subject.shape == nullptr) continue;
    const Finding found = hold(*row.promise, subject);
    row.kept += found.kept() ? 1 : 0;
    if (row.held++ == 0 || found.worst > row.worst.worst) row.worst = found, row.subject = name;
  }
}

bool Record::kept() const {
  return !rows.empty() && ranges::all_of(rows, [](const Kept& row) { return row.kept == row.held; });
}

std::string Record::text() const {
  std::string lines, broken;
  for (const Kept& row : rows) {
    if (row.held == 0) continue;
    lines += fmt::format("{:<12} kept by {} of {}\n", row.promise->name, row.kept, row.held);
    if (row.kept < row.held)
      broken += fmt::format("broken: '{}' ({}), worst by {}: {}\n", row.promise->name, row.promise->says, row.subject,
                            row.worst.where);
  }
  for (const std::string& note : notes) lines += note + '\n';
  return lines + broken;
}

Record hold_backend(const std::string& name, double resolution, const Progress& progress) {
  // what chords lose on an arc of 12 mm, the sharpest of the shapes, and as much again for splines round kinks
  constexpr double kUsual = 0.5e-3, kHeight = 40.0, kSlope = 60.0;
  const double h = resolution > 0.0 ? resolution : kUsual;
  const Backend& backend = backend_of(name);
  Record record;
  const std::vector<Shape> all = shapes();
  for (std::size_t i = 0; i < all.size() && !progress.stop_requested(); ++i) {
    if (progress.report) progress.report(i, all.size(), all[i].name);
    const Shape shape = shape_for(backend, all[i]);
    try {
      Subject subject = subject_of(shape, represented(shape, name, backend.resample ? resolution : 0.0), backend);
      subject.tolerance.height = kHeight * h * h, subject.tolerance.slope = kSlope * h;
      record.add(shape.name, subject);
    } catch (const Error& error) {
      record.notes.push_back(fmt::format("{} is not represented: {}", shape.name, error.what()));
    }
  }
  return record;
}

}  // namespace treadmark::conformance
