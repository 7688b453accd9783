// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

namespace {

constexpr double kMPa = 1e6, kPerMm = 1e3;

/// One record: numbers in the units of the file with their names behind them.
class Record {
 public:
  Record& add(std::string_view name, std::string text) {
    texts_ += (texts_.empty() ? "" : " ") + std::move(text);
    names_ += fmt::format("{}{}", names_.empty() ? "" : ", ", name);
    return *this;
  }
  /// value: in SI units, unit: that of the file.
  Record& add(std::string_view name, double value, double unit = 1.0) { return add(name, exact_text(value, unit)); }
  Record& add_integer(std::string_view name, long value) { return add(name, std::to_string(value)); }
  std::string line() const { return fmt::format(" {:<44}  % {}\n", texts_, names_); }

 private:
  std::string texts_, names_;
};

class InputWriter {
 public:
  InputWriter(const Case& c, const std::filesystem::path& folder) : case_(c), folder_(folder) {}

  std::string text(std::string_view sequence) {
    const bool rail = std::holds_alternative<WheelRailCase>(case_.content);
    out_ = fmt::format("\n {} {}  MODULE, sequence; case {}\n", rail ? 1 : 3, sequence, case_.number);
    if (rail)
      wheel_rail(std::get<WheelRailCase>(case_.content));
    else
      basic(std::get<BasicCase>(case_.content));
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, std::string advice = {}) const {
    throw Error(ErrorKind::configuration,
                fmt::format("case {}: {} cannot be written as input of CONTACT (.inp)", case_.number, what),
                case_.where, std::move(advice));
  }
  void refuse_if(bool bad, const std::string& what, std::string advice = {}) const {
    if (bad) refuse(what, std::move(advice));
  }
  void put(const Record& record) { out_ += record.line(); }

  /// Treadmark's own settings, by the keys of the case file, where they are not what an input file means.
  void own_settings(const std::vector<std::pair<std::string_view, std::string_view>>& usual) {
    for (const auto& [path, meant] : usual)
      for (const CaseKey& key : case_keys()) {
        if (key.info.path != path) continue;
        std::string value = key.text ? key.text(case_) : key.written(case_, folder_);
        std::replace(value.begin(), value.end(), '\n', ' ');  // of lists
        if (!value.empty() && value != meant) out_ += fmt::format(" %treadmark {} = {}\n", path, value);
      }
  }

  template <class Content>
  void fastsim_first_step(const Content& c, std::string_view path) {
    if (theory(c.tangential_model).limits.springs) own_settings({{path, toml_text("whole")}});
  }

  template <class Content>
  int bound_digit(const Content& c) const {
    const int digit = theory(c.normal_model).digit.value;
    if (!(c.material.sheet_flexibility > 0.0)) return digit;
    refuse_if(digit != 0, "a thin sheet (material.sheet_flexibility) with an approximate pressure");
    return 1;
  }

  template <class Content>
  int material_digit(const Content& c) const {
    const Material& m = c.material;
    const bool viscous = m.creep_ratio_1 > 0.0 || m.creep_ratio_2 > 0.0,
               layer = m.layer_flexibility > 0.0 || m.layer_yield > 0.0;
    const int theory_digit = theory(c.tangential_model).digit.value;
    const bool simplified = c.tangential_model != TangentialModel::full;
    refuse_if(simplified && theory_digit < 0, fmt::format("the {}", theory(c.tangential_model).name),
              "tangential_model = \"full\" or one of FASTSIM");
    refuse_if(static_cast<int>(viscous) + static_cast<int>(layer) + static_cast<int>(simplified) > 1,
              "more than one of viscoelastic bodies, an interface layer and a simplified theory");
    return simplified ? theory_digit : viscous ? 1 : layer ? 4 : 0;
  }

  template <class Content>
  void third_word(const Content& c) {
    const SolverSettings& s = c.solver;
    using First = SolverSettings::FirstSlip;
    const bool sweeps = s.method == SolverSettings::Method::sweeps, first = s.first_slip != First::last;
    const int solver = sweeps ? 2 : first ? 4 : 0;
    put(Record().add("H-G-I-A-O-W-R",
                     fmt::format("{}{}0{}{}21", c.thermal ? 3 : 0, solver, case_.element_table, case_.shown ? 2 : 0)));
    put(Record()
            .add_integer("MAXGS", s.max_iterations)
            .add_integer("MAXIN", s.max_outer)
            .add_integer("MAXNR", s.max_force)
            .add_integer("MAXOUT", s.max_coupling)
            .add("EPS", s.eps)
            .add_integer("NPOT_MAX", most_elements(c)));
    Record slip;
    if (sweeps) slip.add("OMEGAH", 0.9).add("OMEGAS", 1.0);
    slip.add_integer("INISLP", s.first_slip == First::below   ? 1
                               : s.first_slip == First::above ? -1
                                                              : 0)
        .add("OMGSLP", 0.5);
    if (solver != 0) put(slip);
  }
  static long most_elements(const WheelRailCase& c) { return c.discretisation.max_elements; }
  static long most_elements(const BasicCase&) { return 20000; }

  /// position: of a variation, its text with a blank.
  void friction_line(const FrictionLaw& f, const std::string& position = {}) {
    Record r;
    if (!position.empty()) r.add("ALPHVF or SVF", position);
    using Kind = FrictionLaw::Kind;
    if (f.kind == Kind::coulomb)
      r.add("FSTAT", f.kinetic).add("FKIN", f.kinetic);
    else if (f.kind == Kind::temperature)
      r.add("FREF", f.kinetic)
          .add("TREF", f.reference_temperature)
          .add("DFHEAT", f.temperature_change)
          .add("DTHEAT", f.temperature_range);
    else
      r.add("FKIN", f.kinetic)
          .add("F1", f.amplitude_1)
          .add("SABSH1", f.half_velocity_1, kMillimetre)
          .add("F2", f.amplitude_2)
          .add("SABSH2", f.half_velocity_2, kMillimetre);
    put(r);
  }
  void friction_memory(const std::vector<FrictionLaw>& laws) {
    const FrictionLaw& f = laws.front();
    for (const FrictionLaw& law : laws) {
      refuse_if(law.kind != f.kind, "friction laws of several kinds in one case");
      refuse_if(law.kind != FrictionLaw::Kind::coulomb &&
                    (law.memory_distance != f.memory_distance || law.memory_velocity != f.memory_velocity),
                "friction laws with different memory in one case");
    }
    if (f.kind != FrictionLaw::Kind::coulomb)
      put(Record().add("MEMDST", f.memory_distance, kMillimetre).add("MEM_S0", f.memory_velocity, kMillimetre));
  }

  template <class Content>
  void material_lines(const Content& c, int bound, int kind) {
    const Material& m = c.material;
    put(Record()
            .add("POISS1", m.poisson_1)
            .add("POISS2", m.poisson_2)
            .add("GG1", m.shear_modulus_1, kMPa)
            .add("GG2", m.shear_modulus_2, kMPa));
    constexpr double kFlexibility = kMillimetre / kMPa;
    if (bound == 1) put(Record().add("FLXZ", m.sheet_flexibility, kFlexibility));
    const FastsimSettings& s = c.fastsim;
    if (kind == 1) {
      put(Record()
              .add("FG1", m.creep_ratio_1)
              .add("FG2", m.creep_ratio_2)
              .add("TC1", m.relaxation_time_1)
              .add("TC2", m.relaxation_time_2));
    } else if (kind == 4) {
      // With GG3 = 1 the thickness is the flexibility.
      const std::string thickness = exact_text(m.layer_flexibility, m.layer_flexibility / kFlexibility,
                                               [](double x) { return x * kMillimetre / kMPa; });
      put(Record()
              .add("GG3", 1.0)
              .add("LAYTHK", thickness)
              .add("TAU_C0", m.layer_yield, kMPa)
              .add("K_TAU", m.layer_yield > 0.0 ? m.layer_hardening : 0.0, kMPa / kMillimetre));
    } else if (kind != 0) {
      Record r;
      if (c.tangential_model == TangentialModel::fastsim_one_flexibility) r.add("FLX", s.flexibility, kFlexibility);
      put(r.add("K0_MF", s.k0).add("ALFAMF", s.alpha).add("BETAMF", s.beta));
    }
  }

  template <class Content>
  void heat_lines(const Content& c, int kind) {
    if (!c.thermal) return;
    for (const ThermalProperties* body : {&c.thermal->body_1, &c.thermal->body_2})
      put(Record()
              .add("BKTEMP", body->bulk_temperature)
              .add("HEATCP", body->heat_capacity)
              .add("LAMBDA", body->conductivity, 1e3)
              .add("DENS", body->density, 1e9));
    if (kind == 4) put(Record().add("BETAPL", c.thermal->plastic_fraction));
  }

  void subsurface_lines(const SubsurfaceInput& s) {
    if (s.blocks.empty()) return;
    put(Record().add_integer("MATFIL", s.full_tensor ? 2 : s.text_table ? 1 : 0).add_integer("OUTPUT", 0));
    const auto lengths = [&](std::string_view name, const std::vector<double>& values) {
      list(name, values, kMillimetre);
    };
    const auto indices = [&](std::string_view name, const std::vector<int>& values) {
      Record r;
      for (const int i : values) r.add(name, std::to_string(i + 1));
      put(r);
    };
    for (const SubsurfaceInput::Block& b : s.blocks) {
      const bool some = !b.columns.empty() || !b.rows.empty();
      refuse_if(b.at_elements && some && (b.columns.empty() || b.rows.empty()),
                "subsurface points of all columns and some rows, or the reverse", "give both in subsurface.blocks");
      put(Record().add_integer("ISUBS", !b.at_elements ? 9 : some ? 7 : 5));
      if (!b.at_elements) {
        put(Record()
                .add_integer("NX", static_cast<long>(b.x.size()))
                .add_integer("NY", static_cast<long>(b.y.size()))
                .add_integer("NZ", static_cast<long>(b.z.size())));
        lengths("X", b.x);
        lengths("Y", b.y);
      } else {
        if (some) {
          put(Record()
                  .add_integer("NX", static_cast<long>(b.columns.size()))
                  .add_integer("NY", static_cast<long>(b.rows.size())));
          indices("IX", b.columns);
          indices("IY", b.rows);
        }
        put(Record().add_integer("NZ", static_cast<long>(b.z.size())));
      }
      lengths("Z", b.z);
    }
    put(Record().add_integer("ISUBS", 0));
  }

  /// Many numbers, some on a line.
  void list(std::string_view name, const std::vector<double>& values, double unit) {
    constexpr std::size_t kOnALine = 8;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i % kOnALine == 0) out_ += i == 0 ? "  " : "\n  ";
      out_ += exact_text(values[i], unit) + ' ';
    }
    out_ += fmt::format(" % {}\n", name);
  }

  std::string file_name(const std::filesystem::path& file) const {
    const std::string name = relative_to(file, folder_).generic_string();
    const bool bad = ranges::any_of(name, [](unsigned char c) { return c == '\'' || std::iscntrl(c) != 0; });
    refuse_if(bad, fmt::format("the file name {}, for its quote or control character,", name), "rename the file");
    return fmt::format("'{}'", name);
  }

  void profile(const SurfaceSource& s, const std::string& body) {
    const std::string advice =
        fmt::format("make a profile or slices of it (treadmark convert CASE OUT.slc{}), and give {}.shape.file",
                    body == "rail" ? 's' : 'w', body);
    refuse_if(!s.parts.empty(), "a rail of several parts (rail.parts)", advice);
    refuse_if(s.crossing.part != CrossingInput::Part::none, "a section that moves (rail.shape.crossing)", advice);
    Defects::each(s.defects, [&](const char* key, Body, const auto& all) {
      refuse_if(!all.empty(), fmt::format("a defect ({})", key), advice);
    });
    refuse_if(!s.offsets.file.empty(), fmt::format("a table of deviations ({}.offsets)", body), advice);
    const auto* file = std::get_if<GeometryFile>(&s.geometry);
    refuse_if(std::holds_alternative<SolidsInput>(s.geometry),
              fmt::format("the {0} made of solids ({0}.shape.solids)", body), advice);
    refuse_if(file == nullptr, fmt::format("the shape of the {} by formula ({}.shape)", body, body), advice);
    if (const auto row = shape_extension(file->file))
      refuse_if((row->kinds & (kTriangleFile | kSplineFile | kCadFile | kOffsetFile)) != 0,
                fmt::format("the {} as {}", body, row->extension), advice);

    const ProfileOptions& o = file->options;
    const SmoothingOptions usual;
    SmoothingOptions m = o.smoothing;
    if (m.method == SmoothingOptions::Method::by_noise) m.method = usual.method;  // CONTACT knows none such
    const bool wavelength = m.method != SmoothingOptions::Method::spline;
    const bool further = wavelength || m.kink_high != usual.kink_high || m.kink_low != usual.kink_low ||
                         m.kink_width != usual.kink_width || o.zigzag_threshold != ProfileOptions{}.zigzag_threshold ||
                         o.max_omit != ProfileOptions{}.max_omit || o.error_handling != 0;
    put(Record()
            .add(fmt::format("{} profile", body), file_name(file->file))
            .add_integer("MIRRORY", o.mirror_y)
            .add("SCALE", o.scale)
            .add("SMOOTH", m.strength, wavelength ? kMillimetre : kMillimetre * kMillimetre * kMillimetre)
            .add_integer("MIRRORZ", o.mirror_z)
            .add_integer("PRFOPT", further ? 2 : 0));
    if (!further) return;
    put(Record()
            .add_integer("ISMOOTH", static_cast<long>(m.method))
            .add("ZIGTHRS", o.zigzag_threshold)
            .add("KINKHIGH", m.kink_high)
            .add("KINKLOW", m.kink_low)
            .add("KINKWID", m.kink_width, kMillimetre));
    put(Record().add_integer("ERRHND", o.error_handling).add("MAXOMIT", o.max_omit));
  }

  void wheel_rail(const WheelRailCase& c) {
    using Reference = ReferenceSurface;
    const int bound = bound_digit(c), kind = material_digit(c);
    refuse_if(c.longitudinal_force && c.rail_springs,
              "a longitudinal force (wheelset.longitudinal_force_N) of a rail on springs (track.springs)");
    const int force = c.longitudinal_force ? 1 : c.rail_springs ? 3 : 0;
    const auto& variation = c.friction_variation;
    const int method = discretisation_digit(c);
    refuse_if(c.reference_surface != Reference::plane && c.discretisation.method != 2,
              "contact.reference_surface with a discretisation.method of its own");
    refuse_if(c.reference_surface != Reference::plane && c.tangential_model != TangentialModel::full,
              "contact.reference_surface of a simplified theory",
              "contact.reference_surface = \"plane\" (--set) takes one creepage for a patch, as such files do");
    const bool flexible = deviates(c.state.wheel_offset) || deviates(c.state.wheel_velocity);
    own_settings({{"case.sensitivities", "false"},
                  {"case.error_bars", toml_text("auto")},
                  {"case.uncertainty", ""},
                  {"case.reference_ways", "true"},
                  {"discretisation.reference_search_mesh", "true"},
                  {"discretisation.prune", "true"},
                  {"discretisation.detector", ""},
                  {"rail.backend", ""},
                  {"rail.resolution_mm", "0"},
                  {"wheel.backend", ""},
                  {"wheel.resolution_mm", "0"}});
    fastsim_first_step(c, "solver.fastsim_first_step");
    const DiscretisationInput& elements = c.discretisation;
    own_settings({{"discretisation.dx_mm", exact_text(elements.dx, kMillimetre)},
                  {"discretisation.ds_mm", exact_text(elements.ds, kMillimetre)}});
    for (const auto& [body, source] : {std::pair{"rail", &c.rail}, std::pair{"wheel", &c.wheel}})
      if (const auto* file = std::get_if<GeometryFile>(&source->geometry);
          file != nullptr && file->options.smoothing.method == SmoothingOptions::Method::by_noise)
        out_ += fmt::format(" %treadmark {}.shape.smoothing = 'auto'\n", body);
    if (const auto* file = std::get_if<GeometryFile>(&c.wheel.geometry);
        file != nullptr && file->options.placement == ProfileOptions::Placement::automatic &&
        !is_slices_file(file->file))
      out_ += " %treadmark wheel.shape.placement = 'automatic'\n";
    if (const auto* file = std::get_if<GeometryFile>(&c.wheel.geometry); file != nullptr && is_slices_file(file->file))
      own_settings({{"wheel.shape.open_seam", "true"}});
    if (c.longitudinal_force && c.state.velocity.pitch != 0.0)
      out_ += fmt::format(" %treadmark wheelset.vpitch_rad_s = {}\n %treadmark wheelset.longitudinal_force_N = {}\n",
                          exact_text(c.state.velocity.pitch, 1.0), exact_text(*c.longitudinal_force, 1.0));

    put(Record().add("C-P-B-T-N-F-S",
                     fmt::format("{}{}{}{}{}{}{}", (c.side == Side::right ? 1 : 0) + (c.roller ? 4 : 0),
                                 kHistoryDigits[static_cast<int>(c.history)], bound, theory(c.regime).digit.value,
                                 c.vertical_force_prescribed ? 1 : 0, force, c.subsurface.blocks.empty() ? 0 : 3)));
    Record word;
    word.add("V-L-D-C-M-Z-E", fmt::format("{}{}{}{}{}3{}", static_cast<int>(variation.kind),
                                          kLawDigits[static_cast<int>(c.friction.kind)], method,
                                          theory(c.influence.kind).digit.value, kind, flexible ? 5 : 3));
    if (const int second = (c.discretisation.linear_weight ? 10 : 0) + (c.damping ? 2 : 0); second != 0)
      word.add_integer("10 GAPWGT + M2", second);
    put(word);
    third_word(c);
    friction_of(c);
    if (c.influence.kind == InfluenceSettings::Kind::angle_corrected)
      put(Record().add_integer("IF_METH", c.influence.linear ? 0 : 1).add_integer("VARIANT", c.influence.variant));
    material_lines(c, bound, kind);
    if (const auto& d = c.damping)
      put(Record()
              .add("CDAMPN", d->normal)
              .add("CDAMPT", d->tangential)
              .add("DFNMAX", d->max_rate_normal)
              .add("DFTMAX", d->max_rate_tangential));
    heat_lines(c, kind);
    grid(c.discretisation);
    track(c);
    wheelset(c, flexible);
    subsurface_lines(c.subsurface);
  }

  static bool deviates(const SixMotion& m) {
    return m.x != 0.0 || m.y != 0.0 || m.z != 0.0 || m.roll != 0.0 || m.yaw != 0.0 || m.pitch != 0.0;
  }

  void friction_of(const WheelRailCase& c) {
    const FrictionVariation& v = c.friction_variation;
    using Kind = FrictionVariation::Kind;
    if (v.kind == Kind::none) {
      friction_line(c.friction);
      return friction_memory({c.friction});
    }
    put(Record().add_integer("NVF", static_cast<long>(v.laws.size())));
    for (std::size_t i = 0; i < v.laws.size(); ++i)
      friction_line(v.laws[i], exact_text(v.positions[i], v.kind == Kind::inclination ? 1.0 : kMillimetre));
    friction_memory(v.laws);
  }

  void grid(const DiscretisationInput& d) {
    Record r;
    r.add("DX", d.dx, kMillimetre)
        .add("DS", d.ds, kMillimetre)
        .add("DQREL", d.dq_relative)
        .add("A_SEP", d.angle_separation)
        .add("D_SEP", d.separation, kMillimetre)
        .add("D_COMB", d.combination, kMillimetre);
    const bool misses = d.near_miss != DiscretisationInput{}.near_miss;
    if (d.turning || misses) r.add("D_TURN", d.turning.value_or(2.0 * d.separation - d.combination), kMillimetre);
    if (misses) r.add("G_MISS", d.near_miss, kMillimetre);
    put(r);
  }

  void track(const WheelRailCase& c) {
    const Track& t = c.track;
    Record r;
    if (t.gauge_based)
      r.add("GAUGHT", t.gauge_height, kMillimetre).add_integer("GAUGSQ", 0).add("GAUGWD", t.gauge_width, kMillimetre);
    else
      r.add("GAUGHT", 0.0).add("RAILY0", t.rail_y0, kMillimetre).add("RAILZ0", t.rail_z0, kMillimetre);
    if (c.roller)
      r.add("NOMRAD", c.roller->nominal_radius, kMillimetre);
    else
      r.add("CANT", t.cant);
    put(r.add("CURV", t.curvature, kPerMm));
    profile(c.rail, "rail");
    put(Record()
            .add("DY", t.dy, kMillimetre)
            .add("DZ", t.dz, kMillimetre)
            .add("ROLL", t.roll)
            .add("VY", t.vy, kMillimetre)
            .add("VZ", t.vz, kMillimetre)
            .add("VROLL", t.vroll));
    if (const auto& s = c.rail_springs)
      put(Record()
              .add("KYRAIL", s->stiffness_y, 1e3)
              .add("FYRAIL", s->force_y)
              .add("KZRAIL", s->stiffness_z, 1e3)
              .add("FZRAIL", s->force_z)
              .add("DYSTEP0", s->first_step_y, kMillimetre));
  }

  void six(const SixMotion& m, const std::array<std::string_view, 6>& names) {
    put(Record()
            .add(names[0], m.x, kMillimetre)
            .add(names[1], m.y, kMillimetre)
            .add(names[2], m.z, kMillimetre)
            .add(names[3], m.roll)
            .add(names[4], m.yaw)
            .add(names[5], m.pitch));
  }

  void wheelset(const WheelRailCase& c, bool flexible) {
    const WheelsetDimensions& w = c.wheelset;
    Record dimensions;
    dimensions.add("FBDIST", w.flange_back_distance, kMillimetre)
        .add("FBPOS", w.flange_back_position, kMillimetre)
        .add("NOMRAD", w.nominal_radius, kMillimetre);
    if (w.tape_line) dimensions.add("YTAPE", *w.tape_line, kMillimetre);
    put(dimensions);
    profile(c.wheel, "wheel");
    const SixMotion &at = c.state.position, &rate = c.state.velocity;
    Record position;
    position.add(c.roller ? "X" : "S", at.x, kMillimetre).add("Y", at.y, kMillimetre);
    if (c.vertical_force_prescribed)
      position.add("FZ", c.vertical_force);
    else
      position.add("Z", at.z, kMillimetre);
    put(position.add("ROLL", at.roll).add("YAW", at.yaw).add("PITCH", at.pitch));
    Record velocity;
    if (c.roller)
      velocity.add("VPITCH_ROL", c.roller->pitch_rate);
    else
      velocity.add("VS", rate.x, kMillimetre);
    velocity.add("VY", rate.y, kMillimetre)
        .add("VZ", rate.z, kMillimetre)
        .add("VROLL", rate.roll)
        .add("VYAW", rate.yaw);
    if (c.longitudinal_force)
      velocity.add("FX", *c.longitudinal_force);
    else
      velocity.add("VPITCH", rate.pitch);
    put(velocity);
    if (!flexible) return;
    six(c.state.wheel_offset, {"DXWHL", "DYWHL", "DZWHL", "DROLLW", "DYAWW", "DPITCHW"});
    six(c.state.wheel_velocity, {"VXWHL", "VYWHL", "VZWHL", "VROLLW", "VYAWW", "VPITCHW"});
  }

  void basic(const BasicCase& c) {
    const int bound = bound_digit(c), kind = material_digit(c);
    const bool slip = !c.extra_slip_x.empty(), rolling = c.regime == Regime::transient || c.regime == Regime::steady;
    refuse_if(slip && c.spin_slip != SpinSlip::both, "extra slip of elements together with patch.spin_slip");
    const int extra = slip ? 9 : c.spin_slip == SpinSlip::longitudinal ? 2 : c.spin_slip == SpinSlip::lateral ? 3 : 0;
    const FrictionLaw& first = c.friction_of_row.empty() ? c.friction : c.friction_of_row.front();
    const std::string closed = toml_text("closed");
    own_settings({{"case.sensitivities", "false"}, {"case.reference_ways", "true"}, {"patch.grid_border", closed}});
    fastsim_first_step(c, "patch.fastsim_first_step");
    put(Record().add("P-B-T-N-F-S", fmt::format("{}{}{}{}{}{}", kHistoryDigits[static_cast<int>(c.history)], bound,
                                                theory(c.regime).digit.value, c.normal_force_prescribed ? 1 : 0,
                                                c.fy_relative   ? 2
                                                : c.fx_relative ? 1
                                                                : 0,
                                                c.subsurface.blocks.empty() ? 0 : 3)));
    put(Record().add("V-L-D-C-M-Z-E", fmt::format("{}{}2{}{}2{}", c.friction_of_row.empty() ? 0 : 3,
                                                  kLawDigits[static_cast<int>(first.kind)],
                                                  theory(c.influence.kind).digit.value, kind, extra)));
    third_word(c);
    kinematics(c);
    if (c.friction_of_row.empty()) {
      friction_line(c.friction);
      friction_memory({c.friction});
    }
    if (rolling)
      put(Record()
              .add("CHI", c.chi)
              .add("DQ", c.dq, kMillimetre)
              .add("VELOC", c.velocity, kMillimetre)
              .add("FACPHI", c.spin_offset_factor));
    influence(c.influence);
    material_lines(c, bound, kind);
    heat_lines(c, kind);
    if (const auto* hertz = std::get_if<HertzInput>(&c.geometry))
      potential_contact(c, *hertz);
    else
      gap(c, std::get<GapInput>(c.geometry));
    if (!c.friction_of_row.empty()) {
      for (const FrictionLaw& law : c.friction_of_row) friction_line(law);
      friction_memory(c.friction_of_row);
    }
    const double unit = c.regime == Regime::shift ? kMillimetre : 1.0;
    for (std::size_t i = 0; i < c.extra_slip_x.size(); ++i)
      out_ += fmt::format("  {} {}\n", exact_text(c.extra_slip_x[i], unit), exact_text(c.extra_slip_y[i], unit));
    subsurface_lines(c.subsurface);
  }

  void kinematics(const BasicCase& c) {
    const bool shift = c.regime == Regime::shift;
    Record r;
    if (c.normal_force_prescribed)
      r.add("FN", c.normal_force);
    else
      r.add("PEN", c.approach, kMillimetre);
    const auto driven = [&](std::string_view force_name, std::string_view name, const std::optional<double>& force,
                            double creepage) {
      if (force)
        r.add(force_name, *force);
      else
        r.add(name, creepage, shift ? kMillimetre : 1.0);
    };
    driven("FX", "CKSI", c.fx_relative, c.xi);
    driven("FY", "CETA", c.fy_relative, c.eta);
    r.add("CPHI", c.phi, shift ? 1.0 : kPerMm);
    if (c.spin_x != 0.0 || c.spin_y != 0.0) r.add("SPINXO", c.spin_x, kMillimetre).add("SPINYO", c.spin_y, kMillimetre);
    put(r);
  }

  void influence(const InfluenceInput& in) {
    using Kind = InfluenceSettings::Kind;
    if (in.kind == Kind::table) put(Record().add("CFF", file_name(in.file)));
    if (in.kind != Kind::angle_corrected) return;
    put(Record()
            .add_integer("IF_METH", in.linear ? 0 : 1)
            .add_integer("VARIANT", in.variant)
            .add_integer("NN", static_cast<long>(in.position.size())));
    for (std::size_t i = 0; i < in.position.size(); ++i)
      put(Record().add("S", in.position[i], kMillimetre).add("ALPHA", in.inclination[i]));
  }

  void potential_contact(const BasicCase& c, const HertzInput& h) {
    using Given = HertzInput::Given;
    put(Record().add_integer("IPOTCN", -1 - static_cast<int>(h.given)));
    Record r;
    r.add_integer("MX", c.mx).add_integer("MY", c.my);
    const auto length = [&](std::string_view name, double value) { r.add(name, value, kMillimetre); };
    const auto curvature = [&](std::string_view name, double value) { r.add(name, value, kPerMm); };
    switch (h.given) {
      case Given::curvatures:
        curvature("A1", h.a1);
        curvature("B1", h.b1);
        break;
      case Given::curvature_and_ratio:
        curvature("A1", h.a1);
        r.add("AOB", h.aob);
        break;
      case Given::line_curvature:
        curvature("A1", h.a1);
        length("BB", h.bb);
        break;
      case Given::semi_axes:
      case Given::line_semi_axis:
        length("AA", h.aa);
        length("BB", h.bb);
        break;
      case Given::semi_double_elliptic:
        length("AA", h.aa);
        length("BNEG", h.bb_negative);
        length("BPOS", h.bb_positive);
        break;
    }
    put(r.add("SCALE", h.scale));
  }

  void gap(const BasicCase& c, const GapInput& g) {
    put(Record().add_integer("IPOTCN", 3));
    put(Record()
            .add_integer("MX", c.mx)
            .add_integer("MY", c.my)
            .add("XC1", c.x0, kMillimetre)
            .add("YC1", c.y0, kMillimetre)
            .add("DX", c.dx, kMillimetre)
            .add("DY", c.dy, kMillimetre));
    using Kind = GapInput::Kind;
    const int base = g.kind == Kind::per_element ? 9 : 1 + static_cast<int>(g.kind);
    put(Record().add_integer("IBASE", base).add_integer("IPLAN", 1 + static_cast<int>(c.planform.kind)));
    const std::vector<double>& b = g.coefficients;
    if (g.kind == Kind::per_element) {
      list("H", b, kMillimetre);
    } else if (g.kind == Kind::circular) {
      Record r;
      r.add_integer("NN", static_cast<long>(b.size()) - 4);
      constexpr std::string_view kNames[] = {"XM", "RM", "Y1", "DY1"};
      for (std::size_t i = 0; i < 4; ++i) r.add(kNames[i], b.at(i), kMillimetre);
      put(r);
      list("B", {b.begin() + 4, b.end()}, kMillimetre);
    } else {
      Record r;
      for (std::size_t i = 0; i < b.size(); ++i) {
        const bool quadratic = g.kind == Kind::quadratic;
        const bool curvature = quadratic && i < 3, slope = quadratic && (i == 3 || i == 4);
        const bool wave_number = !quadratic && (i == 1 || i == 4);
        r.add(fmt::format("B{}", i + 1),
              wave_number
                  ? exact_text(b[i], b[i] / kPerMm, [](double x) { return x * kMillimetre * (kMilli * kMilli); })
                  : exact_text(b[i], curvature ? kPerMm
                                     : slope   ? 1.0
                                               : kMillimetre));
      }
      put(r);
    }
    planform(c.planform);
  }

  void planform(const PlanformInput& p) {
    using Kind = PlanformInput::Kind;
    const std::vector<double>& v = p.coefficients;
    if (p.kind == Kind::free) return;
    if (p.kind == Kind::quadratic) {
      Record r;
      for (std::size_t i = 0; i < v.size(); ++i)
        r.add(fmt::format("B{}", i + 1), v[i], i < 3 ? kMilli * kMilli : i < 5 ? kMilli : 1.0);
      return put(r);
    }
    const std::size_t count = v.size() / 4;
    if (p.kind == Kind::sub_patches) put(Record().add_integer("NPATCH", static_cast<long>(count)));
    for (std::size_t i = 0; i < count; ++i)
      list("XL, XH, YL, YH", {v.begin() + 4 * static_cast<long>(i), v.begin() + 4 * static_cast<long>(i) + 4},
           kMillimetre);
    if (p.kind == Kind::sub_patches)
      for (std::size_t i = 0; i + 1 < count; ++i)
        list("FAC",
             {p.coupling.begin() + static_cast<long>(i * count + i + 1),
              p.coupling.begin() + static_cast<long>((i + 1) * count)},
             1.0);
  }

  const Case& case_;
  const std::filesystem::path& folder_;
  std::string out_;
};

}  // namespace

std::string contact_input_text(const CaseFile& file, const std::filesystem::path& folder) {
  std::string title = file.title;
  ranges::replace_if(
      title, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  std::string out = fmt::format("% {}\n", title);
  for (const Case& c : file.cases) out += contact_case_text(c, folder, std::to_string(c.sequence + 1));
  return out + "\n 0  MODULE\n";
}

std::string contact_case_text(const Case& c, const std::filesystem::path& folder, std::string_view sequence) {
  return InputWriter(c, folder).text(sequence);
}

}  // namespace treadmark::io
