// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/cases/contact_digits.hpp"
#include "treadmark/io/cases/contact_text.hpp"

namespace treadmark::io {

/// Values of one sequence of cases that later cases may keep, already in SI units.
struct ContactSequence {
  bool started = false;
  int previous_normal = -1;              ///< N digit of the previous case
  bool tangential_history = false;       ///< a case with P = 0 has been run: previous tractions are not zero
  SolverInput solver;
  int max_elements = 20000;
  FrictionLaw friction;
  int friction_law = 0;                  ///< L digit that was read last
  bool has_material = false;
  SourcePosition material_where;
  Material material;                     ///< without layer
  struct Layer {
    bool given = false;
    double flexibility = 0.0;            ///< [m/Pa]
    bool elastic = true;
    double yield = 0.0;                  ///< TAU_C0 as written [MPa]
    SourcePosition where;
  } layer;
  struct Simplified {
    bool given = false;
    double k0 = 1.0, alpha = 1.0, beta = 1.0;
  } simplified;
  bool has_damping = false;

  WheelRailCase wheel_rail;
  int discretisation_method = 2;         ///< D digit that was read last
  bool has_rail = false, has_wheel = false;

  BasicCase basic;
  int potential_contact = 0;             ///< IPOTCN, 0 = not read yet
  bool has_rolling = false;
  HertzInput hertz;
  std::optional<GapInput> gap;
  long gap_elements = 0;                 ///< elements that a per-element gap belongs to
  bool has_extra_slip = false;
};

/// One case while it is read: the digits, the kept values and what turned out to be unsupported.
/// The grammar is read to the end before a refusal is thrown, so that skipped cases may contain anything.
struct ContactReader {
  ContactText& text;
  ContactSequence& kept;
  const std::filesystem::path& folder;   ///< of the input file
  int module;
  std::optional<ControlWord> problem, model, run;
  long damping = 0;                      ///< M2
  long weight = 0;                       ///< gapwgt
  SourcePosition damping_where;
  std::vector<std::string>& notes;
  std::vector<Error> refusals;

  void read_control_words();
  void refuse(const SourcePosition& where, std::string message, std::string advice = {});
  void note(std::string message);        ///< once per file

  void read_solver();
  void read_friction(long sets, bool with_position);
  void read_rolling();
  void read_material();
  void read_damping();
  void read_heat();
  void read_subsurface();
  Material effective_material();
};

/// The body of one case after its control words.
WheelRailCase read_wheel_rail(ContactReader& reader);
BasicCase read_basic(ContactReader& reader);

}  // namespace treadmark::io
