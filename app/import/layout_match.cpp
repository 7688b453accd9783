// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/layout_match.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::app {

namespace {

/// The layout's line beside it by its own length.
class BesideLayout {
 public:
  BesideLayout(const LayoutLine& layout, double beside) : layout_(layout), beside_(beside) {
    constexpr double kStep = 0.25, kMost = 100e3;  // [m]
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
  Vec3 position(double along) const { return position_at(place(along)); }
  Vec3 direction(double along) const { return layout_.frames(place(along)).rotation.col(0); }

 private:
  Vec3 position_at(double place) const { return layout_.frames(place).apply({0.0, beside_, 0.0}); }

  const LayoutLine& layout_;
  double beside_;
  std::vector<double> places_, lengths_;
};

/// The rail laid on the layout from a place on, one way.
class Laid {
 public:
  Laid(const BesideLayout& layout, const scans::RailLine& rail) : layout_(layout), length_(rail.length()) {
    constexpr int kPoints = 200;
    rail_.resize(3, kPoints + 1);
    for (int k = 0; k <= kPoints; ++k) {
      along_.push_back(length_ * k / kPoints);
      rail_.col(k) = rail.position(rail.from() + along_.back());
    }
  }

  /// largest and rms at `at`.
  LayoutMatch match(double at, bool reversed) const {
    Eigen::Matrix3Xd on(3, rail_.cols());
    const auto of = [&](Eigen::Index k) {
      const double along = along_[static_cast<std::size_t>(k)];
      return at + (reversed ? length_ - along : along);
    };
    for (Eigen::Index k = 0; k < rail_.cols(); ++k) on.col(k) = layout_.position(of(k));
    const Eigen::Matrix4d motion = Eigen::umeyama(rail_, on, false);
    LayoutMatch out{at, reversed, 0.0, 0.0};
    for (Eigen::Index k = 0; k < rail_.cols(); ++k) {
      const Vec3 ahead = layout_.direction(of(k));
      Vec3 off = motion.topLeftCorner<3, 3>() * rail_.col(k) + motion.topRightCorner<3, 1>() - on.col(k);
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
  Eigen::Matrix3Xd rail_;
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
