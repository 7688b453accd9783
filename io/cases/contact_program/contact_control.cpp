// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/contact_program/contact_case.hpp"

namespace treadmark::io {

std::filesystem::path resolve_name(const std::filesystem::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return (folder / name).lexically_normal();
}

void ContactReader::refuse(const SourcePosition& where, std::string message, std::string advice) {
  refusals.emplace_back(ErrorKind::configuration, std::move(message), where, std::move(advice));
}

Error ContactReader::refusal() const {
  const Error& first = refusals.front();
  std::string advice = first.advice();
  for (std::size_t i = 1; i < refusals.size(); ++i)
    advice +=
        fmt::format("{}also line {}: {}", advice.empty() ? "" : "; ", refusals[i].where().line, refusals[i].message());
  advice += fmt::format("{}docs/contact-input.md lists what is supported", advice.empty() ? "" : "; ");
  return Error(first.kind(), first.message(), first.where(), advice);
}

void ContactReader::note(std::string message) {
  if (std::find(notes.begin(), notes.end(), message) == notes.end()) notes.push_back(std::move(message));
}

void ContactReader::fail_at(const ControlWord& word, std::string_view keyword, std::string message,
                            std::string advice) const {
  const DigitValue& d = word.described(keyword);
  throw Error(ErrorKind::configuration, fmt::format("{} ({}) = {} {}", d.letter, d.keyword, word[keyword], message),
              word.where(keyword), std::move(advice));
}

void ContactReader::read_control_words() {
  problem.emplace(text, module, ControlWord::Name::problem);
  model.emplace(text, module, ControlWord::Name::model);
  damping = weight = 0;
  if (const auto second = text.optional_integer()) {
    damping_where = text.where();
    if (*second < 0) text.fail("the second integer of the line VLDCMZE must not be negative");
    damping = *second % 10;
    weight = *second / 10;
    if (weight > 2)
      text.fail(
          fmt::format("the weight of the contact reference (second integer of the line VLDCMZE / 10) is {}, but only "
                      "0, 1 (linear) and 2 (quadratic) exist",
                      weight));
  }
  run.emplace(text, module, ControlWord::Name::run);
  if ((*run)["XFLOW"] >= 1) {
    text.begin_record("the debug line PSFLCIN");
    text.integer("PSFLCIN");
    text.optional_integer();
  }

  for (const ControlWord* word : {&*problem, &*model, &*run})
    for (const std::string_view keyword : word->keywords()) {
      const DigitValue& d = word->described(keyword);
      if (d.support == DigitSupport::no)
        refuse(word->where(keyword),
               fmt::format("{} ({}) = {}, {}, is not supported", d.letter, d.keyword, (*word)[keyword], d.meaning),
               d.condition.empty() ? "" : fmt::format("use {}", d.condition));
    }
  if (module == 3 && damping >= 2)
    refuse(damping_where,
           fmt::format("M2 (second integer of the line VLDCMZE) = {}, damping, is not supported in module 3", damping),
           "use M2 = 0, or module 1");
  if (module == 3 && damping == 1 && kept.damping)
    refuse(damping_where, "M2 = 1, keep damping, is not supported in module 3", "use M2 = 0, or module 1");

  if (!kept.started && (*problem)["PVTIME"] != 2)
    note(fmt::format("P (PVTIME) = {} of the first case at {} is taken as 2: there is nothing to continue",
                     (*problem)["PVTIME"], problem->where("PVTIME").to_string()));
  const int solver = (*run)["GAUSEI"];
  if (solver >= 2)
    note(fmt::format("G (GAUSEI) = {}, {}: {}", solver, run->described("GAUSEI").meaning,
                     solver == 3 || solver == 5 ? "read, but the solver and its relaxation are Treadmark's own"
                                                : "its relaxation (OMEGAH, OMEGAS, OMGSLP) is read without effect"));
  if ((*run)["IESTIM"] > 0) note("I (IESTIM) > 0: initial estimates are not needed and ignored");
}

void ContactReader::read_solver() {
  const int method = (*run)["GAUSEI"];
  if (method == 1) return;
  text.begin_record("the line MAXGS");
  SolverSettings& s = kept.solver;
  const auto count = [&](std::string_view name) {
    const long value = text.integer(name);
    if (value < 0 || value > 1000000000) text.fail(fmt::format("{} = {} is not a number of iterations", name, value));
    return static_cast<int>(value);
  };
  s.max_iterations = count("MAXGS");
  s.max_outer = count("MAXIN");
  s.max_force = count("MAXNR");
  s.max_coupling = count("MAXOUT");
  s.eps = text.real("EPS");
  if (!(s.eps > 0.0)) text.fail("EPS must be positive");
  if (const auto elements = text.optional_integer())
    kept.max_elements = static_cast<int>(std::clamp(*elements, 100L, 1000000L));

  s.method = method == 2 ? SolverSettings::Method::sweeps : SolverSettings::Method::automatic;
  s.first_slip = SolverSettings::FirstSlip::last;
  if (method >= 2 && method <= 4) {
    text.begin_record(method == 4 ? "the line INISLP" : "the line OMEGAH");
    if (method != 4)
      for (const auto name : {"OMEGAH", "OMEGAS"}) text.real(name);
    const long first = text.integer("INISLP");
    if (method != 3 && first != 0)
      s.first_slip = first > 0 ? SolverSettings::FirstSlip::below : SolverSettings::FirstSlip::above;
    text.real("OMGSLP");
  } else if (method == 5) {
    text.begin_record("the line FDECAY");
    for (const auto name : {"FDECAY", "BETATH"}) text.real(name);
    text.integer("KDOWFB");
    for (const auto name : {"D_IFC", "D_LIN", "D_CNS", "D_SLP", "POW_S"}) text.real(name);
  }
}

HistoryUse ContactReader::history() const {
  return kept.has_history ? kHistories[(*problem)["PVTIME"]] : HistoryUse::start;
}

}  // namespace treadmark::io
