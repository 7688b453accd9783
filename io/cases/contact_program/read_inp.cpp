// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_program/read_inp.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/combination_rules.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/sha256.hpp"

namespace treadmark::io {

namespace {

void check_first_case(const ContactReader& r) {
  const ControlWord& model = *r.model;
  if (model["FRCLAW"] == 1)
    throw Error(ErrorKind::configuration, "L (FRCLAW) = 1 in the first case: there is no friction law to keep",
                model.where("FRCLAW"), "use L = 0 and give FSTAT, FKIN");
  if (model["DISCNS"] <= 1)
    throw Error(ErrorKind::configuration,
                fmt::format("D (DISCNS) = {} in the first case: there is no discretisation to keep", model["DISCNS"]),
                model.where("DISCNS"), "use D = 2");
}

/// The digit that a contradiction is about.
SourcePosition where_of(const ContactReader& r, CaseSetting setting) {
  const bool rail = r.module == 1;
  switch (setting) {
    case CaseSetting::regime:
      return r.problem->where("TANG");
    case CaseSetting::normal_model:
      return r.problem->where("BOUND");
    case CaseSetting::load:
      return r.problem->where("NORM");
    case CaseSetting::subsurface:
      return r.problem->where("STRESS");
    case CaseSetting::friction:
      return r.model->where("FRCLAW");
    case CaseSetting::influence:
      return r.model->where("INFLCF");
    case CaseSetting::material:
      return r.model->where("MATER");
    case CaseSetting::geometry:
      return r.model->where(rail ? "ZTRACK" : "RZNORM");
    case CaseSetting::extra_slip:
      return r.model->where("EXRHS");
    case CaseSetting::grid:
      return r.model->where("DISCNS");
    case CaseSetting::heat:
      return r.run->where("HEAT");
    case CaseSetting::reference_surface:
      return r.model->where("DISCNS");
    case CaseSetting::force:
      return r.problem->where("FORCE");
    case CaseSetting::elastic_constants:
      return r.kept.material_where;
    case CaseSetting::layer:
      return r.kept.layer->where;
  }
  return {};
}

/// read: the cases so far. Steps that are too long are noted only, as the reference program runs them.
void refuse_contradictions(ContactReader& r, const Case& c, const std::vector<Case>& read) {
  for (const Contradiction& one : contradictions(c)) r.refuse(where_of(r, one.setting), one.message, one.advice);
  const auto previous =
      std::find_if(read.rbegin(), read.rend(), [&](const Case& p) { return p.sequence == c.sequence; });
  if (previous == read.rend()) return;
  for (const Contradiction& one : contradictions(*previous, c))
    r.refuse(where_of(r, one.setting), one.message, one.advice);
  if (const std::string doubt = doubt_about_history(*previous, c); !doubt.empty() && !r.kept.step_noted) {
    r.kept.step_noted = true;
    r.note(fmt::format("{}: {}", c.where.to_string(), doubt));
  }
}

/// Lines "%treadmark key = value", with the keys of case files.
void apply_own_settings(ContactText& text, Case& c, const std::filesystem::path& folder) {
  for (const ContactText::OwnSetting& one : text.take_own_settings()) {
    try {
      CaseOverride setting = parse_override(one.text);
      setting.value.where = one.where;
      if (setting.path == "case.steps" || setting.path == "case.time_step_s")
        throw Error(ErrorKind::configuration, setting.path + " makes cases while a .toml file is read", one.where);
      apply_assignment(c, setting, folder);
    } catch (const Error& e) {
      throw Error(e.kind(), e.message(), one.where, e.advice());
    }
  }
}

}  // namespace

CaseFile parse_contact_input(std::string_view content, const std::filesystem::path& name) {
  CaseFile result;
  result.path = name;
  result.sha256 = sha256_hex(content);
  result.title = name.stem().string();
  const std::filesystem::path folder = name.parent_path();
  ContactText text(content, name.string());
  // Cases with the same module and the same result element form a sequence, within which values are kept.
  std::map<std::tuple<long, long, long>, ContactSequence> sequences;

  long module = 0, element = 1, patch = 1;
  int number = 0;
  bool module_line = true;
  while (true) {
    SourcePosition where;
    if (module_line) {
      if ((text.drop_line(), text.at_end())) {
        if (number == 0) text.fail("the file contains no case");
        result.notes.emplace_back("the file ends without the closing line '0 MODULE'");
        return result;
      }
      text.begin_record("the module line");
      module = text.integer("MODULE");
      where = text.where();
      if (module == 0) break;
      if (module != 1 && module != 3) text.fail(fmt::format("MODULE = {} does not exist: expected 0, 1 or 3", module));
      element = text.optional_integer().value_or(1);
      patch = text.optional_integer().value_or(1);
    }
    const auto [place, fresh] = sequences.try_emplace({module, element, patch});
    ContactSequence& kept = place->second;
    if (fresh) kept.number = static_cast<int>(sequences.size()) - 1;
    ContactReader reader{text, kept, folder, static_cast<int>(module), {}, {}, {}, 0, 0, {}, result.notes, {}};
    reader.read_control_words();
    if (!module_line) where = reader.problem->where(module == 1 ? "CONFIG" : "PVTIME");
    if (!kept.started) check_first_case(reader);

    Case next;
    next.number = ++number;
    where.column = 1;
    next.where = where;
    next.sequence = kept.number;
    next.element_table = (*reader.run)["MATFIL"];
    next.shown = (*reader.run)["OUTPUT"] != 0;
    if (module == 1)
      next.content = read_wheel_rail(reader);
    else
      next.content = read_basic(reader);
    kept.started = true;
    apply_own_settings(text, next, folder);

    const int ending = (*reader.run)["RETURN"];
    if (ending <= 1) {
      kept.has_history = true;
      refuse_contradictions(reader, next, result.cases);
      if (!reader.refusals.empty()) throw reader.refusal();
      result.cases.push_back(std::move(next));
    }
    module_line = ending % 2 == 1;
  }
  return result;
}

CaseFile read_contact_input(const std::filesystem::path& file) { return parse_contact_input(read_text(file), file); }

}  // namespace treadmark::io
