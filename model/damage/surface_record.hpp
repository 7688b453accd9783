// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// Cells on the own surface of a wheel or rail: columns along u (x of a rail [m], theta of a wheel [rad]), rows along
/// the profile coordinate y [m]. Cell (i, j) lies round (u0 + i du, y0 + j dy). Of a wheel that is the same all round
/// there is one column of a whole turn, of a rail that is the same everywhere one column of one metre.
struct SurfaceCells {
  Body body = Body::rail;
  double u0 = 0.0, du = 1.0;  ///< [m] or [rad]
  int nu = 1;
  double y0 = 0.0, dy = 1e-3;  ///< [m]
  int ny = 0;
  /// Of every row: radius of the wheel, 1 of a rail; NaN where there is no surface.
  std::vector<double> radius;

  /// One column that stands for all.
  bool uniform() const { return nu == 1; }
  /// Whether the last column joins the first.
  bool closed() const { return body == Body::wheel; }
  /// Whether there is surface in a row.
  bool exists(int j) const { return j >= 0 && j < ny && std::isfinite(radius[static_cast<std::size_t>(j)]); }
  /// Number of the column that one beyond the ends is; of a rail it stays outside.
  int wrapped(int i) const { return closed() ? (i % nu + nu) % nu : i; }
  double y(int j) const { return y0 + j * dy; }
  double u(int i) const { return u0 + i * du; }
  /// Of the projection along which depth is removed [m2].
  double area(int j) const { return du * dy * radius[static_cast<std::size_t>(j)]; }
};

/// Values of cells, row by row; rows that nothing has touched take no memory.
class CellSheet {
 public:
  explicit CellSheet(int nu = 1) : nu_(nu) {}

  double at(int i, int j) const {
    const auto row = rows_.find(j);
    return row == rows_.end() ? 0.0 : row->second.at(static_cast<std::size_t>(i));
  }
  /// A value to be changed; makes the row. References to other rows stay.
  double& ref(int i, int j) {
    std::vector<double>& row = rows_[j];
    if (row.empty()) row.resize(static_cast<std::size_t>(nu_), 0.0);
    return row.at(static_cast<std::size_t>(i));
  }
  double sum() const;
  /// The largest value above 0, else 0.
  double largest() const;
  int nu() const { return nu_; }
  /// By their number, increasing.
  const std::map<int, std::vector<double>>& rows() const { return rows_; }
  std::map<int, std::vector<double>>& rows() { return rows_; }
  std::size_t memory_bytes() const { return rows_.size() * static_cast<std::size_t>(nu_) * sizeof(double); }

 private:
  int nu_;
  std::map<int, std::vector<double>> rows_;
};

/// What points at a depth below the cells have endured, the largest of all passages [Pa].
struct StressRecord {
  explicit StressRecord(int nu = 1);

  CellSheet von_mises;
  CellSheet shear;      ///< amplitude on the plane where it is largest
  CellSheet shakedown;  ///< shear yield that residual stresses need to keep a passage elastic
  CellSheet dang_van;   ///< shear round the middle of the passage and weighted hydrostatic stress
};

/// What has flowed at a depth below the cells.
struct FlowRecord {
  explicit FlowRecord(int nu = 1);

  CellSheet strain;  ///< shear that passages have added up [-]
};

/// What contacts have done to the points of a surface.
struct SurfaceRecord {
  /// Of so many columns, stresses at so many depths and flow at so many.
  explicit SurfaceRecord(int nu = 1, std::size_t depths = 0, std::size_t flow_depths = 0);

  CellSheet volume;       ///< removed, negative: raised [m3]
  CellSheet work;         ///< of friction [J]
  CellSheet sliding;      ///< distance [m]
  CellSheet passages;     ///< of contacts over the cell
  CellSheet pressure;     ///< largest [Pa]
  CellSheet traction;     ///< largest [Pa]
  CellSheet t_gamma;      ///< largest of the contacts that passed [N]
  CellSheet fi_surf;      ///< largest surface fatigue index above 0 of the contacts that passed [-]
  CellSheet damage;       ///< sum over passages by their T gamma [-]
  CellSheet temperature;  ///< largest above 0 [deg C]
  std::vector<StressRecord> stresses;
  std::vector<FlowRecord> flow;
  double volume_by_law = 0.0;     ///< sum of what the law takes from the elements of the contacts [m3]
  double work_of_contacts = 0.0;  ///< sum over the power that the contacts state [J]

  /// Of all sheets.
  std::size_t memory_bytes() const;
};

/// One row a sheet of a record: its name in files, its unit, and whether contacts add to it or the largest value stays.
template <class Record>
struct SheetRow {
  CellSheet Record::*sheet;
  const char *name, *unit, *meaning;
  bool summed;
};
inline constexpr SheetRow<SurfaceRecord> kSheets[] = {
    {&SurfaceRecord::volume, "volume", "m3", "removed from the cell, negative: raised", true},
    {&SurfaceRecord::work, "work", "J", "of friction in the cell", true},
    {&SurfaceRecord::sliding, "sliding", "m", "distance, mean over the cell", true},
    {&SurfaceRecord::passages, "passages", "1", "of contacts over the cell", true},
    {&SurfaceRecord::pressure, "pressure", "Pa", "largest", false},
    {&SurfaceRecord::traction, "traction", "Pa", "largest", false},
    {&SurfaceRecord::t_gamma, "t_gamma", "N", "largest of the contacts that passed", false},
    {&SurfaceRecord::fi_surf, "fi_surf", "1", "largest surface fatigue index above 0", false},
    {&SurfaceRecord::damage, "damage", "1", "sum over passages by their T gamma", true},
    {&SurfaceRecord::temperature, "temperature", "degC", "largest above 0", false}};
inline constexpr SheetRow<StressRecord> kStressSheets[] = {
    {&StressRecord::von_mises, "von_mises", "Pa", "largest", false},
    {&StressRecord::shear, "shear", "Pa", "largest amplitude of all planes", false},
    {&StressRecord::shakedown, "shakedown", "Pa", "largest shear yield that shakedown needs", false},
    {&StressRecord::dang_van, "dang_van", "Pa", "largest shear and weighted hydrostatic stress", false}};
inline constexpr SheetRow<FlowRecord> kFlowSheets[] = {
    {&FlowRecord::strain, "strain", "1", "shear that passages have added up", true}};

}  // namespace treadmark
