// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io::testing {

/// Writes cases of CONTACT input files from their control digits: every line that the grammar asks for, with fixed
/// values.
class ContactWriter {
 public:
  explicit ContactWriter(int module) : module_(module) {
    digits_ = module == 1 ? Digits{{"CONFIG", 1}, {"PVTIME", 2}, {"BOUND", 0},  {"TANG", 3},   {"NORM", 1},
                                   {"FORCE", 0},  {"STRESS", 0}, {"VARFRC", 0}, {"FRCLAW", 0}, {"DISCNS", 2},
                                   {"INFLCF", 2}, {"MATER", 0},  {"ZTRACK", 3}, {"EWHEEL", 3}}
                          : Digits{{"PVTIME", 2}, {"BOUND", 0},  {"TANG", 3},   {"NORM", 1},   {"FORCE", 0},
                                   {"STRESS", 0}, {"VARFRC", 0}, {"FRCLAW", 0}, {"DISCNS", 2}, {"INFLCF", 2},
                                   {"MATER", 0},  {"RZNORM", 2}, {"EXRHS", 0}};
    for (const char* name : {"XFLOW", "HEAT", "GAUSEI", "IESTIM", "MATFIL", "OUTPUT", "FLOW"}) digits_[name] = 0;
    digits_["RETURN"] = 1;
  }

  ContactWriter& set(const std::string& digit, int value) {
    digits_.at(digit) = value;
    return *this;
  }
  /// Replaces one line (named below) by other text.
  ContactWriter& line(const std::string& name, const std::string& text) {
    lines_[name] = text;
    return *this;
  }
  int digit(const std::string& name) const { return digits_.at(name); }

  std::string str(bool module_line = true) const {
    std::string out;
    const auto add = [&](const std::string& name, const std::string& standard) {
      const auto own = lines_.find(name);
      out += "  " + (own == lines_.end() ? standard : own->second) + "   " + name + "\n";
    };
    if (module_line) add("module", std::to_string(module_));
    const auto word = [&](const std::vector<std::string>& names) {
      std::string text;
      for (const auto& name : names) text += std::to_string(digits_.at(name));
      return text;
    };
    const bool rail = module_ == 1;
    add("word1", rail ? word({"CONFIG", "PVTIME", "BOUND", "TANG", "NORM", "FORCE", "STRESS"})
                      : word({"PVTIME", "BOUND", "TANG", "NORM", "FORCE", "STRESS"}));
    add("word2", rail ? word({"VARFRC", "FRCLAW", "DISCNS", "INFLCF", "MATER", "ZTRACK", "EWHEEL"})
                      : word({"VARFRC", "FRCLAW", "DISCNS", "INFLCF", "MATER", "RZNORM", "EXRHS"}));
    add("word3", word({"XFLOW", "HEAT", "GAUSEI", "IESTIM", "MATFIL", "OUTPUT", "FLOW", "RETURN"}));
    if (digit("XFLOW") >= 1) add("debug", "1000005");

    if (digit("GAUSEI") != 1) add("solver", "999 100 30 1 1e-5");
    if (digit("GAUSEI") == 2 || digit("GAUSEI") == 3) add("omega", "0.9 1.0 0 0.5");
    if (digit("GAUSEI") == 4) add("slip", "1 1.1");
    if (digit("GAUSEI") == 5) add("gd", "0.1 0.2 3 0.4 0.5 0.6 0.7 0.8");
    if (!rail) add("kinematics", "9000. -0.001 0.002 0.0003");
    if (digit("FRCLAW") != 1 && digit("VARFRC") != 3) friction(add, rail && digit("VARFRC") != 0 ? 2 : 1);
    if (digit("INFLCF") >= 2) {
      if (!rail && digit("TANG") >= 2) add("rolling", "0.0 0.4 30000.");
      if (digit("INFLCF") == 4) add("ifmeth", rail ? "0 4" : "0 4 2");
      if (digit("INFLCF") == 4 && !rail) add("angles", "-1.0 0.1r 1.0 5d");
      if (digit("INFLCF") == 9) add("cff", "'influence coefficients.cff'");
      add("material", "0.28 0.28 82000. 82000.");
      if (digit("BOUND") == 1) add("flxz", "1e-5");
      if (digit("MATER") == 1) add("viscoelastic", "1.0 1.0 0.01 0.01");
      if (digit("MATER") == 2) add("simplified", "1e-5 1.0 1.0 1.0");
      if (digit("MATER") == 3 || digit("MATER") == 5) add("simplified", "0.9 0.8 0.7");
      if (digit("MATER") == 4) add("layer", "8200. 1.25 0.0 0.0");
    }
    if (lines_.contains("damping")) add("damping", "");
    if (digit("HEAT") == 3) {
      add("heat1", "0.0 450.0 50e-3 7.85e-6");
      add("heat2", "0.0 450.0 50e-3 7.85e-6");
      if (digit("MATER") == 4) add("betapl", "1.0");
    }
    rail ? wheel_rail(add) : basic(add);
    if (digit("STRESS") >= 2) add("stress", "1 0");
    if (digit("STRESS") == 3) subsurface(add);
    return out;
  }

 private:
  using Digits = std::map<std::string, int>;

  template <class Add>
  void friction(Add add, int sets) const {
    const bool table = module_ == 1 && digit("VARFRC") != 0;
    if (table) add("nvf", std::to_string(sets));
    const int law = digit("FRCLAW");
    for (int i = 0; i < sets; ++i) {
      const std::string position = table ? (std::to_string(10 * i - 20) + (digit("VARFRC") == 1 ? "d " : " ")) : "";
      add("friction", position + (law == 0   ? "0.3 0.3"
                                  : law == 5 ? "0.3 0.4 6e-4"
                                  : law == 6 ? "0.3 20. -0.1 100."
                                             : "0.2 0.1 100. 0.05 200."));
    }
    if (law != 0 && law != 5) add("memory", "0.003 1.0");
  }

  template <class Add>
  void wheel_rail(Add add) const {
    if (digit("DISCNS") >= 2) add("grid", "0.4 0.5 1.0 90d 8.0 4.0");
    const int z = digit("ZTRACK"), e = digit("EWHEEL");
    if (z == 1 || z == 3) {
      add("track", digit("CONFIG") >= 4 ? "14.0 0 1435.0 500." : "14.0 0 1435.0 0.025");
      add("rail", "'rail.prr' 0 1.0 0.0 -1");
    }
    if (z == 2 || z == 3) {
      add("deviation", "0.1 0.2 0.3d 4.0 5.0 0.6");
      if (digit("FORCE") == 3) add("massless", "1000. 0. 1000. 0.");
    }
    if (e == 3 || e == 5) {
      add("wheelset", "1360. -70. 460.");
      add("wheel", "'sub\\wheel.prw' 0 1.0 0.0");
    }
    if (e >= 1)
      add("position", digit("NORM") == 1 ? "1.0 2.0 125000. 0.001 0.002 -25d" : "1.0 2.0 0.3 0.001 0.002 -25d");
    if (e >= 2) add("velocity", "2000. 1. 2. 0.1 0.2 -4.0");
    if (e >= 4) {
      add("flexible", "0.1 0.2 0.3 1d 2d 3d");
      add("flexible rates", "1 2 3 0.1 0.2 0.3");
    }
  }

  template <class Add>
  void basic(Add add) const {
    const int d = digit("DISCNS");
    if (d == 2) {
      add("ipotcn", "1");
      add("potcon", "3 2 -1.5 -1.0 1.0 1.0");
    }
    if (digit("RZNORM") == 2 && !lines_.contains("hertz")) {
      add("ibase", "1 1");
      add("gap", "0.001 0.0 0.002 0.0 0.0 0.0");
    }
    if (digit("FRCLAW") != 1 && digit("VARFRC") == 3) friction(add, 2);
    if (digit("EXRHS") == 9) add("slip", "1 2 1 2 1 2\n 1 2 1 2 1 2");
  }

  template <class Add>
  void subsurface(Add add) const {
    if (lines_.contains("block")) return add("block", "");
    for (const char* block :
         {"1\n 2 0.0 0.5", "2\n 1 1 2\n 1 1 2\n 1 0.1 0.1", "3\n 2 1\n 1 2\n 1\n 1 0.1 0.1", "5\n 2\n 0.0 1.0",
          "6\n 1 1 2\n 1 1 2\n 1\n 0.5", "7\n 1 1\n 1\n 1\n 2\n 0.0 1.0", "9\n 2 1 2\n 0.0 1.0\n 0.0\n 0.0\n 1.0", "0"})
      add("block", block);
  }

  int module_;
  Digits digits_;
  std::map<std::string, std::string> lines_;
};

/// Reads an input file, and what a user is told where it must not be read; cases: what stands in it before its end.
inline CaseFile parse_input(const std::string& text) { return parse_contact_input(text, "folder/test.inp"); }
inline CaseFile parse_cases(const std::string& cases) { return parse_input(cases + "0\n"); }
inline std::string input_refusal(const std::string& text) {
  return treadmark::testing::refusal_of([&] { parse_input(text); }, ErrorKind::configuration);
}
inline std::string cases_refusal(const std::string& cases) { return input_refusal(cases + "0\n"); }

inline ContactWriter basic() { return ContactWriter(3); }
/// A second basic case that keeps all it can.
inline ContactWriter keeping_basic() {
  return basic().set("FRCLAW", 1).set("DISCNS", 0).set("INFLCF", 0).set("RZNORM", 0).set("GAUSEI", 1);
}

/// Settings of a case that do not go together, and a part of what a user is told, with the place of one of them.
struct Contradictory {
  ContactWriter input;
  std::string expected;
};

}  // namespace treadmark::io::testing
