// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/judge_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/profiles/clean_points.hpp"
#include "treadmark/io/profiles/faults.hpp"
#include "treadmark/measured/noise.hpp"
#include "treadmark/model/profile_scatter.hpp"

namespace treadmark::io {
namespace {

using profiles::median;
using profiles::RawPoints;

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
  Judge(const SourcedProfile& sourced, const ExpectedWheel& expected, const std::vector<StandardOutline>& standards)
      : p_(sourced.profile), source_(sourced.source), expected_(expected), standards_(standards) {}

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
    noise();
    standard();
    return std::move(out_);
  }

 private:
  void fact(const char* name, std::string value) { out_.facts.emplace_back(name, std::move(value)); }
  void remark(const char* name, std::string text) { out_.remarks.push_back({name, std::move(text)}); }

  void what_was_read() {
    fact("kind", source_.kind);
    fact("body", p_.body == Body::wheel ? "wheel" : "rail");
    fact("points", source_.points_in_file == p_.y.size()
                       ? fmt::format("{}", p_.y.size())
                       : fmt::format("{} of {} in the file", p_.y.size(), source_.points_in_file));
    for (const auto& [name, value] : source_.said) fact("file says", fmt::format("{} = {}", name, value));
  }

  void ranges() {
    constexpr double kNarrow = 15e-3;
    constexpr double kWidthRail = 0.072, kWidthWheel = 0.130;
    fact("y", fmt::format("{:.2f} to {:.2f} mm, to the right", kMm * y_.low, kMm * y_.high));
    fact("z", fmt::format("{:.2f} to {:.2f} mm, down", kMm * z_.low, kMm * z_.high));
    std::string unit = source_.unit ? std::string(symbol(*source_.unit)) + ", stated in the file" : "mm";
    if (source_.scale_to_mm != 1.0)
      unit += fmt::format("; numbers of the file times {:.6g} are mm", source_.scale_to_mm);
    fact("unit", unit);
    if (y_.size() >= kNarrow || z_.size() >= kNarrow) return;
    const double usual = p_.body == Body::wheel ? kWidthWheel : kWidthRail;
    const auto off = [&](double factor) { return std::fabs(std::log(factor * y_.size() / usual)); };
    const bool inches = off(25.4) < off(10.0);
    remark("unit", fmt::format("the {} is only {:.3g} mm wide: is it in {}? set scale_to_mm = {}",
                               p_.body == Body::wheel ? "wheel" : "rail", kMm * y_.size(), inches ? "inches" : "cm",
                               inches ? "25.4" : "10"));
  }

  void orientation() {
    fact("turned", fmt::format("y {}, z {}, order of the points {}", source_.mirrored_y ? "mirrored" : "as in the file",
                               source_.mirrored_z ? "mirrored" : "as in the file",
                               source_.reversed ? "reversed" : "as in the file"));
    if (profiles::seem_exchanged(p_.y, p_.z)) {
      lies_wrong_ = true;
      remark("exchanged", "z runs one way and y to and fro: are y and z exchanged? exchange the columns, or name them");
      return;
    }
    RawPoints points;
    points.y = p_.y, points.z = p_.z;
    if (p_.body == Body::wheel ? flange_height(-1.0) > kFlange && flange_height(1.0) < 0.5 * kFlange
                               : z_.size() > kFlange && profiles::z_points_up(points, p_.body)) {
      lies_wrong_ = true;
      remark("upside_down",
             fmt::format("z seems to point up: set mirror_z = \"{}\"", source_.mirrored_z ? "no" : "yes"));
    }
  }

  /// How far the flange reaches beyond the usual height of the tread, z times the sign.
  double flange_height(double sign) const {
    std::vector<double> heights;
    for (const double z : p_.z) heights.push_back(sign * z);
    return *std::max_element(heights.begin(), heights.end()) - median(heights);
  }

  void flange() {
    if (flange_height(1.0) < kFlange) {
      fact("flange", "none");
      return;
    }
    const auto tip = static_cast<std::size_t>(std::max_element(p_.z.begin(), p_.z.end()) - p_.z.begin());
    const bool right_side = p_.y[tip] < 0.5 * (y_.low + y_.high);
    fact("flange", fmt::format("tip at y = {:.2f} mm, z = {:.2f} mm, {}", kMm * p_.y[tip], kMm * p_.z[tip],
                               right_side ? "on the side of small y as it should" : "on the side of great y"));
    if (!right_side) {
      remark("flange_side",
             fmt::format("the flange is on the side of great y (tip at {:.4g} mm), that of a left wheel: "
                         "set mirror_y = {}",
                         kMm * p_.y[tip], source_.mirrored_y ? "false" : "true"));
      return;
    }
    flange_back(tip);
  }

  /// The profile ends on a steep side behind the tip.
  void flange_back(std::size_t tip) {
    constexpr double kBelowTip = 5e-3, kLength = 3e-3, kSteep = 1.5, kFarOff = 3e-3;
    const std::size_t end = p_.y.size() - 1;
    std::size_t start = end;
    while (start > tip && std::hypot(p_.y[start] - p_.y[end], p_.z[start] - p_.z[end]) < kLength) --start;
    const bool there = p_.z[tip] - p_.z[end] > kBelowTip && start > tip &&
                       std::fabs(p_.z[start] - p_.z[end]) > kSteep * std::fabs(p_.y[start] - p_.y[end]);
    if (!there) {
      fact("flange back", "not in the profile");
      return;
    }
    fact("flange back", fmt::format("y = {:.2f} mm", kMm * y_.low));
    if (!expected_.flange_back || std::fabs(*expected_.flange_back - y_.low) < kFarOff) return;
    remark("flange_back", fmt::format("the back of the flange is at y = {:.2f} mm, the case puts it at {:.2f} mm: set "
                                      "wheelset.flange_back_position_mm (FBPOS) = {:.2f}",
                                      kMm * y_.low, kMm * *expected_.flange_back, kMm * y_.low));
  }

  /// 14 mm below the top on the side of small y, where the gauge is measured.
  void gauge_point() {
    constexpr double kDepth = 14e-3, kNear = 1e-3;
    const auto top = static_cast<std::size_t>(std::min_element(p_.z.begin(), p_.z.end()) - p_.z.begin());
    const double depth = p_.z[top] + kDepth;
    std::size_t left = top, right = top;
    while (left > 0 && p_.z[left] < depth) --left;
    while (right + 1 < p_.z.size() && p_.z[right] < depth) ++right;
    const bool reaches_left = p_.z[left] >= depth, reaches_right = p_.z[right] >= depth;
    if (!reaches_left) {
      fact("gauge point", "not in the profile: it ends less than 14 mm below the top");
      if (reaches_right && p_.y[top] - y_.low < y_.high - p_.y[top] - kNear)
        remark(
            "gauge_side",
            fmt::format("the profile reaches 14 mm below its top on the side of great y only: is the gauge side there? "
                        "set mirror_y = {}",
                        source_.mirrored_y ? "false" : "true"));
      return;
    }
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

  void steps() {
    constexpr double kGap = 10e-3, kTimes = 10.0;
    std::vector<double> steps;
    for (std::size_t i = 1; i < p_.y.size(); ++i)
      steps.push_back(std::hypot(p_.y[i] - p_.y[i - 1], p_.z[i] - p_.z[i - 1]));
    const auto largest = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
    const double usual = median(steps);
    const std::string where =
        source_.lines.size() == p_.y.size()
            ? fmt::format("lines {} to {}", std::min(source_.lines[largest], source_.lines[largest + 1]),
                          std::max(source_.lines[largest], source_.lines[largest + 1]))
            : std::string("no line known");
    fact("steps", fmt::format("{:.3g} mm, largest {:.3g} mm at y = {:.2f} mm ({})", kMm * usual, kMm * steps[largest],
                              kMm * p_.y[largest], where));
    if (steps[largest] > kGap && steps[largest] > kTimes * usual)
      remark("gap",
             fmt::format("a gap of {:.3g} mm at y = {:.2f} to {:.2f} mm ({}) is bridged: measure the missing part, "
                         "or keep contact away from it",
                         kMm * steps[largest], kMm * p_.y[largest], kMm * p_.y[largest + 1], where));
  }

  /// A profile that was smoothed says what its points were like.
  void noise() {
    const auto [across, y, z, step] = p_.scatter ? measured::PointNoise{p_.scatter->white, p_.scatter->rounding_y,
                                                                        p_.scatter->rounding_z, p_.scatter->step}
                                                 : measured::profile_noise(p_);
    fact("noise", fmt::format("{:.2g} mm{}", kMm * across,
                              std::max(y, z) > 0.0 ? fmt::format(", rounded to {:.3g} mm", kMm * std::max(y, z)) : ""));
    if (p_.scatter && p_.scatter->removed > 0.0)
      fact("smoothed", fmt::format("points moved by {:.2g} mm (rms)", kMm * p_.scatter->removed));
  }

  /// Several profiles share a head: all that are as near as the nearest are named.
  void standard() {
    constexpr double kAlike = 1e-6;  // [m] finer than any gauge
    constexpr std::size_t kNamed = 6;
    std::vector<std::pair<StandardDeparture, std::string>> all;
    for (const StandardOutline& standard : standards_)
      if (const auto departure = departure_from(p_, standard)) all.emplace_back(*departure, standard.name);
    if (all.empty()) return;
    const auto usual = [](const auto& row) { return row.first.usual; };
    const StandardDeparture best = std::ranges::min_element(all, {}, usual)->first;
    std::string names;
    std::size_t count = 0;
    for (const auto& [departure, name] : all)
      if (departure.usual <= best.usual + kAlike && ++count <= kNamed) names += (count > 1 ? ", " : "") + name;
    if (count > kNamed) names += fmt::format(" and {} more", count - kNamed);
    fact("standard",
         fmt::format("{:.3g} mm from {} (largest {:.3g} mm) when shifted by {:.2f} mm and rolled by {:.2f} mrad",
                     kMm * best.usual, names, kMm * best.largest, kMm * best.shift_y, kMm * best.roll));
  }

  static constexpr double kFlange = 15e-3;  ///< what reaches so far beyond the tread is a flange
  const Profile& p_;
  const ProfileSource& source_;
  const ExpectedWheel& expected_;
  const std::vector<StandardOutline>& standards_;
  ProfileJudgement out_;
  Range y_, z_;
  bool lies_wrong_ = false;  ///< upside down or exchanged: sides mean nothing
};

/// z of the outline at y, NaN outside.
double height_at(const StandardOutline& outline, double y) {
  const auto after = std::upper_bound(outline.y.begin(), outline.y.end(), y);
  if (after == outline.y.begin() || after == outline.y.end()) return NAN;
  const auto k = static_cast<std::size_t>(after - outline.y.begin());
  const double t = (y - outline.y[k - 1]) / (outline.y[k] - outline.y[k - 1]);
  return outline.z[k - 1] + t * (outline.z[k] - outline.z[k - 1]);
}

}  // namespace

std::optional<StandardDeparture> departure_from(const Profile& profile, const StandardOutline& standard) {
  constexpr double kHalf = 25e-3, kLeast = 20e-3, kFar = 0.16, kCoarse = 1e-3, kFine = 0.02e-3;
  constexpr double kFewest = 8;
  if (standard.y.empty()) return std::nullopt;
  // the level part of a rail is round its top, that of a wheel round the tape line 70 mm from the back of the flange
  const auto fit = [&](double shift) -> std::optional<StandardDeparture> {
    std::vector<double> y, d;
    for (std::size_t i = 0; i < profile.y.size(); ++i) {
      const double at = profile.y[i] + shift;
      const double z = std::fabs(at) <= kHalf ? height_at(standard, at) : NAN;
      if (std::isnan(z)) continue;
      y.push_back(at);
      d.push_back(z - profile.z[i]);
    }
    const auto n = static_cast<double>(y.size());
    if (n < kFewest || range_of(y).size() < kLeast) return std::nullopt;
    double my = 0.0, md = 0.0, yy = 0.0, yd = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) my += y[i] / n, md += d[i] / n;
    for (std::size_t i = 0; i < y.size(); ++i) yy += (y[i] - my) * (y[i] - my), yd += (y[i] - my) * (d[i] - md);
    const double slope = yd / yy;
    std::vector<double> rest;
    for (std::size_t i = 0; i < y.size(); ++i) rest.push_back(std::fabs(d[i] - md - slope * (y[i] - my)));
    StandardDeparture out;
    out.largest = *std::max_element(rest.begin(), rest.end());
    out.usual = median(std::move(rest));
    out.shift_y = shift;
    out.roll = slope;
    return out;
  };
  // a shift that leaves out part of the level middle would fit anything: all of it must be there, or as much as ever is
  const Range y = range_of(profile.y);
  const auto common = [&](double shift) { return std::min(kHalf, y.high + shift) - std::max(-kHalf, y.low + shift); };
  double most = 0.0;
  for (double shift = -kFar; shift <= kFar; shift += kCoarse) most = std::max(most, common(shift));
  std::optional<StandardDeparture> best;
  const auto search = [&](double from, double to, double step) {
    for (double shift = from; shift <= to; shift += step) {
      if (common(shift) < most - kCoarse) continue;
      const auto found = fit(shift);
      if (found && (!best || found->largest < best->largest)) best = found;
    }
  };
  search(-kFar, kFar, kCoarse);
  if (best) search(best->shift_y - kCoarse, best->shift_y + kCoarse, kFine);
  return best;
}

ProfileJudgement judge_profile(const SourcedProfile& profile, const ExpectedWheel& expected,
                               const std::vector<StandardOutline>& standards) {
  return Judge(profile, expected, standards).judge();
}

}  // namespace treadmark::io
