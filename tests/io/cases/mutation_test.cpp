// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/tests/io/cases/contact_writer.hpp"
#include "treadmark/tests/io/cases/same_cases.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::io {
namespace {

using testing::ContactWriter;

/// A few random edits: characters changed, removed, doubled, blocks moved, numbers blown up. Same seed, same edits.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::string characters = "0123456789.-+eEdr'%\"[]{}=,_ \n\tabcxyz:#\\\xff";
  for (std::size_t edits = 1 + below(6); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(text.size()), length = 1 + below(12);
    switch (below(8)) {
      case 0:
        text[at] = characters[below(characters.size())];
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 3:
        text.insert(at, 1, characters[below(characters.size())]);
        break;
      case 4:
        text.resize(at);
        break;
      case 5:
        text.insert(at, "99999999999");
        break;
      case 6:
        text.insert(at, below(2) == 0 ? "1.5-3 " : "-0.0+2,");
        break;
      default:
        text.insert(at, below(2) == 0 ? "\n%treadmark wheelset.y_mm = 1\n" : " 1e999 ");
        break;
    }
  }
  return text;
}

/// What has been read holds numbers only, and what can be written of it reads as the same.
void expect_sound(const CaseFile& file) {
  for (const Case& c : file.cases) {
    const KeyScope scope = std::holds_alternative<BasicCase>(c.content) ? KeyScope::patch : KeyScope::wheel_rail;
    for (const CaseKey& key : case_keys())
      if (key.info.scope == KeyScope::any || key.info.scope == scope) {
        const std::string text = testing::key_text(key, c);
        EXPECT_TRUE(text.find("nan") == std::string::npos && text.find("inf,") == std::string::npos &&
                    !text.ends_with("inf"))
            << key.info.path << " = " << text;
      }
  }
  const auto again = [&](auto write, auto parse) {
    std::string text;
    try {
      text = write(file, std::filesystem::path());
    } catch (const Error&) {
      return;  // what it cannot say
    }
    SCOPED_TRACE(text);
    testing::expect_same_cases(file, parse(text));
  };
  again(contact_input_text, [](const std::string& t) { return parse_contact_input(t, "m.inp"); });
  again(case_file_text, [](const std::string& t) { return parse_case_text(t, "m.toml"); });
}

/// Every so often, for it takes longer than reading.
void expect_sound_sometimes(const CaseFile& file) {
  static int count = 0;
  constexpr int kEvery = 10;
  if (count++ % kEvery == 0) expect_sound(file);
}

/// Returns how many mutants were still accepted; anything but Error fails the test by escaping.
template <class Parse>
int accepted(const std::string& text, unsigned seed, int count, Parse parse) {
  std::mt19937 random(seed);
  int good = 0;
  for (int i = 0; i < count; ++i) {
    const std::string mutant = mutated(text, random);
    try {
      parse(mutant);
      ++good;
    } catch (const Error&) {
    }
    if (::testing::Test::HasFailure()) {
      ADD_FAILURE() << "of the mutant\n" << mutant;
      break;
    }
  }
  return good;
}

constexpr int kMutants = 3000;

TEST(Mutation, ContactInputOnlyThrowsError) {
  std::string text = ContactWriter(1).set("EWHEEL", 5).set("FRCLAW", 4).set("MATER", 4).str();
  text += ContactWriter(1).set("STRESS", 3).set("VARFRC", 1).set("HEAT", 3).set("INFLCF", 4).set("RETURN", 3).str();
  text += ContactWriter(3).set("MATER", 3).set("GAUSEI", 2).str();
  text += ContactWriter(3)
              .set("EXRHS", 9)
              .line("ibase", "2 1")
              .line("gap", "2 0. 460. -10. 20.\n 0. 1.")
              .set("RETURN", 2)
              .str();
  text += ContactWriter(3).str(false);
  text += ContactWriter(3).set("STRESS", 3).set("HEAT", 3).set("INFLCF", 4).set("FRCLAW", 6).str();
  text += ContactWriter(3).set("TANG", 1).set("MATER", 4).set("BOUND", 1).set("VARFRC", 3).set("PVTIME", 0).str();
  text += ContactWriter(3)
              .set("TANG", 2)
              .set("NORM", 0)
              .set("EXRHS", 9)
              .line("ibase", "1 4")
              .line("gap", "1 0 1 0 0 0\n 2\n 0 1 0 1\n 0 1 2 3\n 0.5")
              .str();
  text += ContactWriter(1)
              .set("CONFIG", 5)
              .set("FORCE", 3)
              .set("TANG", 2)
              .set("DISCNS", 4)
              .set("INFLCF", 4)
              .set("MATER", 4)
              .set("PVTIME", 0)
              .str();
  text += ContactWriter(1)
              .line("word2", "0022033 2")
              .line("damping", "1. 2. 3. 4.")
              .set("FORCE", 1)
              .set("STRESS", 3)
              .set("HEAT", 3)
              .str();
  text += "0 MODULE\n";
  const int good = accepted(text, 1, kMutants,
                            [](const std::string& t) { expect_sound_sometimes(parse_contact_input(t, "m.inp")); });
  EXPECT_GT(good, 0);
  EXPECT_LT(good, kMutants);
}

TEST(Mutation, CaseFileOnlyThrowsError) {
  const std::string example = treadmark::testing::content_of(TREADMARK_SOURCE_DIR "/examples/wheel-flat.toml");
  const std::string patch =
      "[patch]\nnormal_force_N = 1e3\nmx = 10\nmy = 8\ncreepage_x = -1e-3\nrolling_step_mm = 0.4\nvelocity_m_s = 30\n"
      "hertz.given = \"semi_axes\"\nhertz.semi_axis_x_mm = 4.0\nhertz.semi_axis_y_mm = 2.0\n[case]\nregime = "
      "\"steady\"\n"
      "[[cases]]\npatch.creepage_y = [0.0, 1e-3]\n[[cases]]\npatch.force_x_relative = -0.5\n";
  const std::string everything =
      "[patch]\napproach_mm = 0.01\nmx = 3\nmy = 2\ndx_mm = 1\ndy_mm = 1\nrolling_step_mm = 1\nvelocity_m_s = 30\n"
      "gap.coefficients_si = [1, 0, 1, 0, 0, 0]\nextra_slip_x = [1, 2, 3, 4, 5, 6]\nextra_slip_y = [0, 0, 0, 0, 0, 7]\n"
      "planform = { kind = \"sub_patches\", rectangles_mm = [0, 1, 0, 1, 0, 1, 2, 3], coupling = [0.5] }\n"
      "[case]\nregime = \"steady\"\nhistory = \"continue\"\nsequence = 3\n[influence]\nkind = "
      "\"angle_corrected\"\nposition_mm = [-1, 1]\n"
      "inclination_deg = [2, 3]\n[heat]\nrail_bulk_temperature_C = 20\n[friction]\nrows = [{ coefficient = 0.2 }, { "
      "coefficient = 0.3 }]\n"
      "[[subsurface.blocks]]\nz_mm = [0.0, 0.5]\ncolumns = [0, 2]\n[[subsurface.blocks]]\nx_mm = [1]\ny_mm = [-1, "
      "1]\nz_mm = [-2]\n";
  const std::string rolling =
      "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n[wheelset]\nvertical_force_N = "
      "1e5\nlongitudinal_force_N = 1e3\n"
      "velocity_m_s = 2\n[case]\nregime = \"transient\"\nhistory = \"continue\"\ntime_step_s = "
      "1e-4\n[roller]\nnominal_radius_mm = 500\n"
      "pitch_rate_rad_s = 4\n[track.springs]\nforce_y_N = 3\n[damping]\nnormal_s = 1e-4\nmax_rate_normal_N_per_s = "
      "9\n[contact]\nreference_surface = \"curved\"\n"
      "[[cases]]\ncase.steps = 3\n[[cases]]\ncase.steps = 2\nwheelset.y_mm = [0, 1]\n";
  for (const std::string& text : {example, patch, everything, rolling}) {
    const int good = accepted(text, 2, kMutants / 2,
                              [](const std::string& t) { expect_sound_sometimes(parse_case_text(t, "m.toml")); });
    EXPECT_GT(good, 0);
    EXPECT_LT(good, kMutants / 2);
  }
}

TEST(Mutation, OverridesOnlyThrowError) {
  const std::string text =
      "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\nwheelset.z_mm = 1\n[[wheel.flats]]\n"
      "length_mm = 9\ndepth_mm = 1\n";
  for (const std::string one :
       {"wheelset.y_mm=3", "wheel.flats.0.depth_mm=0.5", "rail.shape.standard=60E1", "track.cant=\"1:40\""}) {
    accepted(one, 3, kMutants / 10, [&](const std::string& t) {
      const std::vector<std::string> overrides{t};
      parse_case_text(text, "m.toml", overrides);
    });
  }
}

}  // namespace
}  // namespace treadmark::io
