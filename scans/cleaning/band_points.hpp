// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/model/shape/profile.hpp"
#include "treadmark/scans/placement/section.hpp"

namespace treadmark::scans {

/// The unrolled running band of a wheel or rail: a along the track or circumference (radius times theta) [m], s along
/// the section [m]. d is the distance from the section along its normal, > 0 out of the material.
struct Band {
  Body body = Body::rail;
  double radius = 1.0;  ///< wheel: nominal radius, which turns angles into lengths; rail: 1
  Section section;
  double a_min = 0.0, a_max = 0.0;
  bool closed = false;  ///< a wheel all round: a_max is a_min again

  double length() const { return a_max - a_min; }
};

enum class PointState : std::uint8_t { used, held_out, outlier, off_band };

/// Of the surface, also where the fit is tested by it.
inline bool is_of_surface(PointState state) { return state == PointState::used || state == PointState::held_out; }

/// Points on a band, sorted into even cells: row after row of equal a, in a row by s.
struct BandPoints {
  std::vector<float> a, s, d;        ///< a counts from the band's a_min
  std::vector<std::uint32_t> index;  ///< in the cloud
  std::vector<PointState> state;
  std::size_t rows = 0, columns = 0;  ///< cells along a, along s
  double cell_a = 0.0, cell_s = 0.0;
  std::size_t halvings_a = 0,
              halvings_s = 0;        ///< of the coarsest intervals that splines begin with (fit/) down to cells
  std::vector<std::uint32_t> begin;  ///< of cell row * columns + column; one more at the end
  /// Of the points of the cloud, where these are a part of all: chance goes by them. Empty: their places in the cloud.
  /// They lie elsewhere.
  std::span<const std::uint32_t> numbers;

  std::uint32_t number(std::size_t i) const { return numbers.empty() ? index[i] : numbers[index[i]]; }
  std::size_t size() const { return d.size(); }
  std::size_t first(std::size_t row, std::size_t column) const { return begin[row * columns + column]; }
};

/// Where every point lies on the band; what became of those that are on none.
struct Projection {
  Band band;
  BandPoints points;
  std::size_t beyond_section = 0;  ///< beside the section's ends, or where it is too steep to be seen from outside
  std::size_t far_off = 0;         ///< farther than `farthest` above or below it
  std::size_t beyond_length = 0;   ///< past the ends of the band, where hardly any points are
};

/// The coarsest intervals of cells along a band, or some of them in a row.
struct BandIntervals {
  double from = 0.0, step = 0.0;  ///< where the first begins; of one [m]
  std::size_t count = 0;
};

/// Those of a projection.
BandIntervals intervals_of(const Projection& projection);

struct ProjectSettings {
  Body body = Body::rail;
  double radius = 1.0;
  double farthest = 8e-3;  ///< from the section, more than any damage is deep [m]
  double finest = 1e-3;    ///< size that cells come near to [m]
  /// A part of a band that is known, open at both ends, whose cells are the band's own; it may have few points or none.
  std::optional<BandIntervals> part = {};
};

/// points: [m] in the cloud's frame; keep: flags or empty. The ends of the band are where the points end; a wheel is
/// closed unless they leave out more of the circumference than its lines are apart. Errors: Error(input_data) if fewer
/// than 1000 points lie on the band.
Projection project(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const Pose& X_CS,
                   const Section& section, const ProjectSettings& settings);

}  // namespace treadmark::scans
