// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <complex>

#include <Eigen/Dense>

#include "treadmark/core/constants.hpp"
#include "treadmark/model/vehicle/flexible_track.hpp"

namespace treadmark::vehicle {

/// Zhai's ballasted track (2004), one rail; kappa G A as of a 60 kg/m rail.
inline FlexibleTrack zhai_track(double spacing = 0.545, int seats = 120) {
  FlexibleTrack track;
  track.rail = {2.059e11 * 3.217e-5, 244e6, 60.64, 7850.0 * 3.217e-5, 0.0};
  const double share = spacing / 0.545;  // a finer track carries the same on each metre
  for (int i = 0; i < seats; ++i)
    track.seats.push_back({i * spacing, share * 65e6, share * 75e3, share * 125.5, share * 137.75e6, share * 58.8e3});
  return track;
}

/// Stiffness of the two layers below a metre of rail at w = 2 pi f [N/m2].
inline std::complex<double> bed_stiffness(const RailSeat& seat, double spacing, double w) {
  const std::complex<double> pad(seat.pad_stiffness, w * seat.pad_damping),
      below(seat.bed_stiffness - w * w * seat.sleeper_mass, w * seat.bed_damping);
  return pad * below / (pad + below) / spacing;
}

/// Deflection at a distance from a unit force on an infinite beam of Timoshenko's theory on a bed: residues of the
/// Fourier transform over the wave number k,
///   w(k) = (R + B k2)/((Z + S k2)(R + B k2) - S2 k2),   Z = bed - m w2,   R = S - J w2,   S = kappa G A,   B = E I,
/// both times rail.
inline std::complex<double> infinite_beam(const RailBeam& beam, std::complex<double> bed, double w,
                                          double distance = 0.0, std::complex<double> rail = 1.0) {
  using Complex = std::complex<double>;
  const Complex s = rail * beam.shear_stiffness, b = rail * beam.bending_stiffness, r = s - w * w * beam.rotary_inertia;
  const Complex z = bed - w * w * beam.mass;
  // s b k4 + (z b + s r - s2) k2 + z r = 0
  const Complex half = 0.5 * (z * b + s * r - s * s) / (s * b), root = std::sqrt(half * half - z * r / (s * b));
  const Complex squares[] = {-half + root, -half - root};
  Complex sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    Complex k = std::sqrt(squares[i]);
    if (k.imag() < 0.0) k = -k;
    sum += (r + b * squares[i]) / (2.0 * k * (squares[i] - squares[1 - i])) * std::exp(Complex(0.0, distance) * k);
  }
  return Complex(0.0, 1.0) * sum / (s * b);
}

/// Receptance of an infinite rail on the seats of a track, by superposition: each seat answers the deflection at it
/// with a force, and these forces and the unit force act on the free rail (Heckl 1995).
inline std::complex<double> rail_on_points(const FlexibleTrack& track, double x, double w) {
  using Complex = std::complex<double>;
  const auto free = [&](double distance) {
    // Hardly any damping: it tells which waves run away.
    return infinite_beam(track.rail, Complex(0.0, 1e-9 * w * w * track.rail.mass), w, distance);
  };
  const auto n = static_cast<Eigen::Index>(track.seats.size());
  const auto seat = [&](Eigen::Index i) -> const RailSeat& { return track.seats[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXcd system = Eigen::MatrixXcd::Identity(n, n);
  Eigen::VectorXcd under(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    under[i] = free(std::abs(seat(i).x - x));
    for (Eigen::Index j = 0; j < n; ++j)
      system(i, j) += free(std::abs(seat(i).x - seat(j).x)) * bed_stiffness(seat(j), 1.0, w);
  }
  const Eigen::VectorXcd deflection = system.partialPivLu().solve(under);
  Complex sum = free(0.0);
  for (Eigen::Index i = 0; i < n; ++i) sum -= under[i] * bed_stiffness(seat(i), 1.0, w) * deflection[i];
  return sum;
}

}  // namespace treadmark::vehicle
