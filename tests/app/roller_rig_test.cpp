// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {
namespace {

nlohmann::json results(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const ProgramResult r = run_program({"run", file.string(), "-o", folder.string()});
  EXPECT_LE(r.status, 1) << r.err;  // a second patch lies at the end of the short rail, which is a doubt
  std::ifstream in(folder / "result.json");
  return nlohmann::json::parse(in).at("cases");
}

std::string toml(const std::string& side, const std::string& radius, const std::string& rate) {
  return "[case]\nside = \"" + side +
         "\"\nregime = \"steady\"\n[rail]\nshape.file = \"rail.prr\"\n"
         "[wheel]\nshape.file = \"wheel.txt\"\nshape.mirror_z = \"no\"\n"
         "[track]\nrail_y_mm = " +
         std::string(side == "left" ? "-750" : "750") +
         "\nrail_z_mm = 0\n"
         "[roller]\nnominal_radius_mm = " +
         radius + "\npitch_rate_rad_s = " + rate +
         "\n"
         "[wheelset]\nflange_back_distance_mm = 1360\nflange_back_position_mm = -70\nnominal_radius_mm = 460\n"
         "vertical_force_N = 60e3\nvpitch_rad_s = -21.73\n"
         "[material]\nshear_modulus_GPa = 82\npoisson_ratio = 0.28\n[friction]\ncoefficient = 0.3\n"
         "[discretisation]\ndx_mm = 0.5\nds_mm = 0.5\nangle_separation_deg = 90\nseparation_mm = 8\ncombination_mm = "
         "4\n"
         "reference_search_mesh = true\n";
}

/// C = 4, 5 of CONTACT's input format against [roller], with rollers and rings.
TEST(RollerRig, BothFormatsAgree) {
  for (const bool right : {false, true})
    for (const bool ring : {false, true}) {
      SCOPED_TRACE(std::string(right ? "right " : "left ") + (ring ? "ring" : "roller"));
      const SampleInput input;
      const std::string radius = ring ? "-800.0" : "500.0", rate = ring ? "-12.5" : "20.0";
      std::string text = input.read("case.inp");
      text = text.substr(0, text.find("\n\n  1 MODULE")) + "\n\n 0 MODULE\n";
      input.write("case.inp", text);
      input.edit("case.inp", " 1203100    C-P", right ? " 5203100    C-P" : " 4203100    C-P");
      input.edit("case.inp", "   -1.0   750.0     0.0   0.025\n",
                 std::string("   -1.0   ") + (right ? "750.0" : "-750.0") + "     0.0   " + radius + "\n");
      input.edit("case.inp", " 10000. 0.0", " " + rate + " 0.0");
      input.write("case.toml", toml(right ? "right" : "left", radius, rate));
      const auto a = results(input.inp(), input.folder() / "inp"),
                 b = results(input.folder() / "case.toml", input.folder() / "toml");
      ASSERT_EQ(a.size(), 1u);
      ASSERT_EQ(b.size(), 1u);
      EXPECT_NEAR(a[0]["roller"]["nominal_radius_mm"].get<double>(), std::stod(radius), 1e-9);
      EXPECT_NEAR(a[0]["force_on_rail"]["fz_tr_N"].get<double>(), 60e3, 10.0);
      EXPECT_GE(a[0]["patches"].size(), 1u);
      ASSERT_EQ(a[0]["patches"].size(), b[0]["patches"].size());
      for (const auto& [key, value] :
           a[0]["force_on_rail"].items())  // both formats stop iterating within their own accuracy
        if (key.find("_tr_N") != std::string::npos) {
          EXPECT_NEAR(value.get<double>(), b[0]["force_on_rail"][key].get<double>(), 1e-5 * 60e3) << key;
        }
      EXPECT_EQ(a[0]["patches"][0]["grid"], b[0]["patches"][0]["grid"]);
      EXPECT_NEAR(a[0]["patches"][0]["kinematics"]["xi"].get<double>(),
                  b[0]["patches"][0]["kinematics"]["xi"].get<double>(), 1e-8);
    }
}

}  // namespace
}  // namespace treadmark::testing
