// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "treadmark/core/channel.hpp"

namespace treadmark::io::cad {

/// What Treadmark and the program that holds OpenCASCADE say to each other (core/helper_process.hpp).

using Point = std::array<double, 3>;  ///< [m]

inline constexpr int kMostFaces = 100'000;

struct CadLine {
  Point origin{}, direction{};  ///< [m]; a unit vector
};

/// Where a line meets a face.
struct CadHit {
  double t = 0.0;           ///< along the line [m]
  std::int64_t face = -1;   ///< counted from 0; -1: it meets none
  double u = 0.0, v = 0.0;  ///< parameters of the face
};

/// A point of an edge of a face.
struct CadEdgePoint {
  Point p{};                      ///< [m]
  std::int64_t round_a_hole = 0;  ///< 1: the edge belongs to an inner border of the face
};

/// What is wrong with a file; no message: nothing.
struct CadFault {
  std::string message = {}, advice = {};
};

/// A tensor one of model/shape/spline_surface.hpp: poles along u fastest.
struct CadSpline {
  std::int64_t degree_u = 3, degree_v = 3;
  std::vector<double> knots_u = {}, knots_v = {}, weights = {};
  std::vector<Point> poles = {};
};

/// Part of the parameters of a face.
struct CadPart {
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
};

/// Faces as triangles.
struct CadTriangles {
  std::string message = {};  ///< why there are none
  double deviation = 0.0;    ///< of the middle of a triangle from the face, normal to it [m]
  std::vector<Point> vertices = {};
  std::vector<std::array<std::int32_t, 3>> triangles = {};
  std::vector<std::int32_t> faces = {};  ///< of each triangle
};

/// A surface to be written: the curve of the poles of least u, extruded along x or turned about y, or all of it.
struct CadSheet {
  enum class Kind : std::int64_t { extruded, revolved, surface };
  Kind kind = Kind::surface;
  double from = 0.0, to = 0.0;  ///< extruded: x [m]; revolved: angle from +z towards +x [rad]
  std::string name = {}, description = {};
  CadSpline spline = {};
};

/// The questions; each is followed by what it is about, and answered.
enum class Question : std::int64_t {
  last_hits,     ///< least t [m], lines: of each the hit with the greatest t from there on
  points_on,     ///< face: some points inside of it
  edges_of,      ///< face: some points on each of its edges
  unchanging,    ///< face, whether turned: by its kind the same all round the y axis, or else all along x
  entity,        ///< face: number and kind of the entity of the file that it was made of
  spline_of,     ///< face, part of it that counts: why it is no B-spline there, or the spline
  triangles_of,  ///< faces, greatest deviation and length of sides [m]: CadTriangles
};

inline void put(Channel& c, const CadFault& fault) {
  c.put_list(fault.message);
  c.put_list(fault.advice);
}

inline CadFault take_fault(Channel& c) {
  CadFault fault;
  fault.message = c.take_list<std::string>();
  fault.advice = c.take_list<std::string>();
  return fault;
}

inline void put(Channel& c, const CadSpline& s) {
  c.put(s.degree_u);
  c.put(s.degree_v);
  c.put_list(s.knots_u);
  c.put_list(s.knots_v);
  c.put_list(s.weights);
  c.put_list(s.poles);
}

inline CadSpline take_spline(Channel& c) {
  CadSpline s;
  s.degree_u = c.take<std::int64_t>();
  s.degree_v = c.take<std::int64_t>();
  s.knots_u = c.take_list<std::vector<double>>();
  s.knots_v = c.take_list<std::vector<double>>();
  s.weights = c.take_list<std::vector<double>>();
  s.poles = c.take_list<std::vector<Point>>();
  return s;
}

}  // namespace treadmark::io::cad
