// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/track_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace treadmark {

namespace {

[[noreturn]] void refuse(const LayoutElement& element, std::string message, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), element.where, std::move(advice));
}

bool finite(const FromTo& value) { return std::isfinite(value.from) && std::isfinite(value.to); }

void check_element(const LayoutElement& e, const TrackLayout& layout) {
  if (!(e.length > 0.0) || !(e.length <= kLongestLine))
    refuse(e, fmt::format("an element of the line is {:.6g} m long", e.length),
           fmt::format("give more than 0 and at most {:g} m", kLongestLine));
  if (!finite(e.curvature) || !finite(e.cant) || !finite(e.gauge)) refuse(e, "a number of the line is not finite");
  for (const double curvature : {e.curvature.from, e.curvature.to})
    if (std::abs(curvature) * kTightestRadius > 1.0)
      refuse(e, fmt::format("a curve has a radius of {:.6g} m, less than {:g} m", 1.0 / std::abs(curvature),
                            kTightestRadius));
  for (const double cant : {e.cant.from, e.cant.to})
    if (std::abs(cant) > layout.cant_base / 2.0)
      refuse(e, fmt::format("a cant of {:.6g} mm on rails {:.6g} mm apart", cant * 1e3, layout.cant_base * 1e3),
             "cant is in millimetres, at most half of its base");
  if (!(e.gauge.from > 0.0) || !(e.gauge.to > 0.0)) refuse(e, "a gauge of the line is not positive");
  if (layout.cant_axis == CantAxis::low_rail && e.cant.from * e.cant.to < 0.0)
    refuse(e, "the cant changes its sign within an element while the track turns about its low rail",
           "turn about the centre, or put a piece without cant between");
}

void check_joint(const LayoutElement& one, const LayoutElement& next) {
  constexpr double kSame = 1e-9;  // [m]: rounding of a change of units
  if (std::abs(one.cant.to - next.cant.from) > kSame)
    refuse(next, fmt::format("the cant steps from {:.6g} to {:.6g} mm", one.cant.to * 1e3, next.cant.from * 1e3),
           "put a transition between the two");
  if (std::abs(one.gauge.to - next.gauge.from) > kSame)
    refuse(next, fmt::format("the gauge steps from {:.6g} to {:.6g} mm", one.gauge.to * 1e3, next.gauge.from * 1e3),
           "put a transition between the two");
}

}  // namespace

double TrackLayout::length() const {
  double sum = 0.0;
  for (const LayoutElement& element : elements) sum += element.length;
  return sum;
}

namespace {

bool is_constant(const LayoutElement& e) { return e.curvature.from == e.curvature.to && e.cant.from == e.cant.to; }

/// What stands between two elements instead of their kink, this much of each; none where there is no kink.
std::optional<TransitionShape> shape_between(const LayoutElement& one, const LayoutElement& next) {
  const bool from_constant = is_constant(one), to_constant = is_constant(next);
  if (from_constant && to_constant)
    return one.curvature.to != next.curvature.from ? std::optional(TransitionShape::bloss) : std::nullopt;
  if (from_constant && next.shape == TransitionShape::linear) return TransitionShape::rising;
  if (to_constant && one.shape == TransitionShape::linear) return TransitionShape::easing;
  return std::nullopt;
}

/// Values at a share of an element; linear ones and constants only.
double at_share(const FromTo& value, double u) { return value.from + u * (value.to - value.from); }

}  // namespace

TrackLayout rounded(const TrackLayout& layout, double half_length) {
  TrackLayout out = layout;
  out.elements.clear();
  const std::vector<LayoutElement>& given = layout.elements;
  double cut_before = 0.0;  // of the element at hand
  for (std::size_t i = 0; i < given.size(); ++i) {
    const LayoutElement& e = given[i];
    const auto shape = i + 1 < given.size() ? shape_between(e, given[i + 1]) : std::nullopt;
    const double cut_behind = shape ? std::min({half_length, 0.25 * e.length, 0.25 * given[i + 1].length}) : 0.0;
    const auto values = [](const LayoutElement& from, double u, const LayoutElement& to, double w) {
      LayoutElement part;
      for (FromTo LayoutElement::*v : {&LayoutElement::curvature, &LayoutElement::cant, &LayoutElement::gauge})
        part.*v = {at_share(from.*v, u), at_share(to.*v, w)};
      return part;
    };
    LayoutElement kept = e;
    if (cut_before > 0.0 || cut_behind > 0.0) {
      kept = values(e, cut_before / e.length, e, 1.0 - cut_behind / e.length);
      kept.length = e.length - cut_before - cut_behind;
      kept.shape = e.shape;
      kept.where = e.where;
    }
    out.elements.push_back(kept);
    if (shape) {
      const LayoutElement& next = given[i + 1];
      LayoutElement joint = values(e, 1.0 - cut_behind / e.length, next, cut_behind / next.length);
      joint.length = 2.0 * cut_behind;
      joint.shape = *shape;
      joint.where = next.where;
      out.elements.push_back(joint);
    }
    cut_before = cut_behind;
  }
  return out;
}

void check(const TrackLayout& layout) {
  if (layout.elements.empty())
    throw Error(ErrorKind::configuration, "the line has no elements", layout.where, "give at least one straight");
  if (!(layout.cant_base > 0.0) || !std::isfinite(layout.cant_base))
    throw Error(ErrorKind::configuration, "the base of cant must be positive", layout.where);
  for (std::size_t i = 0; i < layout.elements.size(); ++i) {
    check_element(layout.elements[i], layout);
    if (i > 0) check_joint(layout.elements[i - 1], layout.elements[i]);
  }
  if (layout.length() > kLongestLine)
    throw Error(ErrorKind::configuration, fmt::format("the line is {:.6g} m long", layout.length()), layout.where,
                fmt::format("at most {:g} m", kLongestLine));
}

}  // namespace treadmark
