// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/read_cad.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/cad/cad_process.hpp"
#include "treadmark/io/cad/step_text.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {
namespace {

constexpr double kScan = 0.2e-3;     // steps across in which the section is looked for [m]
constexpr double kNodes = 0.25e-3;   // arc length between points of a section [m]
constexpr double kDeep = 45e-3;      // below the highest point nothing is touched [m]
constexpr double kJump = 6e-3;       // from one step to the next: another part of the body [m]
constexpr double kRim = 20e-6;       // so far inside of ends, beside which OpenCASCADE misses steep faces [m]
constexpr double kSame = 1e-8;       // [m]
constexpr double kCoarse = 10e-3;    // between slices [m]
constexpr double kFine = 0.5e-3;     // likewise, where the shape changes most [m]
constexpr double kDeviation = 1e-7;  // that makes slices closer [m]
constexpr double kFarApart = 60e-3;  // a surface that begins again so far aside is another one [m]
constexpr double kLongest = 200.0, kWidest = 10.0;  // of a body, across and up too [m]
constexpr std::size_t kMostSlices = 20'000;
constexpr double kSide = 0.5e-3, kFlat = 20e-6;  // of triangles: longest side; deviation before they are divided [m]

/// Slices of one width are not all of the surface.
struct SidesMove {
  Error error;
};

/// What lines from the contact side see.
class RunningSurface {
 public:
  RunningSurface(const cad::CadShape& shape, Body body, std::string file)
      : shape_(shape), wheel_(body == Body::wheel), file_(std::move(file)) {
    low_ = shape.low(), high_ = shape.high();
  }

  struct Seen {
    double h = kNaN;  ///< z of a rail, radius of a wheel [m]
    std::int64_t face = -1;
    double u = 0.0, v = 0.0;  ///< parameters of the face
    bool is_there() const { return face >= 0; }
  };

  Seen at(double u, double y) const { return at(u, std::vector<double>{y}).front(); }
  /// Many at once: a question takes longer than its answer.
  std::vector<Seen> at(double u, const std::vector<double>& y) const {
    constexpr double kAnywhere = -1e6;  // [m]
    const cad::Point direction = wheel_ ? cad::Point{std::sin(u), 0.0, std::cos(u)} : cad::Point{0.0, 0.0, -1.0};
    std::vector<cad::CadLine> lines;
    lines.reserve(y.size());
    for (const double across : y)
      lines.push_back({wheel_ ? cad::Point{0.0, across, 0.0} : cad::Point{u, across, 0.0}, direction});
    std::vector<Seen> out(y.size());
    const std::vector<cad::CadHit> hits = shape_.last_hits(wheel_ ? 0.0 : kAnywhere, lines);
    for (std::size_t i = 0; i < out.size(); ++i)
      if (hits[i].face >= 0) out[i] = {wheel_ ? hits[i].t : -hits[i].t, hits[i].face, hits[i].u, hits[i].v};
    return out;
  }

  /// Whether a lies outside of b.
  bool outside(double a, double b) const { return wheel_ ? a > b : a < b; }
  double below_top(double h, double top) const { return wheel_ ? top - h : h - top; }

  /// The part of the section at u that can be touched: from its outermost point sideways. Errors: a hole.
  struct Section {
    std::vector<double> y, h;
    double top = 0.0;
  };
  Section section(double u) const {
    const double from = low_[1] + 1e-9, to = high_[1] - 1e-9;
    const int n = std::max(8, to_whole<int>(std::ceil((to - from) / kScan)));
    std::vector<double> across(static_cast<std::size_t>(n) + 1);
    for (int i = 0; i <= n; ++i) across[static_cast<std::size_t>(i)] = from + (to - from) * i / n;
    const std::vector<Seen> seen = at(u, across);
    int top = -1;
    for (int i = 0; i <= n; ++i)
      if (seen[static_cast<std::size_t>(i)].is_there() &&
          (top < 0 || outside(seen[static_cast<std::size_t>(i)].h, seen[static_cast<std::size_t>(top)].h)))
        top = i;
    if (top < 0)
      throw Error(ErrorKind::input_data, fmt::format("there is no surface at {}", place(u)), {file_},
                  "x forward, y to the right, z down; the axle of a wheel is the y axis: is the part placed so?");
    const double highest = seen[static_cast<std::size_t>(top)].h;
    const auto end_towards = [&](int step) {
      int i = top;
      while (i + step >= 0 && i + step <= n && follows(seen, i, step, highest)) i += step;
      require_no_hole(seen, i, step, highest, u, from + (to - from) * i / n, n, (to - from) / n);
      return i;
    };
    const int first = end_towards(-1), last = end_towards(1);
    const double y_first = edge(u, from + (to - from) * first / n, -(to - from) / n, highest),
                 y_last = edge(u, from + (to - from) * last / n, (to - from) / n, highest);
    Section out;
    out.top = highest;
    std::vector<double> y{y_first}, arc{0.0};
    double before = at(u, y_first).h;
    for (int i = first; i <= last; ++i) {
      const double here = from + (to - from) * i / n;
      if (!(here > y.back() && here < y_last)) continue;
      arc.push_back(arc.back() + std::hypot(here - y.back(), seen[static_cast<std::size_t>(i)].h - before));
      y.push_back(here);
      before = seen[static_cast<std::size_t>(i)].h;
    }
    arc.push_back(arc.back() + std::hypot(y_last - y.back(), at(u, y_last).h - before));
    y.push_back(y_last);
    const int steps = std::max(4, to_whole<int>(std::ceil(arc.back() / kNodes)));
    std::size_t k = 0;
    for (int i = 0; i <= steps; ++i) {
      const double s = arc.back() * i / steps;
      while (k + 2 < arc.size() && arc[k + 1] < s) ++k;
      const double t = arc[k + 1] > arc[k] ? (s - arc[k]) / (arc[k + 1] - arc[k]) : 0.0;
      out.y.push_back(i == steps ? y_last : y[k] + t * (y[k + 1] - y[k]));
    }
    out.h = heights(u, out.y);
    return out;
  }

  /// NaN at the outermost places, where the sides may move a little. Throws SidesMove for an end among the others.
  std::vector<double> heights(double u, const std::vector<double>& y) const {
    constexpr std::size_t kOutermost = 4;
    std::vector<double> h(y.size());
    const std::vector<Seen> all = at(u, y);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const Seen& seen = all[i];
      if (!seen.is_there() && (i < kOutermost || i + kOutermost >= y.size())) {
        h[i] = kNaN;
        continue;
      }
      if (!seen.is_there() || (i > 0 && std::fabs(seen.h - h[i - 1]) > kJump + 20.0 * (y[i] - y[i - 1])))
        throw SidesMove{
            Error(ErrorKind::input_data,
                  fmt::format("at {} the surface has a hole or ends at y = {:.6g} mm, where it goes on elsewhere{}",
                              place(u), 1e3 * y[i], beside(i > 0 ? all[i - 1].face : seen.face)),
                  {file_}, "close the hole, or give triangles (.stl)")};
      h[i] = seen.h;
    }
    return h;
  }

  /// What is seen where the section lies.
  struct Faces {
    std::vector<double> changing;  ///< stations of some points of faces that are not by their kind the same all along
    std::set<std::int64_t> seen;
    cad::CadPart part;  ///< of the parameters, if one face alone is seen
  };
  Faces faces(const Section& section) const {
    Faces out;
    for (int face = 0; face < shape_.faces(); ++face) {
      check_cancelled();
      const bool same = shape_.unchanging(face, wheel_);
      for (const cad::Point& p : shape_.points_on(face)) {
        if (p[1] < section.y.front() || p[1] > section.y.back()) continue;
        const auto [u, h] = natural(p);
        if (below_top(h, section.top) > kDeep + kJump) continue;
        const Seen outermost = at(u, p[1]);
        if (!(std::fabs(outermost.h - h) <= kSame)) continue;
        out.seen.insert(face);
        if (same) break;
        out.changing.push_back(u);
      }
    }
    return out;
  }

  /// Lines all over it, for faces that were passed by, and the part of parameters that they meet.
  void look_everywhere(const Section& section, Faces& faces) const {
    constexpr int kStations = 25;
    constexpr std::size_t kEach = 4;  // nodes
    bool any = false;
    for (int i = 0; i < kStations; ++i) {
      check_cancelled();
      const double u = from_ + (to_ - from_) * i / (kStations - 1);
      for (std::size_t k = 0; k < section.y.size();
           k += k + 1 == section.y.size() ? 1 : std::min(kEach, section.y.size() - 1 - k)) {
        const Seen seen = at(u, section.y[k]);
        if (!seen.is_there()) continue;
        faces.seen.insert(seen.face);
        cad::CadPart& part = faces.part;
        if (!any) part = {seen.u, seen.u, seen.v, seen.v};
        any = true;
        part = {std::min(part.u0, seen.u), std::max(part.u1, seen.u), std::min(part.v0, seen.v),
                std::max(part.v1, seen.v)};
      }
    }
  }

  /// Errors: a hole, or a gap: of an edge that is seen, one side has no surface, but goes on. Throws SidesMove for an
  /// end between the ends.
  void require_whole(const Section& section) const {
    constexpr double kBeside = 20e-6, kEnds = 50e-6;  // [m]
    const double scale = wheel_ ? std::fabs(section.top) : 1.0;
    std::optional<SidesMove> moved;
    for (int face = 0; face < shape_.faces(); ++face) {
      check_cancelled();
      for (const cad::CadEdgePoint& edge : shape_.edges_of(face)) {
        const cad::Point& p = edge.p;
        const auto [u, h] = natural(p);
        if (p[1] < section.y.front() + kEnds || p[1] > section.y.back() - kEnds) continue;
        if (!closed_ && (scale * (u - from_) < kEnds || scale * (to_ - u) < kEnds)) continue;
        if (below_top(h, section.top) > kDeep) continue;
        const auto goes_on = [&, u_ = u, h_ = h](const std::pair<double, double>& towards, double far) {
          const Seen beside = at(u_ + towards.first * far / scale, p[1] + towards.second * far);
          return beside.is_there() && std::fabs(beside.h - h_) < kJump;
        };
        int there = 0, gone = 0;
        bool again = edge.round_a_hole != 0;
        for (const std::pair<double, double>& towards : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
          const bool beside = goes_on(towards, kBeside);
          ++(beside ? there : gone);
          for (double far = 2.0 * kBeside; !beside && !again && far < kFarApart; far *= 1.5)
            again = goes_on(towards, far);
        }
        if (there == 0 || gone == 0) continue;  // behind something, or within the surface
        const Error error(ErrorKind::input_data,
                          fmt::format("the surface has a hole or ends at {}, y = {:.6g} mm{}", place(u), 1e3 * p[1],
                                      this->beside(face)),
                          {file_}, "close it in the CAD program: wheels cannot roll over it");
        if (again) throw error;
        if (!moved) moved = SidesMove{error};
      }
    }
    if (moved) throw *moved;
  }

  /// All of it along the track, or the part round the axle about angle 0; call before the others.
  void find_ends() {
    const double middle = wheel_ ? 0.0 : 0.5 * (low_[0] + high_[0]);
    const double farthest = wheel_ ? kPi : 0.5 * (high_[0] - low_[0]);
    double y = 0.5 * (low_[1] + high_[1]), best = kNaN;
    constexpr int kAcross = 200, kSteps = 360;
    for (int i = 0; i <= kAcross; ++i) {
      const double here = low_[1] + (high_[1] - low_[1]) * (i + 0.5) / (kAcross + 1);
      if (const Seen seen = at(middle, here); seen.is_there() && (std::isnan(best) || outside(seen.h, best)))
        best = seen.h, y = here;
    }
    const auto there = [&](double u) {
      const Seen seen = at(u, y);
      return seen.is_there() && std::fabs(seen.h - best) < kDeep;
    };
    const auto end_towards = [&](double step) {
      int k = 0;
      while (k < kSteps && there(middle + (k + 1) * step)) ++k;
      if (k == kSteps && wheel_) return std::copysign(kPi, step);
      double last = middle + k * step, gone = last + step;
      constexpr int kHalvings = 40;
      for (int i = 0; i < kHalvings; ++i) (there(0.5 * (last + gone)) ? last : gone) = 0.5 * (last + gone);
      return last;
    };
    if (!there(middle)) return;
    to_ = end_towards(farthest / kSteps);
    from_ = end_towards(-farthest / kSteps);
    if (!wheel_ || to_ - from_ < 2.0 * kPi * (1.0 - 1e-9)) {
      const double rim = kRim / (wheel_ ? std::fabs(best) : 1.0);
      to_ -= rim, from_ += rim;
    }
    closed_ = wheel_ && to_ - from_ >= 2.0 * kPi * (1.0 - 1e-9);
  }
  double from() const { return from_; }
  double to() const { return to_; }
  bool closed() const { return closed_; }
  std::string place(double u) const {
    return wheel_ ? fmt::format("{:.6g} degrees", u * 180.0 / kPi) : fmt::format("x = {:.6g} mm", 1e3 * u);
  }

  std::pair<double, double> natural(const cad::Point& p) const {
    return wheel_ ? std::pair{std::atan2(p[0], p[2]), std::hypot(p[0], p[2])} : std::pair{p[0], p[2]};
  }
  Vec3 outwards(const Vec3& p) const {
    return wheel_ ? Vec3(p.x(), 0.0, p.z()).stableNormalized() : Vec3(0.0, 0.0, -1.0);
  }

 private:
  bool follows(const std::vector<Seen>& seen, int i, int step, double top) const {
    const int following = i + step;
    const Seen &here = seen[static_cast<std::size_t>(i)], &next = seen[static_cast<std::size_t>(following)];
    return next.is_there() && std::fabs(next.h - here.h) <= kJump && below_top(next.h, top) <= kDeep;
  }

  /// The surface ended at i; if it goes on near by, as high as here, that is a hole.
  void require_no_hole(const std::vector<Seen>& seen, int i, int step, double top, double u, double y, int n,
                       double spacing) const {
    const Seen& last = seen[static_cast<std::size_t>(i)];
    if (i + step < 0 || i + step > n || below_top(last.h, top) > 0.5 * kDeep) return;
    int k = i + 2 * step;
    for (; k >= 0 && k <= n && std::abs(k - i) * spacing <= kFarApart; k += step) {
      const Seen& other = seen[static_cast<std::size_t>(k)];
      if (!other.is_there() || std::fabs(other.h - last.h) > kJump || below_top(other.h, top) > kDeep) continue;
      throw Error(ErrorKind::input_data,
                  fmt::format("the surface has a hole at {}, from y = {:.6g} to {:.6g} mm{}", place(u), 1e3 * y,
                              1e3 * (y + (k - i) * spacing), beside(last.face)),
                  {file_}, "close the hole in the CAD program: wheels cannot roll over it");
    }
  }

  std::string beside(std::int64_t face) const {
    const std::string entity = face >= 0 ? shape_.entity(face) : std::string();
    return entity.empty() ? entity : fmt::format(", beside the entity {}", entity);
  }

  /// Where the section ends between y and y + step.
  double edge(double u, double y, double step, double top) const {
    double there = y, gone = y + step;
    double h = at(u, y).h;
    constexpr int kHalvings = 24;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (there + gone);
      const Seen seen = at(u, middle);
      if (seen.is_there() && std::fabs(seen.h - h) <= kJump && below_top(seen.h, top) <= kDeep)
        there = middle, h = seen.h;
      else
        gone = middle;
    }
    return there - std::copysign(kRim, step);
  }

  const cad::CadShape& shape_;
  bool wheel_;
  std::string file_;
  cad::Point low_{}, high_{};
  double from_ = 0.0, to_ = 0.0;
  bool closed_ = false;
};

Profile profile_of(Body body, std::vector<double> y, std::vector<double> h, double radius, const std::string& name) {
  Profile p;
  p.body = body;
  p.name = name;
  if (body == Body::wheel) {
    for (double& r : h) r -= radius;
    ranges::reverse(y);
    ranges::reverse(h);
  }
  p.y = std::move(y);
  p.z = std::move(h);
  return p;
}

/// Slices, closer where halfway between two of them the shape is not halfway between theirs.
SliceSet slices_of(const RunningSurface& surface, Body body, double radius, const std::vector<double>& y,
                   const std::vector<double>& changing, const std::string& name) {
  const bool wheel = body == Body::wheel;
  const double scale = wheel ? radius : 1.0, from = surface.from(), to = surface.to();
  struct Slice {
    double u;
    std::vector<double> h;
  };
  std::vector<Slice> all;
  const auto slice = [&](double u) {
    check_cancelled();
    if (all.size() > kMostSlices)
      throw Error(ErrorKind::input_data,
                  fmt::format("the surface changes so much that it needs more than {} slices", kMostSlices), {name},
                  "give a part of it, or triangles (.stl)");
    return Slice{u, surface.heights(u, y)};
  };
  // whether a shape changes shows at some of the points
  constexpr std::size_t kEach = 8;
  std::vector<double> some;
  some.reserve(y.size() / kEach + 1);
  for (std::size_t i = 0; i < y.size(); i += kEach) some.push_back(y[i]);
  const int n = std::max(4, to_whole<int>(std::ceil(scale * (to - from) / kCoarse)));
  const auto refine = [&](const auto& self, const Slice& a, const Slice& b) -> void {
    if (scale * (b.u - a.u) > 2.0 * kFine) {
      const double halfway = 0.5 * (a.u + b.u);
      const std::vector<double> h = surface.heights(halfway, some);
      double off = 0.0;
      for (std::size_t k = 0; k < some.size(); ++k)
        off = std::fmax(off, std::fabs(h[k] - 0.5 * (a.h[kEach * k] + b.h[kEach * k])));
      if (off > kDeviation) {
        Slice middle = slice(halfway);
        self(self, a, middle);
        all.push_back(middle);
        self(self, middle, b);
      }
    }
  };
  Slice before = slice(from);
  const Slice first = before;
  all.push_back(before);
  // evenly, and where faces lie that a wide step might pass by
  std::vector<double> stations = changing;
  for (int i = 1; i <= n; ++i) stations.push_back(from + (to - from) * i / n);
  ranges::sort(stations);
  for (const double u : stations) {
    const bool last = u >= to;
    if (scale * (u - before.u) < kFine || (!last && scale * (to - u) < kFine)) continue;
    Slice next = surface.closed() && last ? Slice{to, first.h} : slice(u);
    refine(refine, before, next);
    all.push_back(next);
    before = std::move(next);
  }
  // splines ring where long steps follow short ones
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      const double step = all[i + 1].u - all[i].u;
      const double before_it = i > 0 ? all[i].u - all[i - 1].u : step,
                   after_it = i + 2 < all.size() ? all[i + 2].u - all[i + 1].u : step;
      if (scale * step < 2.0 * kFine || step <= 2.0 * (1.0 + 1e-6) * std::min(before_it, after_it)) continue;
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(i) + 1, slice(0.5 * (all[i].u + all[i + 1].u)));
      again = true;
    }
  }
  // what all of them have
  std::size_t begin = 0, end = y.size();
  for (const Slice& s : all) {
    while (begin < end && std::isnan(s.h[begin])) ++begin;
    while (begin < end && std::isnan(s.h[end - 1])) --end;
  }
  const auto kept = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(begin),
                               values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  SliceSet out;
  out.body = body;
  out.name = name;
  out.u.reserve(all.size());
  out.profiles.reserve(all.size());
  for (const Slice& s : all) {
    out.u.push_back(s.u);
    out.profiles.push_back(profile_of(body, kept(y), kept(s.h), radius, name));
  }
  return out;
}

/// A face of which at least this part is whole.
std::optional<SplineSurface> spline_of(const cad::CadShape& shape, std::int64_t face, const cad::CadPart& part,
                                       const std::string& file) {
  std::string why;
  cad::CadSpline given = shape.spline_of(face, part, why);
  if (!why.empty()) return std::nullopt;
  SplineSurface out;
  out.name = shape.entity(face);
  out.where = {file};
  const auto knots = [](std::int64_t degree, std::vector<double>& list) {
    return SplineKnots{static_cast<int>(std::clamp<std::int64_t>(degree, 0, kHighestDegree + 1)), std::move(list)};
  };
  out.levels.push_back({knots(given.degree_u, given.knots_u), knots(given.degree_v, given.knots_v)});
  out.weights = std::move(given.weights);
  out.points.reserve(given.poles.size());
  for (const cad::Point& p : given.poles) out.points.emplace_back(p[0], p[1], p[2]);
  check(out);
  return out;
}

/// All faces that something can touch, down to where nothing is touched.
TriangleMesh triangles_of(const cad::CadShape& shape, const RunningSurface& surface,
                          const RunningSurface::Section& section, const std::string& file, std::string& note) {
  std::vector<std::int64_t> faces;
  const auto in_reach = [&](const cad::Point& p) {
    return surface.below_top(surface.natural(p).second, section.top) <= kDeep;
  };
  for (int face = 0; face < shape.faces(); ++face) {
    check_cancelled();
    bool reached = ranges::any_of(shape.points_on(face), in_reach);
    if (!reached)
      for (const cad::CadEdgePoint& edge : shape.edges_of(face)) reached = reached || in_reach(edge.p);
    if (reached) faces.push_back(face);
  }
  constexpr double kCoarsest = 8.0;
  cad::CadTriangles given;
  double side = kSide;
  for (double coarser = 1.0; coarser <= kCoarsest; coarser *= 2.0) {
    side = kSide * coarser;
    given = shape.triangles_of(faces, kFlat * coarser * coarser, side);
    if (given.message.empty()) break;
  }
  if (!given.message.empty())
    throw Error(ErrorKind::input_data, "the CAD file " + given.message, {file}, "export triangles (.stl)");
  TriangleMesh out;
  out.name = std::filesystem::path(file).filename().string();
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> becomes(given.vertices.size(), kNone);
  double outwards = 0.0;
  out.triangles.reserve(given.triangles.size());
  for (const auto& t : given.triangles) {
    std::array<Vec3, 3> corner;
    bool reached = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const cad::Point& p = given.vertices[static_cast<std::size_t>(t[k])];
      corner[k] = {p[0], p[1], p[2]};
      reached = reached || in_reach(p);
    }
    if (!reached) continue;
    outwards += (corner[1] - corner[0]).cross(corner[2] - corner[0]).dot(surface.outwards(corner[0]));
    auto& kept = out.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& now = becomes[static_cast<std::size_t>(t[k])];
      if (now == kNone) {
        now = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(corner[k]);
      }
      kept[k] = now;
    }
  }
  if (outwards < 0.0)
    for (auto& t : out.triangles) std::swap(t[1], t[2]);
  note += fmt::format("its sides move: {} triangles of {} faces, sides up to {:g} mm, middles within {:.2g} um. ",
                      out.triangles.size(), faces.size(), 1e3 * side, 1e6 * given.deviation);
  return out;
}

}  // namespace

CadSurface cad::running_surface(const CadShape& shape, Body body, double nominal_radius,
                                const std::filesystem::path& file) {
  const cad::Point low = shape.low(), high = shape.high();
  if (high[0] - low[0] > kLongest || high[1] - low[1] > kWidest || high[2] - low[2] > kWidest)
    throw Error(ErrorKind::input_data,
                fmt::format("the part is {:.4g} m long, {:.4g} m wide and {:.4g} m high", high[0] - low[0],
                            high[1] - low[1], high[2] - low[2]),
                {file.string()}, fmt::format("is its unit right? It says {}", shape.unit()));
  RunningSurface surface(shape, body, file.string());
  surface.find_ends();
  const double start = 0.5 * (surface.from() + surface.to());
  if (!(surface.from() < surface.to()))
    throw Error(ErrorKind::input_data, "there is no surface of any length", {file.string()},
                "x forward, y to the right, z down; the axle of a wheel is the y axis: is the part placed so?");
  const RunningSurface::Section section = surface.section(start);
  constexpr double kLeast = 0.8, kMost = 1.25;  // of the nominal radius
  if (body == Body::wheel && !(section.top > kLeast * nominal_radius && section.top < kMost * nominal_radius))
    throw Error(ErrorKind::input_data,
                fmt::format("its greatest radius about the y axis is {:.6g} mm, the nominal radius {:.6g} mm",
                            1e3 * section.top, 1e3 * nominal_radius),
                {file.string()}, "the axle of a wheel is the y axis: is the part placed so, and its unit right?");
  CadSurface out;
  out.note = fmt::format("{} faces in {}. ", shape.faces(), shape.unit());
  const std::string name = file.filename().string();
  try {
    RunningSurface::Faces faces = surface.faces(section);
    const auto is_spline = [&](const cad::CadPart& part) {
      auto spline = faces.seen.size() == 1 ? spline_of(shape, *faces.seen.begin(), part, file.string()) : std::nullopt;
      if (!spline) return false;
      const auto& [u, v] = spline->levels.front();
      out.note += fmt::format("the B-spline of {}, degrees {} x {}, {} x {} poles. ", spline->name, u.degree, v.degree,
                              u.functions(), v.functions());
      out.shape = *std::move(spline);
      return true;
    };
    if (!faces.changing.empty()) {
      surface.look_everywhere(section, faces);
      if (is_spline({})) return out;
    }
    surface.require_whole(section);
    if (faces.changing.empty()) {
      out.shape = profile_of(body, section.y, section.h, nominal_radius, name);
      out.note += fmt::format("one section of {} points. ", section.y.size());
      return out;
    }
    if (is_spline(faces.part)) return out;
    SliceSet slices = slices_of(surface, body, nominal_radius, section.y, faces.changing, name);
    out.note +=
        fmt::format("{} faces seen; {} slices of {} points. ", faces.seen.size(), slices.u.size(), section.y.size());
    out.shape = std::move(slices);
  } catch (const SidesMove&) {
    out.shape = triangles_of(shape, surface, section, file.string(), out.note);
  }
  return out;
}

CadSurface read_cad(const std::filesystem::path& file, Body body, double nominal_radius,
                    const SourcePosition& asked_by) {
  constexpr std::uintmax_t kMostBytes = 512'000'000;
  require_file(file, "CAD file", ErrorKind::input_data, asked_by);
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed)
    throw Error(ErrorKind::input_data, fmt::format("cannot open the CAD file {}", file.string()), asked_by,
                "is its name right?");
  if (size > kMostBytes)
    throw Error(ErrorKind::input_data, fmt::format("the CAD file has {} bytes, more than {}", size, kMostBytes),
                {file.string()}, "export the running surface alone");
  if (is_step_file(file)) cad::require_step_numbers(file);
  const cad::CadShape shape(cad::start_opencascade(file.string()), file, !is_step_file(file));
  return cad::running_surface(shape, body, nominal_radius, file);
}

void write_cad(const std::filesystem::path& file, const CadContent& content) {
  if (!is_step_file(file))
    throw Error(ErrorKind::configuration, "CAD files are written as STEP", {file.string()}, "use .step or .stp");
  const SplineSurface& given = content.spline;
  check(given);
  const bool wheel = content.body == Body::wheel;
  cad::CadSheet sheet;
  sheet.name = wheel ? "wheel" : "rail";
  sheet.description = content.description;
  cad::CadSpline& spline = sheet.spline;
  const auto& [u, v] = given.levels.front();
  spline.degree_u = u.degree, spline.degree_v = v.degree;
  spline.knots_u = u.knots, spline.knots_v = v.knots, spline.weights = given.weights;
  spline.poles.reserve(given.points.size());
  for (const Vec3& p : given.points) spline.poles.push_back({p.x(), p.y(), p.z()});
  if (content.swept) {
    sheet.kind = wheel ? cad::CadSheet::Kind::revolved : cad::CadSheet::Kind::extruded;
    std::tie(sheet.from, sheet.to) = *content.swept;
    for (std::size_t j = 0; j < v.functions(); ++j) {
      spline.poles[j] = spline.poles[j * u.functions()];
      spline.poles[j][0] = 0.0;
    }
    spline.poles.resize(v.functions());
  }
  // OpenCASCADE writes as it goes: what stands under the name of the file is whole
  OutputFolder own(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path place = own.path() / "surface.step";
  cad::write_sheet(place, sheet);
  write_file(file, profiles::read_text(place, "CAD file", {}));
}

}  // namespace treadmark::io
