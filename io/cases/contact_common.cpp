// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/contact_case.hpp"

namespace treadmark::io {

namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kMegapascal = 1e6;
constexpr double kSmallestFriction = 1e-4;
constexpr double kNoYield = 1e-10, kNeverYields = 1e10;  // [MPa]: outside, a layer is purely elastic

}  // namespace

void ContactReader::refuse(const SourcePosition& where, std::string message, std::string advice) {
  refusals.emplace_back(ErrorKind::configuration, std::move(message), where, std::move(advice));
}

void ContactReader::note(std::string message) {
  if (std::find(notes.begin(), notes.end(), message) == notes.end()) notes.push_back(std::move(message));
}

void ContactReader::read_control_words() {
  using Keywords = std::vector<std::string_view>;
  const bool rail = module == 1;
  problem.emplace(text, module, rail ? "CPBTNFS" : "PBTNFS",
                  rail ? Keywords{"CONFIG", "PVTIME", "BOUND", "TANG", "NORM", "FORCE", "STRESS"}
                       : Keywords{"PVTIME", "BOUND", "TANG", "NORM", "FORCE", "STRESS"});
  model.emplace(text, module, "VLDCMZE",
                rail ? Keywords{"VARFRC", "FRCLAW", "DISCNS", "INFLCF", "MATER", "ZTRACK", "EWHEEL"}
                     : Keywords{"VARFRC", "FRCLAW", "DISCNS", "INFLCF", "MATER", "RZNORM", "EXRHS"});
  damping = weight = 0;
  if (const auto second = text.optional_integer()) {
    damping_where = text.where();
    if (*second < 0) text.fail("the second integer of the line VLDCMZE must not be negative");
    damping = *second % 10;
    weight = *second / 10;
    if (weight > 2)
      text.fail(fmt::format("the weight of the contact reference (second integer of the line VLDCMZE / 10) is {}, but only "
                            "0, 1 (linear) and 2 (quadratic) exist", weight));
  }
  run.emplace(text, module, "XHGIAOWR",
              Keywords{"XFLOW", "HEAT", "GAUSEI", "IESTIM", "MATFIL", "OUTPUT", "FLOW", "RETURN"});
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
               fmt::format("{} ({}) = {}, {}, is not supported", d.letter, d.keyword, (*word)[keyword], d.meaning));
    }
  if (damping >= 2)
    refuse(damping_where, fmt::format("M2 (second integer of the line VLDCMZE) = {}, damping, is not supported", damping));
  if (damping == 1 && kept.has_damping) refuse(damping_where, "M2 = 1, keep damping, is not supported");

  if (!kept.started && (*problem)["PVTIME"] != 2)
    note(fmt::format("P (PVTIME) = {} of the first case at {} is taken as 2: there is nothing to continue",
                     (*problem)["PVTIME"], problem->where("PVTIME").to_string()));
  const int solver = (*run)["GAUSEI"];
  if (solver >= 2)
    note(fmt::format("G (GAUSEI) = {}, {}: read, but the solver and its relaxation are Treadmark's own", solver,
                     run->described("GAUSEI").meaning));
  if ((*run)["IESTIM"] > 0) note("I (IESTIM) > 0: initial estimates are not needed and ignored");
  if ((*run)["MATFIL"] > 0) note("A (MATFIL) > 0: element data go to the HDF5 and VTK files of --output instead of .mat");
}

void ContactReader::read_solver() {
  const int method = (*run)["GAUSEI"];
  if (method == 1) return;
  text.begin_record("the line MAXGS");
  SolverInput& s = kept.solver;
  const auto count = [&](std::string_view name) {
    const long value = text.integer(name);
    if (value < 0 || value > 1000000000) text.fail(fmt::format("{} = {} is not a number of iterations", name, value));
    return static_cast<int>(value);
  };
  s.max_gs = count("MAXGS");
  s.max_in = count("MAXIN");
  s.max_nr = count("MAXNR");
  s.max_out = count("MAXOUT");
  s.eps = text.real("EPS");
  if (!(s.eps > 0.0)) text.fail("EPS must be positive");
  if (const auto elements = text.optional_integer())
    kept.max_elements = static_cast<int>(std::clamp(*elements, 100L, 1000000L));

  if (method == 2 || method == 3) {
    text.begin_record("the line OMEGAH");
    text.real("OMEGAH");
    text.real("OMEGAS");
    text.integer("INISLP");
    text.real("OMGSLP");
  } else if (method == 4) {
    text.begin_record("the line INISLP");
    text.integer("INISLP");
    text.real("OMGSLP");
  } else if (method == 5) {
    text.begin_record("the line FDECAY");
    for (const auto name : {"FDECAY", "BETATH"}) text.real(name);
    text.integer("KDOWFB");
    for (const auto name : {"D_IFC", "D_LIN", "D_CNS", "D_SLP", "POW_S"}) text.real(name);
  }
}

void ContactReader::read_friction(long sets, bool with_position) {
  const int law = (*model)["FRCLAW"];
  const int variation = (*model)["VARFRC"];
  FrictionLaw first;
  using Kind = FrictionLaw::Kind;
  first.kind = law == 2 ? Kind::linear : law == 3 ? Kind::rational : law == 4 ? Kind::exponential : Kind::coulomb;
  for (long i = 0; i < sets; ++i) {
    FrictionLaw f = first;
    text.begin_record("the friction line");
    if (with_position) variation == 1 ? text.angle("ALPHVF") : text.real("SVF");
    if (law == 0) {
      const double rest = text.real("FSTAT");
      f.kinetic = text.real("FKIN");
      if (f.kinetic != rest)
        text.fail(fmt::format("FKIN = {} must equal FSTAT = {} in Coulomb friction (L = 0)", f.kinetic, rest));
      if (f.kinetic < kSmallestFriction)
        text.fail(fmt::format("the coefficient of friction must be at least {}, found {}", kSmallestFriction, f.kinetic));
    } else if (law == 6) {
      for (const auto name : {"FREF", "TREF", "DFHEAT", "DTHEAT"}) text.real(name);
    } else {
      f.kinetic = text.real("FKIN");
      if (f.kinetic < kSmallestFriction)
        text.fail(fmt::format("the coefficient of friction must be at least {}, found {}", kSmallestFriction, f.kinetic));
      const auto term = [&](std::string_view amplitude, std::string_view velocity, double& a, double& v) {
        a = text.real(amplitude);
        v = text.real(velocity) * kMillimetre;
        if (a != 0.0 && !(v > 0.0)) text.fail(fmt::format("{} must be positive where {} is not 0", velocity, amplitude));
      };
      const std::string stem = law == 2 ? "FLIN" : law == 3 ? "FRAT" : "FEXP";
      term(stem + "1", "SABSH1", f.amplitude_1, f.half_velocity_1);
      term(stem + "2", "SABSH2", f.amplitude_2, f.half_velocity_2);
    }
    if (i == 0) kept.friction = f;
  }
  if (law != 0) {
    text.begin_record("the friction memory line");
    kept.friction.memory_distance = text.real("MEMDST") * kMillimetre;
    if (kept.friction.memory_distance < 0.0) text.fail("MEMDST must not be negative");
    kept.friction.memory_velocity = text.real("MEM_S0") * kMillimetre;
    if (kept.friction.memory_velocity < 0.0) text.fail("MEM_S0 must not be negative");
  }
  kept.friction_law = law;
}

void ContactReader::read_rolling() {
  text.begin_record("the rolling line CHI");
  BasicCase& b = kept.basic;
  b.chi = text.angle("CHI");
  b.dq = text.real("DQ") * kMillimetre;
  if (!(b.dq > 0.0)) text.fail("DQ must be positive");
  b.velocity = text.real("VELOC") * kMillimetre;
  if (!(b.velocity > 0.0)) text.fail("VELOC must be positive");
  const auto factor = text.optional_real();
  b.spin_offset_factor = factor ? *factor : 1.0 / 6.0;
  kept.has_rolling = true;
}

void ContactReader::read_material() {
  const int coefficients = (*model)["INFLCF"], kind = (*model)["MATER"];
  if (coefficients == 4) {
    text.begin_record("the line IF_METH");
    text.integer("IF_METH");
    text.integer("VARIANT");
    if (module == 3) {
      const long pairs = text.integer("NN");
      if (pairs < 1) text.fail("NN must be positive");
      text.begin_record("the table of surface inclinations");
      for (long i = 0; i < pairs; ++i) {
        text.real("S");
        text.angle("ALPHA");
      }
    }
  } else if (coefficients == 9) {
    text.begin_record("the file of influence coefficients");
    text.quoted("the file name");
  }

  text.begin_record("the material line POISS");
  Material& m = kept.material;
  kept.material_where = text.where();
  const auto poisson = [&](std::string_view name) {
    const double value = text.real(name);
    if (value < 0.0 || value > 0.5) text.fail(fmt::format("{} = {} lies outside 0 ... 0.5", name, value));
    return value;
  };
  const auto modulus = [&](std::string_view name) {
    const double value = text.real(name) * kMegapascal;
    if (!(value > 0.0)) text.fail(fmt::format("{} must be positive", name));
    return value;
  };
  m.poisson_1 = poisson("POISS1");
  m.poisson_2 = poisson("POISS2");
  m.shear_modulus_1 = modulus("GG1");
  m.shear_modulus_2 = modulus("GG2");
  kept.has_material = true;

  if ((*problem)["BOUND"] == 1) {
    text.begin_record("the line FLXZ");
    text.real("FLXZ");
  }
  if (kind == 1) {
    text.begin_record("the viscoelastic line FG1");
    for (const auto name : {"FG1", "FG2", "TC1", "TC2"}) text.real(name);
  } else if (kind == 2 || kind == 3 || kind == 5) {
    text.begin_record("the flexibility line of the simplified theory");
    if (kind == 2) text.real("FLX");
    auto& s = kept.simplified;
    s.k0 = text.real("K0_MF");
    s.alpha = text.real("ALFAMF");
    s.beta = text.real("BETAMF");
    s.given = true;
  } else if (kind == 4) {
    text.begin_record("the layer line GG3");
    auto& layer = kept.layer;
    layer.where = text.where();
    const double modulus_3 = text.real("GG3");
    if (!(modulus_3 > 0.0)) text.fail("GG3 must be positive");
    const double thickness = text.real("LAYTHK");
    if (thickness < 0.0) text.fail("LAYTHK must not be negative");
    layer.flexibility = thickness * kMillimetre / (modulus_3 * kMegapascal);
    layer.yield = text.real("TAU_C0");
    layer.where = text.where();
    layer.elastic = layer.yield <= kNoYield || layer.yield >= kNeverYields;
    text.real("K_TAU");
    layer.given = true;
  } else if (kind >= 6) {
    throw refusals.empty() ? Error(ErrorKind::configuration, "unknown material", model->where("MATER")) : refusals.front();
  }
}

void ContactReader::read_damping() {
  if (damping == 0) kept.has_damping = false;
  if (damping < 2) return;
  text.begin_record("the damping line CDAMPN");
  for (const auto name : {"CDAMPN", "CDAMPT", "DFNMAX", "DFTMAX"}) text.real(name);
  kept.has_damping = true;
}

void ContactReader::read_heat() {
  if ((*run)["HEAT"] != 3) return;
  for (const auto record : {"the thermal line of body 1", "the thermal line of body 2"}) {
    text.begin_record(record);
    for (const auto name : {"BKTEMP", "HEATCP", "LAMBDA", "DENS"}) text.real(name);
  }
  if ((*model)["MATER"] == 4) {
    text.begin_record("the line BETAPL");
    text.real("BETAPL");
  }
}

void ContactReader::read_subsurface() {
  const int stress = (*problem)["STRESS"];
  if (stress < 2) return;
  text.begin_record("the subsurface output line");
  text.integer("MATFIL");
  text.integer("OUTPUT");
  if (stress < 3) return;
  const auto list = [&](std::string_view name, long count, bool integers) {
    if (count < 1) text.fail(fmt::format("{} needs at least one value", name));
    text.begin_record(name);
    for (long i = 0; i < count; ++i) integers ? static_cast<void>(text.integer(name)) : static_cast<void>(text.real(name));
  };
  while (true) {
    text.begin_record("the subsurface block ISUBS");
    const long kind = text.integer("ISUBS");
    if (kind == 0) return;
    if (!(kind >= 1 && kind <= 3) && !(kind >= 5 && kind <= 7) && kind != 9)
      text.fail(fmt::format("ISUBS = {} does not exist", kind));
    if (kind == 2 || kind == 6) {
      for (const auto axis : {"IXL", "IYL"}) {
        text.begin_record(fmt::format("the line {}", axis));
        for (const auto name : {"first", "increment", "last"}) text.integer(name);
      }
    } else if (kind == 3 || kind == 7) {
      text.begin_record("the line NX");
      const long nx = text.integer("NX"), ny = text.integer("NY");
      list("IX", nx, true);
      list("IY", ny, true);
    } else if (kind == 9) {
      text.begin_record("the line NX");
      const long nx = text.integer("NX"), ny = text.integer("NY"), nz = text.integer("NZ");
      list("X", nx, false);
      list("Y", ny, false);
      list("Z", nz, false);
    }
    if (kind <= 3) {
      text.begin_record("the line NZ");
      text.integer("NZ");
      text.real("ZL");
      text.real("DZ");
    } else if (kind <= 7) {
      text.begin_record("the line NZ");
      const long nz = text.integer("NZ");
      list("Z", nz, false);
    }
  }
}

Material ContactReader::effective_material() {
  const int kind = (*model)["MATER"];
  if (!kept.has_material)
    throw Error(ErrorKind::configuration,
                fmt::format("C (INFLCF) = {} keeps the material, but no earlier case has given it", (*model)["INFLCF"]),
                model->where("INFLCF"), "use C = 2 in the first case");
  Material m = kept.material;
  if (kind == 4) {
    if (!kept.layer.given)
      throw Error(ErrorKind::configuration, "M (MATER) = 4 needs the layer line GG3, but no case has given it",
                  model->where("MATER"), "use C (INFLCF) = 2");
    if (!kept.layer.elastic)
      refuse(kept.layer.where,
             fmt::format("M (MATER) = 4 with TAU_C0 = {}, plasticity of the interface layer, is not supported",
                         kept.layer.yield),
             "TAU_C0 = 0 or > 1e10 makes the layer purely elastic");
    m.layer_flexibility = kept.layer.flexibility;
  }
  if ((kind == 3 || kind == 5) && !kept.simplified.given)
    throw Error(ErrorKind::configuration, fmt::format("M (MATER) = {} needs the line K0_MF, but no case has given it", kind),
                model->where("MATER"), "use C (INFLCF) = 2");

  constexpr double kDissimilar = 1e-4;
  const double difference = combine(m).difference;
  if ((*problem)["TANG"] != 0 && std::abs(difference) >= kDissimilar)
    refuse(kept.material_where,
           fmt::format("dissimilar materials (K = {:.3g}) couple the normal and the tangential problem, which is not supported",
                       difference),
           "T (TANG) = 0 is possible");
  return m;
}

}  // namespace treadmark::io
