// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/model/vehicle/assessment.hpp"
#include "treadmark/model/vehicle/driving.hpp"
#include "treadmark/model/vehicle/flexible_track.hpp"
#include "treadmark/model/vehicle/free_run.hpp"
#include "treadmark/model/vehicle/irregularities.hpp"
#include "treadmark/model/vehicle/track_layout.hpp"
#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::io {

/// What a simulation file asks for: plain data in SI units, every value filled in.

/// How the force of one wheel is found.
enum class ContactModelInput {
  full,       ///< the contact problem itself, at every instant
  table,      ///< a table of solutions made beforehand
  automatic,  ///< the table where it agrees with the contact problem, else that
};
/// Their words.
inline constexpr std::array<std::string_view, 3> kContactModels{"full", "table", "auto"};

/// Creep forces of wheels whose contact is a table.
enum class CreepForcesInput {
  shen_hedrick_elkins,  ///< Kalker's coefficients, saturated
  exact_table,          ///< a table of solutions of the exact theory
};

/// One wheel of the vehicle and its contact.
struct WheelContactInput {
  int wheelset = 0;  ///< from 0, the leading one
  Side side = Side::left;
  ContactModelInput model = ContactModelInput::table;
  bool defects = false;         ///< false: the wheel is round
  std::optional<double> pitch;  ///< of the wheelset at the start, the same for both its wheels [rad]; none: 0
  /// Of a full contact: from and to which place along the rail, from a table elsewhere; none: without end [m].
  std::optional<double> full_from, full_to;

  /// Whether it is a full contact somewhere and one from a table elsewhere.
  bool changes_over() const { return full_from || full_to; }
};

/// Instants at which the fields within the contact patches are kept.
struct FieldRequests {
  std::vector<double> pitch;     ///< where a wheelset passes one of these angles, in each revolution [rad]
  std::vector<double> position;  ///< distance travelled [m]
};

/// A point of a body whose accelerations are written down.
struct PointInput {
  std::string name;
  PointKind kind = PointKind::car_body;
  std::string body;
  Vec3 arm = Vec3::Zero();  ///< from the body's centre of mass [m]
};

/// What a history holds.
struct HistoryRequest {
  std::vector<std::string> channels;  ///< patterns (io/histories/channels.hpp); none: everything
  SourcePosition channels_where;
  std::vector<PointInput> points;
  double axle_box_y = 1.0;  ///< of the points of axle boxes, to both sides of the wheelset's middle [m]
  double gravity = 9.81;    ///< that instruments feel as their bodies lean [m/s2]
};

/// A rail that holds the backs of flanges.
struct CheckRailInput {
  Side side = Side::left;
  double from = 0.0, to = 0.0;                            ///< along the rail [m]
  double face_y = 0.0;                                    ///< from the middle of the track [m]
  double depth = 0.01;                                    ///< below the rail tops [m]
  double stiffness = 0.0, damping = 0.0, friction = 0.3;  ///< [N/m], [N s/m], [-]
  double flare_length = 0.0, flare = 0.0;                 ///< [m]
};

/// A file that belongs to a simulation, for its record.
struct NamedFile {
  std::filesystem::path path;
  std::string sha256;  ///< hex
};

/// Equal vehicles that follow in a train.
struct TrainPart {
  NamedFile file;                    ///< of one of them; empty: as the leading vehicle
  int count = 1;                     ///< of such vehicles
  double behind = 0.0;               ///< place of x = 0 behind that of the vehicle before [m]
  std::vector<std::string> between;  ///< coupled bodies: of the vehicle before, and of this one
  CouplerSpec coupler;               ///< position: in the vehicle before
};

/// How far and how exactly a simulation goes.
struct SimulationSettings {
  double speed = 0.0;              ///< at the start [m/s]; > 0
  SpeedProfile profile;            ///< begins with it; one point: constant
  double distance = 0.0;           ///< travelled in the whole simulation [m]; > 0
  double duration = 0.0;           ///< [s]
  double gravity = 9.81;           ///< [m/s2]
  double tolerance = 1e-7;         ///< local error of displacements in a step [m]
  std::optional<double> max_step;  ///< [s]
  double min_step = 1e-9;          ///< [s]
  /// Largest distance travelled in a step, over dx; not given: 1 for transient rolling, else 2.
  double max_step_elements = 2.0;
  double from_midspan = 0.0;     ///< of a flexible track: place of x = 0 at the start from the middle of a bay [m]
  bool shared_rails = false;     ///< of a flexible track: one below all wheels of a side, else one below each wheel
  double rail_start = 0.0;       ///< place of the leading wheelset along the rails at the start [m]
  double spectral_radius = 0.8;  ///< of the time integration at infinite frequency, 0.5 ... 1
  CreepForcesInput creep_forces = CreepForcesInput::shen_hedrick_elkins;
  ContactModelInput contact = ContactModelInput::table;  ///< of wheels that are not named
  /// What a table may be wrong by where the contact is chosen: of forces over the normal force, of wear numbers over
  /// that of the full contact.
  double force_error = 0.03, wear_error = 0.1;
  double checkpoint = 10.0;   ///< time of the computer between two checkpoints [s]
  double output_every = 0.0;  ///< distance between two lines of output [m]; 0 = every step

  /// The longest step that max_step and max_step_elements allow, elements of length dx [s].
  double longest_step(double dx) const;
};

/// Everything in a simulation file and in the files that it names.
struct SimulationFile {
  std::filesystem::path path;
  std::string sha256;  ///< of the simulation file itself, hex
  std::string title;
  SimulationSettings settings;
  FieldRequests fields;
  HistoryRequest history;
  std::optional<AssessmentRequest> assessment;
  VehicleModel vehicle;  ///< of a train: all its vehicles
  NamedFile vehicle_file;
  std::vector<TrainPart> train;                 ///< behind the leading vehicle
  std::optional<TrackModel> track;              ///< none: rigid track, or a flexible one
  std::optional<FlexibleTrack> flexible_track;  ///< then there is no other one
  std::optional<NamedFile> track_file;
  std::optional<TrackLayout> layout;  ///< none: a straight without end
  double rail_gauge = 1.435;          ///< at which the rails lie where the line has it [m]
  double start = 0.0;                 ///< place of the vehicle's x = 0 on the line when the simulation begins [m]
  std::optional<IrregularitySpec> irregularities;  ///< none: the rails lie as the line says
  std::optional<NamedFile> irregularity_file;
  /// Bodies and settings of the contact. What the simulation itself finds (side, loads, positions, history) has no
  /// meaning here; nominal radius, velocity and pitch rate are those of the leading wheelset that rolls at the speed.
  WheelRailCase contact;
  std::optional<SurfaceSource> other_wheel;  ///< shape of wheels without defects, where `contact.wheel` cannot be it
  std::optional<SurfaceSource> left_rail, right_rail;  ///< instead of `contact.rail`, which is none of them if both are
  std::optional<SurfaceSource> table_rail;             ///< of one section, below tables on rails that vary
  std::vector<AxleTorque> torques;                     ///< motors and brakes
  std::vector<BodyForce> forces;                       ///< from outside
  std::optional<FreeRun> free_run;                     ///< the speeds of settings.profile follow from it; none: given
  std::vector<SpringMotion> spring_motions;
  std::vector<RailShift> rail_shifts;  ///< those of the twist, too
  std::optional<TwistTest> twist;
  std::vector<WheelContactInput> wheels;  ///< all of them: left and right of the leading wheelset, then the next one
  std::vector<CheckRailInput> check_rails;
  std::vector<std::string> notes;  ///< information on what was read or assumed

  /// The rail of a side, as a right-hand one.
  const SurfaceSource& rail(Side side) const {
    const std::optional<SurfaceSource>& own = side == Side::left ? left_rail : right_rail;
    return own ? *own : contact.rail;
  }
  /// Nominal radius of the wheels of a wheelset, from 0 [m]. Wheelsets with that of the leading one have the very
  /// number of `contact`.
  double wheel_radius(int wheelset) const {
    const double own = vehicle.wheelsets.at(static_cast<std::size_t>(wheelset)).nominal_radius;
    return own == vehicle.wheelsets.front().nominal_radius ? contact.wheelset.nominal_radius : own;
  }
};

}  // namespace treadmark::io
