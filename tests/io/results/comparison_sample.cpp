// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/results/comparison_sample.hpp"

#include <cmath>

#include "treadmark/tests/io/results/sample_run.hpp"

namespace treadmark::testing {

io::ComparisonRow sample_row(int case_number, double pmax_error) {
  io::ComparisonRow row;
  row.case_number = case_number;
  row.patches = 1;
  row.pmax = (0.8 + 0.2 * case_number) * 1e9 * (1.0 + pmax_error);
  row.fn = 125000.0;
  row.fx = 7499.0;
  row.fs = -1390.0;
  row.x_tr = 1e-4;
  row.y_tr = 0.7593304;
  row.approach = 1.08244e-4;
  row.area = 8.5e-5;
  row.ncon = 340;
  row.search_s = 0.004 * case_number;
  row.distance_s = 0.001;
  row.comparable = true;
  row.pmax_error = pmax_error;
  row.mean_pressure_error = 0.5 * pmax_error;
  row.area_error = -0.5 * pmax_error;
  row.approach_error = 0.25 * pmax_error;
  row.force_error = 0.1 * std::abs(pmax_error);
  row.position_error = 2e-3 * std::abs(pmax_error);
  return row;
}

namespace {

io::ComparisonCandidate candidate(const char* name, double resolution, double error) {
  io::ComparisonCandidate out;
  out.name = name;
  out.resolution = resolution;
  for (io::RepresentedBody* body : {&out.wheel, &out.rail}) {
    body->backend = name;
    body->resolution = resolution;
    body->build_seconds = body == &out.wheel ? 0.75 : 0.5;
    body->memory_bytes = body == &out.wheel ? 3000000 : 1000000;
  }
  for (int number = 1; number <= 4; ++number) {
    io::ComparisonRow row = sample_row(number, error * (number % 2 == 0 ? -1.0 : 0.5));
    io::CaseResult result;
    result.number = number;
    result.has_wheelset = true;
    result.pitch = -0.1 * number;
    if (number == 4) {
      row.comparable = false;
      row.status = result.status = Status::no_contact;
      row.patches = 0;
    } else {
      result.patches.push_back(ball_patch(20, 16, row.pmax));
      result.patches.back().fields.X_TC.origin.y() = row.y_tr;
    }
    out.rows.push_back(row);
    out.results.push_back(result);
  }
  return out;
}

}  // namespace

io::Comparison sample_comparison() {
  io::Comparison out;
  out.version = "0.2.0";
  out.git = "0123abc";
  out.threads = 2;
  out.seconds = 1.25;
  out.title = "Compared";
  out.input_file = "flat \"one\".toml";
  out.input_sha256 = "e3b0c442";
  out.geometry_sha256 = {{"a.prr", "11"}, {"b.slcw", "22"}};
  out.inputs = {{"track: gauge", "1435 mm"}, {"track: cant", "1:40"}};
  out.settings = {"resolution_mm=1", "bodies=both"};
  out.truth = "analytic <profiles> & flats";

  out.candidates.push_back(candidate("analytic", 0.0, 0.0));
  out.candidates.push_back(candidate("mesh", 1e-3, 0.2));
  out.candidates.push_back(candidate("mesh", 0.5e-3, 0.05));
  out.candidates.push_back(candidate("spline", 0.0, 0.0));
  io::ComparisonCandidate& coarse = out.candidates[1];
  coarse.wheel.difference = {4000, 0, 2.5e-6, 1e-6, 1.5e-3, 0.5e-3, 3.0, 1.0, 0.0, 0.0};
  coarse.rail.difference = {5000, 7, 4e-6, 0.8e-6, 1e-3, 0.25e-3, 2.0, 0.5, 0.0, 0.0};
  io::ComparisonCandidate& fine = out.candidates[2];
  fine.wheel.difference = {4000, 0, 0.625e-6, 0.25e-6, 0.75e-3, 0.25e-3, 1.5, 0.5, 0.0, 0.0};
  fine.wheel.note = "3 triangles mended";
  fine.rows[1].status = Status::not_converged;
  fine.rows[1].message = "the outer loop\nstopped";

  io::ComparisonCandidate failed;
  failed.name = "vdb";
  failed.resolution = 1e-3;
  failed.failure = "no \"grid\" <in> this\nbuild, \\ & so on";
  out.candidates.push_back(failed);
  return out;
}

}  // namespace treadmark::testing
