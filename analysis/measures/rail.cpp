// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/rail.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measures {
namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;
constexpr double kTwoSigma = 1.96;

Measure railed(double value, double deviation) { return {value, kTwoSigma * deviation, {}}; }
Measure not_railed(std::string reason) { return {kUnknown, kUnknown, std::move(reason)}; }

/// Outermost y at a depth on one side (-1: gauge side, +1) of the head; nothing where the section is not there.
std::optional<Section::Place> side_at(const Section& s, double z, int side) {
  std::optional<Section::Place> best;
  for (const Section::Place& p : s.crossings(Vec2::UnitY(), z))
    if (p.p.x() * side > 0.0 && (!best || p.p.x() * side > best->p.x() * side)) best = p;
  return best;
}

/// The crown: where z is least.
Section::Place top_of(const Section& s) { return s.farthest(-Vec2::UnitY(), 0, s.size() - 1); }

/// Nominal sections are known by their head: sides down to where they bend under it.
struct Head {
  double low = 0.0;   ///< z of the lower end of its sides [m]
  double half = 0.0;  ///< largest half width above [m]
  double area = 0.0;  ///< above low [m^2]
};

Head head_of(const Section& nominal) {
  Head head;
  // down the field side until the outline turns under the head
  for (std::size_t i = top_of(nominal).node; i < nominal.size(); ++i) {
    const double angle = nominal.at(i).angle();
    constexpr double kUnder = 0.15;  // [rad]
    if (angle > kRightAngle + kUnder || angle < -kUnder) break;
    head.low = nominal.point(i).y();
    head.half = std::max(head.half, nominal.point(i).x());
  }
  constexpr double kStep = 0.05e-3;
  const auto rows = to_whole<std::size_t>(head.low / kStep);
  const auto left = nominal.y_over(0.5 * kStep, kStep, rows, -1), right = nominal.y_over(0.5 * kStep, kStep, rows, +1);
  for (std::size_t i = 0; i < rows; ++i)
    if (const double width = right[i] - left[i]; width == width) head.area += kStep * width;
  return head;
}

/// A nominal outline for looking up its nearest place, in square cells.
class Outline {
 public:
  explicit Outline(const Section& nominal)
      : y_min_(nominal.y_min() - kMargin),
        z_min_(nominal.z_min() - kMargin),
        columns_(to_whole<int>((nominal.y_max() - y_min_ + kMargin) / kCell) + 1),
        rows_(to_whole<int>((nominal.z_max() - z_min_ + kMargin) / kCell) + 1),
        cells_(static_cast<std::size_t>(columns_ * rows_)) {
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      const Vec2 next = nominal.point(i);
      if (!points_.empty()) {
        const Vec2 from = points_.back(), d = next - from;
        const int steps = std::max(1, to_whole<int>(std::ceil(d.norm() / kStride)));
        for (int k = 0; k <= steps; ++k) {
          std::vector<int>& cell = cells_[cell_of(from + d * (static_cast<double>(k) / steps))];
          if (cell.empty() || cell.back() != static_cast<int>(i) - 1) cell.push_back(static_cast<int>(i) - 1);
        }
      }
      points_.push_back(next);
    }
  }
  struct Near {
    Vec2 p, normal;
    double distance = 0.0;  // along the normal
  };
  std::optional<Near> nearest(const Vec2& q, double farthest) const {
    std::optional<Near> found;
    const int column = to_whole<int>(std::floor((q.x() - y_min_) / kCell)),
              row = to_whole<int>(std::floor((q.y() - z_min_) / kCell));
    double best = farthest;
    for (int ring = 0; (ring - 1) * kCell - kStride < best; ++ring)
      for (int r = row - ring; r <= row + ring; ++r)
        for (int c = column - ring; c <= column + ring; ++c) {
          if (std::max(std::abs(r - row), std::abs(c - column)) != ring) continue;
          if (r < 0 || c < 0 || r >= rows_ || c >= columns_) continue;
          for (const int i : cells_[static_cast<std::size_t>(r * columns_ + c)]) {
            const Vec2 a = points_[static_cast<std::size_t>(i)], d = points_[static_cast<std::size_t>(i) + 1] - a;
            const double t = std::clamp((q - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
            const Vec2 foot = a + t * d;
            if (const double distance = (q - foot).norm(); distance < best) {
              best = distance;
              const Vec2 normal = Vec2(d.y(), -d.x()).normalized();
              found = Near{foot, normal, (q - foot).dot(normal)};
            }
          }
        }
    return found;
  }

 private:
  static constexpr double kCell = 2e-3, kStride = 1e-3, kMargin = 1e-2;  ///< [m]
  std::size_t cell_of(const Vec2& p) const {
    const int c = std::clamp(to_whole<int>((p.x() - y_min_) / kCell), 0, columns_ - 1),
              r = std::clamp(to_whole<int>((p.y() - z_min_) / kCell), 0, rows_ - 1);
    return static_cast<std::size_t>(r * columns_ + c);
  }

  double y_min_, z_min_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
  std::vector<Vec2> points_;
};

/// What does not wear: below 20 mm everywhere (the gauge face only where it is the underside of the head or below), and
/// the field side below 14 mm.
bool unworn(const Vec2& p, const Vec2& normal) {
  constexpr double kField = 14e-3, kBelow = 20e-3;
  const bool under = normal.y() > 0.2;  // normals point out of the material, z is down
  if (p.x() > 0.0) return p.y() > kField;
  constexpr double kWeb = 40e-3;
  return p.y() > kBelow && (under || p.y() > kWeb);
}

class RailRuler {
 public:
  RailRuler(const Section& section, const Section* nominal, const RailGauge& gauge)
      : s_(section), nominal_(nominal), g_(gauge) {}

  RailMeasures measure() {
    check_shape();
    align();
    own();
    if (nominal_ == nullptr) {
      for (Measure* m : {&out_.w1, &out_.w2, &out_.w3, &out_.equivalent, &out_.loss, &out_.loss_top, &out_.loss_side,
                         &out_.loss_part, &out_.lip})
        *m = not_railed("no nominal profile was named");
    } else {
      against();
      judge_nominal();
    }
    return out_;
  }

 private:
  void check_shape() const {
    const auto refuse = [](const std::string& what) {
      throw Error(ErrorKind::input_data, "the section does not look like a rail: " + what, {},
                  "is it a wheel, or upside down? wheels are measured by 'measure wheel'");
    };
    const Section::Place top = top_of(s_);
    const double width = s_.y_max() - s_.y_min(), height = s_.z_max() - s_.z_min();
    constexpr double kWidestHead = 95e-3, kLeastFoot = 60e-3, kNarrow = 45e-3, kDepth = 14e-3, kFall = 5e-3;
    if (width > kWidestHead && height < kLeastFoot)
      refuse(fmt::format("it is {:.3g} mm wide and {:.3g} mm high, heads of rails are narrower", 1e3 * width,
                         1e3 * height));
    const double left = top.p.x() - s_.y_min(), right = s_.y_max() - top.p.x();
    if (left < kFall || right < kFall) refuse("it falls off to one side only");
    std::optional<double> low, high;
    for (const Section::Place& p : s_.crossings(Vec2::UnitY(), top.p.y() + kDepth))
      (p.p.x() < top.p.x() ? low : high) = p.p.x();
    if (low && high && *high - *low < kNarrow)
      refuse(fmt::format("{:.3g} mm below its top it is {:.3g} mm wide, heads of rails are wider", 1e3 * kDepth,
                         1e3 * (*high - *low)));
  }

  void align() {
    out_.alignment = g_.alignment;
    out_.inclination = not_railed("the inclination needs a section aligned with its nominal one by its unworn parts");
    if (nominal_ == nullptr) {
      out_.alignment = RailAlignment::none;
      // heights count from its own top
      top_ = top_of(s_);
      return;
    }
    if (g_.alignment == RailAlignment::top) by_top();
    if (g_.alignment == RailAlignment::unworn) by_unworn_parts();
    top_ = top_of(s_);
  }

  void by_top() {
    const double down = top_of(*nominal_).p.y() - top_of(s_).p.y();
    s_.move(0.0, {0.0, down});
    const auto own = side_at(s_, g_.side_depth, -1), wanted = side_at(*nominal_, g_.side_depth, -1);
    if (!own || !wanted)
      throw Error(ErrorKind::input_data,
                  fmt::format("the gauge side {:.3g} mm below the top is not in the section", 1e3 * g_.side_depth), {},
                  "align by the unworn parts, or not at all: --alignment");
    out_.shift_y = wanted->p.x() - own->p.x();
    out_.shift_z = down;
    s_.move(0.0, {out_.shift_y, 0.0});
  }

  /// Gauss-Newton steps with Tukey's weights on the distances along the nominal section's normals.
  void by_unworn_parts() {
    const Outline outline(*nominal_);
    double turn = 0.0;
    Vec2 shift = Vec2::Zero();
    const Section original = s_;
    // to begin with: tops at one height, widest places of the field side at one y
    {
      double widest = -1.0, wanted = -1.0;
      const double top = top_of(s_).p.y();
      for (std::size_t i = 0; i < s_.size(); ++i)
        if (s_.point(i).y() < top + 35e-3) widest = std::max(widest, s_.point(i).x());
      for (std::size_t i = 0; i < nominal_->size(); ++i)
        if (nominal_->point(i).y() < 35e-3) wanted = std::max(wanted, nominal_->point(i).x());
      shift = {wanted - widest, -top};
    }
    // whole rails: undersides of the feet at one height
    constexpr double kWhole = 0.1, kMostWorn = 25e-3;
    if (nominal_->z_max() > kWhole && s_.z_max() - s_.z_min() > nominal_->z_max() - kMostWorn)
      shift.y() = nominal_->z_max() - s_.z_max();
    // places at even distances, so that no part counts for its many points
    struct Spot {
      Vec2 p;
      int parts;  // of one interval between points, which scatter together
    };
    std::vector<Spot> places;
    constexpr double kApart = 0.4e-3;
    for (std::size_t i = 0; i + 1 < original.size(); ++i) {
      const Vec2 from = original.point(i), d = original.point(i + 1) - from;
      if (!places.empty() && (from - places.back().p).norm() < kApart && d.norm() < kApart) continue;
      const int parts = std::max(1, to_whole<int>(d.norm() / kApart));
      for (int k = 0; k < parts; ++k) places.push_back({from + d * (static_cast<double>(k) / parts), parts});
    }
    double rms = kUnknown;
    std::size_t fitted = 0;
    Eigen::Matrix3d normal, spread;  // spread: of the right side, for a scatter of one
    double near = 8e-3;
    for (int round = 0; round < 40; ++round) {
      normal.setZero();
      spread.setZero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      std::vector<double> sizes;
      struct Row {
        Eigen::Vector3d j;
        double r;
        int parts;
      };
      std::vector<Row> rows;
      const double c = std::cos(turn), s = std::sin(turn);
      for (const auto& [o, parts] : places) {
        const Vec2 q = Vec2(c * o.x() - s * o.y(), s * o.x() + c * o.y()) + shift;
        if (q.y() < 10e-3) continue;
        const auto foot = outline.nearest(q, near);
        if (!foot || !unworn(foot->p, foot->normal)) continue;
        const Vec2 arm = q - shift;
        rows.push_back({{foot->normal.x(), foot->normal.y(), foot->normal.dot(Vec2(-arm.y(), arm.x())) / kArm},
                        foot->distance,
                        parts});
        sizes.push_back(std::fabs(foot->distance));
      }
      constexpr std::size_t kFewest = 12;
      fitted = rows.size();
      if (fitted < kFewest) give_up();
      std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
      const double cut = std::max(4.685 * 1.4826 * sizes[sizes.size() / 2], 1e-5);
      double sum = 0.0, weights = 0.0;
      for (const Row& row : rows) {
        const double u = row.r / cut, w = std::fabs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
        normal += w * row.j * row.j.transpose();
        spread += w * w * row.parts * row.j * row.j.transpose();
        right -= w * row.r * row.j;
        sum += w * row.r * row.r, weights += w;
      }
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
      constexpr double kDetermined = 2e-3;  // of the least to the greatest eigenvalue
      if (!(eigen.eigenvalues()[0] > kDetermined * eigen.eigenvalues()[2])) give_up();
      const Eigen::Vector3d step = normal.ldlt().solve(right);
      shift += step.head<2>();
      turn += step[2] / kArm;
      rms = std::sqrt(sum / std::max(weights, 1e-300));
      near = std::max(2e-3, std::min(near, 20.0 * rms));
      if (step.norm() < 1e-10) break;
    }
    s_.move(turn, shift);
    out_.shift_y = shift.x(), out_.shift_z = shift.y(), out_.residual = rms;
    const Eigen::Matrix3d inverse = normal.inverse();
    // what differs by more than scatter differs alike over some millimetres
    constexpr double kAlike = 10e-3;
    const double scatter = std::pow(s_.scatter(fitted, kApart * static_cast<double>(fitted)), 2);
    const double one = scatter + kAlike / kApart * std::max(0.0, rms * rms - scatter);
    const Eigen::Matrix3d variance = inverse * spread * inverse * one;
    align_y_ = std::sqrt(variance(0, 0)), align_z_ = std::sqrt(variance(1, 1));
    // The section had to be turned back by turn: it was inclined by -turn, which lowers -y where it is positive.
    out_.inclination = railed(turn, std::sqrt(variance(2, 2)) / kArm);
  }

  [[noreturn]] static void give_up() {
    throw Error(
        ErrorKind::input_data,
        "too little of the rail that does not wear is in the section: field side, underside of the head, web, foot", {},
        "say --alignment none where the section already lies in its nominal section's axes, or --alignment top, "
        "which hides wear of the top");
  }

  /// What needs no nominal section.
  void own() {
    const double top = top_.p.y();
    const auto left = side_at(s_, top + g_.side_depth, -1), right = side_at(s_, top + g_.side_depth, +1);
    if (left && right)
      out_.head_width = railed(right->p.x() - left->p.x(), std::numbers::sqrt2 * left->error);
    else
      out_.head_width =
          not_railed(fmt::format("a side {:.3g} mm below the top is not in the section", 1e3 * g_.side_depth));

    // the middle of the head: a level crown has no top of its own
    const double centre = left && right ? 0.5 * (left->p.x() + right->p.x()) : top_.p.x();
    // Kasa's circle (1976) through the crown
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    int count = 0;
    double low = top_.p.x(), high = low;
    for (std::size_t i = 0; i < s_.size(); ++i) {
      const Vec2 d = s_.point(i) - Vec2(centre, top_.p.y());
      if (std::fabs(d.x()) > g_.crown_half || d.y() > g_.crown_half) continue;
      const Eigen::Vector3d row(d.x(), d.y(), 1.0);
      normal += row * row.transpose();
      sums += row * d.squaredNorm();
      low = std::min(low, s_.point(i).x()), high = std::max(high, s_.point(i).x());
      ++count;
    }
    if (count >= 5 && high - low > 1.5 * g_.crown_half) {
      const Eigen::Vector3d c = normal.ldlt().solve(sums);
      const double radius = std::sqrt(c[2] + 0.25 * (c[0] * c[0] + c[1] * c[1]));
      // curvature from a parabola: 180^(1/2) sigma / (n^(1/2) half^2), relative to 1/R
      const double scatter = s_.scatter(static_cast<std::size_t>(count), 2.0 * g_.crown_half);
      const double curvature = std::sqrt(180.0 / count) * scatter / (4.0 * g_.crown_half * g_.crown_half);
      out_.crown_radius = railed(radius, radius * radius * 2.0 * curvature);
    } else {
      out_.crown_radius = not_railed("too little of the crown is in the section");
    }

    // the gauge face: a line through its points between two depths
    Vec2 mean = Vec2::Zero();
    int points = 0;
    const auto in_face = [&](std::size_t i) {
      const Vec2& p = s_.point(i);
      return p.x() < centre - 15e-3 && p.y() - top >= g_.face_from && p.y() - top <= g_.face_to;
    };
    for (std::size_t i = 0; i < s_.size(); ++i)
      if (in_face(i)) mean += s_.point(i), ++points;
    if (points >= 3) {
      mean /= points;
      double zz = 0.0, yz = 0.0;
      for (std::size_t i = 0; i < s_.size(); ++i)
        if (in_face(i)) {
          const Vec2 d = s_.point(i) - mean;
          zz += d.y() * d.y(), yz += d.x() * d.y();
        }
      // -y is outwards: a face that leads inwards on its way up is inclined
      const double scatter = s_.scatter(static_cast<std::size_t>(points), g_.face_to - g_.face_from);
      out_.face_angle = railed(kRightAngle - std::atan2(-yz, zz), scatter / std::sqrt(std::max(zz, 1e-12)));
    } else {
      out_.face_angle = not_railed("the gauge face is not in the section");
    }
  }

  void against() {
    const Head head = head_of(*nominal_);
    const auto error = [this](const Section::Place& p, double across) { return std::hypot(p.error, across); };
    if (const auto crown = s_.first_at_y(0.0); crown && s_.z_at(0.0) < 0.5 * head.low)
      out_.w1 = railed(s_.z_at(0.0) - nominal_->z_at(0.0), error(*crown, align_z_));
    else
      out_.w1 = not_railed("the crown is not in the section");
    const auto worn = side_at(s_, g_.side_depth, -1), fresh = side_at(*nominal_, g_.side_depth, -1);
    if (worn && fresh)
      out_.w2 =
          railed(worn->p.x() - fresh->p.x(), error(*worn, align_y_) / std::max(0.1, std::fabs(worn->tangent.y())));
    else
      out_.w2 = not_railed(
          fmt::format("the gauge side {:.3g} mm below the nominal top is not in the section", 1e3 * g_.side_depth));
    oblique(error);
    if (out_.w1.known() && out_.w2.known())
      out_.equivalent = {
          out_.w1.value + 0.5 * out_.w2.value, std::hypot(out_.w1.uncertainty, 0.5 * out_.w2.uncertainty), {}};
    else
      out_.equivalent = not_railed(out_.w1.known() ? out_.w2.reason : out_.w1.reason);
    out_.lost_gauge = lost_on(-1, head);
    out_.lost_field = lost_on(+1, head);
    areas(head);
  }

  double lost_on(int way, const Head& head) const {
    constexpr double kStep = 0.5e-3;
    constexpr std::size_t kFewest = 10;
    const auto count = to_whole<std::size_t>((head.low - g_.side_depth) / kStep);
    const auto own = s_.y_over(g_.side_depth, kStep, count, way),
               wanted = nominal_->y_over(g_.side_depth, kStep, count, way);
    double sum = 0.0;
    std::size_t known = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (const double lost = way * (wanted[i] - own[i]); !std::isnan(lost)) sum += lost, ++known;
    return known < kFewest ? kUnknown : sum / static_cast<double>(known);
  }

  void doubt(std::string text) { out_.doubts.push_back({"nominal_profile", std::move(text)}); }

  /// Rails are rolled to some tenths of a millimetre (EN 13674-1: heads to 0.5 mm in width, 0.6 mm in height), and
  /// metal does not grow, but for lips that flow out of the gauge side.
  void judge_nominal() {
    constexpr double kRolled = 0.3e-3, kInPlace = 0.5e-3, kGrown = 0.6e-3, kLip = 2e-3;
    if (out_.residual > std::hypot(kRolled, s_.noise()))
      doubt(
          fmt::format("what does not wear lies {:.2f} mm (rms) off the nominal section, which rails are rolled to {:g} "
                      "mm of: is it another rail's?",
                      1e3 * out_.residual, 1e3 * kRolled));
    if (const double off = out_.alignment == RailAlignment::none ? off_unworn() : 0.0;
        off > std::hypot(kInPlace, s_.noise()))
      doubt(
          fmt::format("as the section lies, a third of what does not wear is {:.2f} mm or more off the nominal one: is "
                      "it another rail's, or not in its axes? say --alignment unworn",
                      1e3 * off));
    const struct {
      const char* name;
      const Measure& wear;
      double grown;
    } wears[] = {{"W1", out_.w1, kGrown}, {"W2", out_.w2, kLip}, {"W3", out_.w3, kGrown}};
    for (const auto& [name, wear, grown] : wears)
      if (const double most = grown + std::fmax(0.0, wear.uncertainty); wear.known() && wear.value < -most)
        doubt(
            fmt::format("{} is {:.2f} mm: metal would have grown there by more than rolling ({:g} mm) and its "
                        "uncertainty explain: is the nominal section another rail's, or aligned by what has worn?",
                        name, 1e3 * wear.value, 1e3 * grown));
  }

  /// Distance of a third of what does not wear from the nominal section, at most as far as is looked [m]; 0: too little
  /// of it is there.
  double off_unworn() const {
    constexpr double kFrom = 10e-3, kFarthest = 8e-3;
    constexpr std::size_t kFewest = 12;
    const Outline outline(*nominal_);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < s_.size(); ++i) {
      const Vec2& p = s_.point(i);
      if (p.y() < kFrom || p.y() > nominal_->z_max()) continue;  // below a nominal head there may be a web
      const auto foot = outline.nearest(p, kFarthest);
      if (!foot || unworn(foot->p, foot->normal)) sizes.push_back(foot ? std::fabs(foot->distance) : kFarthest);
    }
    if (sizes.size() < kFewest) return 0.0;
    const auto third = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 3);
    std::nth_element(sizes.begin(), third, sizes.end(), std::greater<>());
    return *third;
  }

  /// Where the nominal section is inclined by 45 degrees on the gauge side.
  std::optional<Section::Place> oblique_place(int side) const {
    const std::size_t crown = top_of(*nominal_).node;
    std::optional<Section::Place> best;
    double off = 0.02;
    for (std::size_t i = 0; i < nominal_->size(); ++i) {
      if (side < 0 ? i > crown : i < crown) continue;
      const Section::Place p = nominal_->at(i);
      if (p.p.y() > 30e-3) continue;
      const double d = std::fabs(p.angle() - side * g_.oblique);
      if (d < off) off = d, best = p;
    }
    return best;
  }

  template <class Error>
  void oblique(const Error& error) {
    out_.w3 = not_railed("the gauge corner is not in the section");
    const auto place = oblique_place(-1);
    if (!place) return;
    // the line through the nominal point along its normal, inwards: (sin, cos) of 45 degrees for the gauge side
    const Vec2 inwards(-place->tangent.y(), place->tangent.x());
    const Vec2 along = place->tangent;
    constexpr double kOutside = -3e-3, kInside = 20e-3;
    std::optional<double> nearest;
    for (const Section::Place& p : s_.crossings(along, along.dot(place->p))) {
      const double depth = inwards.dot(p.p - place->p);
      if (depth < kOutside || depth > kInside || (nearest && *nearest < depth)) continue;
      nearest = depth;
      out_.w3 =
          railed(depth, error(p, std::hypot(align_y_, align_z_)) / std::max(0.2, std::fabs(p.tangent.dot(along))));
    }
  }

  /// Metal missing and standing out: over y between the places of 45 degrees, over z beside them.
  void areas(const Head& head) {
    const auto left = oblique_place(-1), right = oblique_place(+1);
    const std::string part = "the head is not whole in the section, down to the lower end of the nominal sides";
    for (Measure* m : {&out_.loss, &out_.loss_top, &out_.loss_side, &out_.loss_part, &out_.lip}) *m = not_railed(part);
    if (!left || !right) return;
    constexpr double kStep = 0.05e-3;
    double top = 0.0, side = 0.0, lip = 0.0;
    {
      const double first = left->p.x(), across = right->p.x() - first;
      const auto count = to_whole<std::size_t>(std::ceil(across / kStep));
      const double step = across / static_cast<double>(count);
      const auto own = s_.z_over(first + 0.5 * step, step, count),
                 wanted = nominal_->z_over(first + 0.5 * step, step, count);
      for (std::size_t i = 0; i < count; ++i) {
        if (std::isnan(own[i])) return;
        (own[i] > wanted[i] ? top : lip) += step * std::fabs(std::min(own[i], head.low) - wanted[i]);
      }
    }
    constexpr double kCloseToEnd = 1e-3;
    for (const int way : {-1, +1}) {
      const Section::Place& corner = way < 0 ? *left : *right;
      const double first = std::min(corner.p.y(), head.low), down = head.low - first, limit = std::fabs(corner.p.x());
      const auto count = to_whole<std::size_t>(std::ceil(down / kStep));
      const double step = down / static_cast<double>(std::max<std::size_t>(1, count));
      const auto own = s_.y_over(first + 0.5 * step, step, count, way),
                 wanted = nominal_->y_over(first + 0.5 * step, step, count, way);
      for (std::size_t i = 0; i < count; ++i) {
        const double z = first + (static_cast<double>(i) + 0.5) * step;
        if (std::isnan(wanted[i])) continue;
        if (std::isnan(own[i]) && z > top_.p.y()) {
          if (head.low - z < kCloseToEnd) break;
          return;  // the side ends before the nominal one
        }
        const double y = std::isnan(own[i]) ? limit : std::max(limit, way * own[i]);
        const double lost = way * wanted[i] - y;
        (lost > 0.0 ? side : lip) += step * std::fabs(lost);
      }
    }
    const double error_top = (right->p.x() - left->p.x()) * align_z_, error_side = head.low * align_y_;
    out_.loss_top = railed(top, error_top);
    out_.loss_side = railed(side, error_side);
    out_.loss = railed(top + side, std::hypot(error_top, error_side));
    out_.loss_part = railed((top + side) / head.area, std::hypot(error_top, error_side) / head.area);
    out_.lip = railed(lip, std::hypot(error_top, error_side));
  }

  static constexpr double kArm = 0.05;  ///< [m] makes the turn comparable with shifts
  Section s_;
  const Section* nominal_;
  RailGauge g_;
  RailMeasures out_;
  Section::Place top_;
  double align_y_ = 0.0, align_z_ = 0.0;
};

}  // namespace

std::string_view name_of(RailAlignment alignment) {
  switch (alignment) {
    case RailAlignment::unworn:
      return "unworn";
    case RailAlignment::top:
      return "top";
    case RailAlignment::none:
      break;
  }
  return "none";
}

RailMeasures measure_rail(const Section& section, const Section* nominal, const RailGauge& gauge) {
  if (section.body() != Body::rail)
    throw Error(ErrorKind::input_data, "this section is that of a wheel, not of a rail");
  return RailRuler(section, nominal, gauge).measure();
}

}  // namespace treadmark::measures
