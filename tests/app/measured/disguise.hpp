// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::testing {

/// A section of known shape: a standard profile, worn by a formula.
struct BaseShape {
  const char* name;
  Body body;
  std::function<std::vector<Vec2>()> points;  ///< every 0.02 mm, y growing [mm], z down
  const char* true_shape;  ///< name of the shape that it would be, measured in full; a cut rail is 60E1
};
const std::vector<BaseShape>& base_shapes();
const BaseShape& base_shape(const std::string& name);

/// How an instrument and its user write a section down. Lengths in mm unless the name says otherwise.
struct Disguise {
  enum class Reader { columns, miniprof, simpack, gensys };
  enum class Order { along, backwards, doubled };
  enum class Encoding { utf8, with_mark, utf16, latin1 };
  Reader reader = Reader::columns;
  double in_mm = 1.0;  ///< one unit of the file
  std::string unit = "mm";
  bool unit_said = false;
  Order order = Order::along;
  bool mirrored = false, up = false;
  std::string header;  ///< "", "y z", "x z" ...
  std::string count;   ///< "", "263", "263 2": %n stands for the number
  std::string delimiter = " ";
  bool decimal_comma = false, in_brackets = false;
  std::string minus = "-";
  Encoding encoding = Encoding::utf8;
  std::string line_end = "\n";
  double step = 0.2;
  double shift_y = 0.0, shift_z = 0.0;
  double tilt_deg = 0.0;
  double low = -1e3, high = 1e3;  ///< of y: what was measured
  double noise = 0.0, rounded = 1e-4;
  double spike = 0.0;        ///< height of one point
  std::string nothing;       ///< text in place of z in four lines
  bool at_the_ends = false;  ///< those four
};

/// The file, and the ending of its name.
struct DisguisedFile {
  std::string ending, bytes;
};
DisguisedFile disguised(const BaseShape& base, const Disguise& how, std::uint64_t seed);

/// One trial of the list: what is made of which shape.
struct DisguiseTrial {
  const BaseShape* base = nullptr;
  Disguise how;
  std::string words;  ///< for messages
};
DisguiseTrial disguise_trial(std::uint64_t number);

}  // namespace treadmark::testing
