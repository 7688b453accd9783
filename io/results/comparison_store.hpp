// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/never_held.hpp"
#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::io {

/// Writes the fields of all candidates to one HDF5 file in SI units: /candidate_01 (the truth), /candidate_02 ..., each
/// with its cases as write_hdf5 writes them, and with surfaces where it has any; the layout is in docs/results.md. The
/// file appears only when complete. Errors: as write_hdf5. Not to be called from two threads at once.
void write_comparison_fields(const std::filesystem::path& path, const Comparison& comparison);

/// The comparison in such a file: what was compared, and of each candidate name, resolution, failure, cases with
/// fields, and surfaces. Its rows and bodies are in compare.json only. Errors: Error(input_data), as read_hdf5. Not to
/// be called from two threads at once.
Comparison read_comparison_fields(const std::filesystem::path& path);

/// Absent, a number (not finite = it does not exist), a count or a text.
using FieldValue = std::variant<std::monostate, double, std::int64_t, std::string, NeverHeld>;

/// A number of a struct: the name that the files give it, where it is, and the factor from SI to the unit of its name.
template <class Struct>
struct NamedNumber {
  std::string_view name;
  double Struct::*value;
  double factor = 1.0;
};

inline constexpr NamedNumber<SurfaceDifference> kDifferenceNumbers[] = {
    {"height_max_um", &SurfaceDifference::height_max, kMicro},
    {"height_rms_um", &SurfaceDifference::height_rms, kMicro},
    {"slope_max_mrad", &SurfaceDifference::slope_max, kMilli},
    {"slope_rms_mrad", &SurfaceDifference::slope_rms, kMilli},
    {"curvature_max_per_m", &SurfaceDifference::curvature_max},
    {"curvature_rms_per_m", &SurfaceDifference::curvature_rms}};

/// Of rows: of the patch that carries most of the load, of the case, and, of comparable rows only, errors.
inline constexpr NamedNumber<ComparisonRow> kRowPatchNumbers[] = {{"pmax_MPa", &ComparisonRow::pmax, kMega},
                                                                  {"fn_N", &ComparisonRow::fn},
                                                                  {"fx_N", &ComparisonRow::fx},
                                                                  {"fs_N", &ComparisonRow::fs},
                                                                  {"x_tr_mm", &ComparisonRow::x_tr, kMilli},
                                                                  {"y_tr_mm", &ComparisonRow::y_tr, kMilli},
                                                                  {"approach_mm", &ComparisonRow::approach, kMilli},
                                                                  {"area_mm2", &ComparisonRow::area, kMicro}};
inline constexpr NamedNumber<ComparisonRow> kRowTimes[] = {{"search_s", &ComparisonRow::search_s},
                                                           {"distance_s", &ComparisonRow::distance_s}};
inline constexpr NamedNumber<ComparisonRow> kRowErrors[] = {
    {"pmax_error_percent", &ComparisonRow::pmax_error, 1e2},
    {"area_error_percent", &ComparisonRow::area_error, 1e2},
    {"approach_error_percent", &ComparisonRow::approach_error, 1e2},
    {"force_error_percent", &ComparisonRow::force_error, 1e2},
    {"position_error_mm", &ComparisonRow::position_error, kMilli}};

/// As the errors; older files lack it.
inline constexpr NamedNumber<ComparisonRow> kMeanPressureError{"mean_pressure_error_percent",
                                                               &ComparisonRow::mean_pressure_error, 1e2};

/// Name with its unit, and the value in that unit: what the JSON and the CSV file say.
struct NamedField {
  std::string_view name;
  FieldValue value;
};

std::vector<NamedField> candidate_fields(const ComparisonCandidate& candidate);
std::vector<NamedField> body_fields(const RepresentedBody& body);

/// Always the same names in the same order. Errors of a row that is not comparable are absent.
std::vector<NamedField> row_fields(const ComparisonCandidate& candidate, const ComparisonRow& row);

}  // namespace treadmark::io
