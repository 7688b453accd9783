// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include <fmt/format.h>

namespace treadmark::testing {

/// A quarter of a cylinder of 460 mm about y, from -45 to 45 degrees and 60 mm wide, as G+Smo writes it: y runs second.
inline const std::string kWheelShell = R"(<?xml version="1.0" encoding="UTF-8"?>
<!--by hand, radius 460-->
<xml>
 <Geometry type="TensorNurbs2" id="7">
  <Basis type="TensorNurbsBasis2">
   <Basis type="TensorBSplineBasis2">
    <Basis type="BSplineBasis" index="0">
     <KnotVector degree="2">0 0 0 1 1 1 </KnotVector>
    </Basis>
    <Basis type="BSplineBasis" index="1">
     <KnotVector degree="1">0 0 1 1 </KnotVector>
    </Basis>
   </Basis>
   <weights>1 0.70710678118654757 1
1 0.70710678118654757 1
</weights>
  </Basis>
  <coefs geoDim="3">-325.26911934581187 -30 325.26911934581187
0 -30 650.53823869162374
325.26911934581187 -30 325.26911934581187
-325.26911934581187 30 325.26911934581187
0 30 650.53823869162374
325.26911934581187 30 325.26911934581187
</coefs>
 </Geometry>
</xml>
)";

/// A flat rail of 400 x 80 mm at z = 0, biquadratic over 4 x 4 cells, the 2 x 2 in its middle divided; the four finer
/// functions stand bump_mm high.
inline std::string hierarchical_rail(double bump_mm, const char* kind = "THB") {
  const double coarse[] = {0.0, 0.125, 0.375, 0.625, 0.875, 1.0};  // where functions stand (Greville)
  const double fine[] = {0.4375, 0.5625};                          // of those inside of the box
  std::string text = fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<xml>
 <Geometry type="{0}Spline2" id="0">
  <Basis type="{0}SplineBasis2">
   <Basis type="TensorBSplineBasis2">
    <Basis type="BSplineBasis" index="0">
     <KnotVector degree="2">0 0 0 0.25 0.5 0.75 1 1 1 </KnotVector>
    </Basis>
    <Basis type="BSplineBasis" index="1">
     <KnotVector degree="2">0 0 0 0.25 0.5 0.75 1 1 1 </KnotVector>
    </Basis>
   </Basis>
   <box level="1">2 2 6 6 
</box>
  </Basis>
  <coefs geoDim="3">)",
                                 kind);
  const auto point = [&](double s, double t, double z) {
    text += fmt::format("{} {} {} \n", -200.0 + 400.0 * s, -40.0 + 80.0 * t, z);
  };
  for (const double t : coarse)
    for (const double s : coarse) point(s, t, 0.0);
  for (const double t : fine)
    for (const double s : fine) point(s, t, bump_mm);
  return text + "</coefs>\n </Geometry>\n</xml>\n";
}

/// Two plates of 100 x 60 mm one behind the other at z = 0, said to meet, with this step between them.
inline std::string two_plates(double step_mm, const std::string& interface = "0 2 1 1 0 1 1 1") {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<xml>\n";
  for (int id = 0; id < 2; ++id) {
    const double x = 100.0 * id, z = step_mm * id;
    text += fmt::format(R"(<Geometry type="TensorBSpline2" id="{0}">
<Basis type="TensorBSplineBasis2">
<Basis type="BSplineBasis" index="0"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
<Basis type="BSplineBasis" index="1"><KnotVector degree="1">0 0 1 1</KnotVector></Basis>
</Basis>
<coefs geoDim="3">{1} -30 {3}
{2} -30 {3}
{1} 30 {3}
{2} 30 {3}
</coefs>
</Geometry>
)",
                        id, x, x + 100.0, z);
  }
  text += "<MultiPatch parDim=\"2\" id=\"2\">\n<patches type=\"id_range\">0 1</patches>\n";
  if (!interface.empty()) text += "<interfaces>" + interface + "\n</interfaces>\n";
  return text + "<boundary>0 1\n1 2\n</boundary>\n</MultiPatch>\n</xml>\n";
}

}  // namespace treadmark::testing
