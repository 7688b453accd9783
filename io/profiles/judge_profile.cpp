// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/judge_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/analysis/measured/lumps.hpp"
#include "treadmark/analysis/measured/noise.hpp"
#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/io/profiles/faults.hpp"
#include "treadmark/model/rail_head.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/profile_scatter.hpp"

namespace treadmark::io {
namespace {

using profiles::median;

constexpr double kMm = 1e3;

struct Range {
  double low = 0.0, high = 0.0;
  double size() const { return high - low; }
};

Range range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

class Judge {
 public:
  Judge(const SourcedProfile& sourced, const ExpectedProfile& expected)
      : p_(sourced.profile), source_(sourced.source), expected_(expected) {}

  ProfileJudgement judge() {
    out_.notes = source_.notes;
    y_ = range_of(p_.y);
    z_ = range_of(p_.z);
    what_was_read();
    ranges();
    orientation();
    if (!lies_wrong_) {
      if (p_.body == Body::wheel)
        flange();
      else
        gauge_point();
    }
    radius();
    steps();
    lump();
    noise();
    return std::move(out_);
  }

 private:
  void fact(const char* name, std::string value) { out_.facts.emplace_back(name, std::move(value)); }
  void remark(const char* name, std::string text) { out_.remarks.push_back({name, std::move(text)}); }
  /// Of points first to last.
  void remark_at(const char* name, std::string text, std::size_t first, std::size_t last) {
    out_.remarks.push_back(
        {name, std::move(text), std::pair(std::min(p_.y[first], p_.y[last]), std::max(p_.y[first], p_.y[last]))});
  }

  void what_was_read() {
    fact("kind", source_.kind);
    fact("body", body_name(p_.body));
    fact("points", source_.points_in_file == p_.y.size()
                       ? fmt::format("{}", p_.y.size())
                       : fmt::format("{} of {} in the file", p_.y.size(), source_.points_in_file));
    for (const auto& [name, value] : source_.said) fact("file says", fmt::format("{} = {}", name, value));
    for (const measured::Doubt& doubt : source_.doubts) remark(doubt.name.c_str(), doubt.text);
  }

  void ranges() {
    constexpr double kNarrow = 16e-3, kUpright = 3.0;
    constexpr double kWidthRail = 0.072, kWidthWheel = 0.130;
    fact("y", fmt::format("{:.2f} to {:.2f} mm, to the right", kMm * y_.low, kMm * y_.high));
    fact("z", fmt::format("{:.2f} to {:.2f} mm, down", kMm * z_.low, kMm * z_.high));
    std::string unit = source_.unit ? std::string(symbol(*source_.unit)) + ", stated in the file" : "mm";
    if (source_.scale_to_mm != 1.0)
      unit += fmt::format("; numbers of the file times {:.6g} are mm", source_.scale_to_mm);
    fact("unit", unit);
    if (y_.size() >= kNarrow || z_.size() >= kUpright * y_.size()) return;
    const double usual = p_.body == Body::wheel ? kWidthWheel : kWidthRail;
    const auto off = [&](double factor) { return std::fabs(std::log(factor * y_.size() / usual)); };
    const bool inches = off(25.4) < off(10.0);
    remark("unit", fmt::format("the {} is only {:.3g} mm wide: is it in {}? set scale_to_mm = {}", body_name(p_.body),
                               kMm * y_.size(), inches ? "inches" : "cm", inches ? "25.4" : "10"));
  }

  void orientation() {
    const measured::Understanding& seen = source_.understood;
    fact("turned", fmt::format("y {}, z {}, order of the points {}", source_.mirrored_y ? "mirrored" : "as in the file",
                               source_.mirrored_z ? "mirrored" : "as in the file",
                               source_.reversed ? "reversed" : "as in the file"));
    if (profiles::seem_exchanged(p_.y, p_.z)) {
      lies_wrong_ = true;
      remark("exchanged", "z runs one way and y to and fro: are y and z exchanged? exchange the columns, or name them");
      return;
    }
    const auto evidence = [&](const char* axis, const measured::Readings& r) {
      if (r.marked)
        fact("evidence",
             fmt::format("{}: {} ({:.3g} against {:.3g} mirrored)", axis, r.evidence, r.as_it_is, r.turned));
    };
    evidence("z", seen.z);
    evidence("y", seen.y);
    for (const measured::Doubt& doubt : seen.doubts) {
      if (doubt.name == "upside_down" || doubt.name == "flange_side") lies_wrong_ = true;
      remark(doubt.name.c_str(), doubt.text);
    }
  }

  void flange() {
    const measured::WheelMarks& marks = source_.understood.wheel;
    if (!marks.tip_y) {
      fact("flange", "none");
      return;
    }
    fact("flange", fmt::format("tip at y = {:.2f} mm, z = {:.2f} mm{}", kMm * *marks.tip_y, kMm * *marks.tip_z,
                               marks.second_flange ? "; another one on the other side" : ""));
    if (marks.tape_z) fact("tape line", fmt::format("y = 0, z = {:.3f} mm", kMm * *marks.tape_z));
    if (!marks.back_y) {
      fact("flange back", "not in the profile");
      return;
    }
    fact("flange back", fmt::format("y = {:.2f} mm", kMm * *marks.back_y));
    constexpr double kFarOff = 3e-3;
    if (!expected_.flange_back || std::fabs(*expected_.flange_back - *marks.back_y) < kFarOff) return;
    remark("flange_back", fmt::format("the back of the flange is at y = {:.2f} mm, the case puts it at {:.2f} mm: set "
                                      "wheelset.flange_back_position_mm (FBPOS) = {:.2f}",
                                      kMm * *marks.back_y, kMm * *expected_.flange_back, kMm * *marks.back_y));
  }

  /// Whether points of these, beside a head, are as high as it.
  bool has_keeper(std::size_t first, std::size_t end, double depth) const {
    constexpr double kWide = 5e-3;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = first; i < end; ++i)
      if (p_.z[i] < depth) low = std::min(low, p_.y[i]), high = std::max(high, p_.y[i]);
    return high - low > kWide;
  }

  /// 14 mm below the top on the side of small y, where the gauge is measured.
  void gauge_point() {
    constexpr double kDepth = 14e-3, kNear = 1e-3;
    const RailHead head = head_of_rail(p_.y, p_.z, kDepth).value_or(RailHead{});
    const std::size_t top = head.top;
    const double depth = p_.z[top] + kDepth;
    const bool reaches_left = head.first > 0, reaches_right = head.last + 1 < p_.z.size();
    if (has_keeper(head.last + 1, p_.z.size(), depth) && !has_keeper(0, head.first, depth))
      remark("gauge_side", fmt::format("there is a groove on the side of great y only: is the gauge side there? set "
                                       "mirror_y = {}",
                                       source_.mirrored_y ? "false" : "true"));
    if (!reaches_left) {
      fact("gauge point", "not in the profile: it ends less than 14 mm below the top");
      if (expected_.by_gauge)
        remark("gauge_point",
               fmt::format(
                   "on the side of small y the profile ends {:.1f} mm below its top, and the gauge is measured 14 mm "
                   "below it: measure deeper, or place the rail by track.rail_y_mm",
                   kMm * (p_.z.front() - p_.z[top])));
      if (reaches_right && p_.y[top] - y_.low < y_.high - p_.y[top] - kNear)
        remark(
            "gauge_side",
            fmt::format("the profile reaches 14 mm below its top on the side of great y only: is the gauge side there? "
                        "set mirror_y = {}",
                        source_.mirrored_y ? "false" : "true"));
      return;
    }
    const std::size_t left = head.first - 1;
    const double t = (depth - p_.z[left]) / (p_.z[left + 1] - p_.z[left]);
    fact("gauge point",
         fmt::format("y = {:.2f} mm, 14 mm below the top", kMm * (p_.y[left] + t * (p_.y[left + 1] - p_.y[left]))));
  }

  void radius() {
    constexpr double kSame = 0.02;
    if (!source_.nominal_radius) return;
    fact("nominal radius",
         fmt::format("{:.2f} mm, half the diameter that the file states", kMm * *source_.nominal_radius));
    if (expected_.nominal_radius && std::fabs(*expected_.nominal_radius / *source_.nominal_radius - 1.0) > kSame)
      remark("nominal_radius", fmt::format("the file states a radius of {:.2f} mm, the case has {:.2f} mm: set "
                                           "wheelset.nominal_radius_mm",
                                           kMm * *source_.nominal_radius, kMm * *expected_.nominal_radius));
  }

  /// Dirt that is no spike.
  void lump() {
    const std::optional<measured::Lump>& found = source_.lump;
    if (!found) return;
    remark_at("lump",
              fmt::format(
                  "{} of {:.2g} mm at y = {:.2f} mm ({}), {}: dirt or damage? where it touches, the pressure is "
                  "that of it; clean the profile, or remove the points",
                  found->height > 0.0 ? "a lump" : "a notch", kMm * std::fabs(found->height), kMm * p_.y[found->first],
                  where(found->first, found->last),
                  found->first == found->last ? "one point" : fmt::format("{} points", found->last - found->first + 1)),
              found->first, found->last);
  }

  /// Lines of the file that points come from.
  std::string where(std::size_t a, std::size_t b) const {
    if (source_.lines.size() != p_.y.size()) return "no line known";
    const auto [low, high] = std::minmax(source_.lines[a], source_.lines[b]);
    return low == high ? fmt::format("line {}", low) : fmt::format("lines {} to {}", low, high);
  }

  void steps() {
    constexpr double kGap = 10e-3, kTimes = 10.0;
    std::vector<double> steps;
    for (std::size_t i = 1; i < p_.y.size(); ++i)
      steps.push_back(std::hypot(p_.y[i] - p_.y[i - 1], p_.z[i] - p_.z[i - 1]));
    const auto largest = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
    const double usual = median(steps);
    const std::string lines = where(largest, largest + 1);
    fact("steps", fmt::format("{:.3g} mm, largest {:.3g} mm at y = {:.2f} mm ({})", kMm * usual, kMm * steps[largest],
                              kMm * p_.y[largest], lines));
    if (steps[largest] > kGap && steps[largest] > kTimes * usual)
      remark_at("gap",
                fmt::format("a gap of {:.3g} mm at y = {:.2f} to {:.2f} mm ({}) is bridged: measure the missing part, "
                            "or keep contact away from it",
                            kMm * steps[largest], kMm * p_.y[largest], kMm * p_.y[largest + 1], lines),
                largest, largest + 1);
  }

  /// A profile that was smoothed says what its points were like.
  void noise() {
    measured::PointNoise found;
    if (p_.scatter)
      found.across = p_.scatter->white, found.rounding_y = p_.scatter->rounding_y,
      found.rounding_z = p_.scatter->rounding_z;
    else
      found = measured::profile_noise(p_);
    const double across = found.across, rounding = std::max(found.rounding_y, found.rounding_z);
    fact("noise", fmt::format("{:.2g} mm{}", kMm * across,
                              rounding > 0.0 ? fmt::format(", rounded to {:.3g} mm", kMm * rounding) : ""));
    constexpr double kFelt =
        0.25e-6;  // white noise that changes the pressure of a curve through all points by percents
    const bool smoothed = measured::is_smoothed(p_);
    if (!smoothed && p_.smoothing.strength == 0.0 && across > kFelt)
      remark("noise", fmt::format("the points scatter by {:.2g} mm and the curve runs through all of them: pressures "
                                  "are too large; set smoothing = \"auto\", or smooth them in the file",
                                  kMm * across));
    if (p_.scatter && !p_.scatter->between.empty()) {
      const std::vector<double>& between = p_.scatter->between;
      const auto worst = std::max_element(between.begin(), between.end());
      const double y = p_.y[static_cast<std::size_t>(worst - between.begin())];
      fact("between points", fmt::format("the curve is known to {:.2g} um (standard deviation), at y = {:.1f} mm; what "
                                         "that leaves of a contact is its noise",
                                         kMm * kMm * *worst, kMm * y));
    }
    if (p_.scatter && p_.scatter->removed > 0.0)
      fact("smoothed", fmt::format("points moved by {:.2g} mm (rms)", kMm * p_.scatter->removed));
  }

  const Profile& p_;
  const ProfileSource& source_;
  const ExpectedProfile& expected_;
  ProfileJudgement out_;
  Range y_, z_;
  bool lies_wrong_ = false;  ///< upside down or exchanged: sides mean nothing
};

}  // namespace

ProfileJudgement judge_profile(const SourcedProfile& profile, const ExpectedProfile& expected) {
  return Judge(profile, expected).judge();
}

}  // namespace treadmark::io
