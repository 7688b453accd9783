// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

constexpr double kSmallestFriction = 1e-4;

double coefficient(ContactText& text, std::string_view name) {
  const double value = text.real(name, kMostFriction);
  if (value < kSmallestFriction)
    text.fail(fmt::format("the coefficient of friction must be at least {}, found {}", kSmallestFriction, value));
  return value;
}

FrictionLaw read_coulomb(ContactText& text) {
  FrictionLaw f;
  const double rest = text.real("FSTAT");
  f.kinetic = coefficient(text, "FKIN");
  if (f.kinetic != rest)
    text.fail(fmt::format("FKIN = {} must equal FSTAT = {} in Coulomb friction (L = 0)", f.kinetic, rest));
  return f;
}

FrictionLaw read_falling(ContactText& text, int law) {
  FrictionLaw f;
  using Kind = FrictionLaw::Kind;
  f.kind = law == 2 ? Kind::linear : law == 3 ? Kind::rational : Kind::exponential;
  f.kinetic = coefficient(text, "FKIN");
  const auto term = [&](std::string_view amplitude, std::string_view velocity, double& a, double& v) {
    a = text.real(amplitude, kMostFriction);
    v = text.real(velocity) * kMillimetre;
    if (a != 0.0 && !(v > 0.0)) text.fail(fmt::format("{} must be positive where {} is not 0", velocity, amplitude));
  };
  const std::string stem = law == 2 ? "FLIN" : law == 3 ? "FRAT" : "FEXP";
  term(stem + "1", "SABSH1", f.amplitude_1, f.half_velocity_1);
  term(stem + "2", "SABSH2", f.amplitude_2, f.half_velocity_2);
  return f;
}

/// Polach (2005): mu0 [A + (1 - A) exp(-B w)] is exponential falling friction.
FrictionLaw read_polach(ContactText& text) {
  FrictionLaw f;
  f.kind = FrictionLaw::Kind::exponential;
  const double rest = coefficient(text, "FSTAT"), share = text.real("A"), rate = text.real("B");
  if (share < 0.0 || share > 1.0) text.fail(fmt::format("A = {} of Polach's friction lies outside 0 ... 1", share));
  if (!(rate > 0.0)) text.fail("B of Polach's friction [s/mm] must be positive", "L = 0 is constant friction");
  f.kinetic = share * rest;
  if (f.kinetic < kSmallestFriction)
    text.fail(fmt::format("A FSTAT = {} of Polach's friction must be at least {}", f.kinetic, kSmallestFriction));
  f.amplitude_1 = rest - f.kinetic;
  f.half_velocity_1 = std::numbers::ln2 / rate * kMillimetre;
  return f;
}

FrictionLaw read_temperature_dependent(ContactText& text) {
  FrictionLaw f;
  f.kind = FrictionLaw::Kind::temperature;
  f.kinetic = coefficient(text, "FREF");
  f.reference_temperature = text.real("TREF");
  f.temperature_change = text.real("DFHEAT", kMostFriction);
  if (f.kinetic + f.temperature_change < kSmallestFriction)
    text.fail(
        fmt::format("FREF + DFHEAT = {} must be at least {}", f.kinetic + f.temperature_change, kSmallestFriction));
  f.temperature_range = text.real("DTHEAT");
  if (!(f.temperature_range > 0.0)) text.fail("DTHEAT must be positive");
  return f;
}

}  // namespace

void ContactReader::read_friction(long sets) {
  const int law = (*model)["FRCLAW"];
  ContactSequence::Friction f;
  f.law = law;
  f.variation = (*model)["VARFRC"];
  f.laws.clear();
  for (long i = 0; i < sets; ++i) {
    text.begin_record("the friction line");
    if (f.variation == 1 || f.variation == 2) {
      const double position = f.variation == 1 ? text.angle("ALPHVF") : text.real("SVF") * kMillimetre;
      if (!f.positions.empty() && !(position > f.positions.back()))
        text.fail(fmt::format("{} of the friction sets must increase", f.variation == 1 ? "ALPHVF" : "SVF"));
      f.positions.push_back(position);
    }
    f.laws.push_back(law == 0   ? read_coulomb(text)
                     : law == 5 ? read_polach(text)
                     : law == 6 ? read_temperature_dependent(text)
                                : read_falling(text, law));
  }
  if (law != 0 && law != 5) {
    text.begin_record("the friction memory line");
    const double distance = text.real("MEMDST") * kMillimetre;
    if (distance < 0.0) text.fail("MEMDST must not be negative");
    const double velocity = text.real("MEM_S0") * kMillimetre;
    if (velocity < 0.0) text.fail("MEM_S0 must not be negative");
    for (FrictionLaw& one : f.laws) {
      one.memory_distance = distance;
      one.memory_velocity = velocity;
    }
  }
  kept.friction = std::move(f);
}

}  // namespace treadmark::io
