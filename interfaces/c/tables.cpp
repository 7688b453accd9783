// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/table/force_tables.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/io/cases/validate_case.hpp"

struct tm_contact_table {
  explicit tm_contact_table(treadmark::app::MadeTable from)
      : made(std::make_shared<const treadmark::app::MadeTable>(std::move(from))), table(made->table) {}

  std::shared_ptr<const treadmark::app::MadeTable> made;
  treadmark::vehicle::ForceTable table;
  std::string message;  ///< of the last evaluation
};

namespace treadmark::c {
namespace {

/// The rows of a table that programs give or get, in their order.
template <class Row>
std::vector<NamedNumber> named_numbers() {
  std::vector<NamedNumber> all;
  all.reserve(columns<Row>().size());
  for (const Column<Row>& column : columns<Row>())
    all.push_back({std::string(column.stored), std::string(column.unit.si), std::string(column.meaning)});
  return all;
}

}  // namespace

std::span<const NamedNumber> motion_numbers() {
  static const auto rows = named_numbers<vehicle::WheelMotion>();
  return rows;
}

std::span<const NamedNumber> force_numbers() {
  static const auto rows = named_numbers<vehicle::WheelForces>();
  return rows;
}

}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_table_create(const tm_pair* p, const tm_case* c, const char* const* settings, size_t n,
                          tm_contact_table** out) {
  return make(out, [&] {
    require(p != nullptr && c != nullptr, "pair and case must not be null");
    const app::TableRequest request =
        app::table_request(io::given_settings(texts_of(settings, n, "settings must be n texts")));
    require(request.overrides.empty(), "settings of a table are no keys of cases: use tm_case_set");
    io::validate_case(*c->content);
    const std::optional<io::ContentCache> cache = io::ContentCache::from_environment();
    return std::make_unique<tm_contact_table>(
        app::make_table(*c->content, p->geometry, request, cache ? &*cache : nullptr, callers_progress()));
  });
}

tm_status tm_table_read(const char* file, tm_contact_table** out) {
  return make(out, [&] {
    require(file != nullptr, "file must not be null");
    return std::make_unique<tm_contact_table>(app::read_table(file));
  });
}

tm_status tm_table_write(const tm_contact_table* t, const char* file) {
  return guarded([&] {
    require(t != nullptr && file != nullptr, "table and file must not be null");
    app::write_table(file, *t->made);
  });
}

tm_status tm_table_copy(const tm_contact_table* from, tm_contact_table** out) {
  return make(out, [&] {
    require(from != nullptr, "from must not be null");
    return std::make_unique<tm_contact_table>(*from);
  });
}

tm_status tm_table_evaluate(tm_contact_table* t, const double* motion, size_t n_motion, double* forces,
                            size_t n_forces) {
  Status end = Status::ok;
  const tm_status status = guarded([&] {
    require(t != nullptr && motion != nullptr && forces != nullptr, "table, motion and forces must not be null");
    const auto given = columns<vehicle::WheelMotion>();
    const auto wanted = columns<vehicle::WheelForces>();
    require(n_motion <= given.size() && n_forces <= wanted.size(),
            "there are not so many numbers (tm_list names them)");
    vehicle::WheelMotion asked;
    for (std::size_t i = 0; i < n_motion; ++i) given[i].access.put(asked, motion[i]);
    const vehicle::WheelForces found = t->table.at(asked);
    end = found.reaction.status;
    t->message = found.reaction.message;
    for (std::size_t i = 0; i < n_forces; ++i) forces[i] = wanted[i].access.get(found);
  });
  return status == TM_OK ? status_of(end) : status;
}

const char* tm_table_message(const tm_contact_table* t) { return t == nullptr ? "" : t->message.c_str(); }

tm_status tm_table_error(const tm_contact_table* t, const char* number, double* worst, double* rms) {
  return guarded([&] {
    require(t != nullptr && number != nullptr, "table and number must not be null");
    const auto& check = t->made->table.check();
    require(check.has_value(), "the table was compared with nothing");
    const auto found = ranges::find(check->errors, number, &vehicle::TableError::number);
    require(found != check->errors.end(), "no number of a table that is compared has this name (docs/tables.md)");
    if (worst != nullptr) *worst = found->worst;
    if (rms != nullptr) *rms = found->rms;
  });
}

void tm_table_free(tm_contact_table* t) { delete t; }

}  // extern "C"
