// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/register_scans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/elements.hpp"

namespace treadmark::scans {
namespace {

using Motion6 = Eigen::Vector<double, 6>;

/// Pieces of surface, to find the one nearest to a place.
class Pieces {
 public:
  explicit Pieces(const SurfaceElements& first) : position_(first.position), normal_(first.normal), size_(first.size) {}

  void add(const SurfaceElements& more, const Pose& motion) {
    for (std::size_t k = 0; k < more.position.size(); ++k) {
      position_.push_back(motion.apply(more.position[k]));
      normal_.push_back(motion.rotation * more.normal[k]);
    }
    size_ = std::max(size_, more.size);
  }
  void sort(double reach) {
    reach_ = reach;
    cubes_.clear();
    for (std::size_t k = 0; k < position_.size(); ++k) cubes_[key(cube(position_[k]))].push_back(k);
  }
  double size() const { return size_; }
  const Vec3& position(std::size_t k) const { return position_[k]; }
  const Vec3& normal(std::size_t k) const { return normal_[k]; }

  static constexpr std::size_t kNone = ~std::size_t{0};
  /// Of those within reach that lie the same way and beside which the place does not lie.
  std::size_t nearest(const Vec3& place, const Vec3& normal) const {
    constexpr double kSameWay = 0.8, kBeside = 1.5;  // cosine; sizes of pieces
    std::size_t best = kNone;
    double least = reach_ * reach_;
    const Cube middle = cube(place);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto found = cubes_.find(key({middle[0] + x, middle[1] + y, middle[2] + z}));
          if (found == cubes_.end()) continue;
          for (const std::size_t k : found->second)
            if (const double square = (position_[k] - place).squaredNorm();
                square < least && std::fabs(normal_[k].dot(normal)) > kSameWay)
              least = square, best = k;
        }
    if (best == kNone) return kNone;
    const Vec3 off = place - position_[best];
    return (off - normal_[best] * normal_[best].dot(off)).norm() < kBeside * size_ ? best : kNone;
  }

 private:
  using Cube = std::array<std::int64_t, 3>;
  Cube cube(const Vec3& p) const {
    constexpr double kFarthest = 1e12;  // keys have room for it
    Cube out{};
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = to_whole<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(k)] / reach_), -kFarthest, kFarthest);
    return out;
  }
  static std::uint64_t key(const Cube& c) {
    std::uint64_t out = 0;
    for (const std::int64_t k : c) out = out * 0x1fffffULL + static_cast<std::uint64_t>(k + (std::int64_t{1} << 40));
    return out;
  }

  std::vector<Vec3> position_, normal_;
  double size_ = 0.0, reach_ = 1.0;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cubes_;
};

/// One scan on the way to others.
class Registration {
 public:
  Registration(std::uint16_t pass, const std::vector<Vec3>& points) : elements_(look_for_elements(points)) {
    motion_.pass = pass;
    motion_.points = points.size();
    const std::size_t stride = 1 + elements_.position.size() / kMostPairs;
    for (std::size_t k = 0; k < elements_.position.size(); k += stride) sample_.push_back(k);
    for (const std::size_t k : sample_) middle_ += elements_.position[k] / static_cast<double>(sample_.size());
    for (const std::size_t k : sample_)
      lever_ += (elements_.position[k] - middle_).squaredNorm() / static_cast<double>(sample_.size());
    lever_ = std::max(std::sqrt(lever_), 1e-3);
  }

  const SurfaceElements& elements() const { return elements_; }
  const ScanMotion& motion() const { return motion_; }

  /// Part of it that has something within reach.
  double overlap(const Pieces& others) {
    find_pairs(others);
    return share();
  }

  void lay_on(Pieces& others, double farthest) {
    const double nearest = 2.0 * std::max(others.size(), elements_.size);
    constexpr int kMostRounds = 150;
    constexpr double kShrinks = 0.85, kStill = 1e-6, kRestless = 50e-6;  // steps [m]
    // a squat that is the only thing to tell the place along a rail stands out of all others before it lies on itself:
    // what is that far off counts at first, and less and less
    constexpr double kAtFirst = 0.02;
    double reach = std::max(farthest, nearest), step = kInfinity;
    least_scale_ = kAtFirst * nearest;
    for (int round = 0; round < kMostRounds && (reach > nearest || least_scale_ > motion_.apart || step > kStill);
         ++round) {
      check_cancelled();
      others.sort(reach);
      find_pairs(others);
      require_overlap();
      step = move(others, reach > nearest);
      if (reach <= nearest) least_scale_ *= kShrinks;
      reach = std::max(nearest, kShrinks * reach);
    }
    const Vec3 turned = motion_.motion.apply(middle_);
    motion_.shift = turned - middle_;
    const Eigen::AngleAxisd turn(motion_.motion.rotation);
    motion_.turn = turn.angle() * turn.axis();
    motion_.overlap = share();
    double moved = 0.0;
    for (const std::size_t k : sample_)
      moved = std::max(moved, (motion_.motion.apply(elements_.position[k]) - elements_.position[k]).norm());
    constexpr double kMostMoved = 1.5, kMostApart = 0.5e-3;  // of the farthest; [m]
    if (step > kRestless) refuse(fmt::format("it moves by {:.3f} mm still after many rounds", kMilli * step));
    if (moved > kMostMoved * farthest)
      refuse(
          fmt::format("it would move by {:.1f} mm, and scan.register_mm is {:g}", kMilli * moved, kMilli * farthest));
    if (motion_.apart > kMostApart)
      refuse(fmt::format("where they overlap they lie {:.2f} mm off each other at best (standard deviation)",
                         kMilli * motion_.apart));
    // what fits best, as crowns of two rails do, hides how far the rest is off: dirt, and what has moved, is less
    constexpr double kMostElsewhere = 0.15;
    if (elsewhere_ > kMostElsewhere)
      refuse(fmt::format("{:.0f} % of what overlaps lies more than {:.2f} mm off: is it the same rail?",
                         100.0 * elsewhere_, kMilli * kTukey * std::max(motion_.apart, kLeastApart)));
  }

 private:
  static constexpr std::size_t kMostPairs = 6000;
  static constexpr double kLeastApart = 0.1e-3;  ///< what is nearer is no other surface [m]

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(
        ErrorKind::input_data, fmt::format("scan {} cannot be laid on the others: {}", motion_.pass, why), {},
        "lay it on them roughly where it was exported, raise scan.register_mm if it lies farther off, or leave it "
        "out");
  }

  double share() const {
    const auto found = std::count_if(pairs_.begin(), pairs_.end(), [](std::size_t k) { return k != Pieces::kNone; });
    return static_cast<double>(found) / static_cast<double>(std::max<std::size_t>(1, pairs_.size()));
  }

  void require_overlap() const {
    constexpr double kLeast = 0.05, kFewest = 50.0;
    if (share() < kLeast || share() * static_cast<double>(sample_.size()) < kFewest)
      refuse(fmt::format("only {:.1f} % of its surface was seen by them, too", 100.0 * share()));
  }

  void find_pairs(const Pieces& others) {
    pairs_.assign(sample_.size(), Pieces::kNone);
    parallel_for(sample_.size(), [&](std::size_t k) {
      const std::size_t own = sample_[k];
      pairs_[k] = others.nearest(motion_.motion.apply(elements_.position[own]),
                                 motion_.motion.rotation * elements_.normal[own]);
    });
  }

  /// One step of Gauss and Newton's; its size [m]. far: pairs are no more than a guess yet.
  double move(const Pieces& others, bool far) {
    struct Pair {
      double off;
      Motion6 change;  ///< of it, by a shift and by a turn about the middle times the lever
    };
    std::vector<Pair> pairs;
    std::vector<double> sizes;
    const Vec3 middle = motion_.motion.apply(middle_);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (pairs_[k] == Pieces::kNone) continue;
      const Vec3 p = motion_.motion.apply(elements_.position[sample_[k]]), q = others.position(pairs_[k]);
      const Vec3 own = motion_.motion.rotation * elements_.normal[sample_[k]], other = others.normal(pairs_[k]);
      const Vec3 n = (own.dot(other) < 0.0 ? Vec3(other - own) : Vec3(other + own)).normalized();
      Pair pair{n.dot(p - q), {}};
      pair.change << n, (p - middle).cross(n) / lever_;
      pairs.push_back(pair);
      sizes.push_back(std::fabs(pair.off));
    }
    constexpr double kLeastScale = 1e-7;  // [m]
    motion_.apart = std::max(kLeastScale, kMad * median_of(sizes));
    const double scale = std::max(motion_.apart, least_scale_);
    const double most = kTukey * std::max(motion_.apart, kLeastApart);
    elsewhere_ = static_cast<double>(std::count_if(pairs.begin(), pairs.end(),
                                                   [&](const Pair& pair) { return std::fabs(pair.off) > most; })) /
                 static_cast<double>(std::max<std::size_t>(1, pairs.size()));
    Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
    Motion6 rhs = Motion6::Zero();
    double weight = 0.0;
    for (const Pair& pair : pairs) {
      const double x = pair.off / (kTukey * scale);
      if (!(std::fabs(x) < 1.0)) continue;
      const double w = (1.0 - x * x) * (1.0 - x * x);
      weight += w;
      matrix += w * pair.change * pair.change.transpose();
      rhs -= w * pair.off * pair.change;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(matrix);
    // a plain rail tells no shift along it: what normals seem to tell of that is their own noise, some 0.4 of that of a
    // piece's place over its size
    constexpr double kOfBest = 1e-4, kFewPieces = 0.04, kOfNormals = 0.8, kOfOutliers = 0.5;
    const double noise = std::max(motion_.apart, kOfOutliers * least_scale_);
    const double least = far ? kOfBest * eigen.eigenvalues()[5]
                             : std::max(kFewPieces, weight * std::pow(kOfNormals * noise / others.size(), 2));
    Motion6 step = Motion6::Zero(), variance = Motion6::Zero();
    motion_.open = 0;
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double known = eigen.eigenvalues()[k];
      if (!(known > least)) {
        ++motion_.open;
        continue;
      }
      const Motion6 direction = eigen.eigenvectors().col(k);
      step += direction * (direction.dot(rhs) / known);
      variance += direction.cwiseAbs2() * (motion_.apart * motion_.apart / known);
    }
    motion_.shift_error = std::sqrt(variance.head<3>().maxCoeff());
    motion_.turn_error = std::sqrt(variance.tail<3>().maxCoeff()) / lever_;
    const Vec3 turn = step.tail<3>() / lever_;
    const double angle = turn.norm();
    const Mat3 rotation = angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle)) : Mat3::Identity();
    const Vec3 shift = step.head<3>();
    motion_.motion = Pose{middle + shift - rotation * middle, rotation} * motion_.motion;
    return step.norm();
  }

  SurfaceElements elements_;
  std::vector<std::size_t> sample_, pairs_;
  Vec3 middle_ = Vec3::Zero();
  double lever_ = 0.0;
  double least_scale_ = 0.0;  ///< of pairs, by which they count [m]
  double elsewhere_ = 0.0;    ///< part of the pairs that do not fit
  ScanMotion motion_;
};

}  // namespace

std::vector<ScanMotion> register_scans(std::span<const Vec3> points, std::span<const std::uint16_t> passes,
                                       double farthest) {
  std::map<std::uint16_t, std::vector<Vec3>> of_pass;
  for (std::size_t i = 0; i < passes.size(); ++i) of_pass[passes[i]].push_back(points[i]);
  std::vector<ScanMotion> out;
  if (of_pass.size() < 2) return out;
  std::vector<Registration> waiting;
  for (const auto& [pass, own] : of_pass) {
    try {
      waiting.emplace_back(pass, own);
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("scan {} cannot be laid on the others: {}", pass, error.message()), {},
                  "leave its points out");
    }
  }
  const auto first = std::max_element(waiting.begin(), waiting.end(), [](const Registration& a, const Registration& b) {
    return a.motion().points < b.motion().points;
  });
  Pieces laid(first->elements());
  out.push_back(first->motion());
  out.back().overlap = 1.0;
  waiting.erase(first);
  while (!waiting.empty()) {
    check_cancelled();
    laid.sort(farthest);
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < waiting.size(); ++k)
      if (const double overlap = waiting[k].overlap(laid); overlap > most) most = overlap, best = k;
    Registration next = std::move(waiting[best]);
    waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(best));
    next.lay_on(laid, farthest);
    laid.add(next.elements(), next.motion().motion);
    out.push_back(next.motion());
  }
  std::sort(out.begin(), out.end(), [](const ScanMotion& a, const ScanMotion& b) { return a.pass < b.pass; });
  return out;
}

}  // namespace treadmark::scans
