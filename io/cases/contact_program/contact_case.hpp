// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/cases/contact_program/contact_digits.hpp"
#include "treadmark/io/cases/contact_program/contact_text.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

/// Values of one sequence of cases that later cases may keep, already in SI units.
struct ContactSequence {
  int number = 0;            ///< in the order in which the sequences appear in the file
  bool started = false;      ///< a case has been read
  bool has_history = false;  ///< a case has been read that is to be computed
  bool step_noted = false;   ///< a rolling step that does not fit the positions has been noted
  int previous_normal = -1;  ///< N digit of the previous case
  SolverSettings solver;
  int max_elements = 20000;

  struct Friction {
    int law = 0;                        ///< L digit
    int variation = 0;                  ///< V digit it was read with
    std::vector<double> positions;      ///< V = 1, 2: [rad], [m]
    std::vector<FrictionLaw> laws{{}};  ///< V = 0: one
    FrictionVariation by_place() const;
  } friction;

  bool has_material = false;
  SourcePosition material_where;
  Material material;  ///< elastic constants only
  std::optional<double> sheet_flexibility;
  struct Viscoelastic {
    double creep_ratio_1 = 0.0, creep_ratio_2 = 0.0, relaxation_time_1 = 0.0, relaxation_time_2 = 0.0;
  };
  std::optional<Viscoelastic> viscoelastic;
  struct Layer {
    double flexibility = 0.0;             ///< [m/Pa]
    double yield = 0.0, hardening = 0.0;  ///< [Pa], [Pa/m]; yield 0 = elastic
    double written_yield = 0.0;           ///< TAU_C0 [MPa]
    SourcePosition where;
  };
  std::optional<Layer> layer;
  std::optional<FastsimSettings> simplified;  ///< but for its flexibility
  std::optional<double> simplified_flexibility;
  InfluenceInput influence;
  std::optional<Thermal> thermal;
  SubsurfaceInput subsurface;
  std::optional<Damping> damping;

  WheelRailCase wheel_rail;
  /// Of lines whose meaning depends on digits; a case takes what its own digits ask for. SI units.
  std::optional<double> roller_radius, roller_pitch_rate, forward_velocity, pitch_rate, longitudinal_force;
  std::optional<RailSprings> rail_springs;
  int discretisation_method = 2;  ///< D digit that was read last
  bool has_rail = false, has_wheel = false;

  BasicCase basic;
  int potential_contact = 0;  ///< IPOTCN, 0 = not read yet
  bool has_rolling = false;
  HertzInput hertz;
  std::optional<GapInput> gap;
  PlanformInput planform;
  long gap_elements = 0;  ///< elements that a per-element gap belongs to
  /// Extra rigid slip as written: [-], with a shift [mm].
  std::vector<double> extra_slip_x, extra_slip_y;
  SpinSlip spin_slip = SpinSlip::both;
};

/// One case while it is read: the digits, the kept values and what turned out to be unsupported.
/// The grammar is read to the end before a refusal is thrown, so that skipped cases may contain anything.
struct ContactReader {
  ContactText& text;
  ContactSequence& kept;
  const std::filesystem::path& folder;  ///< of the input file
  int module;
  std::optional<ControlWord> problem, model, run;
  long damping = 0;  ///< M2
  long weight = 0;   ///< gapwgt
  SourcePosition damping_where;
  std::vector<std::string>& notes;
  std::vector<Error> refusals;

  void read_control_words();
  void refuse(const SourcePosition& where, std::string message, std::string advice = {});
  Error refusal() const;           ///< the first of them, which also tells about the others
  void note(std::string message);  ///< once per file

  bool on_roller() const { return (*problem)["CONFIG"] >= 4; }  ///< module 1

  void read_solver();
  /// sets: friction laws that follow, with their positions if V = 1, 2.
  void read_friction(long sets);
  void read_rolling();
  void read_influence();
  void read_material();
  void read_damping();
  void read_heat();
  void read_subsurface();

  /// What the case uses of the kept values; Error where something was never given.
  Material effective_material();
  void put_simplified_theory(TangentialModel& model, FastsimSettings& fastsim) const;
  std::optional<Thermal> effective_heat() const;
  SubsurfaceInput effective_subsurface() const;
  HistoryUse history() const;
  [[noreturn]] void fail_at(const ControlWord& word, std::string_view keyword, std::string message,
                            std::string advice = {}) const;
};

/// A file name of the input, with / or \\, relative to folder.
std::filesystem::path resolve_name(const std::filesystem::path& folder, std::string name);

/// Potential contact area, undeformed distance and planform of a basic case.
void read_potential_contact(ContactReader& reader);
void read_gap(ContactReader& reader);

/// Profile line of a wheel-rail case, 'file' MIRRORY SCALE SMOOTH [MIRRORZ [PRFOPT]], and the lines that PRFOPT
/// announces.
SurfaceSource read_profile(ContactReader& reader, std::string_view body);
/// Track or roller, and the wheelset; then what the digits take of their motion.
void read_track(ContactReader& reader);
void read_wheelset(ContactReader& reader);
void put_motion(ContactReader& reader, WheelRailCase& to);

/// P digits of HistoryUse and L digits of FrictionLaw::Kind, in the order of the enumerators; what a P digit keeps.
inline constexpr int kHistoryDigits[] = {2, 0, 1, 3}, kLawDigits[] = {0, 2, 3, 4, 6};
inline constexpr HistoryUse kHistories[] = {HistoryUse::keep_going, HistoryUse::normal_only, HistoryUse::start,
                                            HistoryUse::same_instant};

/// What a D digit asks for, in the conventions of such files; and the digit of a case.
void put_discretisation(WheelRailCase& to, int digit, int max_elements);
int discretisation_digit(const WheelRailCase& c);

/// The body of one case after its control words.
WheelRailCase read_wheel_rail(ContactReader& reader);
BasicCase read_basic(ContactReader& reader);

}  // namespace treadmark::io
