// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "treadmark/core/output_file.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using treadmark::testing::error_of;

constexpr double kRadius = 0.08;  ///< of the samples: a cylinder along x with its crown at z = 0, 0.4 rad to both sides

/// Made by OpenCASCADE itself: rail.step, rail.igs, and hole.step, with a hole of 6 mm at x = 5, y = 4 mm.
std::string sample(const std::string& name) {
  std::ifstream file(std::filesystem::path(TREADMARK_SOURCE_DIR) / "tests/io/cad/data" / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Cad : public ::testing::Test {
 protected:
  CadSections read(const std::string& text, const std::string& name = "rail.step", Body body = Body::rail) const {
    write_file(folder_.path() / name, text);
    return read_cad(folder_.path() / name, body, body == Body::wheel ? 0.46 : 0.0);
  }
  std::string refusal(const std::string& text, const std::string& name = "rail.step", Body body = Body::rail) const {
    return error_of([&] { read(text, name, body); });
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }
  const treadmark::testing::TemporaryFolder folder_;
};

void expect_crown(const Profile& p, double tolerance, double scale = 1.0) {
  ASSERT_GT(p.y.size(), 200u);
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    const double y = p.y[i] / scale;
    EXPECT_NEAR(p.z[i] / scale, kRadius - std::sqrt(kRadius * kRadius - y * y), tolerance) << i;
  }
  EXPECT_NEAR(p.y.front() / scale, -kRadius * std::sin(0.4), 3e-5);
  EXPECT_NEAR(p.y.back() / scale, kRadius * std::sin(0.4), 3e-5);
}

TEST_F(Cad, AnExtrudedFaceIsOneProfile) {
  for (const char* name : {"rail.step", "rail.igs"}) {
    const CadSections s = read(sample(name), name);
    ASSERT_TRUE(std::holds_alternative<Profile>(s.shape)) << name;
    expect_crown(std::get<Profile>(s.shape), 1e-9);
    EXPECT_THAT(s.note, HasSubstr(name == std::string("rail.igs") ? "1 faces in MM" : "1 faces in millimetre"));
  }
}

TEST_F(Cad, CountsInTheUnitOfTheFile) {
  // ten times as large: in centimetres
  const CadSections s = read(replaced(sample("rail.step"), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.CENTI.,.METRE.)"));
  const auto& p = std::get<Profile>(s.shape);
  EXPECT_NEAR(p.z.front(), 45e-3, 5e-5) << "deeper nothing is touched";
  for (std::size_t i = 0; i < p.y.size(); i += 20)
    EXPECT_NEAR(p.z[i], 10.0 * kRadius - std::sqrt(100.0 * kRadius * kRadius - p.y[i] * p.y[i]), 1e-9);
}

TEST_F(Cad, RefusesWhatDoesNotSayItsUnit) {
  const std::string text = sample("rail.step");
  const std::size_t from = text.find("GLOBAL_UNIT_ASSIGNED_CONTEXT"), to = text.find("REPRESENTATION_CONTEXT", from);
  EXPECT_THAT(refusal(text.substr(0, from) + text.substr(to)), HasSubstr("does not say its unit of length"));
  EXPECT_THAT(refusal(replaced(text, "(#92,#93,#94)", "(#93,#94)")), HasSubstr("does not say its unit of length"));
}

TEST_F(Cad, NamesTheEntityBesideAHole) {
  EXPECT_THAT(refusal(sample("hole.step")),
              AllOf(HasSubstr("hole or ends at x = "), HasSubstr("beside the entity #"), HasSubstr("AdvancedFace")));
}

TEST_F(Cad, RefusesWhatIsNoFileOfItsKind) {
  EXPECT_THAT(refusal(""), HasSubstr("no STEP file"));
  EXPECT_THAT(refusal("hello"), HasSubstr("no STEP file"));
  EXPECT_THAT(refusal("hello", "a.iges"), HasSubstr("the CAD file"));
  EXPECT_THAT(refusal(sample("rail.step").substr(0, 2500)), HasSubstr("no STEP file"));
  EXPECT_THAT(error_of([&] { read_cad(folder_.path() / "none.step", Body::rail, 0.0); }), HasSubstr("cannot open"));
  // as a wheel the cylinder's axis lies across
  EXPECT_NE(refusal(sample("rail.step"), "rail.step", Body::wheel), "");
}

TEST_F(Cad, WritesWhatItReads) {
  CadPoints wheel{Body::wheel, {}, {}, 0.0, 2.0 * std::acos(-1.0), {}, 0};
  for (int k = -200; k <= 200; ++k) {
    wheel.y.push_back(0.25e-3 * k);
    wheel.h.push_back(0.46 + 2e-3 * std::sin(60.0 * wheel.y.back()));
  }
  const auto file = folder_.path() / "wheel.step";
  write_cad(file, wheel);
  const CadSections s = read_cad(file, Body::wheel, 0.46);
  ASSERT_TRUE(std::holds_alternative<Profile>(s.shape));
  const auto& p = std::get<Profile>(s.shape);
  EXPECT_GT(p.y.front(), p.y.back());
  for (std::size_t i = 0; i < p.y.size(); ++i) EXPECT_NEAR(p.z[i], 2e-3 * std::sin(60.0 * p.y[i]), 1e-9) << i;
  std::ifstream once(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(once), {}};
  write_cad(file, wheel);
  std::ifstream again(file, std::ios::binary);
  EXPECT_EQ(bytes, (std::string{std::istreambuf_iterator<char>(again), {}})) << "the same surface, the same bytes";
  EXPECT_THAT(error_of([&] { write_cad(folder_.path() / "wheel.igs", wheel); }), HasSubstr("written as STEP"));
}

TEST_F(Cad, AFaceThatChangesBecomesSlices) {
  CadPoints rail{Body::rail, {}, {}, 0.0, 0.0, {}, 0};
  const auto z = [](double x, double y) {
    return kRadius - std::sqrt(kRadius * kRadius - y * y) + 1e-4 * std::cos(60.0 * x);
  };
  for (int i = 0; i <= 60; ++i, ++rail.stations)
    for (int k = -30; k <= 30; ++k) rail.grid.emplace_back(1e-3 * i, 0.7e-3 * k, z(1e-3 * i, 0.7e-3 * k));
  const auto file = folder_.path() / "rail.stp";
  write_cad(file, rail);
  const CadSections s = read_cad(file, Body::rail, 0.0);
  ASSERT_TRUE(std::holds_alternative<SliceSet>(s.shape));
  const auto& slices = std::get<SliceSet>(s.shape);
  ASSERT_GT(slices.u.size(), 10u);
  EXPECT_NEAR(slices.u.front(), 0.0, 3e-5);
  EXPECT_NEAR(slices.u.back(), 0.06, 3e-5);
  for (std::size_t i = 0; i < slices.u.size(); ++i)
    for (std::size_t k = 0; k < slices.profiles[i].y.size(); k += 7)
      EXPECT_NEAR(slices.profiles[i].z[k], z(slices.u[i], slices.profiles[i].y[k]), 1e-7) << slices.u[i];
}

TEST_F(Cad, SurvivesDamagedFiles) {
  std::mt19937 random(5);
  const std::string letters = "0123456789#$*().,-'E ";
  int read_well = 0, refused = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::string name = trial % 3 == 0 ? "rail.igs" : trial % 3 == 1 ? "hole.step" : "rail.step";
    std::string text = sample(name);
    for (unsigned k = 0; k <= random() % 6; ++k) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0)
        text[at] = letters[random() % letters.size()];
      else
        text.erase(at, random() % 30);
    }
    const std::string said = refusal(text, name);
    EXPECT_THAT(said, ::testing::AnyOf(std::string(), HasSubstr("input data: "))) << trial;
    ++(said.empty() ? read_well : refused);
  }
  EXPECT_GT(refused, 5);
  EXPECT_GT(read_well + refused, 39);
}

}  // namespace
}  // namespace treadmark::io
