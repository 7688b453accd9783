// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/model/contact/contact_settings.hpp"
#include "treadmark/model/contact/friction.hpp"
#include "treadmark/model/contact/material.hpp"
#include "treadmark/model/contact/wheel_on_rail.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::io {

/// What a case file asks for, whatever its format: plain data in SI units, every kept value filled in.
/// Geometry files are named here and read later, once per distinct reference.

/// Options on a profile line (MIRRORY, SCALE, SMOOTH ...).
struct ProfileOptions {
  /// Who says where the axes of the file lie.
  enum class Placement {
    automatic,   ///< the points: the tape line by the back of the flange, the tread at z = 0, the flange's side
    as_in_file,  ///< the file; only which way z points may be decided from the points
    reference,   ///< the file; only which way z points is decided, by the ends of the profile (Conventions::contact)
  };
  int mirror_y = 0;  ///< 1 = negate y, -1 = no, 0 = decide from the data (automatic placement alone)
  int mirror_z = 0;  ///< 1 = negate z, -1 = no, 0 = decide from the data
  Placement placement = Placement::automatic;
  bool back_told = false;  ///< the case says where the back of the flange is in the file, which is then not moved
  double scale = 1.0;      ///< file units to mm (so 1000 for a file in metres)
  /// Points that were measured, unless said otherwise.
  SmoothingOptions smoothing = {.method = SmoothingOptions::Method::by_noise};
  double zigzag_threshold = 2.6179938779914944;  ///< [rad]
  double max_omit = 0.5;                         ///< share of points that cleaning may remove
  int error_handling = 0;                        ///< CONTACT's option ERRHND
  friend bool operator==(const ProfileOptions&, const ProfileOptions&);
};

/// A profile, slices, triangles or offsets in a file.
struct GeometryFile {
  std::filesystem::path file;  ///< already resolved against the folder of the case file
  ProfileOptions options;
  bool open_seam = false;  ///< SliceSet::open_seam
};

/// One of the bodies that a shape is put together from, see Solid.
struct SolidInput {
  std::filesystem::path file;  ///< closed triangles or a level set (.vdb); resolved against the folder of the case file
  Solid::Use use = Solid::Use::join;
  double scale = 1.0;          ///< file units to mm
  std::string grid;            ///< name of the level set in its file; empty: the only one
  Vec3 offset = Vec3::Zero();  ///< in the frame of the wheel or rail [m]
};

/// A shape put together from bodies.
struct SolidsInput {
  std::vector<SolidInput> solids;
  double voxel = 0.0;  ///< [m]; 0: that of the first level set, or the default
};

/// A rail whose one section moves along the track.
struct CrossingInput {
  /// What moves: nothing, the nose, the wing rail.
  enum class Part { none, nose, wing } part = Part::none;
  double x = 0.0;           ///< where a nose levels off or a wing starts to move [m]
  double y = 0.0, z = 0.0;  ///< offset of its section there [m]
  double slope = 0.1;       ///< of the nose before x (rising), of the wing after it (towards +y)
  double length = 0.5;      ///< over which it rises or moves [m]
  double rounding = 0.1;    ///< over which the slope changes [m]
  friend bool operator==(const CrossingInput&, const CrossingInput&) = default;
};

/// A table of deviations that are added to a surface.
struct OffsetsInput {
  std::filesystem::path file;                ///< empty: none; resolved against the folder of the case file
  std::optional<LengthUnit> unit;            ///< of the positions; none: as the file says, else mm
  std::optional<LengthUnit> deviation_unit;  ///< none: as the file says, else that of the positions
  bool angles_deg = false;                   ///< wheel: the rows' positions are degrees
  SourcePosition where;
};

/// The shape of a wheel or rail, and the representation it is wanted in.
struct SurfaceSource {
  /// A file to be read, or a shape given in the case file itself.
  std::variant<GeometryFile, StandardProfile, ArcChain, SolidsInput> geometry;
  Defects defects;
  OffsetsInput offsets;     ///< on top of the defects
  std::string backend;      ///< "" = the natural one; see `treadmark list backends`
  double resolution = 0.0;  ///< [m]; 0 = the backend's default
  SourcePosition where;
  CrossingInput crossing;      ///< rail only
  Vec3 offset = Vec3::Zero();  ///< of a part, in the frame of the body [m]
  std::vector<SurfaceSource>
      parts;  ///< rail only: several surfaces, of which the outermost counts, instead of geometry
};

/// Elements, and how contact is looked for.
struct DiscretisationInput : ElementGrid {
  /// 2 automatic (locus for constant profiles), 5 grid, 6 grid for steep slopes, 7 initial contact point.
  int method = 2;
  Conventions conventions = Conventions::treadmark;  ///< of search, distances and parts of patches
  /// Grids: heights only where contact cannot be ruled out; false = everywhere (brute force).
  bool prune = true;
  std::string detector;  ///< of the registry of detectors; empty: as method and prune say
};

/// Influence coefficients; a table is read when the case is solved.
struct InfluenceInput : InfluenceSettings {
  std::filesystem::path file;  ///< resolved against the folder of the case file
};

/// Restricts where contact can be.
struct PlanformInput {
  /// Of the restriction; see coefficients.
  enum class Kind { free, quadratic, two_rectangles, sub_patches };
  Kind kind = Kind::free;
  /// quadratic: b1 .. b6, no contact where b1 x^2 + b2 xy + b3 y^2 + b4 x + b5 y + b6 >= 0 (SI: [1/m^2], [1/m], [-];
  /// any scale) two_rectangles, sub_patches: x low, x high, y low, y high of each [m]
  std::vector<double> coefficients;
  std::vector<double> coupling;  ///< sub_patches: count x count, symmetric, 1 on the diagonal
};

/// Points at which stresses below the surface are wanted.
struct SubsurfaceInput {
  /// A grid of points.
  struct Block {
    bool at_elements = true;         ///< x, y: element centres, else free points
    std::vector<int> columns, rows;  ///< at_elements: indices from 0; empty = all
    std::vector<double> x, y;        ///< free points [m]
    std::vector<double> z;           ///< depth > 0 in body 1, < 0 in body 2 [m]
  };
  std::vector<Block> blocks;  ///< empty = no stresses are wanted
  bool text_table = false;    ///< .subs text file
  bool full_tensor = false;   ///< in text files
};

/// How well something given is known.
struct UncertainInput {
  std::string key;      ///< of the case file, a number; or "rail.shape", "wheel.shape"
  double sigma = 0.0;   ///< standard deviation, in the unit of the key; of a shape of its heights [mm]
  double length = 0.0;  ///< of a shape: places so far apart have errors of their own, with a spline between them [m]
};

/// Which cases get error bars: those that say how well they are known; those, too, of which only the surfaces say it;
/// none.
enum class ErrorBars { automatic, always, never };

/// Friction that differs from place to place of a wheel on a rail; between the positions laws are interpolated.
struct FrictionVariation {
  /// What friction depends on.
  enum class Kind { none, inclination, along_track };
  Kind kind = Kind::none;
  std::vector<double> positions;  ///< increasing: inclination of the rail's surface [rad], or s along the track [m]
  std::vector<FrictionLaw> laws;  ///< one for each position, of one kind
};

/// One wheel on one rail (module 1).
struct WheelRailCase {
  Side side = Side::right;
  SurfaceSource rail, wheel;
  Track track;
  std::optional<Roller> roller;
  std::optional<RailSprings> rail_springs;
  WheelsetDimensions wheelset;
  WheelsetState state;  ///< of a shift velocities are displacements of the step: [m], [rad]
  bool vertical_force_prescribed = true;
  double vertical_force = 0.0;               ///< F_z on the rail, track axes [N]
  std::optional<double> longitudinal_force;  ///< F_x on the rail, wheelset axes [N]: the pitch rate is then sought
  bool rolls_by_radius = false;              ///< the pitch rate is rolling_rate, whatever velocity and radius become
  Regime regime = Regime::steady;
  HistoryUse history = HistoryUse::start;
  ReferenceSurface reference_surface = ReferenceSurface::plane;
  DiscretisationInput discretisation;
  Material material;
  FrictionLaw friction;  ///< of a variation the first law
  FrictionVariation friction_variation;
  SolverSettings solver;
  NormalModel normal_model = NormalModel::full;  ///< full, kpec or analyn
  TangentialModel tangential_model = TangentialModel::full;
  FastsimSettings fastsim;
  /// constant, bilinear, or angle_corrected without a table: the inclinations are the curved reference's
  InfluenceInput influence;
  std::optional<Thermal> thermal;
  std::optional<Damping> damping;
  bool sensitivities = false;               ///< derivatives of forces are wanted
  std::vector<UncertainInput> uncertainty;  ///< independent of each other
  ErrorBars error_bars = ErrorBars::automatic;
  SubsurfaceInput subsurface;                        ///< element numbers that a patch does not have are passed over
  Conventions conventions = Conventions::treadmark;  ///< of spin moments and steps in time
};

/// Pitch rate at which the nominal radius passes neither rail nor roller too fast or too slowly [rad/s].
double rolling_rate(const WheelRailCase& c);

/// Hertzian geometry (IPOTCN < 0): what is given and the grid that follows from it.
struct HertzInput {
  /// Which of the numbers below are given.
  enum class Given { curvatures, curvature_and_ratio, semi_axes, line_curvature, line_semi_axis, semi_double_elliptic };
  Given given = Given::curvatures;
  double a1 = 0.0, b1 = 0.0;  ///< curvatures A, B [1/m]
  double aa = 0.0, bb = 0.0;  ///< semi-axes [m]; line contact: bb = half width
  double aob = 0.0;           ///< a/b
  double scale = 1.0;         ///< potential contact over the ellipse
  /// semi_double_elliptic: half widths towards -y and +y [m]; 0 = bb both
  double bb_negative = 0.0, bb_positive = 0.0;
};

/// Undeformed distance given by formula (IBASE 1..3) or per element (9).
struct GapInput {
  /// The formula.
  enum class Kind { quadratic, circular, sinusoidal, per_element };
  Kind kind = Kind::quadratic;
  /// The numbers of the formula, in SI units: lengths [m], curvatures and wave numbers [1/m].
  ///
  /// quadratic: b1 .. b6 of b1 x^2 + b2 xy + b3 y^2 + b4 x + b5 y + b6
  ///
  /// circular: xm, R, y1, dy, b_1 .. b_n of (x - xm)^2/(2R) + b, where b is linear between the points
  /// (y1 + (k-1) dy, b_k), and beyond the outermost two
  ///
  /// sinusoidal: b1 .. b8 of b1 sin(b2 (x - b3)) - b4 sin(b5 (x - b6)) + x^2/b7 + y^2/b8
  ///
  /// per_element: h of every element, x running fastest
  std::vector<double> coefficients;
};

/// In which direction the spin of a patch makes its surfaces slide.
enum class SpinSlip { both, longitudinal, lateral };

/// What lies beyond the grid of a patch: bodies that go on, so that contact there is cut off, or nothing that may
/// touch.
enum class GridBorder { open, closed };

/// One patch with given geometry (module 3).
struct BasicCase {
  bool normal_force_prescribed = true;
  double normal_force = 0.0;          ///< [N]
  double approach = 0.0;              ///< [m]
  double xi = 0.0, eta = 0.0;         ///< creepage [-]; shift: [m]
  double phi = 0.0;                   ///< [rad/m]; shift: [rad]
  double spin_x = 0.0, spin_y = 0.0;  ///< [m]
  SpinSlip spin_slip = SpinSlip::both;
  std::optional<double> fx_relative, fy_relative;  ///< prescribed forces over mu F_n
  Regime regime = Regime::frictionless;
  NormalModel normal_model = NormalModel::full;
  TangentialModel tangential_model = TangentialModel::full;
  FastsimSettings fastsim;
  double chi = 0.0, dq = 0.0, velocity = 0.0;     ///< [rad], [m], [m/s]
  double spin_offset_factor = 1.0 / 6.0;          ///< FACPHI
  int mx = 0, my = 0;                             ///< columns and rows of elements
  double x0 = 0.0, y0 = 0.0, dx = 0.0, dy = 0.0;  ///< centre of the first element and steps [m] (IPOTCN > 0)
  GridBorder grid_border = GridBorder::open;
  std::variant<GapInput, HertzInput> geometry;  ///< HertzInput: grid follows from it
  Material material;
  FrictionLaw friction;
  SolverSettings solver;
  HistoryUse history = HistoryUse::start;
  InfluenceInput influence;
  PlanformInput planform;
  std::vector<FrictionLaw> friction_of_row;        ///< empty, or one for each row
  std::vector<double> extra_slip_x, extra_slip_y;  ///< empty, or one for each element [-]; shift: [m]
  Conventions conventions = Conventions::treadmark;
  std::optional<Thermal> thermal;
  bool sensitivities = false;  ///< derivatives of forces are wanted
  SubsurfaceInput subsurface;
};

/// One case of a file.
struct Case {
  int number = 0;         ///< counts from 1 in the file
  SourcePosition where;   ///< first line of the case
  int sequence = 0;       ///< cases of one sequence follow each other in time
  bool shown = true;      ///< false: no output is wanted (O = 0)
  int element_table = 0;  ///< .mat text table of elements: 0 none, 1 those in contact, 2 all
  /// While a file is read: cases in time that one table makes (0: positions are as given).
  int steps = 0;
  /// The time between them [s]; 0: that of a rolling step.
  double time_step = 0.0;
  std::variant<WheelRailCase, BasicCase> content;
};

/// All cases of a file, in order.
struct CaseFile {
  std::filesystem::path path;
  std::string sha256;  ///< of the case file itself, hex
  std::string title;
  std::vector<Case> cases;
  std::vector<std::string> notes;  ///< information on what was read or assumed (for example: initial estimate ignored)
};

}  // namespace treadmark::io
