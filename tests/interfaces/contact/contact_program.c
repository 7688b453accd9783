/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: Treadmark contributors */
#include <math.h>
#include <stdio.h>

#include "contact_addon.h"

/* Hertz: two halves of steel with A = B = 0.001 / mm under 10 kN touch on a circle of radius (3 F (1 - nu) / (8 A G))^(1/3). */
int main(void) {
  int ire = 1, icp = 1, method = 0, two = 2, four = 4, five = 5, ipotcn = -1, error = -1, one = 1, patches = 3;
  int codes[2] = {CNTC_ic_tang, CNTC_if_units}, values[2] = {0, CNTC_un_cntc};
  double material[4] = {0.28, 0.28, 82000.0, 82000.0}, friction[2] = {0.3, 0.3}, hertz[5] = {21.0, 21.0, 1e-3, 1e-3, 1.1};
  double force = 10000.0, found[10], pressure = 0.0, radius;
  cntc_initialize(&ire, &patches, NULL, &error, " ", &one);
  if (error != 0) return 1;
  cntc_setflags(&ire, &icp, &two, codes, values);
  cntc_setmaterialparameters(&ire, &icp, &method, &four, material);
  cntc_setfrictionmethod(&ire, &icp, &method, &two, friction);
  cntc_sethertzcontact(&ire, &icp, &ipotcn, &five, hertz);
  cntc_setnormalforce(&ire, &icp, &force);
  cntc_calculate(&ire, &icp, &error);
  if (error != 0) return 2;
  one = 10;
  cntc_gethertzcontact(&ire, &icp, &one, found);
  cntc_getmaximumpressure(&ire, &icp, &pressure);
  radius = cbrt(3.0 * force * (1.0 - 0.28) / (8.0 * 1e-3 * 82000.0));
  printf("radius %.6f mm, expected %.6f; greatest pressure %.2f MPa\n", found[2], radius, pressure);
  cntc_finalize(&ire);
  return fabs(found[2] - radius) < 1e-3 * radius && fabs(pressure - 1.5 * force / (3.14159265 * radius * radius)) < 0.02 * pressure ? 0 : 3;
}
