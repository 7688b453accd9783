// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "treadmark/analysis/measured/section.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measures {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTwoSided = 1.96;  // standard deviations that hold 95 of 100

double hypotenuse(double a, double b) { return std::sqrt(a * a + b * b); }

Measure measured(double value, double deviation) { return {value, kTwoSided * deviation, {}}; }
Measure missing(std::string reason) { return {kUnknown, kUnknown, std::move(reason)}; }

/// Standard deviation in y, or in z, of a place where the curve crosses a line of constant z, or y.
double error_y(const Section::Place& p) { return p.error / std::max(0.05, std::fabs(p.tangent.y())); }
double error_z(const Section::Place& p) { return p.error / std::max(0.05, std::fabs(p.tangent.x())); }

class WheelRuler {
 public:
  WheelRuler(const Section& section, const WheelGauge& gauge) : s_(section), g_(gauge) {}

  WheelMeasures measure(double nominal_radius, const std::vector<NominalWheel>& nominals) {
    find_flange();
    find_back();
    const auto tape = s_.first_at_y(0.0);
    // nothing but the tread: the tape line of a section may be crossed by nothing else
    if (!tape)
      throw Error(
          ErrorKind::input_data,
          fmt::format("the section has no tape line: it ends {:.3g} mm from the flange back, the tape line lies "
                      "{:.3g} mm from it",
                      1e3 * (s_.y_max() + g_.tape_line), 1e3 * g_.tape_line),
          {}, "measure a wider section");
    tape_ = *tape;
    s_.move(0.0, {0.0, -tape_.p.y()});
    out_.shift_z = -tape_.p.y();
    tip_.p.y() += out_.shift_z;
    tape_.p.y() = 0.0;
    check_tread();
    flange();
    tread();
    rim();
    if (nominal_radius > 0.0)
      out_.diameter = measured(2.0 * (nominal_radius - out_.shift_z), 2.0 * error_z(tape_));
    else
      out_.diameter = missing("nothing says the radius of the wheel: --nominal-radius");
    against(nominals);
    return out_;
  }

 private:
  [[noreturn]] static void refuse(const std::string& what) {
    throw Error(ErrorKind::input_data, what, {},
                "is it a rail, upside down, or a part only? rails are measured by 'measure rail'");
  }

  /// The tip: the greatest z; a flange has steep sides both or one, and a tread beside it.
  void find_flange() {
    tip_ = s_.farthest(Vec2::UnitY(), 0, s_.size() - 1);
    constexpr double kLeastHeight = 15e-3, kLeastTread = 30e-3;
    const double field = s_.y_max() - tip_.p.x();
    if (s_.z_max() - s_.z_min() < kLeastHeight)
      refuse(fmt::format("the section does not look like a wheel: it is {:.3g} mm high, less than any flange",
                         1e3 * (s_.z_max() - s_.z_min())));
    if (field < kLeastTread)
      refuse(
          fmt::format("the section does not look like a wheel: {:.3g} mm beside its deepest point, less than any "
                      "tread",
                      1e3 * field));
  }

  void find_back() {
    // Where little straight back was measured a parabola y(z) through its upright points tells where it reaches
    // farthest; the fillet to the tip begins there on new wheels.
    constexpr double kUpright = 85.0 * kDegree, kCutOff = 2.5 * kDegree, kFarthest = 30e-3;
    std::vector<Vec2> upright;
    std::vector<double> behind_y, behind_z;
    std::size_t least = 0;
    for (std::size_t i = 0; i < tip_.node; ++i) {
      if (s_.point(i).x() < s_.point(least).x()) least = i;
      behind_y.push_back(s_.point(i).x()), behind_z.push_back(s_.point(i).y());
      if (std::fabs(std::fabs(s_.at(i).angle()) - 0.5 * std::numbers::pi) < 0.5 * std::numbers::pi - kUpright)
        upright.push_back(s_.point(i));
    }
    const std::optional<measured::FlangeBack> straight = measured::straight_back(behind_y, behind_z, tip_.p.y());
    double back = kUnknown;
    back_error_ = s_.at(least).error;
    constexpr std::size_t kEnough = 8;
    if (straight) {
      back = straight->y;
      back_error_ = std::max(back_error_, s_.noise() * straight->error);
    } else if (upright.size() >= kEnough) {
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      const auto [low, high] = std::minmax_element(upright.begin(), upright.end(),
                                                   [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
      const double middle = 0.5 * (low->y() + high->y()), half = std::max(0.5 * (high->y() - low->y()), 1e-6);
      const Vec2 origin = upright.front();
      for (const Vec2& p : upright) {
        const double t = (p.y() - middle) / half;
        const Eigen::Vector3d row(1.0, t, t * t);
        normal += row * row.transpose();
        right += row * (p.x() - origin.x());
      }
      const Eigen::Matrix3d inverse = normal.inverse();
      const Eigen::Vector3d c = inverse * right;
      const auto at = [&](double t) { return origin.x() + c[0] + t * (c[1] + t * c[2]); };
      double farthest = at(-1.0) < at(1.0) ? -1.0 : 1.0;
      if (const double t = c[2] > 0.0 ? -0.5 * c[1] / c[2] : 2.0; std::fabs(t) < 1.0) farthest = t;
      // a section that is cut off in the fillet between back and tip does not reach the back
      const Eigen::Vector3d slope(0.0, 1.0, 2.0 * farthest), value(1.0, farthest, farthest * farthest);
      const double noise = s_.scatter(upright.size(), 2.0 * half);
      const double scatter = kTwoSided * noise * std::sqrt(std::max(0.0, slope.dot(inverse * slope)));
      const double most = std::tan(kCutOff) * half + (std::isnan(scatter) ? 0.0 : scatter);
      if (std::fabs(slope.dot(c)) < most) back = at(farthest);
      back_error_ = std::max(back_error_, noise * std::sqrt(std::max(0.0, value.dot(inverse * value))));
    } else if (std::fabs(std::fabs(s_.at(least).angle()) - 0.5 * std::numbers::pi) < kCutOff) {
      back = s_.point(least).x();
    }
    constexpr double kSame = 1e-3;
    if (!straight && back == back && std::fabs(back - s_.point(least).x()) > kSame) back = kUnknown;
    if (back == back && tip_.p.x() - back > kFarthest) back = kUnknown;
    if (back != back && g_.back) back = *g_.back;
    out_.back_seen = back == back;
    if (!g_.from_flange_back || !out_.back_seen) {
      back_ = back;
      return;
    }
    out_.shift_y = -g_.tape_line - back;
    s_.move(0.0, {out_.shift_y, 0.0});
    tip_.p.x() += out_.shift_y;
    back_ = -g_.tape_line;
  }

  /// A tread runs level, where a rail would fall off to its other side.
  void check_tread() {
    constexpr double kAcross = 15e-3, kLevel = 10e-3;
    double beside = std::fabs(s_.z_at(kAcross));
    for (std::size_t i = tip_.node; i < s_.size(); ++i)
      if (s_.point(i).x() > 0.0) beside = std::max(beside, s_.point(i).y());
    if (tip_.p.x() > -20e-3 || tip_.p.y() < 15e-3 || !(beside < kLevel))
      refuse(
          fmt::format("the section does not look like a wheel: its deepest point lies at y = {:.3g} mm, {:.3g} mm "
                      "below the tape line, and beside that {}",
                      1e3 * tip_.p.x(), 1e3 * tip_.p.y(), beside == beside ? "it falls off" : "the section ends"));
  }

  /// The flange face at a height: between tip and tape line.
  static std::optional<Section::Place> face_of(const Section& s, const Section::Place& tip, double z) {
    for (const Section::Place& p : s.crossings(Vec2::UnitY(), z))
      if (p.node + 1 > tip.node && p.p.x() < 0.0 && p.p.x() > tip.p.x()) return p;
    return std::nullopt;
  }

  void flange() {
    const bool tip_seen = tip_.node > 0;  // else the section ends on the flange's face
    const std::string no_tip = "the flange tip is not in the section";
    out_.flange_height = tip_seen ? measured(tip_.p.y(), hypotenuse(tip_.error, error_z(tape_))) : missing(no_tip);
    const auto face_at = [&](double z) { return face_of(s_, tip_, z); };
    const auto face = face_at(g_.face_depth), upper = face_at(tip_.p.y() - g_.below_tip);
    const double z_error = error_z(tape_);
    const std::string no_face = "the flange face is not in the section";
    const auto slope_error = [&](const Section::Place& p) {  // of y, the height being uncertain too
      return hypotenuse(error_y(p), z_error * std::fabs(p.tangent.x()) / std::max(0.05, std::fabs(p.tangent.y())));
    };
    if (!face)
      out_.flange_thickness = out_.flange_gradient = missing(no_face);
    else if (!out_.back_seen)
      out_.flange_thickness = missing("the flange back is not in the section");
    else
      out_.flange_thickness = measured(face->p.x() - back_, hypotenuse(slope_error(*face), back_error_));
    if (face && upper && tip_seen) {
      const double tip_error =
          tip_.error * std::fabs(upper->tangent.x() / std::max(0.05, std::fabs(upper->tangent.y())));
      out_.flange_gradient =
          measured(face->p.x() - upper->p.x(), std::hypot(slope_error(*face), error_y(*upper), tip_error));
    } else if (face) {
      out_.flange_gradient = missing(no_tip);
    }
    // Inclination over chords of 1 mm, so that scatter does not count.
    double steepest = kUnknown, error = 0.0;
    constexpr double kChord = 1e-3;
    for (std::size_t i = tip_.node, j = i; i < s_.size() && s_.point(i).x() < 0.0; ++i) {
      if (s_.point(i).y() < 2e-3 || s_.point(i).y() > tip_.p.y() - g_.below_tip) continue;
      for (j = std::max(i, j); j < s_.size() && (s_.point(j) - s_.point(i)).norm() < kChord;) ++j;
      if (j >= s_.size()) break;
      const Vec2 d = s_.point(j) - s_.point(i);
      const double angle = std::atan2(-d.y(), d.x());
      if (!(angle <= steepest)) steepest = angle, error = std::numbers::sqrt2 * s_.at(i).error / d.norm();
    }
    out_.flange_angle = steepest == steepest ? measured(steepest, error) : missing(no_face);
  }

  void tread() {
    constexpr double kStep = 0.25e-3, kFirst = -25e-3;
    double deepest = std::numeric_limits<double>::infinity(), hollow = 0.0;
    double last = kUnknown, highest = kUnknown;
    const auto count = to_whole<std::size_t>((g_.field_end - kFirst) / kStep) + 1;
    const std::vector<double> all = s_.z_over(kFirst, kStep, count);
    for (std::size_t i = 0; i < count; ++i) {
      const double z = all[i];
      if (std::isnan(z)) continue;
      last = kFirst + kStep * static_cast<double>(i);
      deepest = std::min(deepest, z);  // least radius so far
      if (z - deepest > hollow) hollow = z - deepest, highest = last;
    }
    constexpr double kEnough = 40e-3, kAtEnd = 1e-3, kFelt = 0.1e-3, kWholeTread = 5e-3;
    if (hollow > kFelt && last - highest < kAtEnd && last < g_.field_end - kWholeTread)
      out_.hollow = missing(fmt::format(
          "the tread still rises where the section ends, {:.3g} mm from the tape line: it is {:.3g} mm at least",
          1e3 * last, 1e3 * hollow));
    else if (last >= kEnough)
      out_.hollow = measured(hollow, std::numbers::sqrt2 * tape_.error);
    else
      out_.hollow =
          missing(fmt::format("the section ends {:.3g} mm from the tape line, before the tread does", 1e3 * last));
  }

  /// The outer face: upright points at the field end.
  void rim() {
    constexpr double kUpright = 80.0 * kDegree, kBelowTread = 6e-3;
    std::vector<double> plane;
    double reach = s_.y_min();
    const double start = g_.field_end > 0.0 ? 30e-3 : 0.0;
    for (std::size_t i = tip_.node; i < s_.size(); ++i) {
      const Vec2& p = s_.point(i);
      if (p.x() < start) continue;
      reach = std::max(reach, p.x());
      const double off = std::fabs(std::fabs(s_.at(i).angle()) - 0.5 * std::numbers::pi);
      if (off < 0.5 * std::numbers::pi - kUpright && p.y() < -kBelowTread) plane.push_back(p.x());
    }
    constexpr std::size_t kEnough = 8;
    if (plane.size() < kEnough) {
      out_.rollover = out_.rim_width = missing("the outer rim face is not in the section");
      return;
    }
    const auto middle = plane.begin() + static_cast<std::ptrdiff_t>(plane.size() / 2);
    std::nth_element(plane.begin(), middle, plane.end());
    const double error = s_.at(s_.size() - 1).error;
    out_.rollover = measured(std::max(0.0, reach - *middle), std::numbers::sqrt2 * error);
    if (out_.back_seen)
      out_.rim_width = measured(*middle - back_, hypotenuse(error, back_error_));
    else
      out_.rim_width = missing("the flange back is not in the section");
  }

  void against(const std::vector<NominalWheel>& nominals) {
    const std::string none = "no nominal profile was named";
    const std::string free = "the flange back is not in the section, so it cannot be aligned with the nominal one";
    out_.tread_wear = out_.flange_wear = out_.area_lost = out_.area_gained = out_.diameter_lost =
        missing(nominals.empty() ? none : free);
    if (nominals.empty()) return;
    const Section& nominal = nominals.front().section;
    WheelRuler nominal_ruler(nominal, g_);
    const WheelMeasures fresh = nominal_ruler.measure(0.0, {});
    if (!out_.flange_height.known()) {
      out_.tread_wear = out_.flange_wear = out_.area_lost = out_.area_gained = out_.diameter_lost =
          missing(out_.flange_height.reason);
      return;
    }
    out_.tread_wear = measured(tip_.p.y() - fresh.flange_height.value, out_.flange_height.uncertainty / kTwoSided);
    judge_nominal(nominal, fresh.flange_height.value);
    if (!out_.back_seen && g_.from_flange_back && !g_.placed) return;
    // both faces at one depth below the tip, since a worn tread alone makes a flange thicker 10 mm below it
    const double below = fresh.flange_height.value - g_.face_depth;
    const auto worn = face_of(s_, tip_, tip_.p.y() - below);
    const auto new_face = face_of(nominal_ruler.s_, nominal_ruler.tip_, g_.face_depth);
    if (worn && new_face)
      out_.flange_wear = measured(new_face->p.x() - worn->p.x(), std::hypot(error_y(*worn), back_error_, tip_.error));
    else
      out_.flange_wear = missing("the flange face is not in the section");
    judge_growth("flange wear", out_.flange_wear);
    areas(nominal, fresh.flange_height.value);
    reprofile(nominals);
  }

  void doubt(std::string text) { out_.doubts.push_back({"nominal_profile", std::move(text)}); }

  /// Wheels are turned to half a millimetre (EN 13262), their flanges neither grow nor wear between back and tip.
  void judge_nominal(const Section& nominal, double nominal_tip) {
    constexpr double kTurned = 0.5e-3;
    if (const double off = off_unworn(nominal, nominal_tip); off > std::hypot(kTurned, s_.noise()))
      doubt(
          fmt::format("between its back and tip the flange lies {:.2f} mm or more off the nominal one (median): is it "
                      "another wheel's?",
                      1e3 * off));
    judge_growth("tread wear", out_.tread_wear);
  }

  void judge_growth(const char* name, const Measure& wear) {
    constexpr double kGrown = 1e-3;
    if (!(wear.value < -(kGrown + std::fmax(0.0, wear.uncertainty)))) return;
    doubt(
        fmt::format("the {} is {:.2f} mm: metal would have grown by more than turning ({:g} mm) and its uncertainty "
                    "explain: is the nominal section another wheel's?",
                    name, 1e3 * wear.value, 1e3 * kGrown));
  }

  /// Median distance of the flange from back to tip from the nominal one, tips at one height [m]; 0: too little of it
  /// is there.
  double off_unworn(const Section& nominal, double nominal_tip) const {
    constexpr double kStep = 0.25e-3, kBesideBack = 4e-3;  // the back's edge may be cut or worn by check rails
    constexpr std::size_t kFewest = 12;
    const double from = -g_.tape_line + kBesideBack, lift = tip_.p.y() - nominal_tip;
    if (!out_.back_seen || tip_.node == 0) return 0.0;
    const auto count = to_whole<std::size_t>(std::max(0.0, (tip_.p.x() - from) / kStep));
    const std::vector<double> own = s_.z_over(from, kStep, count), wanted = nominal.z_over(from, kStep, count);
    std::vector<double> sizes;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double slope = (wanted[i + 1] - wanted[i]) / kStep, off = own[i] - lift - wanted[i];
      if (!std::isnan(off) && !std::isnan(slope)) sizes.push_back(std::fabs(off) / std::sqrt(1.0 + slope * slope));
    }
    return sizes.size() < kFewest ? 0.0 : median_of(sizes);
  }

  void areas(const Section& nominal, double nominal_tip) {
    constexpr double kStep = 0.05e-3;
    const double lift = tip_.p.y() - nominal_tip;  // tips at one height: worn z minus this
    const double from = tip_.p.x(), to = std::min(g_.field_end, s_.y_max());
    const auto count = to_whole<std::size_t>(std::max(0.0, (to - from) / kStep));
    const auto worn = s_.z_over(from + 0.5 * kStep, kStep, count),
               fresh = nominal.z_over(from + 0.5 * kStep, kStep, count);
    double lost = 0.0, gained = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      if (const double off = fresh[i] - (worn[i] - lift); off == off)
        (off > 0.0 ? lost : gained) += kStep * std::fabs(off);
    const double error = (to - from) * hypotenuse(tip_.error, 0.0);
    out_.area_lost = measured(lost, error);
    out_.area_gained = measured(gained, error);
  }

  /// The profile of which least must be turned off: it has to lie within the worn one.
  void reprofile(const std::vector<NominalWheel>& nominals) {
    constexpr double kStep = 0.25e-3;
    const double from = tip_.p.x(), to = std::min(g_.field_end, s_.y_max() - 1e-3);
    // on the steep face scatter across is turned into depth
    const double steep =
        1.0 / std::cos(std::min(75.0 * kDegree, out_.flange_angle.known() ? out_.flange_angle.value : 0.0));
    const double error = 2.0 * hypotenuse(tape_.error, steep * hypotenuse(tape_.error, back_error_));
    // another profile than the first must save more than what is uncertain
    const double same = std::fmax(1e-6, 0.5 * kTwoSided * error);
    double least = std::numeric_limits<double>::infinity();
    const auto count = to_whole<std::size_t>(std::max(0.0, (to - from) / kStep));
    const std::vector<double> worn = s_.z_over(from, kStep, count);
    for (const NominalWheel& aim : nominals) {
      const std::vector<double> wanted = aim.section.z_over(from, kStep, count);
      double cut = 0.0;
      for (std::size_t i = 0; i < count; ++i)
        if (const double off = wanted[i] - worn[i]; off == off) cut = std::max(cut, off);
      if (cut < least - same) least = cut, out_.reprofiled_to = aim.name;
    }
    out_.diameter_lost = measured(2.0 * least, error);
  }

  Section s_;
  WheelGauge g_;
  WheelMeasures out_;
  Section::Place tip_, tape_;
  double back_ = kUnknown, back_error_ = 0.0;
};

}  // namespace

WheelMeasures measure_wheel(const Section& section, const WheelGauge& gauge, double nominal_radius,
                            const std::vector<NominalWheel>& nominals) {
  if (section.body() != Body::wheel)
    throw Error(ErrorKind::input_data, "this section is that of a rail, not of a wheel");
  return WheelRuler(section, gauge).measure(nominal_radius, nominals);
}

}  // namespace treadmark::measures
