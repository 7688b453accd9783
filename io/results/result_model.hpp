// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/model/contact/friction.hpp"
#include "treadmark/model/contact/material.hpp"
#include "treadmark/model/origin.hpp"
#include "treadmark/model/remarks.hpp"
#include "treadmark/model/shape/surface_difference.hpp"

namespace treadmark::io {

/// What the head of a `.mat` text file says beyond the patch itself. The digits are those of CONTACT's control words;
/// SI units.
struct MatFileHead {
  double time = 0.0;                                   ///< [s]
  double s_ws = 0.0, pitch_ws = 0.0;                   ///< wheelset along the track [m], pitch angle [rad]
  double rail_y = 0.0, rail_z = 0.0, rail_roll = 0.0;  ///< rail marker in track axes [m], [rad]
  double roller_radius = 0.0;                          ///< [m], 0 = track
  double wheel_x = 0.0, wheel_y = 0.0, wheel_z = 0.0;  ///< wheel marker in track axes [m]
  double wheel_roll = 0.0, wheel_yaw = 0.0;            ///< [rad]
  double wheel_radius = 0.0;                           ///< nominal [m]
  double spin_x = 0.0, spin_y = 0.0;                   ///< spin centre in the grid's axes [m]
  int configuration = 0, discretisation = 0;           ///< C1, D
  int tangential = 0, material_model = 0;              ///< T, M
  int friction_law = 0, heat = 0;                      ///< L, H
  int case_number = 1, patches = 1, patch = 1;         ///< number of the case, of its patches, and of this one
  Material material;
  double layer_shear_modulus = 0.0, layer_thickness = 0.0;  ///< M = 4: G3 [Pa], h3 [m]
  FrictionLaw friction;
  int format = 2510;  ///< version of the layout, as year and release: 25.10
};

/// Displacement and stress at a point below the surface, in the axes of the patch (x, s, n).
struct SubsurfaceValue {
  Vec3 point = Vec3::Zero();                                ///< [m]; n >= 0: rail, n < 0: wheel
  Vec3 displacement = Vec3::Zero();                         ///< [m]
  Mat3 stress = Mat3::Zero();                               ///< symmetric, tension positive [Pa]
  double hydrostatic = 0.0, von_mises = 0.0, tresca = 0.0;  ///< [Pa]
  Vec3 principal = Vec3::Zero();                            ///< sigma_1 >= sigma_2 >= sigma_3 [Pa]
};

/// Points in nx columns, ny rows and nz layers: values[ix + nx (iy + ny iz)].
struct SubsurfaceBlock {
  int nx = 0, ny = 0, nz = 0;  ///< points along x, s, n
  std::vector<SubsurfaceValue> values;
};

/// Points of a wheel or rail as it was used in a run: nu stations, nv points across in each. In the axes of the body:
/// of a wheel on its axle (x = r sin(theta), z = r cos(theta)), of a rail those of its profile; that of a left-hand
/// pair already is the mirror image.
struct SampledSurface {
  std::string body;             ///< "wheel" or "rail"
  std::string name;             ///< in the run: "wheel_1"
  int nu = 0, nv = 0;           ///< stations, and points in each
  bool closed = false;          ///< the last station joins the first
  std::vector<double> u;        ///< stations: x of a rail [m], angle round a wheel or roller [rad]; increasing
  std::vector<double> x, y, z;  ///< [m], station after station, y increasing in each; NaN = no surface
  std::vector<double>
      deviation;  ///< along the outward normal from the body's mean section [m]; empty: all sections are alike

  /// Where a point stands in x, y, z and deviation.
  std::size_t index(int iu, int iv) const {
    return static_cast<std::size_t>(iu) * static_cast<std::size_t>(nv) + static_cast<std::size_t>(iv);
  }
};

/// Errors: Error(configuration) for lists of wrong lengths, other bodies than these two, and names that are not fit for
/// a file or repeated.
void check_surfaces(std::span<const SampledSurface> surfaces);

/// Index of the surface of this name; -1 = none.
int surface_index(std::span<const SampledSurface> surfaces, const std::string& name);

/// Results of a run as plain data in SI units; the writers convert to the units in the names of the result file.

/// A force on the rail [N] and its moment [N m].
struct Load {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< [N], [N m]
};

/// One load in four systems of axes; moments about the rail marker (track, rail) or the wheel marker (wheelset, wheel).
struct Loads {
  Load track, rail, wheelset, wheel;
};

/// What is known of every element of a patch; index = ix + nx * iy. Empty: not asked for, or not there.
struct PatchFields {
  Grid2 grid;               ///< element centres in contact axes [m]
  Pose X_TC;                ///< pose of the grid's frame (x, s, n) in track axes (identity for a basic case)
  std::vector<double> gap;  ///< undeformed distance [m], NaN = no surface
  std::vector<double> pressure, traction_x, traction_s;                ///< [Pa], on the rail
  std::vector<double> displacement_n, displacement_x, displacement_s;  ///< [m]
  std::vector<double> slip_x, slip_s;                                  ///< relative slip [-] (shift: [m])
  std::vector<double> friction;                                        ///< coefficient mu [-]
  std::vector<double> dissipation;           ///< power of friction that becomes heat [W/m^2] (shift: work [J/m^2])
  std::vector<std::uint8_t> state;           ///< 0 exterior, 1 adhesion, 2 slip, 3 plastic
  std::vector<double> plastic_x, plastic_s;  ///< plastic shear of the interface layer [m]; empty without
  std::vector<double> yield_stress;          ///< of the interface layer [Pa]; empty without
  /// Of the surfaces of rail and wheel [deg C]; empty unless computed.
  std::vector<double> temperature_1, temperature_2;
  /// Rigid slip of the surfaces beyond creepages and spin, relative as slip is (shift: [m]); empty = none.
  std::vector<double> extra_slip_x, extra_slip_s;
  /// Total derivatives of the patch's largest pressure by heights of rail and wheel over each element, along n [Pa/m];
  /// empty unless derivatives were asked for.
  std::vector<double> pmax_by_rail, pmax_by_wheel;
  /// Curved reference: inclination of each row against the contact plane [rad]; tractions and slip are in the axes of
  /// the row and s is the arc length of the reference. Empty: a plane.
  std::vector<double> row_angle;
};

/// Where row iy of the elements' edges lies in the contact plane's axes: lateral and normal to it [m]; iy = 0 ... ny. A
/// row is as long as it is high in the grid, turned by its inclination; the contact reference lies on the plane.
std::vector<Vec2> row_edges(const PatchFields& fields, double reference_s);

/// One contact patch: numbers on the rail, then its fields. Names follow the keys of the result file.
struct PatchResult {
  bool has_reference = false;                                        ///< wheel-rail cases only
  double x_tr = 0.0, y_tr = 0.0, z_tr = 0.0, angle = 0.0;            ///< contact reference in track axes [m], [rad]
  double x_rail = 0.0, y_rail = 0.0, z_rail = 0.0, s_rail = 0.0;     ///< in rail axes; s along the profile [m]
  double x_wheel = 0.0, y_wheel = 0.0, z_wheel = 0.0;                ///< in wheel-profile axes [m]
  double x_wheelset = 0.0, y_wheelset = 0.0, z_wheelset = 0.0;       ///< in wheelset axes [m]
  double angle_rail = 0.0, angle_wheelset = 0.0, angle_wheel = 0.0;  ///< contact angle in those axes [rad]
  double reference_x = 0.0, reference_s = 0.0;                       ///< contact reference in the axes of the grid [m]
  std::uint64_t id = 0;                  ///< stays with a patch through a sequence in time; 0 = not known
  std::vector<std::uint64_t> came_from;  ///< patches of the previous instant that it continues
  std::optional<Loads> loads;
  /// Sums of the components of tractions and pressures as they are in the axes of the rows.
  struct LocalForces {
    double fn = 0.0, fx = 0.0, fs = 0.0;  ///< [N]
  };
  std::optional<LocalForces> local;  ///< curved reference: sums of the components in the axes of the rows
  /// Principal curvatures of a body at the contact reference.
  struct Curvatures {
    double greater = 0.0, lesser = 0.0;  ///< [1/m], positive: convex
    double direction = 0.0;              ///< of the greater one against x, towards s [rad]
  };
  std::optional<Curvatures> rail_curvatures, wheel_curvatures;
  bool has_rolling = false;
  double chi = 0.0, dq = 0.0, velocity = 0.0;                  ///< [rad], [m], [m/s]
  bool shift = false;                                          ///< creepages are lengths, power is work
  double xi = 0.0, eta = 0.0, phi = 0.0;                       ///< [-], [-], [rad/m] (shift: [m], [m], [rad])
  double fn = 0.0, fx = 0.0, fs = 0.0, mn = 0.0;               ///< on the rail [N], [N m]
  double fx_relative = 0.0, fs_relative = 0.0;                 ///< over mu_static F_n
  double shear_modulus = 0.0;                                  ///< combined G [Pa]
  double elastic_energy = 0.0;                                 ///< [J]
  double frictional_power = 0.0;                               ///< [W], negative = dissipated; shift: work [J]
  double approach = 0.0, pmax = 0.0;                           ///< [m], [Pa]
  int npot = 0, ncon = 0, nadh = 0, nslip = 0;                 ///< elements in all, in contact, in adhesion, in slip
  std::optional<double> max_temperature_1, max_temperature_2;  ///< in contact, rail and wheel [deg C]
  PatchFields fields;
  std::vector<SubsurfaceBlock> subsurface;             ///< in the axes of the patch
  bool subsurface_table = false, full_tensor = false;  ///< a .subs text file is wanted, with all components of stress
  std::optional<MatFileHead> element_table;            ///< a .mat text file is wanted
  bool all_elements = false;                           ///< in it, also those not in contact
  /// Derivatives of the forces on the rail, where they were asked for.
  struct Sensitivities {
    /// Of (F_x, F_s) by the creepages xi, eta [N], phi [N m] (shift: [N/m], [N/rad]).
    std::array<std::array<double, 2>, 3> by_creepage{};
    std::array<double, 3> by_approach{};  ///< of (F_n, F_x, F_s) by the approach [N/m]
  };
  std::optional<Sensitivities> sensitivities;
  /// Relative changes with ever smaller elements, as far as coarser ones tell.
  struct Refinement {
    double pmax = 0.0, area = 0.0, force = 0.0;  ///< of the largest pressure, of the contact area, of forces
  };
  std::optional<Refinement> refinement;
  /// Standard deviations of what noise of the measured profiles and scans has left uncertain.
  struct Noise {
    double pmax = 0.0, area = 0.0, fn = 0.0, place = 0.0;  ///< [Pa], [m^2], [N], across the rolling direction [m]
    double approach = 0.0;                                 ///< [m]
  };
  std::optional<Noise> noise;

  /// Power that friction dissipates over the rolling speed [N]; NaN where nothing rolls.
  double wear_number() const {
    return has_rolling && !shift && velocity > 0.0 ? 0.0 - frictional_power / velocity : NAN;
  }
};

/// Derivatives of the numbers of a case by numbers of its file.
struct CaseDerivatives {
  /// By what.
  struct Parameter {
    std::string key;     ///< of the case file, with its unit
    double value = 0.0;  ///< that the case has, in that unit
    bool of_surfaces =
        false;             ///< it changes a surface: surfaces on both sides of the one that is there were differenced
    std::string left_out;  ///< why there are none by it; empty: there are
  };
  /// Of what.
  struct Number {
    std::string name;        ///< in JSON, of a patch "patch_1.pmax_MPa"
    double value = 0.0;      ///< in the unit of its name
    std::vector<double> by;  ///< each parameter, in the units of both names; NaN: left out
  };
  std::vector<Parameter> parameters;
  std::vector<Number> numbers;
  std::vector<std::string> without;  ///< numbers of patches that have no derivatives
  std::string message;               ///< why there are none at all; empty: there are
};

/// How well the numbers of a case are known, from how well what is given is.
struct CaseUncertainty {
  /// Of what is given; independent of each other.
  struct Source {
    std::string name;    ///< key of the case file, "rail.shape", "noise of the rail", "lateral placement of the wheel"
    double sigma = 0.0;  ///< standard deviation, in the unit of the key; of surfaces what their points move by [mm]
  };
  /// Of what came out.
  struct Number {
    std::string name;                 ///< in JSON, of a patch "patch_1.pmax_MPa"
    double value = 0.0, sigma = 0.0;  ///< in the unit of the name; sigma: standard deviation, NaN: not known
    bool sampled = false;             ///< sigma is that of a sample, else by derivatives
    std::vector<double> shares;       ///< of each source in the variance; NaN: not known
  };
  std::vector<Source> sources;
  std::vector<Number> numbers;
  int checked = 0;      ///< solutions of which derivatives were held to
  int samples = 0;      ///< solutions that were sampled; 0: none, derivatives do
  int others = 0;       ///< of the sample, with another number of patches or none: numbers of patches are without them
  std::string why;      ///< there is a sample
  std::string message;  ///< why nothing is known; empty: it is
};

/// What came out of one case.
struct CaseResult {
  int number = 0;  ///< of the case in its file, from 1
  Status status = Status::ok;
  std::string message;          ///< why the status is not ok
  std::vector<Remark> remarks;  ///< what is doubtful
  double seconds = 0.0;         ///< wall clock [s]
  bool shown = true;            ///< false: the input asks for no output of this case
  bool has_wheelset = false;
  double s = 0.0, y = 0.0, z = 0.0, roll = 0.0, yaw = 0.0, pitch = 0.0;        ///< wheelset [m], [rad]
  double vs = 0.0, vy = 0.0, vz = 0.0, vroll = 0.0, vyaw = 0.0, vpitch = 0.0;  ///< [m/s], [rad/s]
  Vec3 force_tr = Vec3::Zero(), force_ws = Vec3::Zero();                       ///< on the rail [N]
  Vec3 moment_rail = Vec3::Zero();      ///< on the rail about the rail marker, track axes [N m]
  Vec3 moment_wheel = Vec3::Zero();     ///< on the rail about the wheel marker, wheelset axes [N m]
  std::optional<Loads> loads;           ///< on the rail, sum over the patches
  std::optional<Vec2> rail_deflection;  ///< of a rail on springs, y and z [m]
  /// A roller or ring below the wheel.
  struct Roller {
    double nominal_radius = 0.0, pitch_rate = 0.0;  ///< [m], [rad/s]
  };
  std::optional<Roller> roller;  ///< in place of the rail
  /// Poses of the axes of the sampled surfaces in track axes: the wheel's are on its axle and turn with its pitch, the
  /// rail's are those of its profile, moved back by the wheelset's position along the track.
  struct Bodies {
    Pose X_TA, X_TS;
  };
  std::optional<Bodies> bodies;
  std::string wheel_surface, rail_surface;  ///< names of sampled surfaces; empty = none
  double search_s = 0.0, distance_s = 0.0, normal_s = 0.0, tangential_s = 0.0;  ///< times [s]
  int searches = 0, distances = 0, normal_solves = 0, tangential_solves = 0;    ///< how often each was done
  std::vector<std::pair<double, double>> force_iterations;                      ///< (z_ws [m], F_z [N])
  std::vector<PatchResult> patches;
  std::optional<CaseDerivatives> derivatives;  ///< where they were asked for; in JSON and tables, not in HDF5
  std::optional<CaseUncertainty> uncertainty;  ///< where the case or its surfaces say how well they are known
};

/// How a case ended, in result files and tables: "doubtful" where it is ok but a remark is grave, else the word of its
/// status.
std::string_view status_word(const CaseResult& result);

/// A surface that took part in a run.
struct SurfaceUse {
  std::string body;  ///< "wheel" or "rail"
  std::string backend;
  double resolution = 0.0;       ///< spacing of the samples it was built from [m]; 0 = built from the data as given
  double build_seconds = 0.0;    ///< as used_seconds() counts
  std::size_t memory_bytes = 0;  ///< of the surface
  SurfaceDifference fit;         ///< from what it was sampled from; points = 0: not sampled
  std::string note;
};

/// All cases of a run, with where they come from.
struct RunResult : Origin {
  int threads = 1;                   ///< that the run was allowed
  double seconds = 0.0;              ///< wall clock of the whole run [s]
  std::vector<SurfaceUse> surfaces;  ///< in the order in which the cases ask for them
  std::vector<std::string> doubts;   ///< about profiles: "wheel profile w.csv: flange_side: ..."; empty: none
  bool complete = true;              ///< false when interrupted: then fewer cases than asked
  int cases_total = 0;               ///< asked for
  std::string toml;                  ///< the cases as a case file, for who has the result alone; may be empty
  std::vector<CaseResult> cases;
  std::vector<SampledSurface> sampled;  ///< of what the cases used; empty where nobody asked for them
};

}  // namespace treadmark::io
