// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/sample_input.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

namespace treadmark::testing {
namespace {

std::string rail_text() {
  std::ostringstream out;
  out << "header.begin\n  version = 1\n  type = 0\nheader.end\nspline.begin\n  units.len.f = 1000.\n  point.begin\n";
  for (int i = -60; i <= 60; ++i) {
    const double y = 0.6 * i;
    out << "    " << y << " " << 300.0 - std::sqrt(300.0 * 300.0 - y * y) << "\n";
  }
  out << "  point.end\nspline.end\n";
  return out.str();
}

std::string wheel_text() {
  std::ostringstream out;
  for (int i = 120; i >= -140; --i) {
    const double y = 0.5 * i;
    out << y << " " << -0.05 * y + (y < -30.0 ? 0.02 * (y + 30.0) * (y + 30.0) : 0.0) << "\n";
  }
  return out.str();
}

const char* kInpCase = R"(
  1 MODULE
 1203100    C-P-B-T-N-F-S
 0022033    V-L-D-C-M-Z-E
 0001321    H-G-I-A-O-W-R
    999     100    30    1     1e-5
  0.300   0.300
  0.280   0.280   82000.  82000.
  0.500   0.500   1.000   90d   8.0   4.0
   -1.0   750.0     0.0   0.025
  'rail.prr'     0   1.0   0.0
     0.0    0.0   0.000   0.0   0.0   0.000
  1360.0  -70.0   460.0
  'wheel.txt'   0   1.0   0.0   -1
  0.0  0.0  60000. 0.000  0.000   0.0
 10000. 0.0  0.0    0.0    0.0    -21.73

  1 MODULE
 1203100    C-P-B-T-N-F-S
 0111002    V-L-D-C-M-Z-E
 0101321    H-G-I-A-O-W-R
  0.0  2.0  60000. 0.000  0.001   0.0
 10000. 0.0  0.0    0.0    0.0    -21.73

 0 MODULE
)";

}  // namespace

SampleInput::SampleInput() {
  write("rail.prr", rail_text());
  write("wheel.txt", wheel_text());
  write("case.inp", kInpCase);
}

void SampleInput::write(const std::string& file, const std::string& text) const {
  std::ofstream(folder() / file, std::ios::binary) << text;
}

std::string SampleInput::read(const std::string& file) const {
  std::ostringstream text;
  text << std::ifstream(folder() / file, std::ios::binary).rdbuf();
  return text.str();
}

void SampleInput::edit(const std::string& file, const std::string& from, const std::string& to) const {
  std::string text = read(file);
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the sample file " + file + " does not hold '" + from + "'");
  write(file, text.replace(at, from.size(), to));
}

void SampleInput::use_slices() const {
  std::string text = "0.0 1.0\n9\n0 0 0\n1\n";
  for (int i = -4; i <= 4; ++i) {
    const std::string name = "slice_" + std::to_string(i + 4) + ".txt";
    text += std::to_string(0.1 * i) + " '" + name + "'\n";
    write(name, wheel_text());
  }
  write("wheel.slcw", text);
  edit("case.inp", "wheel.txt", "wheel.slcw");
}

}  // namespace treadmark::testing
