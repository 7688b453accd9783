// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/defects.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {

namespace {

constexpr double kSteepest = 1.0;  ///< slope beyond which a shape folds over itself in tilted views

/// Requirements on one shape, named by its place in the lists.
class Shape {
 public:
  Shape(const char* list, std::size_t number) : name_(std::string(list) + '[' + std::to_string(number) + ']') {}

  void require(bool good, const char* what, const char* advice = "") const {
    if (!good) throw Error(ErrorKind::configuration, name_ + ": " + what, {}, advice);
  }
  void finite(std::initializer_list<double> numbers) const {
    require(std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); }),
            "every number must be finite");
  }
  void gentle(double slope, const char* what) const {
    require(slope <= kSteepest, what, "it must not be steeper than 45 degrees");
  }

 private:
  std::string name_;
};

void check(const WheelFlat& f, double R, const Shape& shape) {
  shape.finite({f.length, f.depth, f.theta_center, f.y_center, f.width, f.edge_radius});
  const bool fresh = f.shape == WheelFlat::Shape::fresh;
  shape.require(f.length > 0.0, "the length must be positive");
  shape.require(f.length < (fresh ? 2.0 : 2.0 * kPi) * R, "the length must fit on the wheel");
  shape.require(fresh || (f.depth > 0.0 && f.depth < 0.5 * R),
                "the depth must be positive and less than half the radius");
  shape.require(f.width >= 0.0, "the width must not be negative");
  shape.require(f.edge_radius >= 0.0 && f.edge_radius <= 0.5 * R,
                "the radius of the edges must be at most half of the wheel's, where they meet in the middle");
  shape.require(fresh || f.edge_radius == 0.0, "a rounded flat has no edges", "leave out edge_radius_mm");
  if (!fresh) shape.gentle(f.depth * kPi / f.length, "the flat is too deep for its length");
  if (!fresh && f.width > 0.0) shape.gentle(f.depth * kPi / f.width, "the flat is too deep for its width");
}

void check(const Polygonization& p, double R, const Shape& shape) {
  shape.finite({p.y_center, p.width});
  shape.require(!p.harmonics.empty(), "it needs at least one harmonic");
  shape.require(p.width >= 0.0, "the width must not be negative");
  double slope = 0.0, height = 0.0;
  for (const auto& h : p.harmonics) {
    shape.finite({h.amplitude, h.phase});
    shape.require(h.order >= 1, "the order of a harmonic must be at least 1");
    slope += h.order * std::fabs(h.amplitude);
    height += std::fabs(h.amplitude);
  }
  shape.require(height < 0.5 * R, "the amplitudes must be less than half the radius");
  shape.gentle(slope / R, "the waves are too steep");
  if (p.width > 0.0) shape.gentle(height * kPi / p.width, "the amplitudes are too great for the width");
}

void check(const Squat& s, double, const Shape& shape) {
  shape.finite({s.length, s.width, s.depth, s.x_center, s.y_center, s.second_length, s.second_width, s.second_depth,
                s.second_distance, s.second_y_offset});
  const auto dip = [&](double length, double width, double depth) {
    shape.require(length > 0.0 && width > 0.0, "length and width must be positive");
    shape.gentle(depth * kPi / length, "a dip is too deep for its length");
    shape.gentle(depth * kPi / width, "a dip is too deep for its width");
  };
  shape.require(s.depth > 0.0, "the depth must be positive");
  dip(s.length, s.width, s.depth);
  shape.require(s.second_depth >= 0.0 && s.second_length >= 0.0 && s.second_width >= 0.0,
                "length, width and depth of the second dip must not be negative");
  shape.require(s.second_distance >= 0.0, "the distance of the second dip must not be negative",
                "the first dip is the one with the greater x");
  if (s.second_depth > 0.0)
    dip(s.second_length > 0.0 ? s.second_length : s.length, s.second_width > 0.0 ? s.second_width : s.width,
        s.second_depth);
}

template <class Stretch>
void check_stretch(const Stretch& s, const Shape& shape) {
  shape.finite({s.x_start, s.x_end, s.ramp});
  shape.require(s.x_end > s.x_start, "x_end must be greater than x_start");
  shape.require(s.ramp > 0.0, "the ramp must be positive");
  shape.require(2.0 * s.ramp <= s.x_end - s.x_start, "the ramps are longer than half the length");
}

void check(const Corrugation& c, double, const Shape& shape) {
  check_stretch(c, shape);
  shape.finite({c.y_center, c.width});
  shape.require(c.width >= 0.0, "the width must not be negative");
  shape.require(!c.waves.empty(), "it needs at least one wave");
  double slope = 0.0, height = 0.0;
  for (const auto& w : c.waves) {
    shape.finite({w.wavelength, w.amplitude, w.phase});
    shape.require(w.wavelength > 0.0, "the wavelength must be positive");
    slope += 2.0 * kPi * std::fabs(w.amplitude) / w.wavelength;
    height += std::fabs(w.amplitude);
  }
  shape.gentle(slope + 0.5 * kPi * height / c.ramp, "the waves are too steep");
  if (c.width > 0.0) shape.gentle(height * kPi / c.width, "the amplitudes are too great for the width");
}

void check(const GaugeCornerCollapse& g, double, const Shape& shape) {
  shape.finite({g.length, g.depth, g.width, g.x_center, g.y_start});
  shape.require(g.length > 0.0 && g.width > 0.0 && g.depth > 0.0, "length, width and depth must be positive");
  shape.require(g.gauge_side == 1 || g.gauge_side == -1, "the gauge side must be -1 or +1");
  shape.gentle(g.depth * kPi / g.length, "the collapse is too deep for its length");
  shape.gentle(0.5 * g.depth * kPi / g.width, "the collapse is too deep for its width");
}

template <class Pit>
void check_pit(const Pit& s, const Shape& shape) {
  shape.finite({s.length, s.width, s.depth, s.edge, s.y_center});
  shape.require(s.length > 0.0 && s.width > 0.0 && s.depth > 0.0, "length, width and depth must be positive");
  shape.require(s.edge > 0.0, "the width of the edge must be positive");
  shape.require(2.0 * s.edge <= std::min(s.length, s.width), "the edges are wider than half the spall");
  shape.gentle(0.5 * s.depth * kPi / s.edge, "the edge is too narrow for the depth");
}

void check(const Spall& s, double, const Shape& shape) {
  check_pit(s, shape);
  shape.finite({s.x_center});
}

void check(const WheelSpall& s, double R, const Shape& shape) {
  check_pit(s, shape);
  shape.finite({s.theta_center});
  shape.require(s.length < 2.0 * kPi * R, "the length must fit on the wheel");
  shape.require(s.depth < 0.5 * R, "the depth must be less than half the radius");
}

void check(const FlattenedHead& h, double, const Shape& shape) {
  check_stretch(h, shape);
  shape.finite({h.depth, h.roll, h.edge_radius});
  shape.require(h.edge_radius >= 0.0, "the radius of the edges must not be negative");
  shape.require(h.depth > 0.0, "the depth must be positive");
  shape.require(std::fabs(h.roll) < 0.25 * kPi, "the roll angle must lie within +-45 degrees");
  shape.gentle(1.5 * h.depth / h.ramp, "the ramp is too short for the depth");
}

void check(const MillingPath& m, double, const Shape& shape) {
  constexpr double kSteepestInclination = 80.0 / 180.0 * kPi;
  constexpr const char* kKeepFlat = "it must be a graph z(y): keep the inclinations within +-80 degrees";
  shape.finite({m.start_y, m.start_z, m.start_angle});
  shape.require(m.stations.size() >= 2, "it needs at least two stations");
  double roll_min = m.stations.front().roll, roll_max = roll_min, x = -HUGE_VAL;
  for (const auto& s : m.stations) {
    shape.finite({s.x, s.y, s.z, s.roll});
    shape.require(s.x > x, "the stations must have strictly increasing x");
    x = s.x;
    roll_min = std::min(roll_min, s.roll);
    roll_max = std::max(roll_max, s.roll);
  }
  shape.require(!m.section.empty(), "the section needs at least one segment");
  double angle = m.start_angle;
  const auto flat = [&] {
    return std::fabs(angle) <= kSteepestInclination && std::fabs(angle + roll_min) <= kSteepestInclination &&
           std::fabs(angle + roll_max) <= kSteepestInclination;
  };
  shape.require(flat(), "the section is too steep at its start", kKeepFlat);
  for (const auto& s : m.section) {
    shape.finite({s.length, s.curvature});
    shape.require(s.length > 0.0, "the length of a segment must be positive");
    angle += s.length * s.curvature;
    shape.require(flat(), "the section is too steep", kKeepFlat);
  }
}

}  // namespace

void check_body(const Defects& defects, Body body) {
  Defects::each(defects, [body](std::string key, Body owner, const auto& list) {
    if (list.empty() || owner == body) return;
    std::replace(key.begin(), key.end(), '_', ' ');
    const auto [can, cannot] = owner == Body::wheel ? std::pair("wheels", "rails") : std::pair("rails", "wheels");
    throw Error(ErrorKind::configuration, key.substr(key.find('.') + 1) + " belong to " + can + ", not to " + cannot);
  });
}

void check_defects(const Defects& defects, Body body, double nominal_radius) {
  check_body(defects, body);
  if (body == Body::wheel && !defects.empty() && !(nominal_radius > 0.0))
    throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
  Defects::each(defects, [nominal_radius](const char* key, Body, const auto& list) {
    for (std::size_t i = 0; i < list.size(); ++i) check(list[i], nominal_radius, Shape(key, i));
  });
}

}  // namespace treadmark
