// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::io::scans {

/// A value of each record: what ASTM E2807 calls a terminal of the prototype.
struct E57Field {
  enum class Kind { single, real, integer, scaled, text };
  std::string name;  ///< empty: within a structure, and not looked at
  Kind kind = Kind::real;
  std::int64_t least = 0, most = 0;  ///< of integers, before they are scaled
  double scale = 1.0, offset = 0.0;

  /// Bits of a record.
  unsigned bits() const;
};

/// What the XML says of one scan.
struct E57Scan {
  double quaternion[4] = {1.0, 0.0, 0.0, 0.0};  ///< w x y z
  Vec3 translation = Vec3::Zero();
  bool has_pose = false;
  std::uint64_t file_offset = 0, records = 0;
  std::vector<E57Field> fields;
};

struct E57Layout {
  std::vector<E57Scan> scans;
  std::string reference;  ///< a coordinate system of the Earth that the file names (coordinateMetadata)
};

/// Takes the XML of an E57 file piece by piece. Keeps what tells where the points are. Error(input_data) with line and
/// column within the XML.
class E57Xml {
 public:
  explicit E57Xml(std::string file);
  ~E57Xml();
  E57Xml(const E57Xml&) = delete;
  E57Xml& operator=(const E57Xml&) = delete;

  void feed(std::string_view piece, bool last);
  E57Layout& layout();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace treadmark::io::scans
