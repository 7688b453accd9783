// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/detector.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/law_keys.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/model/damage/fatigue.hpp"
#include "treadmark/model/damage/flow_law.hpp"
#include "treadmark/model/damage/named_laws.hpp"
#include "treadmark/model/damage/wear_law.hpp"
#include "treadmark/model/remarks.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/defects.hpp"

namespace treadmark::cli {

namespace {

void print_left_out(std::string_view name, std::string_view part) {
  std::cout << name << " - left out of this build: " << left_out_advice(part) << '\n';
}

/// A row a profile, columns apart.
void print_profiles() {
  constexpr const char* kRow = "{:<14} {:<5} {:>6} {:>6} {:>6} {:>6}  {}\n";
  std::cout << fmt::format(kRow, "name", "body", "height", "width", "area", "mass", "from; shape; other names");
  std::cout << fmt::format(kRow, "", "", "mm", "mm", "cm2", "kg/m", "");
  const auto number = [](double value, double unit, int digits) {
    return value > 0.0 ? fmt::format("{:.{}f}", value / unit, digits) : std::string("-");
  };
  for (const LibraryProfile& p : profile_library())
    print(fmt::format(kRow, p.name, body_name(p.body), number(p.height, 1e-3, 1), number(p.width, 1e-3, 1),
                      number(p.area, 1e-4, 2), number(p.mass_per_m, 1.0, 2),
                      fmt::format("{}; {}{}{}", p.source, p.shape, p.also.empty() ? "" : "; ", p.also)));
}

/// The tables of case files that damage a surface, with their keys.
void print_defects() {
  Defects::each(Defects{}, [](std::string_view path, Body, const auto&) {
    const auto keys = io::case_keys();
    const auto list = ranges::find_if(keys, [path](const io::CaseKey& key) { return key.info.path == path; });
    std::string names;
    for (const io::KeyInfo& key : list->info.elements)
      names += fmt::format("{}{}{}", names.empty() ? "" : ", ", key.path, key.required ? " (required)" : "");
    print(fmt::format("{:<29}  {}\n{:<29}  keys: {}\n", path, list->info.doc, "", names));
  });
}

/// What can be listed.
struct ListedKind {
  const char* name;
  const char* meaning;
};
constexpr ListedKind kListed[] = {{"backends", "representations of surfaces"},
                                  {"defects", "damage of wheels and rails that cases can ask for, with its keys"},
                                  {"detectors", "of contact between two surfaces"},
                                  {"laws", "of wear, flow and fatigue, and published numbers, for evolve and assess"},
                                  {"profiles", "of wheels and rails that are built in"},
                                  {"remarks", "warnings in results, with their level"},
                                  {"solvers", "theories of contact"},
                                  {"verbs", "of this program"}};

int list_command(const std::string& what) {
  if (what.empty()) {
    for (const ListedKind& kind : kListed)
      std::cout << fmt::format("treadmark list {:<10}{}\n", kind.name, kind.meaning);
  } else if (what == "backends") {
    for (const auto name : backend_names()) std::cout << name << '\n';
    for (const Backend* backend : left_out_backends()) print_left_out(backend->name, backend->part);
  } else if (what == "detectors") {
    for (const detection::DetectorRow* row : detection::detectors())
      print(fmt::format("{:<11}  {}\n", row->name, row->summary));
  } else if (what == "defects") {
    print_defects();
  } else if (what == "profiles") {
    print_profiles();
  } else if (what == "solvers") {
    print(theory_list());
  } else if (what == "verbs") {
    for (const Verb& verb : verbs())
      if (verb.part == nullptr || has_part(verb.part))
        std::cout << verb.name << '\n';
      else
        print_left_out(verb.name, verb.part);
  } else if (what == "remarks") {
    for (const RemarkRow& row : kRemarkRows)
      print(fmt::format("{:<24} {:<13}  {}\n", row.name, row.grave ? "warning" : "minor warning", row.meaning));
  } else if (what == "laws") {
    const auto print_row = [](const auto& row) {
      print(fmt::format("{:<15}  {}\n{:<15}  source: {}\n{:<15}  for: {}\n{:<15}  needs: {}\n", row.word, row.name, "",
                        row.source, "", row.validity, "", row.keys));
    };
    for (const WearTheoryRow& row : kWearTheories) print_row(row);
    for (const FlowTheoryRow& row : kFlowTheories) print_row(row);
    for (const FatigueMeasureRow& row : fatigue_measures()) print_row(row);
    for (const NamedLaw& law : named_laws())
      print(fmt::format("{:<15}  {}: {}\n{:<15}  source: {}\n{:<15}  for: {}\n{:<15}  verified: {}\n", law.name,
                        law.kind(), io::numbers_of(law), "", law.source, "", law.validity, "",
                        law.verified ? "yes" : "no"));
  } else {
    std::vector<std::string> names;
    for (const ListedKind& kind : kListed) names.emplace_back(kind.name);
    throw Error(ErrorKind::configuration, "cannot list '" + what + "'", {}, advice_on_name(what, names));
  }
  return kOk;
}

}  // namespace

Command add_list(CLI::App& verb) {
  auto what = std::make_shared<std::string>();
  verb.add_option("WHAT", *what,
                  "backends, defects, detectors, laws, profiles, remarks, solvers or verbs; without it what there is");
  return [what](const CommonOptions&) { return list_command(*what); };
}

}  // namespace treadmark::cli
