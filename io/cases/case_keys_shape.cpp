// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/shared_keys.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;

/// Keys of wheel.shape or rail.shape.
class ShapeKeys {
 public:
  ShapeKeys(KeyList& list, std::string body, SurfaceSource W::*surface)
      : list_(list), prefix_(body + ".shape."), body_(std::move(body)), surface_(surface) {}

  void add() {
    add_geometry();
    add_file_options();
    if (body_ == "wheel") add_seam();
    add_offsets();
    KeyInfo backend = backend_key(body_ + ".backend",
                                  "surface representation: analytic, spline, nurbs, thb, thb-quadratic, mesh, "
                                  "mesh-flat, offset, offset-quadratic, offset-bilinear, chords or prismatic; "
                                  "without it the one that fits the shape");
