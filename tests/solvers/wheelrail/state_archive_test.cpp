// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "solution_bytes.hpp"
#include "standard_pair.hpp"
#include "treadmark/solvers/wheelrail/pair_state.hpp"
#include "two_crowns.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::HistoryUse;
using kalker::Regime;

struct Sequence {
  std::function<Geometry()> geometry = standard_geometry;
  Problem start;
  std::function<void(Problem&)> advance;
};

Geometry wheel_with_a_flat() {
  constexpr double kLength = 0.05;
  const std::vector<WheelFlat> flat = {{.length = kLength, .depth = kLength * kLength / (8.0 * kStandardRadius)}};
  return {analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
          analytic::make_standard_surface({"S1002"}, Body::wheel, kStandardRadius, flat), true, false};
}

void roll(Problem& p) {
  p.history = HistoryUse::keep_going;
  p.state.position.x += p.discretisation.dx;
  p.state.position.pitch -= p.discretisation.dx / kStandardRadius;
}

Sequence sequence_of(Regime regime) {
  Sequence s;
  s.start = standard_problem();
  s.start.regime = regime;
  s.advance = roll;
  return s;
}

/// Two contacts, as patches or as parts of one.
Sequence crowns(testing::Grouping grouping) {
  Sequence s;
  s.geometry = testing::two_crowns;
  s.start = testing::crowns_problem();
  s.start.regime = Regime::transient;
  s.start.state.velocity = {.x = 10.0, .pitch = -10.0 / testing::kRadius * 1.001};
  testing::group(s.start, grouping);
  s.advance = roll;
  return s;
}

std::vector<std::byte> bytes_of(const Pair& pair) {
  ByteWriter out;
  write(pair.save(), out);
  return out.bytes();
}

/// Steps 8 to 20 after step 7, in a pair and on surfaces of their own, give the bits that they give without a break.
void expect_the_same_after_a_break(const Sequence& s, std::size_t patches_at_break = 1) {
  constexpr int kBreak = 7, kSteps = 20;
  Problem p = s.start;
  Pair pair(s.geometry());
  PairSolution last = pair.solve(p);
  for (int step = 1; step <= kBreak; ++step) s.advance(p), last = pair.solve(p);
  ASSERT_EQ(last.patches.size(), patches_at_break) << last.message;
  const std::vector<std::byte> bytes = bytes_of(pair);
  Pair other(s.geometry());
  ByteReader in(bytes);
  other.restore(read_state(in));
  EXPECT_TRUE(in.at_end());
  EXPECT_EQ(bytes_of(other), bytes);
  for (int step = kBreak + 1; step <= kSteps; ++step) {
    s.advance(p);
    ASSERT_EQ(SolutionBytes::of(other.solve(p)), SolutionBytes::of(pair.solve(p))) << "step " << step;
  }
}

TEST(StateArchive, TransientRollingOverAFlatGoesOnToTheLastBit) {
  Sequence s = sequence_of(Regime::transient);
  s.geometry = wheel_with_a_flat;
  // The break comes where the wheel tips over the edge of its flat.
  s.start.state.position.pitch = 0.058;
  s.start.solver.eps = 1e-7;
  expect_the_same_after_a_break(s);
}

TEST(StateArchive, AStateHasTheHistoryInIt) {
  Pair pair(standard_geometry());
  Problem p = sequence_of(Regime::transient).start;
  pair.solve(p);
  for (int i = 0; i < 3; ++i) roll(p), pair.solve(p);
  const std::vector<std::byte> bytes = bytes_of(pair);
  roll(p);
  Pair restored(standard_geometry()), fresh(standard_geometry());
  ByteReader in(bytes);
  restored.restore(read_state(in));
  EXPECT_GT(std::abs(restored.solve(p).load.track.force.x()), 1.5 * std::abs(fresh.solve(p).load.track.force.x()));
}

TEST(StateArchive, SteadyRollingWithDampingGoesOnToTheLastBit) {
  Sequence s = sequence_of(Regime::steady);
  s.start.damping = Damping{1e-4, 1e-4, 1e9, 1e9};
  s.advance = [](Problem& p) {
    roll(p);
    p.state.position.y += 1e-5;
  };
  expect_the_same_after_a_break(s);
}

TEST(StateArchive, ShiftsGoOnToTheLastBit) {
  Sequence s = sequence_of(Regime::shift);
  s.start.state.velocity = {.x = 2e-6, .y = 3e-6, .yaw = 1e-5};
  s.advance = [](Problem& p) { p.history = HistoryUse::keep_going; };
  expect_the_same_after_a_break(s);
}

TEST(StateArchive, ALeftHandPairGoesOnToTheLastBit) {
  Sequence s = sequence_of(Regime::transient);
  s.start.side = Side::left;
  expect_the_same_after_a_break(s);
}

TEST(StateArchive, SeveralPatchesGoOnToTheLastBit) {
  expect_the_same_after_a_break(crowns(testing::Grouping::apart), 2);
}

TEST(StateArchive, SubPatchesWithAPlasticLayerGoOnToTheLastBit) {
  Sequence s = crowns(testing::Grouping::parts_of_one);
  s.start.material.layer_yield = 1e7;
  const PairSolution first = Pair(s.geometry()).solve(s.start);
  ASSERT_EQ(first.patches.at(0).region.parts.size(), 2u);
  EXPECT_FALSE(first.patches[0].contact.plastic_x.empty());
  expect_the_same_after_a_break(s);
}

TEST(StateArchive, FastsimGoesOnToTheLastBit) {
  Sequence s = sequence_of(Regime::steady);
  s.start.tangential_model = kalker::TangentialModel::fastsim;
  expect_the_same_after_a_break(s);
}

class DamagedState : public ::testing::Test {
 protected:
  void SetUp() override {
    Pair pair(standard_geometry());
    Problem p = sequence_of(Regime::transient).start;
    p.discretisation.dx = p.discretisation.ds = 2e-3;
    pair.solve(p);
    roll(p);
    pair.solve(p);
    bytes_ = bytes_of(pair);
  }
  static ErrorKind refusal(std::span<const std::byte> bytes) {
    try {
      ByteReader in(bytes);
      read_state(in);
    } catch (const Error& error) {
      return error.kind();
    }
    ADD_FAILURE() << "a damaged state was taken";
    return ErrorKind::numerical;
  }
  std::vector<std::byte> bytes_;
};

TEST_F(DamagedState, TruncatedBytesAreRefused) {
  ASSERT_GT(bytes_.size(), 5000u);
  for (std::size_t length = 0; length < bytes_.size(); length += 97)
    EXPECT_EQ(refusal(std::span(bytes_).first(length)), ErrorKind::input_data) << length;
}

TEST_F(DamagedState, ASingleWrongBitIsRefused) {
  for (std::size_t at = 0; at < bytes_.size(); at += 89) {
    std::vector<std::byte> wrong = bytes_;
    wrong[at] ^= std::byte{1} << (at % 8);
    EXPECT_EQ(refusal(wrong), ErrorKind::input_data) << at;
  }
}

TEST_F(DamagedState, AnotherFormatIsRefusedByName) {
  bytes_[0] = std::byte{99};
  try {
    ByteReader in(bytes_);
    read_state(in);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("format 99"), std::string::npos) << error.message();
  }
}

TEST(StateArchive, NoStateIsAFreshOne) {
  ByteWriter out;
  write(std::shared_ptr<const Pair::State>(), out);
  ByteReader in(out.bytes());
  Pair pair(standard_geometry()), fresh(standard_geometry());
  pair.solve(standard_problem());
  pair.restore(read_state(in));
  EXPECT_EQ(bytes_of(pair), bytes_of(fresh));
}

}  // namespace
}  // namespace treadmark::wheelrail
