// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/point_cloud.hpp"

namespace treadmark::app {

struct Clouds {
  PointCloud cloud;                      ///< of all files, in their unit; passes filled where there are several
  std::optional<LengthUnit> unit;        ///< if the files say it, all the same
  std::optional<LengthUnit> usual_unit;  ///< usual in files of this format, if they do not
  std::string reference;                 ///< coordinate system of the Earth that a file names; empty: none
};

/// Reads all files into one cloud, without points that stand for "no data" (a value like -9999 that many share, far
/// from all others). Fills inputs, points_read and what was not finite into the report.
/// Errors: those of the readers; Error(input_data) for files in different units.
Clouds read_clouds(const ImportRequest& request, io::ImportReport& report, const Progress& progress);

/// Why points are left out whose coordinate says that there is none.
inline constexpr const char* kNoData = "no data";

/// Passes over all points of files that are too large for the memory, some at a time, in their order. One thread.
class CloudWalk {
 public:
  explicit CloudWalk(const ImportRequest& request) : request_(request) {}

  /// First: an even share of the points, about `most` of them at most; all where there are no more. Fills the report
  /// as read_clouds does; what was left out counts in the sample. Errors: those of read_clouds.
  Clouds sample(std::size_t most, io::ImportReport& report, const Progress& progress);
  /// Of the points one was in the sample out of so many.
  std::size_t one_in() const { return one_in_; }

  /// Then, as often as it is wanted: all points that the sample would have had, were it all, in the unit of the files.
  void all(const std::function<void(PointCloud& batch)>& take, const Progress& progress);

 private:
  io::Scan walk(std::size_t file, const std::function<void(PointCloud&)>& take, const Progress& progress) const;
  void number_passes(std::size_t file, std::span<std::uint16_t> passes);

  const ImportRequest& request_;
  std::size_t one_in_ = 1;
  std::vector<bool> several_;  ///< passes, a file
  std::vector<std::pair<Eigen::Index, double>> no_data_;
  std::map<std::pair<std::size_t, std::uint16_t>, std::uint16_t> pass_number_;
};

}  // namespace treadmark::app
