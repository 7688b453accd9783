// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/numbers.hpp"

struct tm_contact_table {};

namespace {

constexpr const char* kTables = "tables of forces";

tm_status no_table(tm_contact_table** out) {
  return treadmark::c::make(out,
                            []() -> std::unique_ptr<tm_contact_table> { treadmark::left_out("vehicle", kTables); });
}

tm_status no_call() {
  return treadmark::c::guarded([] { treadmark::left_out("vehicle", kTables); });
}

}  // namespace

namespace treadmark::c {

std::span<const NamedNumber> motion_numbers() { return {}; }
std::span<const NamedNumber> force_numbers() { return {}; }

}  // namespace treadmark::c

extern "C" {

tm_status tm_table_create(const tm_pair*, const tm_case*, const char* const*, size_t, tm_contact_table** out) {
  return no_table(out);
}
tm_status tm_table_read(const char*, tm_contact_table** out) { return no_table(out); }
tm_status tm_table_write(const tm_contact_table*, const char*) { return no_call(); }
tm_status tm_table_copy(const tm_contact_table*, tm_contact_table** out) { return no_table(out); }
tm_status tm_table_evaluate(tm_contact_table*, const double*, size_t, double*, size_t) { return no_call(); }
const char* tm_table_message(const tm_contact_table*) { return ""; }
tm_status tm_table_error(const tm_contact_table*, const char*, double*, double*) { return no_call(); }
void tm_table_free(tm_contact_table* t) { delete t; }

}  // extern "C"
