// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/io/cad/cad_messages.hpp"

namespace treadmark::io::cad {

/// Starts the program that holds OpenCASCADE, treadmark-opencascade. Errors: those of start_helper.
std::unique_ptr<Channel> start_opencascade(const std::string& file);

/// The faces of a CAD file, trimmed as it says. One thread. Errors of all: Error(input_data) where the program at the
/// other end breaks down, says nothing for two minutes, or what makes no sense. Cancelled within a tenth of a second.
class CadShape {
 public:
  /// Errors: Error(input_data) also for what OpenCASCADE finds wrong with the file.
  CadShape(std::unique_ptr<Channel> channel, const std::filesystem::path& file, bool iges);

  const std::string& unit() const { return unit_; }  ///< of the file, in its words
  int faces() const { return faces_; }
  const Point& low() const { return low_; }  ///< of a box round it [m]
  const Point& high() const { return high_; }
  /// See Question.
  std::vector<CadHit> last_hits(double least, const std::vector<CadLine>& lines) const;
  std::vector<Point> points_on(std::int64_t face) const;
  std::vector<CadEdgePoint> edges_of(std::int64_t face) const;
  bool unchanging(std::int64_t face, bool turned) const;
  std::string entity(std::int64_t face) const;
  /// why: left empty where there is a spline.
  CadSpline spline_of(std::int64_t face, const CadPart& part, std::string& why) const;
  CadTriangles triangles_of(const std::vector<std::int64_t>& faces, double deviation, double side) const;

 private:
  template <class Talk>
  auto ask(Talk talk) const;

  mutable std::unique_ptr<Channel> channel_;
  std::string file_, unit_;
  int faces_ = 0;
  Point low_{}, high_{};
};

/// Writes STEP. Errors: those of CadShape; Error(configuration) for what cannot be written.
void write_sheet(const std::filesystem::path& file, const CadSheet& sheet);

}  // namespace treadmark::io::cad
