// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/io/results/write_json.hpp"

namespace treadmark::c {
namespace {

io::PatchResult& patch_of(tm_solution* s, std::size_t patch) {
  io::CaseResult& result = result_of(s);
  require(patch < result.patches.size(), "there is no patch of this index");
  return result.patches[patch];
}

template <class Result>
double value_of(const Result& result, const ResultNumber<Result>* number) {
  require(number != nullptr, "no number of results has this name (tm_list names them)");
  const io::Quantity<Result>& row = *number->row;
  return io::has_block(result, row.block) && row.has(result) ? row.access.get(result)
                                                             : std::numeric_limits<double>::quiet_NaN();
}

void give(const Pose& pose, double* origin, double* rotation) {
  for (int i = 0; i < 3; ++i) {
    if (origin != nullptr) origin[i] = pose.origin[i];
    for (int k = 0; rotation != nullptr && k < 3; ++k) rotation[3 * i + k] = pose.rotation(i, k);
  }
}

const std::vector<Remark>& remarks_of(const tm_solution& s) { return s.pair ? s.pair->remarks : s.result->remarks; }

struct Row {
  const char *name, *unit, *meaning;
};

template <class Rows>
Row row_at(const Rows& rows, std::size_t i) {
  require(i < rows.size(), "the table has no such row");
  return {rows[i].name.c_str(), rows[i].unit.c_str(), rows[i].meaning.c_str()};
}

/// Texts of a table that is not made of strings that end with a zero.
const std::vector<NamedNumber>& fields() {
  static const std::vector<NamedNumber> rows = [] {
    std::vector<NamedNumber> all;
    for (const io::FieldColumn& column : io::kFieldColumns)
      all.push_back({std::string(column.name), std::string(column.unit), std::string(column.meaning)});
    return all;
  }();
  return rows;
}

}  // namespace

io::CaseResult& result_of(tm_solution* s) {
  require(s != nullptr, "solution must not be null");
  if (!s->result) s->result = app::to_result(std::get<io::WheelRailCase>(s->input->content), *s->pair);
  return *s->result;
}

}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_solution_status(const tm_solution* s) {
  Status status = Status::ok;
  const tm_status asked = guarded([&] {
    require(s != nullptr, "solution must not be null");
    status = s->pair ? s->pair->status : s->result->status;
  });
  return asked == TM_OK ? status_of(status) : asked;
}

const char* tm_solution_message(const tm_solution* s) {
  return s == nullptr ? "" : s->pair ? s->pair->message.c_str() : s->result->message.c_str();
}

size_t tm_solution_remarks(const tm_solution* s) { return s == nullptr ? 0 : remarks_of(*s).size(); }

tm_status tm_solution_remark(const tm_solution* s, size_t i, const char** name, const char** text, int* patch,
                             int* grave) {
  for (const char** text_of : {name, text})
    if (text_of != nullptr) *text_of = nullptr;
  return guarded([&] {
    require(s != nullptr, "solution must not be null");
    require(i < remarks_of(*s).size(), "there is no remark of this index");
    const Remark& remark = remarks_of(*s)[i];
    if (name != nullptr) *name = remark.row().name.data();  // a literal
    if (text != nullptr) *text = remark.text.c_str();
    if (patch != nullptr) *patch = remark.patch;
    if (grave != nullptr) *grave = remark.grave() ? 1 : 0;
  });
}

tm_status tm_solution_number(tm_solution* s, const char* name, double* value) {
  return guarded([&] {
    require(name != nullptr && value != nullptr, "name and value must not be null");
    *value = value_of(result_of(s), solution_number_named(name));
  });
}

tm_status tm_solution_pose(tm_solution* s, tm_body body, double origin[3], double rotation[9]) {
  return guarded([&] {
    const io::CaseResult& result = result_of(s);
    const Body which = body_of(body);
    if (!result.bodies) throw Error(ErrorKind::configuration, "the solution has no wheel and rail");
    give(which == Body::wheel ? result.bodies->X_TA : result.bodies->X_TS, origin, rotation);
  });
}

size_t tm_solution_patches(const tm_solution* s) {
  return s == nullptr ? 0 : s->pair ? s->pair->patches.size() : s->result->patches.size();
}

tm_status tm_patch_number(tm_solution* s, size_t patch, const char* name, double* value) {
  return guarded([&] {
    require(name != nullptr && value != nullptr, "name and value must not be null");
    *value = value_of(patch_of(s, patch), patch_number_named(name));
  });
}

tm_status tm_patch_grid(tm_solution* s, size_t patch, int* nx, int* ny, double* x0, double* y0, double* dx,
                        double* dy) {
  return guarded([&] {
    const Grid2& grid = patch_of(s, patch).fields.grid;
    if (nx != nullptr) *nx = grid.nx;
    if (ny != nullptr) *ny = grid.ny;
    if (x0 != nullptr) *x0 = grid.x0;
    if (y0 != nullptr) *y0 = grid.y0;
    if (dx != nullptr) *dx = grid.dx;
    if (dy != nullptr) *dy = grid.dy;
  });
}

tm_status tm_patch_pose(tm_solution* s, size_t patch, double origin[3], double rotation[9]) {
  return guarded([&] { give(patch_of(s, patch).fields.X_TC, origin, rotation); });
}

tm_status tm_patch_field(tm_solution* s, size_t patch, const char* name, const double** values) {
  if (values != nullptr) *values = nullptr;
  return guarded([&] {
    require(name != nullptr && values != nullptr, "name and values must not be null");
    const auto* column = ranges::find(io::kFieldColumns, std::string_view(name), &io::FieldColumn::name);
    require(column != std::end(io::kFieldColumns), "no field has this name (tm_list names them)");
    const std::vector<double>& field = patch_of(s, patch).fields.*(column->values);
    *values = field.empty() ? nullptr : field.data();
  });
}

tm_status tm_patch_states(tm_solution* s, size_t patch, const uint8_t** states) {
  if (states != nullptr) *states = nullptr;
  return guarded([&] {
    require(states != nullptr, "states must not be null");
    const std::vector<std::uint8_t>& all = patch_of(s, patch).fields.state;
    *states = all.empty() ? nullptr : all.data();
  });
}

void tm_solution_free(tm_solution* s) { delete s; }

tm_status tm_list(tm_table table, size_t i, const char** name, const char** unit, const char** meaning) {
  for (const char** text : {name, unit, meaning})
    if (text != nullptr) *text = nullptr;
  return guarded([&] {
    Row row{};
    switch (table) {
      case TM_CASE_NUMBERS:
        row = row_at(case_numbers(), i);
        break;
      case TM_SOLUTION_NUMBERS:
        row = row_at(result_numbers<io::CaseResult>(), i);
        break;
      case TM_PATCH_NUMBERS:
        row = row_at(result_numbers<io::PatchResult>(), i);
        break;
      case TM_PATCH_FIELDS:
        row = row_at(fields(), i);
        break;
      case TM_MOTION_NUMBERS:
        row = row_at(motion_numbers(), i);
        break;
      case TM_FORCE_NUMBERS:
        row = row_at(force_numbers(), i);
        break;
      default:
        require(false, "there is no such table");
    }
    if (name != nullptr) *name = row.name;
    if (unit != nullptr) *unit = row.unit;
    if (meaning != nullptr) *meaning = row.meaning;
  });
}

tm_status tm_run(const char* file, const char* const* assignments, size_t n, char** json) {
  if (json != nullptr) *json = nullptr;
  Status worst = Status::ok;
  const tm_status status = guarded([&] {
    require(file != nullptr, "file must not be null");
    const io::CaseFile cases = io::read_any_case(file, texts_of(assignments, n, "assignments must be n texts"));
    const io::RunResult run = app::run_cases(cases, callers_progress());
    if (!run.complete) throw Cancelled();
    if (json != nullptr) *json = lasting(io::to_json(run));
    for (const io::CaseResult& result : run.cases) worst = std::max(worst, result.status);
  });
  return status == TM_OK ? status_of(worst) : status;
}

void tm_text_free(char* text) { std::free(text); }

}  // extern "C"
