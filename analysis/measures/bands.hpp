// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

namespace treadmark::measures {

/// One-third octaves of wavelength by their nominal middles [m], from 2 m to 3.15 mm, longest first.
std::span<const double> third_octaves();

/// Ends of a band about its exact middle, 10^(1/20) to both sides [m].
struct BandEnds {
  double shortest = 0.0, longest = 0.0;
};
/// The band with this nominal middle.
BandEnds ends_of(double nominal);

/// Level of a root mean square [m] re 1 um [dB].
double level_of(double rms);

/// Limit of rail roughness of ISO 3095:2013 in the band with this nominal middle [dB re 1 um]; NaN where it says
/// nothing.
double iso_3095_limit(double nominal);

}  // namespace treadmark::measures
