// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/many.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::c {
namespace {

std::unique_ptr<tm_case> one_of(const io::CaseFile& file, int number, std::filesystem::path folder) {
  require(number >= 1 && static_cast<std::size_t>(number) <= file.cases.size(), "the file has no case of this number");
  const io::Case& chosen = file.cases[static_cast<std::size_t>(number) - 1];
  return std::make_unique<tm_case>(tm_case{std::make_shared<io::Case>(chosen), std::move(folder), true});
}

/// For changes: its own copy, no longer checked.
io::Case& changed(tm_case& c) {
  if (c.content.use_count() > 1) c.content = std::make_shared<io::Case>(*c.content);
  c.checked = false;
  return *c.content;
}

/// Whether the height of the wheelset follows from a force: rules ask for it.
bool height_is_found(const io::Case& c) {
  const auto* given = std::get_if<io::WheelRailCase>(&c.content);
  return given != nullptr && given->vertical_force_prescribed;
}

void require_scope(const tm_case& c, const CaseNumber& number) {
  if (number.key->info.scope != io::KeyScope::any &&
      static_cast<std::size_t>(number.key->info.scope) != 1 + c.content->content.index())
    throw Error(ErrorKind::configuration, fmt::format("{} does not belong to this kind of case", number.name));
}

}  // namespace

void set_number(tm_case& c, const CaseNumber& number, double value) {
  require_scope(c, number);
  io::CaseValue given;
  if (number.key->info.type == io::KeyType::integer) {
    if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::round(value))
      throw Error(ErrorKind::configuration, fmt::format("{} must be a whole number", number.name));
    given.data = to_whole<std::int64_t>(value);
  } else {
    given.data = value / number.si;
  }
  try {
    io::check_value(number.key->info, given);
  } catch (const Error& error) {
    if (number.si == 1.0) throw;
    throw Error(error.kind(), fmt::format("{} = {:g} {}: {}", number.name, value, number.unit, error.message()), {},
                fmt::format("here it is in {}", number.unit));
  }
  const bool checked = c.checked, found = height_is_found(*c.content);
  number.key->set(changed(c), given, c.folder);
  c.checked = checked && number.motion && height_is_found(*c.content) == found;
}

}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_case_create(int patch, tm_case** out) {
  return make(out, [&] {
    require(patch == 0 || patch == 1, "patch must be 0 or 1");
    auto content = std::make_shared<io::Case>(io::case_without_keys(patch == 1));
    content->number = 1;
    return std::make_unique<tm_case>(tm_case{std::move(content), {}, false});
  });
}

tm_status tm_case_read(const char* file, int number, tm_case** out) {
  return make(out, [&] {
    require(file != nullptr, "file must not be null");
    const std::filesystem::path path(file);
    return one_of(io::read_any_case(path), number, path.parent_path());
  });
}

tm_status tm_case_parse(const char* text, size_t length, const char* folder, int number, tm_case** out) {
  return make(out, [&] {
    require(text != nullptr || length == 0, "text must not be null");
    const std::filesystem::path path = folder == nullptr ? "" : folder;
    return one_of(io::parse_case_text(std::string_view(text, length), path / "text"), number, path);
  });
}

tm_status tm_case_copy(const tm_case* from, tm_case** out) {
  return make(out, [&] {
    require(from != nullptr, "from must not be null");
    return std::make_unique<tm_case>(*from);
  });
}

void tm_case_free(tm_case* c) { delete c; }

tm_status tm_case_text(const tm_case* c, char** toml) {
  if (toml != nullptr) *toml = nullptr;
  return guarded([&] {
    require(c != nullptr && toml != nullptr, "case and toml must not be null");
    io::CaseFile file;
    file.cases = {*c->content};
    *toml = lasting(io::case_file_text(file, c->folder));
  });
}

tm_status tm_case_set(tm_case* c, const char* assignment) {
  return guarded([&] {
    require(c != nullptr && assignment != nullptr, "case and assignment must not be null");
    auto copy = std::make_shared<io::Case>(*c->content);
    io::apply_assignment(*copy, io::parse_override(assignment), c->folder);
    c->content = std::move(copy);
    c->checked = false;
  });
}

tm_status tm_case_find_number(const char* name, int* id) {
  return guarded([&] {
    require(name != nullptr && id != nullptr, "name and id must not be null");
    const int found = case_number_named(name);
    require(found >= 0, "no number of cases has this name (tm_list names them)");
    *id = found;
  });
}

tm_status tm_case_set_number_by_id(tm_case* c, int id, double value) {
  return guarded([&] {
    require(c != nullptr, "case must not be null");
    require(id >= 0 && static_cast<std::size_t>(id) < case_numbers().size(), "no number of cases has this id");
    set_number(*c, case_numbers()[static_cast<std::size_t>(id)], value);
  });
}

tm_status tm_case_set_number(tm_case* c, const char* name, double value) {
  int id = -1;
  const tm_status found = tm_case_find_number(name, &id);
  return found == TM_OK ? tm_case_set_number_by_id(c, id, value) : found;
}

tm_status tm_case_get_number(const tm_case* c, const char* name, double* value) {
  return guarded([&] {
    require(c != nullptr && name != nullptr && value != nullptr, "case, name and value must not be null");
    const int id = case_number_named(name);
    require(id >= 0, "no number of cases has this name (tm_list names them)");
    const CaseNumber& number = case_numbers()[static_cast<std::size_t>(id)];
    require(static_cast<bool>(number.key->get), "this number cannot be asked for");
    require_scope(*c, number);
    *value = number.key->get(*c->content) * number.si;
  });
}

}  // extern "C"
