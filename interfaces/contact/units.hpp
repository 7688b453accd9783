// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/interfaces/contact/contact_addon.h"

namespace treadmark::contact {

/// A caller's units: a number of the caller times a factor is in SI. Angles [rad], times [s], forces [N] and
/// temperatures [deg C] are the same in all.
struct Units {
  int code = CNTC_un_cntc;
  double length = 1e-3;  ///< [m]
  double sign = 1.0;     ///< of outputs that act on a body: +1 on the rail, -1 on the wheel

  double area() const { return length * length; }
  double velocity() const { return length; }
  double stress() const { return 1.0 / area(); }
  double curvature() const { return 1.0 / length; }
  double moment() const { return length; }  ///< and work
  double stiffness() const { return 1.0 / length; }
  double compliance() const { return area() * length; }       ///< length^3 / force
  double hardening() const { return stress() / length; }      ///< force / length^3
  double conductivity() const { return 1.0 / length; }        ///< power / (length K)
  double density() const { return 1.0 / (area() * length); }  ///< kg / length^3
};

/// Those of a code; false: there is none. Imperial units count as CONTACT's.
inline bool units_of(int code, Units& units) {
  if (code < CNTC_un_cntc || code > CNTC_un_imper) return false;
  const bool metres = code == CNTC_un_si || code == CNTC_un_spck;
  units = {code, metres ? 1.0 : 1e-3, code == CNTC_un_spck ? -1.0 : 1.0};
  return true;
}

}  // namespace treadmark::contact
