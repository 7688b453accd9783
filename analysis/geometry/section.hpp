// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::geometry {

/// Height and inclination of a section at one place.
struct SectionPoint {
  double z = 0.0;          ///< [m]
  double slope = 0.0;      ///< dz/dy [-]
  double curvature = 0.0;  ///< [1/m], positive for a convex body
};

/// A lateral section as a graph z(y), z down, at equal steps with its slopes; cubic between them (Hermite). NaN where
/// there is no surface. Wheel: z is the radius. Immutable, safe to use from any number of threads.
class Section {
 public:
  /// y of the first sample and the step [m] > 0; z [m] and slopes, of one size >= 2. Errors: Error(configuration).
  Section(Body body, double first, double step, std::vector<double> z, std::vector<double> slope);

  Body body() const { return body_; }
  double step() const { return step_; }
  double first() const { return first_; }           ///< [m]
  double last() const { return y(z_.size() - 1); }  ///< [m]
  std::size_t size() const { return z_.size(); }
  double y(std::size_t i) const { return first_ + static_cast<double>(i) * step_; }  ///< of a sample [m]
  const std::vector<double>& z() const { return z_; }                                ///< [m]
  const std::vector<double>& slope() const { return slope_; }                        ///< [-]

  /// The same section with so much added to all z [m].
  Section raised(double dz) const;

  /// The same section with so much added to all y [m].
  Section shifted(double dy) const;

  /// Outside of the section and in its gaps NaN.
  SectionPoint at(double y) const;
  /// The height alone, linear between the samples [m].
  double height(double y) const {
    const double t = (y - first_) * per_step_;
    if (!(t >= 0.0) || t > last_index_) return kNone;
    const std::size_t i = t < last_index_ ? to_whole<std::size_t>(t) : z_.size() - 2;
    return z_[i] + (t - static_cast<double>(i)) * (z_[i + 1] - z_[i]);
  }

  friend bool operator==(const Section&, const Section&) = default;

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Body body_;
  double first_, step_, per_step_, last_index_;
  std::vector<double> z_, slope_;
};

inline constexpr double kSectionStep = 0.05e-3;  ///< of what is sampled from surfaces [m]

/// The section of a wheel that is lowest at this pitch [rad] (0: its material angle theta = 0), over the wheel's own y;
/// z is the radius. Errors: Error(input_data) where the wheel has no surface there.
Section wheel_section(const Surface& wheel, double pitch = 0.0);

/// The section of a rail at x [m], turned to the track's axes by its inclination towards the track's centre [rad],
/// about its origin. Errors as above.
Section rail_section(const Surface& rail, double cant, double x = 0.0);

/// Where a rail is held by the gauge.
struct RailTop {
  double z_top = 0.0;    ///< least z [m]
  double y_top = 0.0;    ///< where it is [m]
  double y_gauge = 0.0;  ///< innermost point down to the gauge height; NaN where the section does not reach so deep [m]
};
/// gauge_height: below the top [m].
RailTop rail_top(const Section& rail, double gauge_height);

/// Marks of a wheel's section.
struct WheelMarks {
  double tip_y = 0.0, tip_z = 0.0;  ///< greatest radius on the flange's side; NaN without a flange [m]
  double tape_z = 0.0;              ///< radius at y = 0; NaN where the section does not reach it [m]
  /// y of the flange's face 10 mm below the tape line; NaN where there is none [m]
  double face_y = 0.0;
  /// y between the flange's tip and its face where it is inclined by 45 degrees: a contact beyond has climbed over it.
  /// NaN without a flange [m]
  double climb_y = 0.0;
};
WheelMarks wheel_marks(const Section& wheel);

/// Why a section cannot be that of its body ("it looks like a rail"), empty where it can.
std::string wrong_body(const Section& section);

}  // namespace treadmark::geometry
