// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/model/remarks.hpp"
#include "treadmark/tests/app/measured/disguise.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

/// A section means the same however it was written down: the answer is that of the shape, or doubted, or refused.
/// scripts/profile-trials.py does the same with many more through the program.
namespace treadmark::testing {
namespace {

namespace fs = std::filesystem;
using app::MeasuredFile;
using app::WheelNumbers;

constexpr std::size_t kRuns = 400, kMeasured = 100;

struct Contact {
  double pmax = 0.0, y = 0.0, angle = 0.0;  ///< [Pa], [m], [rad]
  double noise = 0.0;                       ///< standard deviation of the pressure that is stated [Pa]
};

struct RunAnswer {
  bool refused = false, doubted = false;
  std::string why;
  std::vector<Contact> contacts;  ///< one a position
};

/// At these lateral positions [mm]. The wheelset stands where its contact does not jump.
RunAnswer run(const BaseShape& base, const fs::path& file, const std::string& positions) {
  const bool wheel = base.body == Body::wheel;
  const std::string own = fmt::format("shape.file = \"{}\"", file.string());
  const std::string text = fmt::format(
      "wheel.{}\nrail.{}\n[track]\ncant = \"1:40\"\ngauge_mm = 1435\n[wheelset]\nnominal_radius_mm = 460\n"
      "vertical_force_N = 100e3\nvelocity_m_s = 20\nrolling = \"free\"\n[discretisation]\ndx_mm = 0.5\nds_mm = 0.5\n"
      "[[cases]]\nwheelset.y_mm = {}\n",
      wheel ? own : "shape.standard = \"S1002\"", wheel ? "shape.standard = \"60E1\"" : own, positions);
  RunAnswer answer;
  try {
    const io::CaseFile cases = io::parse_case_text(text, file.parent_path() / "case.toml");
    const io::RunResult result = app::run_cases(cases);
    for (const io::CaseResult& c : result.cases) {
      if (c.status == Status::failed || c.status == Status::no_contact || c.status == Status::not_converged) {
        answer.refused = true;
        answer.why += c.message;
        continue;
      }
      answer.doubted = answer.doubted || c.status != Status::ok || any_grave(c.remarks);
      Contact& contact = answer.contacts.emplace_back();
      double most = -1.0;
      for (const io::PatchResult& patch : c.patches) {
        contact.pmax = std::max(contact.pmax, patch.pmax);
        if (patch.fn <= most) continue;
        most = patch.fn;
        contact.y = patch.y_tr, contact.angle = patch.angle;
        contact.noise = patch.noise ? patch.noise->pmax : 0.0;
      }
    }
  } catch (const Error& error) {
    answer.refused = true;
    answer.why = error.what();
  }
  return answer;
}

/// The shape in a format that says its axes and its unit.
fs::path said_file(const TemporaryFolder& folder, const BaseShape& base, double tilt_deg) {
  Disguise plain;
  plain.reader = Disguise::Reader::simpack;
  plain.unit_said = true;
  plain.step = 0.1;
  plain.rounded = 1e-6;
  plain.tilt_deg = tilt_deg;
  const DisguisedFile file = disguised(base, plain, 0);
  return folder.write("true" + file.ending, file.bytes);
}

class DisguisedProfiles : public ::testing::Test {
 protected:
  /// Near the position of the trials, so that a jump of the contact within 0.1 mm is no wrong answer.
  const std::vector<Contact>& truth(const BaseShape& shown, double tilt_deg) {
    const BaseShape& base = base_shape(shown.true_shape);
    auto& kept = truth_[{base.name, tilt_deg}];
    if (kept.empty()) {
      const RunAnswer answer = run(base, said_file(folder_, base, tilt_deg), "[-0.1, 0, 0.1]");
      EXPECT_FALSE(answer.refused && tilt_deg == 0.0) << base.name << ' ' << answer.why;
      kept = answer.contacts;
    }
    return kept;
  }

  fs::path write(const DisguiseTrial& trial, std::uint64_t number) const {
    const DisguisedFile file = disguised(*trial.base, trial.how, number);
    return folder_.write(fmt::format("{}/profile{}", number, file.ending), file.bytes);
  }

  TemporaryFolder folder_;

 private:
  std::map<std::pair<std::string, double>, std::vector<Contact>> truth_;
};

/// How far an answer may be off: what points that are rough or few leave open.
struct Allowance {
  double pressure, place, angle, length;  ///< [1], [m], [rad], [m]
};

Allowance allowance(const Disguise& how) {
  if (how.noise > 10e-3 || how.rounded > 10e-3) return {0.15, 2e-3, 0.02, 0.15e-3};
  if (how.step > 0.5) return {0.08, 1e-3, 0.01, 0.08e-3};
  if (how.noise > 1e-3 || how.rounded > 1e-3 || how.spike != 0.0) return {0.05, 1e-3, 0.01, 0.08e-3};
  return {0.05, 0.5e-3, 0.005, 0.03e-3};
}

bool as_in(const std::vector<Contact>& truth, const Contact& contact, const Allowance& allowed) {
  return std::any_of(truth.begin(), truth.end(), [&](const Contact& t) {
    return std::fabs(contact.pmax - t.pmax) <= std::max(allowed.pressure * t.pmax, 2.0 * contact.noise) &&
           std::fabs(contact.y - t.y) <= allowed.place && std::fabs(contact.angle - t.angle) <= allowed.angle;
  });
}

std::vector<double> tilts_meant(const Disguise& how) {
  // what is inclined as rails are may be meant so
  if (how.tilt_deg != 0.0 && std::fabs(how.tilt_deg) <= 3.0) return {0.0, how.tilt_deg};
  return {0.0};
}

TEST_F(DisguisedProfiles, RunAsTheShapeOrAreDoubtedOrRefused) {
  std::size_t right = 0, doubted = 0, refused = 0;
  for (std::uint64_t k = 0; k < kRuns; ++k) {
    const DisguiseTrial trial = disguise_trial(k);
    const RunAnswer answer = run(*trial.base, write(trial, k), "0");
    if (answer.refused) {
      ++refused;
      continue;
    }
    ASSERT_EQ(answer.contacts.size(), 1U) << trial.words;
    const auto tilts = tilts_meant(trial.how);
    const bool is_right = std::any_of(tilts.begin(), tilts.end(), [&](double tilt) {
      return as_in(truth(*trial.base, tilt), answer.contacts[0], allowance(trial.how));
    });
    if (is_right)
      ++right;
    else if (answer.doubted)
      ++doubted;
    else
      ADD_FAILURE() << trial.words
                    << fmt::format(": {:.0f} MPa at {:.2f} mm, {:.4f} rad for {:.0f} at {:.2f}, {:.4f}",
                                   1e-6 * answer.contacts[0].pmax, 1e3 * answer.contacts[0].y, answer.contacts[0].angle,
                                   1e-6 * truth(*trial.base, 0.0)[1].pmax, 1e3 * truth(*trial.base, 0.0)[1].y,
                                   truth(*trial.base, 0.0)[1].angle);
  }
  RecordProperty("right", static_cast<int>(right));
  RecordProperty("doubted", static_cast<int>(doubted));
  RecordProperty("refused", static_cast<int>(refused));
  EXPECT_GT(right, kRuns / 2) << doubted << " doubted, " << refused << " refused";
}

// --- measures

struct WheelRow {
  const char* name;
  measures::Measure WheelNumbers::*at;
};

TEST_F(DisguisedProfiles, MeasureAsTheShapeOrAreRefused) {
  const WheelRow rows[]{{"flange height", &WheelNumbers::flange_height},
                        {"flange thickness", &WheelNumbers::flange_thickness},
                        {"flange gradient", &WheelNumbers::flange_gradient},
                        {"hollow", &WheelNumbers::hollow}};
  const app::MeasureRequest request;
  std::size_t right = 0;
  for (std::uint64_t k = kRuns, tried = 0; tried < kMeasured; ++k) {
    const DisguiseTrial trial = disguise_trial(k);
    if (trial.base->body != Body::wheel) continue;
    ++tried;
    WheelNumbers numbers;
    try {
      const MeasuredFile file = app::measure_file(write(trial, k).string(), request);
      if (file.doubtful) continue;
      numbers = std::get<WheelNumbers>(file.numbers);
    } catch (const Error&) {
      continue;
    }
    std::string off;
    for (const double tilt : tilts_meant(trial.how)) {
      const fs::path file = said_file(folder_, base_shape(trial.base->true_shape), tilt);
      const WheelNumbers truth = std::get<WheelNumbers>(app::measure_file(file.string(), request).numbers);
      off.clear();
      for (const WheelRow& row : rows) {
        const measures::Measure &m = numbers.*row.at, &t = truth.*row.at;
        if (m.known() && !(std::fabs(m.value - t.value) <= std::max(2.0 * m.uncertainty, allowance(trial.how).length)))
          off += fmt::format(", {} {:.3f} mm for {:.3f}", row.name, 1e3 * m.value, 1e3 * t.value);
      }
      if (off.empty()) break;
    }
    if (off.empty())
      ++right;
    else
      ADD_FAILURE() << trial.words << off;
  }
  EXPECT_GT(right, kMeasured / 2);
}

// Sections of slices are taken as they lie and are not smoothed: they are right, or doubted.
TEST_F(DisguisedProfiles, SlicesOfOneSectionAreRightOrDoubted) {
  const std::array<std::function<void(Disguise&)>, 4> ways{
      [](Disguise& d) { d.noise = 10e-3; }, [](Disguise& d) { d.rounded = 10e-3; },
      [](Disguise& d) { d.tilt_deg = 4.0; }, [](Disguise& d) { d.tilt_deg = -10.0; }};
  for (const char* name : {"new", "60E1", "hollow by 2 mm", "side worn by 4 mm"})
    for (std::size_t k = 0; k <= ways.size(); ++k) {
      const BaseShape& base = base_shape(name);
      Disguise how;
      how.reader = Disguise::Reader::simpack;
      how.unit_said = true;
      how.rounded = 1e-6;
      if (k < ways.size()) ways[k](how);
      const DisguisedFile file = disguised(base, how, k);
      const std::string section = "section" + file.ending;
      folder_.write(section, file.bytes);
      const bool wheel = base.body == Body::wheel;
      std::string text = "0.0 1.0\n5\n0 0 0\n1\n";
      for (const double part : {-1.0, -0.4, 0.0, 0.4, 1.0})
        text += fmt::format("{} '{}'\n", part * (wheel ? 3.14159 : 500.0), section);
      const fs::path slices = folder_.write(wheel ? "sections.slcw" : "sections.slcs", text);
      const RunAnswer answer = run(base, slices, "[0]");
      if (answer.refused || answer.doubted) {
        EXPECT_LT(k, ways.size()) << name << ' ' << answer.why;
        continue;
      }
      const auto& right = truth(base, 0.0);
      EXPECT_TRUE(as_in(right, answer.contacts.at(0), allowance(how))) << name << ' ' << k;
    }
}

}  // namespace
}  // namespace treadmark::testing
