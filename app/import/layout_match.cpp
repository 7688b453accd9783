// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/layout_match.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::app {

namespace {

/// The layout's line beside it by its own length.
class BesideLayout {
 public:
  BesideLayout(const LayoutLine& layout, double beside) : layout_(layout), beside_(beside) {
    constexpr double kStep = 0.25, kMost = 100e3;  // [m], places
    const auto count = to_whole<std::size_t>(std::clamp(std::ceil(layout.length / kStep), 8.0, kMost));
    Vec3 before = position_at(0.0);
    places_ = {0.0};
    lengths_ = {0.0};
    for (std::size_t k = 1; k <= count; ++k) {
      places_.push_back(layout.length * static_cast<double>(k) / static_cast<double>(count));
      const Vec3 here = position_at(places_.back());
      lengths_.push_back(lengths_.back() + (here - before).norm());
      before = here;
    }
  }
  double length() const { return lengths_.back(); }
  /// The place of the layout at a length along the line beside it.
  double place(double along) const {
    const auto behind = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, along);
    const auto k = static_cast<std::size_t>(behind - lengths_.begin());
    const double share = (along - lengths_[k - 1]) / (lengths_[k] - lengths_[k - 1]);
    return places_[k - 1] + share * (places_[k] - places_[k - 1]);
  }
  /// x along the line, z into the track.
  Pose frame(double along) const {
    Pose out = layout_.frames(place(along));
    out.origin = out.apply({0.0, beside_, 0.0});
    return out;
  }

 private:
  Vec3 position_at(double place) const { return layout_.frames(place).apply({0.0, beside_, 0.0}); }

  const LayoutLine& layout_;
  double beside_;
  std::vector<double> places_, lengths_;
};

/// Axes of a piece of a line by its chord, z into the track. ups: out of it, summed.
Mat3 axes_of(const Eigen::Matrix3Xd& points, const Vec3& ups) {
  const Vec3 x = (points.rightCols<1>() - points.leftCols<1>()).normalized(), z = -(ups - x * x.dot(ups)).normalized();
  Mat3 out;
  out << x, z.cross(x), z;
  return out;
}

/// The rail laid on the layout from a place on, one way.
class Laid {
 public:
  Laid(const BesideLayout& layout, const scans::RailLine& rail) : layout_(layout), length_(rail.length()) {
    constexpr int kPoints = 200;
    rail_.resize(3, kPoints + 1);
    ups_.resize(3, kPoints + 1);
    for (int k = 0; k <= kPoints; ++k) {
      along_.push_back(length_ * k / kPoints);
      const Pose frame = rail.at(rail.from() + along_.back());
      rail_.col(k) = frame.origin;
      ups_.col(k) = -frame.rotation.col(2);
    }
  }

  /// largest and rms at `at`.
  LayoutMatch match(double at, bool reversed) const {
    check_cancelled();
    Eigen::Matrix3Xd on(3, rail_.cols()), directions(3, rail_.cols()), up(3, rail_.cols());
    for (Eigen::Index k = 0; k < rail_.cols(); ++k) {
      const double along = along_[static_cast<std::size_t>(k)];
      const Pose frame = layout_.frame(at + (reversed ? length_ - along : along));
      on.col(k) = frame.origin;
      directions.col(k) = frame.rotation.col(0);
      up.col(k) = -frame.rotation.col(2);
    }
    const Eigen::Matrix4d motion = Eigen::umeyama(rail_, on, false);
    Mat3 turn = motion.topLeftCorner<3, 3>();
    Vec3 shift = motion.topRightCorner<3, 1>();
    // a rail does not lie upside down, though a bend to the left would then be one to the right
    if ((turn * ups_).cwiseProduct(up).sum() < 0.0) {
      turn = axes_of(on, up.rowwise().sum()) * axes_of(rail_, ups_.rowwise().sum()).transpose();
      shift = on.rowwise().mean() - turn * rail_.rowwise().mean();
    }
    LayoutMatch out{at, reversed, 0.0, 0.0};
    for (Eigen::Index k = 0; k < rail_.cols(); ++k) {
      const Vec3 ahead = directions.col(k);
      Vec3 off = turn * rail_.col(k) + shift - on.col(k);
      off -= ahead * ahead.dot(off);
      out.largest = std::max(out.largest, off.norm());
      out.rms += off.squaredNorm() / static_cast<double>(rail_.cols());
    }
    out.rms = std::sqrt(out.rms);
    return out;
  }

 private:
  const BesideLayout& layout_;
  double length_;
  std::vector<double> along_;
  Eigen::Matrix3Xd rail_, ups_;
};

}  // namespace

LayoutMatch match_layout(const LayoutLine& layout, double beside, const scans::RailLine& rail) {
  const BesideLayout line(layout, beside);
  constexpr double kShorter = 0.05;  // may be what a layout ends before the rail [m]
  const double room = line.length() - rail.length();
  if (room < -kShorter)
    throw Error(ErrorKind::configuration, fmt::format("placement.line: the layout is {:.2f} m long, the rail {:.2f} m",
                                                      line.length(), rail.length()));
  const Laid laid(line, rail);
  constexpr double kStep = 2.0, kMostPlaces = 5000.0;  // [m]
  const auto places = to_whole<std::size_t>(std::clamp(std::ceil(std::max(0.0, room) / kStep), 1.0, kMostPlaces));
  const double step = std::max(0.0, room) / static_cast<double>(places);
  LayoutMatch best;
  best.rms = kInfinity;
  const auto look = [&](double at, bool reversed) {
    const LayoutMatch here = laid.match(at, reversed);
    if (here.rms < best.rms) best = here;
  };
  for (const bool reversed : {false, true})
    for (std::size_t k = 0; k <= places; ++k) look(step * static_cast<double>(k), reversed);
  constexpr double kFine = 1e-4;  // [m]
  for (double finer = 0.5 * step; finer > kFine; finer *= 0.5)
    for (const double way : {-1.0, 1.0}) {
      const double at = best.at + way * finer;
      if (at >= 0.0 && at <= std::max(0.0, room)) look(at, best.reversed);
    }
  return best;
}

}  // namespace treadmark::app
