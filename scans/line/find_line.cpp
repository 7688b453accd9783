// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/find_line.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_sort.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/line/line_fit.hpp"
#include "treadmark/scans/line/window_fit.hpp"
#include "treadmark/scans/placement/even_sample.hpp"
#include "treadmark/scans/placement/refine_axis.hpp"

namespace treadmark::scans {
namespace {

constexpr double kPiece = 0.4;         // reach of a piece from its middle [m]
constexpr double kBeside = 0.15;       // farthest that points of a rail lie from its line [m]
constexpr double kFinest = 1.0;        // shortest splines: shorter waves are the rail's [m]
constexpr double kWindow = 0.2;        // windows along a long line [m]
constexpr double kStep = 0.25;         // of following a rail [m]
constexpr double kFarthestGap = 20.0;  // that is crossed [m]
constexpr double kLongest = 20e3;      // of lines [m]
// numbers of a line must each take away this much of the loss: at once for all that stay in a straight line's, once in
// some ten thousand scans by chance
constexpr double kNumberPenalty = 10.0;

/// Points by cubes, to find those about a place.
class Places {
 public:
  explicit Places(std::span<const Vec3> points) : points_(points) {
    constexpr std::size_t kBlock = 65536;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % kBlock == 0) check_cancelled();
      cubes_[key(cube(points[i]))].push_back(i);
    }
  }
  std::size_t count() const { return points_.size(); }
  /// Those between -half and half along x of a frame and no farther than kBeside beside it, in its coordinates.
  std::vector<Vec3> in_frame(const Pose& frame, double half) const {
    std::vector<Vec3> out;
    const double reach = std::hypot(half, kBeside);
    const Vec3 low = frame.origin.array() - reach, high = frame.origin.array() + reach;
    const auto from = cube(low), to = cube(high);
    for (auto x = from[0]; x <= to[0]; ++x)
      for (auto y = from[1]; y <= to[1]; ++y)
        for (auto z = from[2]; z <= to[2]; ++z)
          if (const auto found = cubes_.find(key({x, y, z})); found != cubes_.end())
            for (const std::size_t i : found->second) {
              const Vec3 p = frame.apply_inverse(points_[i]);
              if (std::fabs(p.x()) < half && std::hypot(p.y(), p.z()) < kBeside) out.push_back(p);
            }
    return out;
  }

 private:
  using Cube = std::array<std::int64_t, 3>;
  static constexpr double kSize = 0.15;
  static Cube cube(const Vec3& p) {
    constexpr double kFarthest = 1e12;  // keys have room for it
    Cube out{};
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = to_whole<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(k)] / kSize), -kFarthest, kFarthest);
    return out;
  }
  static std::uint64_t key(const Cube& c) {
    std::uint64_t out = 0;
    for (const std::int64_t k : c) out = out * 0x1fffffULL + static_cast<std::uint64_t>(k + (std::int64_t{1} << 40));
    return out;
  }
  std::span<const Vec3> points_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cubes_;
};

/// How a frame moves on by a length that bends and turns evenly.
Pose advanced(const Pose& frame, const Vec3& turn, double length) {
  const Vec3 half = 0.5 * length * turn;
  const double half_angle = half.norm();
  const Mat3 middle = half_angle > 0.0 ? Mat3(Eigen::AngleAxisd(half_angle, half / half_angle)) : Mat3::Identity();
  return frame * Pose{middle * Vec3(length, 0.0, 0.0), middle * middle};
}

/// Follows a rail from a frame on it, one way: frames on it at even steps.
class Follower {
 public:
  Follower(const Places& places, const Section& section, const RailLine* given)
      : places_(places), section_(section), given_(given) {}

  std::vector<Pose> follow(Pose frame, double way) const {
    std::vector<Pose> out;
    Vec3 turn = Vec3::Zero();
    double empty = 0.0;
    const Vec3 start = frame.origin;
    double away = 0.0;
    // each step lies on points of its own, unless the rail runs in a circle
    const std::size_t most = 2 * places_.count() / kFewestOfStep;
    while (empty < kFarthestGap) {
      check_cancelled();
      const Pose before = frame;
      frame = next(frame, turn, way);
      // after a gap the rail may lie farther from where its bend would have it
      constexpr double kReach = 5e-3, kMore = 10e-3, kMost = 40e-3;
      const double reach = std::min(kMost, kReach + kMore * std::min(empty, 3.0));
      const WindowFit fit = fit_window(places_.in_frame(frame, 0.5 * kStep), section_, reach, true, kFewestOfStep);
      if (fit.used == 0) {
        empty += kStep;
        continue;
      }
      const Pose found = moved(frame, fit.motion);
      if (!(fit.motion.head<2>().norm() < 2.0 * kMost) || !(fit.motion.tail<3>().norm() < kMostTurn)) {
        empty += kStep;
        continue;
      }
      if (empty == 0.0) {
        // a few steps back, so that noise of one step's direction does not lead astray
        const Mat3 moved_by = before.rotation.transpose() * found.rotation;
        const Eigen::AngleAxisd angle(moved_by);
        constexpr double kMemory = 0.8;
        turn = kMemory * turn + (1.0 - kMemory) / (way * kStep) * angle.angle() * angle.axis();
      }
      frame = found;
      empty = 0.0;
      out.push_back(frame);
      constexpr double kGone = 4.0 * kStep;
      const double off = (frame.origin - start).norm();
      away = std::max(away, off);
      if ((away > kGone && off < kStep) || out.size() > most)
        throw Error(ErrorKind::input_data, "the rail comes back to a place where it was", {},
                    "cut the scan, so that its line is open");
    }
    return out;
  }

 private:
  static constexpr double kMostTurn = 0.2;  // [rad]
  static constexpr std::size_t kFewestOfStep = 50;

  Pose next(const Pose& frame, const Vec3& turn, double way) const {
    if (given_ == nullptr) return advanced(frame, turn, way * kStep);
    const auto at = given_->locate(frame.origin, given_->nearest(frame.origin));
    if (!at) return advanced(frame, turn, way * kStep);
    const double sense = given_->at(at->x()).rotation.col(0).dot(frame.rotation.col(0)) < 0.0 ? -1.0 : 1.0;
    const Pose here = given_->at(at->x()), there = given_->at(at->x() + sense * way * kStep);
    // as the given line moves on, seen from it, here on the rail beside it
    const Pose motion = there * here.inverse();
    return motion * frame;
  }

  const Places& places_;
  const Section& section_;
  const RailLine* given_;
};

/// The line of frames along a rail: their places and rolls, each counting alike.
RailLine line_of(const std::vector<Pose>& frames) {
  std::vector<LineTarget> targets;
  double along = 0.0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (k > 0) along += (frames[k].origin - frames[k - 1].origin).norm();
    LineTarget target{along, frames[k].origin, 0.0, frames[k].rotation, Mat3::Zero()};
    constexpr double kPlaceKnown = 1e-4, kRollKnown = 1e-3;
    target.information.diagonal() << 1.0 / (kPlaceKnown * kPlaceKnown), 1.0 / (kPlaceKnown * kPlaceKnown),
        1.0 / (kRollKnown * kRollKnown);
    targets.push_back(target);
  }
  LineShape shape{LineShape::Kind::splines, 1};
  while (along / static_cast<double>(2 * shape.intervals) >= kFinest) shape.intervals *= 2;
  if (targets.size() < shape.intervals + 3) shape = {LineShape::Kind::even_bend, 1};
  const Vec3 up = -frames.front().rotation.col(2);
  const RailLine unrolled = fit_line(targets, shape, 0.0, along, 1.0, up).line;
  double before = 0.0;
  for (LineTarget& target : targets) {
    const Pose frame = unrolled.at(target.along);
    const Vec3 z = target.axes.col(2);
    const double roll =
        std::atan2(-z.dot(frame.rotation.col(1)), z.dot(frame.rotation.col(2))) + unrolled.roll(target.along);
    target.roll = before = before + wrap_angle(roll - before);
  }
  return fit_line(targets, shape, 0.0, along, 1.0, up).line;
}

RailLine straight_line(const Pose& frame, double from, double to) {
  std::vector<Vec3> positions;
  for (int i = -1; i <= 2; ++i) positions.push_back(frame.apply({from + (to - from) * i, 0.0, 0.0}));
  return {from, to - from, positions, std::vector<double>(4, 0.0), -frame.rotation.col(2)};
}

/// A window of points along the line, as it lies on the section.
struct Window {
  double from = 0.0, to = 0.0;
  WindowFit fit;
};

/// A section seen from the other way along the rail.
Section mirrored(const Section& section) {
  constexpr double kApart = 0.25e-3;
  std::vector<Vec2> points;
  for (double s = section.length(); s >= 0.0; s -= kApart) {
    const Vec2 p = section.at(s).position;
    if (points.empty() || -p.x() > points.back().x()) points.emplace_back(-p.x(), p.y());
  }
  return Section(points);
}

class LineSearch {
 public:
  LineSearch(std::vector<Vec3> sample, double least_deviation)
      : sample_(std::move(sample)), least_deviation_(least_deviation) {}

  FoundLine run(RailLine line, Section section) {
    line_ = std::move(line);
    section_ = std::move(section);
    constexpr int kMostRounds = 10, kFree = 5;
    constexpr double kStill = 0.2e-6;
    double reach = 15e-3;
    for (int round = 0; round < kMostRounds; ++round) {
      check_cancelled();
      look_along(reach, round);
      const RailLine before = line_;
      lay_line(round < kFree);
      reach = std::max(3e-3, 0.5 * reach);
      if (round > 1 && apart(before) < kStill) break;
    }
    return result();
  }

 private:
  /// Straightens the points, lays the section and the windows on them.
  void look_along(double reach, int round) {
    std::vector<Vec3> straight = sample_;
    line_.straighten(straight);
    // the section from all windows; the first line is no better than a piece's section
    if (round > 0) {
      constexpr std::size_t kMost = 150'000;
      constexpr double kFarthest = 5e-3, kKnots = 2e-3;
      std::vector<Vec2> heap;
      const std::size_t stride = 1 + straight.size() / kMost;
      for (std::size_t i = 0; i < straight.size(); i += stride)
        if (std::hypot(straight[i].y(), straight[i].z()) < kBeside)
          heap.emplace_back(straight[i].y(), -straight[i].z());
      section_ = fit_section(section_, heap, kFarthest, kKnots, 2).section;
    }
    std::erase_if(straight, [](const Vec3& p) { return !(std::hypot(p.y(), p.z()) < kBeside); });
    parallel_sort(straight, [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    find_ends(straight, reach);
    const double length = to_ - from_;
    constexpr double kFewest = 24.0, kShortest = 5e-3;
    const double wanted = std::clamp(length / kFewest, kShortest, kWindow);
    const auto count = to_whole<std::size_t>(std::max(3.0, std::round(length / wanted)));
    windows_.assign(count, {});
    parallel_for(count, [&](std::size_t k) {
      Window& window = windows_[k];
      window.from = from_ + length * static_cast<double>(k) / static_cast<double>(count);
      window.to = from_ + length * static_cast<double>(k + 1) / static_cast<double>(count);
      const auto below = [](const Vec3& p, double x) { return p.x() < x; };
      const auto begin = std::lower_bound(straight.begin(), straight.end(), window.from, below),
                 end = std::lower_bound(begin, straight.end(), window.to, below);
      window.fit = fit_window({begin, end}, section_, reach, false);
    });
  }

  /// Where points begin and end to lie on the section.
  void find_ends(const std::vector<Vec3>& straight, double reach) {
    const std::size_t count = straight.size();
    constexpr std::size_t kFew = 200;
    const auto on = [&](const Vec3& p) { return section_.foot({p.y(), -p.z()}, reach).has_value(); };
    from_ = to_ = 0.0;
    // strays beyond the ends lie on the section by chance only: of each end's points the tenth
    constexpr std::size_t kTenth = 10;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < count && seen < kTenth; ++i)
      if (on(straight[i])) from_ = straight[i].x(), ++seen;
    seen = 0;
    for (std::size_t i = count; i-- > 0 && seen < kTenth;)
      if (on(straight[i])) to_ = straight[i].x(), ++seen;
    if (count < kFew || !(to_ > from_))
      throw Error(ErrorKind::input_data, "the points cannot be followed along the rail", {},
                  "is something else in the scan? cut the rail out");
  }

  std::vector<LineTarget> targets() const {
    std::vector<LineTarget> out;
    for (const Window& window : windows_) {
      if (window.fit.used == 0) continue;
      const double at = window.fit.along;
      const Pose frame = line_.at(at);
      LineTarget target;
      target.along = line_.arc(at);
      target.position = frame.apply({0.0, window.fit.motion[0], window.fit.motion[1]});
      target.roll = line_.roll(at) + window.fit.motion[2];
      target.axes = frame.rotation;
      target.information = window.fit.information.topLeftCorner<3, 3>();
      out.push_back(target);
    }
    return out;
  }

  /// What windows scatter by over what their points' noise says: each against the mean of its neighbours.
  double scatter_of_windows() const {
    std::vector<double> squares;
    const Window* one = nullptr;
    const Window* other = nullptr;
    for (const Window& window : windows_) {
      if (window.fit.used == 0) {
        one = other = nullptr;
        continue;
      }
      if (one != nullptr) {
        const Eigen::Vector3d off =
            other->fit.motion.head<3>() - 0.5 * (one->fit.motion.head<3>() + window.fit.motion.head<3>());
        constexpr double kVariance = 1.5;
        squares.push_back(off.dot(other->fit.information.topLeftCorner<3, 3>() * off) / kVariance);
      }
      one = other;
      other = &window;
    }
    constexpr double kMedian = 2.366;  // of chi squared with three degrees of freedom
    return squares.empty() ? 1.0 : std::max(1.0, std::sqrt(median_of(squares) / kMedian));
  }

  void lay_line(bool choose) {
    const std::vector<LineTarget> aims = targets();
    scatter_ = scatter_of_windows();
    const double from = line_.arc(from_), to = line_.arc(to_);
    const Vec3 up = line_.up(from_);
    if (choose) choose_shape(aims, from, to, up);
    find_gaps(from);
    line_ = fit_line(aims, shape_, from, to, scatter_, up).line;
    from_ = from;
    to_ = to;
    aims_ = aims;
  }

  void find_gaps(double from) {
    gaps_.clear();
    double last = from;
    for (const Window& window : windows_) {
      if (window.fit.used == 0) continue;
      if (const double begin = line_.arc(window.from); begin - last > kLeastGap) gaps_.push_back({last, begin});
      last = line_.arc(window.to);
    }
  }

  void choose_shape(const std::vector<LineTarget>& aims, double from, double to, const Vec3& up) {
    std::vector<LineShape> shapes{{LineShape::Kind::straight, 1}, {LineShape::Kind::even_bend, 1}};
    for (std::size_t n = 1; (to - from) / static_cast<double>(n) >= kFinest && 2 * (n + 3) < aims.size(); n *= 2)
      shapes.push_back({LineShape::Kind::splines, n});
    double least = kInfinity;
    for (const LineShape& shape : shapes) {
      check_cancelled();
      const double cost = fit_line(aims, shape, from, to, scatter_, up).loss + kNumberPenalty * shape.numbers();
      if (cost < least) least = cost, shape_ = shape;
    }
  }

  /// How far the line lies from another one, across.
  double apart(const RailLine& other) const {
    double most = 0.0;
    for (const LineTarget& aim : aims_) {
      const Pose frame = line_.at(aim.along);
      const auto off = other.locate(frame.origin, aim.along);
      most = std::max(most, off ? std::hypot(off->y(), off->z()) : kInfinity);
    }
    return most;
  }

  /// Where windows in a row lie off the line together, by more than they scatter.
  std::vector<LineKink> kinks() const {
    constexpr double kSpan = 0.5, kMatters = 20e-6, kLever = 30e-3;  // [m]
    constexpr double kSure = 60.0, kSureOfOne = 16.0;  // chi squared with three degrees of freedom, and with one
    const double window = (to_ - from_) / static_cast<double>(windows_.size());
    const std::size_t run = to_whole<std::size_t>(std::max(2.0, std::ceil(kSpan / window)));
    std::vector<Vec3> off;  // y, z, roll
    for (const LineTarget& aim : aims_) {
      const Vec3 p = line_.at(aim.along).apply_inverse(aim.position);
      off.emplace_back(p.y(), p.z(), aim.roll - line_.roll(aim.along));
    }
    std::vector<LineKink> out;
    for (std::size_t k = 0; k + run <= aims_.size(); ++k) {
      constexpr double kMost = 1.5;  // times as long as the run would be without a gap in it
      if (aims_[k + run - 1].along - aims_[k].along > kMost * window * static_cast<double>(run)) continue;
      Mat3 information = Mat3::Zero();
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = k; i < k + run; ++i)
        information += aims_[i].information, sum += aims_[i].information * off[i];
      const Mat3 inverse = information.inverse();
      const Vec3 mean = inverse * sum;
      // what is hardly known, as the place across of a head without its sides, is not far off
      const auto size_of = [&](Eigen::Index part) {
        const double variance = scatter_ * scatter_ * inverse(part, part);
        return mean[part] * mean[part] > kSureOfOne * variance ? std::fabs(mean[part]) : 0.0;
      };
      const double size = std::hypot(size_of(0), size_of(1)) + kLever * size_of(2);
      if (!(size > kMatters) || !(sum.dot(mean) > kSure * scatter_ * scatter_)) continue;
      const LineKink kink{aims_[k].along - 0.5 * window, aims_[k + run - 1].along + 0.5 * window, size};
      if (out.empty() || kink.from > out.back().to)
        out.push_back(kink);
      else
        out.back() = {out.back().from, kink.to, std::max(out.back().off, size)};
    }
    return out;
  }

  FoundLine result() {
    FoundLine out;
    out.scatter = scatter_;
    const LineFit straight = fit_line(aims_, {LineShape::Kind::straight, 1}, from_, to_, scatter_, line_.up(from_));
    std::vector<double> places;
    constexpr double kApart = 0.5;  // stations [m]
    constexpr double kMostStations = 1000.0;
    const auto count = to_whole<std::size_t>(std::clamp(std::ceil((to_ - from_) / kApart), 8.0, kMostStations));
    for (std::size_t k = 0; k <= count; ++k)
      places.push_back(from_ + (to_ - from_) * static_cast<double>(k) / static_cast<double>(count));
    const LineFit fit = fit_line(aims_, shape_, from_, to_, scatter_, line_.up(from_), places);
    out.line = fit.line;
    // a straight line has no bend that could be wrong: that of an even one
    const std::vector<LineTurn> errors =
        shape_.kind == LineShape::Kind::straight
            ? fit_line(aims_, {LineShape::Kind::even_bend, 1}, from_, to_, scatter_, line_.up(from_), places).errors
            : fit.errors;
    for (std::size_t k = 0; k < places.size(); ++k)
      out.stations.push_back({places[k], out.line.turn(places[k]), errors[k]});
    for (const double place : places) {
      // how far the section's points lie off by the place and the roll, some 30 mm beside the line
      constexpr double kLever = 30e-3;
      const Pose here = out.line.at(place);
      if (const auto off = straight.line.locate(here.origin, place)) {
        const double turned = straight.line.at(off->x()).rotation.col(1).dot(here.rotation.col(2));
        out.deviation = std::max(out.deviation, std::hypot(off->y(), off->z()) + kLever * std::fabs(turned));
      }
    }
    out.bent = shape_.kind != LineShape::Kind::straight && out.deviation > least_deviation_;
    out.chosen = shape_.kind == LineShape::Kind::splines ? out.line.step() : 0.0;
    out.gaps = gaps_;
    out.kinks = kinks();
    return out;
  }

  std::vector<Vec3> sample_;
  double least_deviation_;
  RailLine line_;
  Section section_;
  double from_ = 0.0, to_ = 0.0, scatter_ = 1.0;
  LineShape shape_;
  std::vector<Window> windows_;
  std::vector<LineTarget> aims_;
  std::vector<LineGap> gaps_;
};

}  // namespace

std::optional<RoughPlace> find_piece(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                     const SurfaceElements& whole, std::optional<LengthUnit> unit,
                                     const std::optional<Vec3>& near) {
  if (whole.position.empty()) return std::nullopt;
  std::vector<Vec3> seeds;
  const Vec3 middle = near.value_or(whole.centre);
  seeds.push_back(*ranges::min_element(whole.position, {}, [&](const Vec3& p) { return (p - middle).squaredNorm(); }));
  if (!near)
    for (const std::size_t quarter : {1u, 2u, 3u}) seeds.push_back(whole.position[quarter * whole.position.size() / 4]);
  std::vector<LengthUnit> units{LengthUnit::millimetre, LengthUnit::metre, LengthUnit::micrometre, LengthUnit::inch};
  if (unit) units = {*unit};
  for (const LengthUnit one : units) {
    const double reach = kPiece / metres_per(one);
    if (!near && whole.radius < 2.0 * reach) continue;
    for (const Vec3& seed : seeds) {
      check_cancelled();
      std::vector<Vec3> piece;
      for (std::size_t i = 0; i < points.size(); ++i)
        if ((keep.empty() || keep[i] != 0) && (points[i] - seed).squaredNorm() < reach * reach)
          piece.push_back(points[i]);
      constexpr std::size_t kFewest = 500;
      if (piece.size() < kFewest) continue;
      try {
        RoughPlace found = find_roughly(piece, {}, Body::rail);
        check_unit(Body::rail, found.size, one);
        return found;
      } catch (const Error&) {
        continue;  // no rail there, or not in this unit
      }
    }
  }
  return std::nullopt;
}

namespace {

/// Takes steps out that go aside or back where those around go on: what lies behind is shifted back.
std::vector<LineJump> take_out_jumps(std::vector<Vec3>& points) {
  constexpr std::size_t kFewest = 8, kAround = 3;
  std::vector<LineJump> out;
  if (points.size() < kFewest) return out;
  const std::size_t count = points.size() - 1;
  std::vector<Vec3> step(count);
  std::vector<double> length(count), turn(count, 0.0), aside(count);
  for (std::size_t k = 0; k < count; ++k) {
    step[k] = points[k + 1] - points[k];
    length[k] = step[k].norm();
    if (k > 0) turn[k] = (step[k] / length[k] - step[k - 1] / length[k - 1]).norm();
  }
  // of as many steps before as behind, so that an even bend changes nothing
  const auto usual = [&](std::size_t k, const auto& value) {
    const std::size_t half = std::min({kAround, k, count - 1 - k});
    std::vector<double> values;
    for (std::size_t j = k - half; j <= k + half; ++j) values.push_back(value(j));
    return median_of(values);
  };
  std::vector<Vec3> ahead(count);
  for (std::size_t k = 0; k < count; ++k) {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      ahead[k][axis] = usual(k, [&](std::size_t j) { return step[j][axis] / length[j]; });
    ahead[k].normalize();
    aside[k] = (step[k] - ahead[k] * ahead[k].dot(step[k])).norm();
  }
  constexpr double kLeast = 0.05, kSure = 6.0, kTurns = 2.0;  // [m]; standard deviations; usual turns
  std::vector<double> sorted = aside;
  const double least = std::max(kLeast, kSure * kMad * median_of(sorted));
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < count; ++k) {
    const double bends = kTurns * length[k] * usual(k, [&](std::size_t j) { return turn[j]; });
    if (aside[k] > std::max(least, bends) || ahead[k].dot(step[k]) <= 0.0) found.push_back(k);
  }
  constexpr std::size_t kRare = 4;  // where every fourth step jumps there is no line that goes on
  if (kRare * found.size() > count) return out;
  Vec3 shift = Vec3::Zero();
  double along = 0.0;
  auto next = found.begin();
  for (std::size_t k = 0; k < count; ++k) {
    if (next != found.end() && *next == k) {
      ++next;
      double on = ahead[k].dot(step[k]);
      if (on <= 0.0) on = usual(k, [&](std::size_t j) { return length[j]; });
      const Vec3 jump = step[k] - on * ahead[k];
      out.push_back({along, jump.norm()});
      shift -= jump;
      step[k] = on * ahead[k];
    }
    points[k + 1] += shift;
    along += step[k].norm();
  }
  return out;
}

/// Standard deviation of points about a smooth line, by how their distances from their neighbours' chords differ from
/// those of an even bend.
double scatter_of(const std::vector<Vec3>& points, const std::vector<double>& along) {
  constexpr double kExact = 1e-3;     // as anybody surveys [m]
  constexpr double kMedian = 1.1774;  // of the length of two normal numbers
  std::vector<double> sizes;
  Vec3 before = Vec3::Zero();
  double h_before = 0.0;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const double a = along[k] - along[k - 1], b = along[k + 1] - along[k], h = a * b;
    const Vec3 off = points[k] - (b * points[k - 1] + a * points[k + 1]) / (a + b);
    if (h_before > 0.0) {
      const double ratio = h / h_before;
      sizes.push_back((off - ratio * before).norm() / std::sqrt(1.5 + 1.5 * ratio * ratio + 2.0 * ratio));
    }
    before = off, h_before = h;
  }
  constexpr std::size_t kFewest = 5;
  return sizes.size() < kFewest ? kExact : std::max(kExact, median_of(sizes) / kMedian);
}

}  // namespace

RailLine line_through(std::span<const Vec3> points, const Vec3& up, std::vector<LineJump>* jumps) {
  constexpr std::size_t kFewest = 2;
  if (points.size() < kFewest) throw Error(ErrorKind::input_data, "a line needs at least two points");
  constexpr std::size_t kBetween = 8;
  constexpr double kClose = kFinest / kBetween;  // closer points say no more of splines that are not shorter
  std::vector<Vec3> kept{points.front()};
  std::vector<std::size_t> number{1};
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double apart = (points[k] - kept.back()).norm();
    if (!(apart > 0.0) || (apart < kClose && k + 1 < points.size())) continue;
    // the last point is the end of the line, however near it is to the one before
    if (apart < kClose && kept.size() > 1) kept.pop_back(), number.pop_back();
    if (!((points[k] - kept.back()).norm() > 0.0)) continue;
    kept.push_back(points[k]);
    number.push_back(k + 1);
  }
  if (kept.size() < kFewest) throw Error(ErrorKind::input_data, "the points of the line lie at one place");
  std::vector<LineJump> taken_out = take_out_jumps(kept);
  if (jumps != nullptr) *jumps = std::move(taken_out);
  std::vector<double> along{0.0};
  for (std::size_t k = 1; k < kept.size(); ++k) {
    if (k > 1 && (kept[k] - kept[k - 1]).dot(kept[k - 1] - kept[k - 2]) <= 0.0)
      throw Error(ErrorKind::input_data,
                  fmt::format("the line turns back at its point {}, after {:.2f} m", number[k - 1], along.back()), {},
                  "give its points in the order in which they lie along it");
    along.push_back(along.back() + (kept[k] - kept[k - 1]).norm());
  }
  points = kept;
  if (!(along.back() < kLongest))
    throw Error(ErrorKind::input_data,
                fmt::format("the line is {:.4g} km long, {:g} km are the most", 1e-3 * along.back(), 1e-3 * kLongest),
                {}, "are its points in the scan's unit?");
  const std::size_t spans = points.size() - 1;
  const double length = along.back();
  LineShape shape{LineShape::Kind::splines, std::max<std::size_t>(1, spans)};
  while (shape.intervals > 1 && length / static_cast<double>(shape.intervals) < kFinest) shape.intervals /= 2;
  std::vector<LineTarget> targets;
  const double scatter = scatter_of(kept, along), known = 1.0 / (scatter * scatter);
  const Mat3 information = Vec3(known, known, 1e-2 * known).asDiagonal();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 before = points[k > 0 ? k - 1 : 0], behind = points[std::min(k + 1, points.size() - 1)];
    const auto target = [&](double at, const Vec3& place, const Vec3& direction) {
      LineTarget out{at, place, 0.0, Mat3::Identity(), information};
      out.axes.col(0) = direction.normalized();
      out.axes.col(1) = direction.unitOrthogonal();
      out.axes.col(2) = out.axes.col(0).cross(out.axes.col(1));
      targets.push_back(out);
    };
    target(along[k], points[k], behind - before);
    if (k + 1 == points.size()) break;
    // by cubics with the chords' directions at the points (Catmull and Rom 1974)
    const double span = along[k + 1] - along[k];
    const auto direction = [&](std::size_t i) -> Vec3 {
      const std::size_t low = i > 0 ? i - 1 : 0, high = std::min(i + 1, points.size() - 1);
      return (points[high] - points[low]) / (along[high] - along[low]);
    };
    const Vec3 leaving = span * direction(k), arriving = span * direction(k + 1);
    const auto between = to_whole<std::size_t>(std::ceil(span / kClose), 2.0, kBetween);
    for (std::size_t j = 1; j < between; ++j) {
      const double t = static_cast<double>(j) / static_cast<double>(between), tt = t * t, ttt = tt * t;
      target(along[k] + t * span,
             (2.0 * ttt - 3.0 * tt + 1.0) * points[k] + (ttt - 2.0 * tt + t) * leaving +
                 (3.0 * tt - 2.0 * ttt) * points[k + 1] + (ttt - tt) * arriving,
             behind - points[k]);
    }
  }
  // as many splines as the points call for, beyond what they scatter by
  RailLine best;
  double least = kInfinity;
  for (int worse = 0;; shape.intervals = (shape.intervals + 1) / 2) {
    check_cancelled();
    RailLine line = fit_line(targets, shape, 0.0, length, 1.0, up).line;
    double cost = kNumberPenalty * shape.numbers();
    for (std::size_t k = 0; k < points.size(); ++k) {
      constexpr double kFar = 6.0;
      const Vec3 off = line.at(along[k]).apply_inverse(points[k]);
      cost += std::min(kFar * kFar, known * (off.y() * off.y() + off.z() * off.z()));
    }
    worse = cost < least ? 0 : worse + 1;
    if (worse == 0) least = cost, best = std::move(line);
    if (shape.intervals == 1 || worse > 1) return best;
  }
}

FoundLine find_line(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const RoughPlace& piece,
                    const SurfaceElements& whole, const PlaceSettings& settings, const RailLine* given,
                    double least_deviation) {
  constexpr double kPerMetre = 3000.0, kFewest = 60e3, kMost = 4e6;
  const double length = 2.0 * whole.radius;
  std::vector<Vec3> sample = even_sample(points, keep, whole.centre, whole.size,
                                         to_whole<std::size_t>(std::clamp(kPerMetre * length, kFewest, kMost)));
  Pose start = first_frame(piece, settings);
  std::vector<Vec3> about;
  for (const Vec3& p : sample)
    if ((p - start.origin).norm() < 2.0 * kPiece && std::fabs(start.apply_inverse(p).x()) < kPiece) about.push_back(p);
  const RefinedAxis refined = refine_axis(about, Body::rail, start);
  start = refined.X_CS;
  const Section section = refined.fit.section;
  // bends of a short rail are small against its section
  constexpr double kShort = 1.2;
  RailLine line;
  if (length < kShort) {
    line = straight_line(start, -0.5 * length, 0.5 * length);
  } else {
    const Places places(sample);
    const Follower follower(places, section, given);
    std::vector<Pose> frames = follower.follow(start, -1.0);
    ranges::reverse(frames);
    frames.push_back(start);
    const std::vector<Pose> ahead = follower.follow(start, 1.0);
    frames.insert(frames.end(), ahead.begin(), ahead.end());
    constexpr std::size_t kFewestFrames = 3;
    if (frames.size() < kFewestFrames)
      return LineSearch(std::move(sample), least_deviation)
          .run(straight_line(start, -0.5 * std::min(length, kLongest), 0.5 * std::min(length, kLongest)), section);
    // x as place() has it, seen from end to end
    const Vec3 chord = frames.back().origin - frames.front().origin;
    const bool against = settings.forward ? chord.dot(*settings.forward) < 0.0 : chord[nearest_axis(chord)] < 0.0;
    if (against) {
      ranges::reverse(frames);
      for (Pose& frame : frames) frame.rotation = frame.rotation * Mat3(Vec3(-1.0, -1.0, 1.0).asDiagonal());
    }
    line = line_of(frames);
    if (against) return LineSearch(std::move(sample), least_deviation).run(std::move(line), mirrored(section));
  }
  return LineSearch(std::move(sample), least_deviation).run(std::move(line), section);
}

}  // namespace treadmark::scans
