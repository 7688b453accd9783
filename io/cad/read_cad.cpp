// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/read_cad.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/cad/cad_process.hpp"
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
    bool is_there() const { return face >= 0; }
  };

  Seen at(double u, double y) const {
    const cad::Point direction = wheel_ ? cad::Point{std::sin(u), 0.0, std::cos(u)} : cad::Point{0.0, 0.0, 1.0};
    const cad::Point origin = wheel_ ? cad::Point{0.0, y, 0.0} : cad::Point{u, y, 0.0};
    const std::vector<cad::CadHit> hits = shape_.hits(origin, direction);
    if (hits.empty()) return {};
    const cad::CadHit& outer = wheel_ ? hits.back() : hits.front();
    if (wheel_ && !(outer.t > 0.0)) return {};
    return {outer.t, outer.face};
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
    const int n = std::max(8, static_cast<int>(std::ceil((to - from) / kScan)));
    std::vector<Seen> seen;
    seen.reserve(static_cast<std::size_t>(n) + 1);
    for (int i = 0; i <= n; ++i) seen.push_back(at(u, from + (to - from) * i / n));
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
    const int steps = std::max(4, static_cast<int>(std::ceil(arc.back() / kNodes)));
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

  /// NaN at the outermost places, where the sides may move a little. Errors: a hole or an end among the others.
  std::vector<double> heights(double u, const std::vector<double>& y) const {
    constexpr std::size_t kOutermost = 4;
    std::vector<double> h(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      const Seen seen = at(u, y[i]);
      if (!seen.is_there() && (i < kOutermost || i + kOutermost >= y.size())) {
        h[i] = kNaN;
        continue;
      }
      if (!seen.is_there() || (i > 0 && std::fabs(seen.h - h[i - 1]) > kJump + 20.0 * (y[i] - y[i - 1])))
        throw Error(ErrorKind::input_data,
                    fmt::format("at {} the surface has a hole or ends at y = {:.6g} mm, where it goes on elsewhere{}",
                                place(u), 1e3 * y[i], beside(i > 0 ? at(u, y[i - 1]).face : seen.face)),
                    {file_}, "close the hole, or give triangles (.stl) if the sides move");
      h[i] = seen.h;
    }
    return h;
  }

  /// Stations of some points of the faces that are seen where the section lies and are not by their kind the same all
  /// along. None: it is the section everywhere.
  std::vector<double> changing_stations(const Section& section) const {
    std::vector<double> stations;
    for (int face = 0; face < shape_.faces(); ++face) {
      check_cancelled();
      if (shape_.unchanging(face, wheel_)) continue;
      for (const cad::Point& p : shape_.points_on(face)) {
        if (p[1] < section.y.front() || p[1] > section.y.back()) continue;
        const auto [u, h] = natural(p);
        if (below_top(h, section.top) > kDeep + kJump) continue;
        const Seen outermost = at(u, p[1]);
        if (std::fabs(outermost.h - h) <= kSame) stations.push_back(u);
      }
    }
    return stations;
  }

  /// Errors: a hole, or an end between the ends: of an edge that is seen, one side has no surface.
  void require_whole(const Section& section) const {
    constexpr double kBeside = 20e-6, kEnds = 50e-6;  // [m]
    const double scale = wheel_ ? std::fabs(section.top) : 1.0;
    for (int face = 0; face < shape_.faces(); ++face) {
      check_cancelled();
      for (const cad::Point& p : shape_.edges_of(face)) {
        const auto [u, h] = natural(p);
        if (p[1] < section.y.front() + kEnds || p[1] > section.y.back() - kEnds) continue;
        if (!closed_ && (scale * (u - from_) < kEnds || scale * (to_ - u) < kEnds)) continue;
        if (below_top(h, section.top) > kDeep) continue;
        int there = 0, gone = 0;
        for (const auto& [du, dy] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
          const Seen beside = at(u + du * kBeside / scale, p[1] + dy * kBeside);
          ++(beside.is_there() && std::fabs(beside.h - h) < kJump ? there : gone);
        }
        if (there == 0 || gone == 0) continue;  // behind something, or within the surface
        throw Error(ErrorKind::input_data,
                    fmt::format("the surface has a hole or ends at {}, y = {:.6g} mm{}", place(u), 1e3 * p[1],
                                this->beside(face)),
                    {file_}, "close it in the CAD program: wheels cannot roll over it");
      }
    }
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

 private:
  std::pair<double, double> natural(const cad::Point& p) const {
    return wheel_ ? std::pair{std::atan2(p[0], p[2]), std::hypot(p[0], p[2])} : std::pair{p[0], p[2]};
  }

  bool follows(const std::vector<Seen>& seen, int i, int step, double top) const {
    const Seen &here = seen[static_cast<std::size_t>(i)], &next = seen[static_cast<std::size_t>(i + step)];
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
    std::ranges::reverse(y);
    std::ranges::reverse(h);
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
    return Slice{u, surface.heights(u, y)};
  };
  const int n = std::max(4, static_cast<int>(std::ceil(scale * (to - from) / kCoarse)));
  const auto refine = [&](const auto& self, const Slice& a, const Slice& b) -> void {
    if (scale * (b.u - a.u) > 2.0 * kFine) {
      Slice middle = slice(0.5 * (a.u + b.u));
      double off = 0.0;
      for (std::size_t i = 0; i < y.size(); ++i) off = std::fmax(off, std::fabs(middle.h[i] - 0.5 * (a.h[i] + b.h[i])));
      if (off > kDeviation) {
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
  std::ranges::sort(stations);
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

}  // namespace

CadSections read_cad(const std::filesystem::path& file, Body body, double nominal_radius,
                     const SourcePosition& asked_by) {
  constexpr std::uintmax_t kMostBytes = 512'000'000;
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed)
    throw Error(ErrorKind::input_data, fmt::format("cannot open the CAD file {}", file.string()), asked_by,
                "is its name right?");
  if (size > kMostBytes)
    throw Error(ErrorKind::input_data, fmt::format("the CAD file has {} bytes, more than {}", size, kMostBytes),
                {file.string()}, "export the running surface alone");
  const cad::CadShape shape(file, !is_step_file(file));
  RunningSurface surface(shape, body, file.string());
  surface.find_ends();
  const double start = 0.5 * (surface.from() + surface.to());
  if (!(surface.from() < surface.to()))
    throw Error(ErrorKind::input_data, "there is no surface of any length", {file.string()},
                "x forward, y to the right, z down; the axle of a wheel is the y axis: is the part placed so?");
  const RunningSurface::Section section = surface.section(start);
  surface.require_whole(section);
  CadSections out;
  out.note = fmt::format("{} faces in {}. ", shape.faces(), shape.unit());
  const std::string name = file.filename().string();
  const std::vector<double> changing = surface.changing_stations(section);
  if (changing.empty()) {
    out.shape = profile_of(body, section.y, section.h, nominal_radius, name);
    out.note += fmt::format("one section of {} points. ", section.y.size());
    return out;
  }
  SliceSet slices = slices_of(surface, body, nominal_radius, section.y, changing, name);
  out.note += fmt::format("{} slices of {} points. ", slices.u.size(), section.y.size());
  out.shape = std::move(slices);
  return out;
}

void write_cad(const std::filesystem::path& file, const CadPoints& points) {
  if (!is_step_file(file))
    throw Error(ErrorKind::configuration, "CAD files are written as STEP", {file.string()}, "use .step or .stp");
  const bool wheel = points.body == Body::wheel;
  cad::CadSheet sheet;
  sheet.name = wheel ? "wheel" : "rail";
  sheet.from = points.from, sheet.to = points.to;
  if (points.grid.empty()) {
    sheet.kind = wheel ? cad::CadSheet::Kind::revolved : cad::CadSheet::Kind::extruded;
    sheet.points.reserve(points.y.size());
    for (std::size_t i = 0; i < points.y.size(); ++i) sheet.points.push_back({0.0, points.y[i], points.h[i]});
  } else {
    sheet.rows = points.stations;
    sheet.points.reserve(points.grid.size());
    for (const Vec3& p : points.grid) sheet.points.push_back({p.x(), p.y(), p.z()});
  }
  // OpenCASCADE writes as it goes: what stands under the name of the file is whole
  OutputFolder own(std::filesystem::temp_directory_path() / "treadmark", OutputFolder::Old::replaced);
  const std::filesystem::path place = own.path() / "surface.step";
  cad::write_sheet(place, sheet);
  write_file(file, profiles::read_text(place, "CAD file", {}));
}

}  // namespace treadmark::io
