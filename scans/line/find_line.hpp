// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/scans/line/rail_line.hpp"
#include "treadmark/scans/placement/place.hpp"

namespace treadmark::scans {

/// A place of a line with how it bends and turns there, and the standard errors of that.
struct LineStation {
  double along = 0.0;    ///< [m]
  LineTurn turn, error;  ///< [1/m], [rad/m]
};

/// Part of a line without points.
struct LineGap {
  double from = 0.0, to = 0.0;  ///< [m]
};

/// Where the rail bends within less than its line's splines are long, so that it lies off the line.
struct LineKink {
  double from = 0.0, to = 0.0;  ///< [m]
  double off = 0.0;             ///< how far, beside and above, and at the head's side by a turn [m]
};

/// A step aside or back among points that were given, which go on as before behind it: what tracks of satellites have.
struct LineJump {
  double along = 0.0, size = 0.0;  ///< from the first point; how far they jump [m]
};

/// The line of a scanned rail.
struct FoundLine {
  RailLine line;
  bool bent = false;       ///< the points contradict a straight line; else it is straight
  double deviation = 0.0;  ///< farthest that the line lies from the straight one through it [m]
  double scatter = 0.0;    ///< of the rail's windows about the line, over what the noise of points explains
  double chosen = 0.0;     ///< length of the line's splines, 0: a straight line, or one that bends evenly [m]
  std::vector<LineStation> stations;
  std::vector<LineGap> gaps;    ///< longer than kLeastGap
  std::vector<LineKink> kinks;  ///< of more than 20 um, beyond what windows scatter by
};

inline constexpr double kLeastGap = 0.5;         ///< along the line that is told of [m]
inline constexpr double kLeastDeviation = 1e-6;  ///< from a straight line that matters [m]

/// The same as find_roughly of a piece of a long rail some 0.8 m long, in the scan's own unit, which is the one that is
/// given or the first in which a piece has the width of a rail. None: the rail is shorter than twice that, or no piece
/// looks like one.
/// whole: elements of all points. near: where to look first, in the scan's unit.
std::optional<RoughPlace> find_piece(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                     const SurfaceElements& whole, std::optional<LengthUnit> unit,
                                     const std::optional<Vec3>& near = {});

/// Finds the line of a rail. Windows along it are laid on the rail's section by robust steps (Tukey's biweight), from
/// the piece outwards, across gaps by the bend before them or along a given line; the windows' places and rolls then
/// fix splines from straight on over even bends to splines 1 m long, of which the one is chosen that the windows call
/// for beyond their own scatter (a penalty for each number of it, as by Schwarz 1978); and again, with points
/// straightened along it, until it stays. Shorter waves than that are deviations of the rail, not its line.
/// least_deviation: what deviates from straight
/// by less is straight [m], as how far passes lie off each other. points: [m]; piece: of them, in metres. given: a line
/// to follow, [m] in the cloud's frame. Deterministic. Errors: those of refine_axis; Error(input_data) where no line
/// can be followed.
FoundLine find_line(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const RoughPlace& piece,
                    const SurfaceElements& whole, const PlaceSettings& settings, const RailLine* given = nullptr,
                    double least_deviation = kLeastDeviation);

/// A smooth line along points in their order, for find_line to follow; nothing is known of its roll. Points that
/// scatter are evened out; jumps are not followed: what lies behind goes on from before it. up: out of the rail,
/// roughly. Errors: Error(input_data) for fewer than two points, all at one place, or turns of more than a right angle,
/// with the number of the point; for more than 20 km.
RailLine line_through(std::span<const Vec3> points, const Vec3& up, std::vector<LineJump>* jumps = nullptr);

}  // namespace treadmark::scans
