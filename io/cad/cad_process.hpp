// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/cad/cad_messages.hpp"

namespace treadmark::io::cad {

/// A run of the program that holds OpenCASCADE, treadmark-opencascade. It ends with this object. One thread.
class CadProcess {
 public:
  /// file: for messages. Errors: Error(configuration) naming the places where the program was looked for.
  explicit CadProcess(std::string file);
  ~CadProcess();
  CadProcess(const CadProcess&) = delete;
  CadProcess& operator=(const CadProcess&) = delete;

  /// Calls talk(channel). Errors: Error(input_data) where the program breaks down or says nothing for two minutes.
  template <class Talk>
  auto ask(Talk talk) {
    try {
      return talk(channel_);
    } catch (const Broken&) {
      broke_down();
    }
  }

 private:
  [[noreturn]] void broke_down();

  std::string file_;
  int socket_ = -1;
  int process_ = -1;
  Channel channel_;
};

/// The faces of a CAD file, trimmed as it says.
class CadShape {
 public:
  /// Errors: those of CadProcess, and Error(input_data) for what OpenCASCADE finds wrong with the file.
  CadShape(const std::filesystem::path& file, bool iges);

  const std::string& unit() const { return unit_; }  ///< of the file, in its words
  int faces() const { return faces_; }
  const Point& low() const { return low_; }  ///< of a box round it [m]
  const Point& high() const { return high_; }
  /// See Question.
  std::vector<CadHit> hits(const Point& origin, const Point& direction) const;
  std::vector<Point> points_on(std::int64_t face) const;
  std::vector<Point> edges_of(std::int64_t face) const;
  bool unchanging(std::int64_t face, bool turned) const;
  std::string entity(std::int64_t face) const;

 private:
  mutable CadProcess process_;
  std::string unit_;
  int faces_ = 0;
  Point low_{}, high_{};
};

/// Writes STEP. Errors: those of CadProcess; Error(configuration) for what cannot be written.
void write_sheet(const std::filesystem::path& file, const CadSheet& sheet);

}  // namespace treadmark::io::cad
