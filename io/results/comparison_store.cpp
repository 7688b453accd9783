// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_store.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/tables/hdf5_origin.hpp"

namespace treadmark::io {

namespace {

constexpr const char* kFormat = "treadmark comparison 1";

std::string group_name(std::size_t index) { return fmt::format("candidate_{:02}", index + 1); }

ComparisonCandidate read_candidate(const Hdf5GroupReader& group) {
  ComparisonCandidate c;
  c.name = group.text("name");
  c.resolution = group.number("resolution");
  c.failure = group.text("failure");
  c.results = read_cases(group);
  c.surfaces = read_surfaces(group);
  check_surface_names(group, c.results, c.surfaces);
  return c;
}

}  // namespace

void write_comparison_fields(const std::filesystem::path& path, const Comparison& comparison) {
  Hdf5Writer file(path);
  file.root().add(origin_attributes(kFormat, comparison));
  file.root().add(std::vector<Attribute>{
      {"axes", std::string(kAxes)}, {"truth", comparison.truth}, {"complete", comparison.complete ? 1 : 0}});
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
    const ComparisonCandidate& c = comparison.candidates[i];
    const Hdf5GroupWriter group = file.root().make_group(group_name(i));
    group.add(std::vector<Attribute>{{"name", c.name}, {"resolution", c.resolution}, {"failure", c.failure}});
    for (const CaseResult& result : c.results)
      write_case(group.make_group(fmt::format("case_{:04}", result.number)), result, CaseTimes::written);
    write_surfaces(group, c.surfaces);
  }
  file.commit();
}

Comparison read_comparison_fields(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  require_format(root, kFormat);
  Comparison out;
  read_origin(root, out);
  out.truth = root.text("truth");
  out.complete = root.integer("complete") != 0;
  for (std::string name = group_name(0); root.has(name); name = group_name(out.candidates.size()))
    out.candidates.push_back(read_candidate(root.open_group(name)));
  return out;
}

ComparedRow compared_row(const ComparisonCandidate& candidate, const ComparisonRow& row) {
  return {
      row, candidate.name, candidate.wheel.backend, candidate.rail.backend, candidate.resolution, digest(candidate)};
}

}  // namespace treadmark::io

namespace treadmark {
namespace {

using io::ComparedRow;
using C = io::ComparisonCandidate;
using B = io::RepresentedBody;
using R = io::ComparisonRow;
using D = io::CandidateDigest;
using S = SurfaceDifference;
using access::of;
using access::word;
using unit::kMm;
using unit::kN;
using unit::kOne;

constexpr FileUnit kUm{"um", 1e6, "m"}, kMrad{"mrad", 1e3, "rad"}, kPerM{"1/m"}, kS{"s"}, kBytes{"bytes"},
    kPerCent{"%", 1e2, "1"}, kMm2{"mm2", 1e6, "m2"};

/// Null for surfaces as given.
template <class Row>
constexpr Access<Row> resolution() {
  return {[](const Row& r) { return r.resolution == 0.0 ? kNaN : r.resolution; },
          [](Row& r, double v) { r.resolution = std::isnan(v) ? 0.0 : v; }};
}
/// How far a body is off, where that was measured.
template <double S::*number>
constexpr Access<B> off() {
  return {[](const B& b) { return b.difference.points > 0 ? b.difference.*number : kNaN; },
          [](B& b, double v) { b.difference.*number = v; }};
}
template <std::size_t S::*number>
constexpr Access<B> points() {
  return {[](const B& b) { return static_cast<double>(b.difference.*number); },
          [](B& b, double v) { b.difference.*number = to_whole<std::size_t>(v); }, nullptr, true};
}
template <auto number>
constexpr Access<ComparedRow> of_all() {
  return {[](const ComparedRow& r) { return static_cast<double>(r.all.*number); }};
}
/// Of the patch that carries most of the load.
template <double R::*number>
constexpr Access<ComparedRow> of_patch() {
  return {[](const ComparedRow& r) { return r.patches > 0 ? r.*number : kNaN; },
          [](ComparedRow& r, double v) { r.*number = v; }};
}
template <double R::*number>
constexpr Access<ComparedRow> time() {
  return {[](const ComparedRow& r) { return r.*number; }, [](ComparedRow& r, double v) { r.*number = v; }};
}
template <int R::*number>
constexpr Access<ComparedRow> count() {
  return {[](const ComparedRow& r) { return static_cast<double>(r.*number); }, nullptr, nullptr, true};
}
template <double R::*number>
constexpr Access<ComparedRow> error() {
  return {[](const ComparedRow& r) { return r.*number; }, [](ComparedRow& r, double v) { r.*number = v; },
          [](const ComparedRow& r) { return r.comparable; }};
}
constexpr Access<C> failure() {
  Access<C> access = of<&C::failure>();
  access.has = [](const C& c) { return !c.failure.empty(); };
  return access;
}

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<C> kCandidates[] = {
    {"backend", kOne, "", of<&C::name>(), "its name as asked for"},
    {"resolution_mm", kMm, "", resolution<C>()},
    {"failure", kOne, "", failure(), "why it could not be built or solved; absent where it could"}};

constexpr Column<B> kBodies[] = {
    {"backend", kOne, "", of<&B::backend>()},
    {"resolution_mm", kMm, "", resolution<B>(), "null: the data as given"},
    {"build_s", kS, "", of<&B::build_seconds>()},
    {"memory_bytes", kBytes, "", of<&B::memory_bytes>()},
    {"height_max_um", kUm, "", off<&S::height_max>(), "normal distance from the reference"},
    {"height_rms_um", kUm, "", off<&S::height_rms>()},
    {"slope_max_mrad", kMrad, "", off<&S::slope_max>(), "angle between the normals"},
    {"slope_rms_mrad", kMrad, "", off<&S::slope_rms>()},
    {"curvature_max_per_m", kPerM, "", off<&S::curvature_max>(), "mean curvature"},
    {"curvature_rms_per_m", kPerM, "", off<&S::curvature_rms>()},
    {"points", kOne, "", points<&S::points>(), "compared; 0: not measured, and the deviations are null"},
    {"missing", kOne, "", points<&S::missing>(), "points where the reference has a surface and this one has none"},
    {"note", kOne, "", of<&B::note>(), "repairs and limits"}};

constexpr Column<ComparedRow> kRows[] = {
    {"backend", kOne, "", of<&ComparedRow::backend>()},
    {"wheel_backend", kOne, "", of<&ComparedRow::wheel_backend>()},
    {"rail_backend", kOne, "", of<&ComparedRow::rail_backend>()},
    {"resolution_mm", kMm, "", resolution<ComparedRow>(), "null: the data as given"},
    {"case", kOne, "", count<&R::case_number>()},
    {"status", kOne, "", word(+[](const ComparedRow& r) { return std::string(to_string(r.status)); })},
    {"height_max_um", kUm, "", of_all<&D::height_max>(), "the worse of wheel and rail, as the next three"},
    {"height_rms_um", kUm, "", of_all<&D::height_rms>()},
    {"slope_max_mrad", kMrad, "", of_all<&D::slope_max>()},
    {"curvature_max_per_m", kPerM, "", of_all<&D::curvature_max>()},
    {"pmax_MPa", unit::kMPa, "", of_patch<&R::pmax>(), "of the patch that carries most of the load, as the quantities up to ncon"},
    {"fn_N", kN, "", of_patch<&R::fn>()},
    {"fx_N", kN, "", of_patch<&R::fx>()},
    {"fs_N", kN, "", of_patch<&R::fs>()},
    {"x_tr_mm", kMm, "", of_patch<&R::x_tr>()},
    {"y_tr_mm", kMm, "", of_patch<&R::y_tr>()},
    {"approach_mm", kMm, "", of_patch<&R::approach>()},
    {"area_mm2", kMm2, "", of_patch<&R::area>()},
    {"ncon", kOne, "", count<&R::ncon>(), "elements in contact"},
    {"patches", kOne, "", count<&R::patches>()},
    {"search_s", kS, "", time<&R::search_s>()},
    {"distance_s", kS, "", time<&R::distance_s>()},
    {"build_s", kS, "", of_all<&D::build_s>(), "wheel and rail together"},
    {"memory_bytes", kBytes, "", {[](const ComparedRow& r) { return static_cast<double>(r.all.memory_bytes); }, nullptr, nullptr, true}, "wheel and rail together"},
    {"mean_pressure_error_percent", kPerCent, "", error<&R::mean_pressure_error>(), "of fn over area; older files lack it"},
    {"pmax_error_percent", kPerCent, "", error<&R::pmax_error>(), "with its sign; null where the reference's largest pressure has no limit (edge_pressure). The errors exist only where candidate and reference have contact"},
    {"pmax_error_sigmas", kOne, "", error<&R::pmax_sigmas>(), "the same in standard deviations that the reference's is known to (case.error_bars); null where it is not; older files lack it"},
    {"area_error_percent", kPerCent, "", error<&R::area_error>()},
    {"approach_error_percent", kPerCent, "", error<&R::approach_error>()},
    {"force_error_percent", kPerCent, "", error<&R::force_error>(), "length of the difference of the forces of all patches, over the reference's"},
    {"position_error_mm", kMm, "", error<&R::position_error>(), "distance of the references in the track's x-y plane"}};
// clang-format on

}  // namespace

template <>
std::span<const Column<io::ComparisonCandidate>> columns() {
  return kCandidates;
}
template <>
std::span<const Column<io::RepresentedBody>> columns() {
  return kBodies;
}
template <>
std::span<const Column<io::ComparedRow>> columns() {
  return kRows;
}

}  // namespace treadmark
