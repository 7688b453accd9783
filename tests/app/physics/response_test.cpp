// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/response_run.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::app {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

const std::string kVehicleRuns = std::string(TREADMARK_SOURCE_DIR) + "/examples/flat-at-speed.toml";
constexpr double kFast = 40.0, kLeading = 10.78, kGravity = 9.81;  // [m/s], [m], [m/s2]

/// The vehicle on round wheels, at constant speed.
std::vector<std::string> round_wheels(double distance) {
  return {"simulation.wheels=[]", "simulation.speed_m_s=" + std::to_string(kFast),
          "simulation.distance_m=" + std::to_string(distance)};
}

ResponseRun response_of(double from, double to, int count, const std::vector<std::string>& overrides = {}) {
  ResponseRequest request;
  request.file = kVehicleRuns;
  request.overrides = round_wheels(1.0);
  request.overrides.insert(request.overrides.end(), overrides.begin(), overrides.end());
  request.from = from;
  request.to = to;
  request.count = count;
  return run_response(request);
}

const std::vector<Complex>& curve(const ResponseRun& run, const std::string& input, const std::string& channel) {
  const auto found =
      ranges::find_if(run.curves, [&](const ResponseCurve& c) { return c.input == input && c.channel == channel; });
  EXPECT_NE(found, run.curves.end()) << input << ' ' << channel;
  return found->values;
}

/// A spring beside a damper with a spring in series.
Complex stiffness(double omega, double k, double c, double series) {
  const Complex damper(0.0, omega * c);
  return k + damper * series / (damper + series);
}

/// How far springs act below the car (secondary ones, traction rods), below a bogie (primary ones) and above it
/// (secondary ones) [m].
struct Levers {
  double car = 0.9725, rod = 1.2, box = 0.14, bogie = 0.2275;
};

/// The vehicle in its vertical plane on lumped track, written down by hand: force of the leading left wheel on its
/// rail, motion of the car, under a level whose phase is that below the leading wheelset. Without levers nothing moves
/// along the track, and ten coordinates are left.
struct InThePlane {
  Complex vertical, car;
};
InThePlane in_the_plane(double frequency, const Levers& levers) {
  constexpr double kPivot = 9.5, kBase = 1.28, kCar = 32e3, kBogie = 2615.0, kSet = 1813.0, kRolling = 112.0,
                   kRadius = 0.46;
  constexpr double kContact = 1.04e9;  // S1002 on an upright 60E1 under 54.5 kN [N/m]; matters little below 30 Hz
  const double omega = 2.0 * pi * frequency, square = omega * omega;
  // Of an axle, of a bogie; half track twice.
  const Complex primary = stiffness(omega, 2 * 1.22e6, 2 * 4e3, 2 * 1e6),
                secondary = stiffness(omega, 2 * 0.43e6, 2 * 20e3, 2 * 6e6),
                primary_x = stiffness(omega, 2 * 31.391e6, 2 * 15e3, 2 * 60e6), secondary_x(2 * 0.16e6, 0.0),
                rod(5e6, omega * 25e3);
  const Complex pads(2 * 1.63761e8, omega * 2 * 1.88955e5), bed(2 * 3.47047e8, omega * 2 * 1.4814e5);
  const Complex below = bed - square * 632.37, rails = -square * 2 * 83.263 + pads * below / (pads + below),
                wheels = 2.0 * kContact * rails / (2.0 * kContact + rails);
  // Up and down and pitch: car z, pitch; bogies z, pitch; wheelsets z. Along the track: bogies, wheelsets, which roll.
  constexpr int kSize = 16, kSets = 6, kBogiesX = 10, kSetsX = 12;
  Eigen::MatrixXcd dynamic = Eigen::MatrixXcd::Zero(kSize, kSize);
  constexpr double kAlong = kSet + kRolling / (kRadius * kRadius);
  const double inertia[kSize] = {kCar, 1.97e6, kBogie, 1476.0, kBogie, 1476.0, kSet,   kSet,
                                 kSet, kSet,   kBogie, kBogie, kAlong, kAlong, kAlong, kAlong};
  for (int i = 0; i < kSize; ++i) dynamic(i, i) = -square * inertia[i];
  using Terms = std::vector<std::pair<int, double>>;
  const auto column = [](const Terms& terms) {
    Eigen::VectorXcd by = Eigen::VectorXcd::Zero(kSize);
    for (const auto& [c, factor] : terms) by[c] += factor;
    return by;
  };
  const auto add = [&](const Terms& stretch, Complex k) {
    const Eigen::VectorXcd by = column(stretch);
    dynamic += k * by * by.transpose();
  };
  // A load that springs bear turns with them, and pushes along where they are bent.
  const auto lean = [&](const Terms& turn, const Terms& bent, double load) {
    const Eigen::VectorXcd a = column(turn), b = column(bent);
    dynamic += load * (a * b.transpose() + b * a.transpose());
  };
  for (int i = 0; i < 2; ++i) {
    const int bogie = 2 + 2 * i, pitch = bogie + 1;
    constexpr double kLoad = kCar * kGravity / 2.0;
    const Terms bent{{1, levers.car}, {kBogiesX + i, -1.0}, {pitch, levers.bogie}};
    add({{0, 1.0}, {1, i == 0 ? -kPivot : kPivot}, {bogie, -1.0}}, secondary);
    add(bent, secondary_x);
    add({{1, levers.rod}, {kBogiesX + i, -1.0}}, rod);
    lean({{1, 0.5}, {pitch, 0.5}}, bent, kLoad);
    dynamic(1, 1) -= kLoad * levers.car;
    dynamic(pitch, pitch) -= kLoad * levers.bogie;
  }
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(kSize);
  for (int set = 0; set < 4; ++set) {
    const int i = set / 2, bogie = 2 + 2 * i, pitch = bogie + 1;
    const double arm = set % 2 == 0 ? kBase : -kBase, place = (set < 2 ? kPivot : -kPivot) + arm;
    constexpr double kLoad = (kCar / 2.0 + kBogie) * kGravity / 2.0;
    const Terms bent{{kBogiesX + i, 1.0}, {pitch, levers.box}, {kSetsX + set, -1.0}};
    add({{bogie, 1.0}, {pitch, -arm}, {kSets + set, -1.0}}, primary);
    add(bent, primary_x);
    lean({{pitch, 1.0}}, bent, kLoad);
    dynamic(pitch, pitch) -= kLoad * levers.box;
    dynamic(kSets + set, kSets + set) += wheels;
    right[kSets + set] = wheels * std::exp(Complex(0.0, omega * (place - kLeading) / kFast));
  }
  const Eigen::VectorXcd moved = dynamic.partialPivLu().solve(right);
  return {0.5 * wheels * (moved[kSets] - 1.0), moved[0]};
}

void expect_in_the_plane(const ResponseRun& run, const Levers& levers) {
  const auto &wheel = curve(run, "longitudinal_level", "ws1_left.Q_N"),
             &car = curve(run, "longitudinal_level", "car.z_m");
  double largest = 0.0;
  for (const Complex& value : car) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < run.frequency.size(); ++i) {
    const InThePlane truth = in_the_plane(run.frequency[i], levers);
    // Rails roll as well, which is seen at high frequencies.
    const double near = run.frequency[i] < 20.0 ? 0.005 : 0.02;
    EXPECT_LT(std::abs(wheel[i] - truth.vertical), near * std::abs(truth.vertical)) << run.frequency[i] << " Hz";
    // The wheelbases filter the car's motion to nothing at some frequencies.
    EXPECT_LT(std::abs(car[i] - truth.car), near * std::abs(truth.car) + 1e-4 * largest) << run.frequency[i] << " Hz";
  }
}

TEST(Response, IsThatOfTheVehicleInItsPlaneByHand) { expect_in_the_plane(response_of(0.5, 40.0, 41), {}); }

// All centres and springs at the height of the axles.
TEST(Response, IsThatOfTenCoordinatesByHand) {
  const ResponseRun run = response_of(0.5, 40.0, 41,
                                      {"vehicle.bodies.car.position_m=[0, 0, -0.46]",
                                       "vehicle.bodies.bogie.positions_m=[[9.5, 0, -0.46], [-9.5, 0, -0.46]]",
                                       "vehicle.springs.secondary.places.0.at_m=[[9.5, -1, -0.46], [9.5, 1, -0.46]]",
                                       "vehicle.springs.secondary.places.1.at_m=[[-9.5, -1, -0.46], [-9.5, 1, -0.46]]",
                                       "vehicle.springs.traction_rod.places.0.at_m=[[9.5, 0, -0.46]]",
                                       "vehicle.springs.traction_rod.places.1.at_m=[[-9.5, 0, -0.46]]"});
  expect_in_the_plane(run, {0.0, 0.0, 0.0, 0.0});
}

struct Wave {
  Irregularity function;
  double frequency, amplitude, phase;  ///< [Hz] at the speed, [m], [rad]
};

/// Waves that a vehicle runs over.
io::SimulationFile over_waves(const std::vector<Wave>& waves, double distance) {
  io::SimulationFile file = io::read_simulation_file(kVehicleRuns, round_wheels(distance));
  IrregularityTable table;
  for (double s = -30.0; s < distance + 60.0; s += 0.1) {
    table.distance.push_back(s);
    for (const Wave& w : waves) table.values[static_cast<std::size_t>(w.function)].resize(table.distance.size());
    for (const Wave& w : waves)
      table.values[static_cast<std::size_t>(w.function)].back() +=
          w.amplitude * std::cos(2.0 * pi * w.frequency * s / kFast + w.phase);
  }
  IrregularitySpec spec;
  spec.table = std::move(table);
  spec.begin = 15.0;
  spec.wind_up = 40.0;
  file.irregularities = spec;
  file.settings.output_every = 0.04;
  file.settings.tolerance = 1e-9;
  return file;
}

/// Complex amplitudes of a column at the frequencies of the waves, by least squares over the times behind a first one.
std::vector<Complex> amplitudes(const io::SimulationResult& r, const std::string& name, const std::vector<Wave>& waves,
                                double from) {
  const std::size_t columns = r.columns.size(), rows = r.values.size() / columns, at = io::column_index(r, name);
  std::vector<std::size_t> used;
  for (std::size_t row = 0; row < rows; ++row)
    if (r.values[row * columns] >= from) used.push_back(row);
  const auto terms = static_cast<Eigen::Index>(2 * waves.size() + 1);
  Eigen::MatrixXd a(static_cast<Eigen::Index>(used.size()), terms);
  Eigen::VectorXd b(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const std::size_t row = used[static_cast<std::size_t>(i)];
    const double t = r.values[row * columns];
    a(i, 0) = 1.0;
    for (std::size_t w = 0; w < waves.size(); ++w) {
      const auto c = static_cast<Eigen::Index>(2 * w + 1);
      a(i, c) = std::cos(2.0 * pi * waves[w].frequency * t);
      a(i, c + 1) = -std::sin(2.0 * pi * waves[w].frequency * t);
    }
    b[i] = r.values[row * columns + at];
  }
  const Eigen::VectorXd x = a.colPivHouseholderQr().solve(b);
  std::vector<Complex> out;
  for (std::size_t w = 0; w < waves.size(); ++w) {
    const auto c = static_cast<Eigen::Index>(2 * w + 1);
    out.emplace_back(x[c], x[c + 1]);
  }
  return out;
}

TEST(Response, IsWhatASimulationMeasures) {
  using enum Irregularity;
  const ResponseRun run = response_of(1.3, 11.0, 15);
  struct Given {
    Irregularity function;
    std::size_t at;  ///< in the frequencies of the response
    double amplitude, phase;
  };
  // So small that contacts are linear: conicity changes by a tenth over 0.05 mm, and where they are changes its slope
  // at loads 0.4 % above those at rest.
  const std::vector<Given> given{{longitudinal_level, 0, 4e-6, 0.3},  {longitudinal_level, 8, 4e-6, 1.1},
                                 {longitudinal_level, 14, 2e-6, 2.0}, {cross_level, 3, 4e-6, 0.7},
                                 {cross_level, 11, 2e-6, 1.9},        {alignment, 2, 2e-6, 0.2},
                                 {alignment, 10, 2e-6, 2.6},          {gauge, 6, 2e-6, 1.4}};
  std::vector<Wave> waves;
  waves.reserve(given.size());
  for (const Given& g : given) waves.push_back({g.function, run.frequency[g.at], g.amplitude, g.phase});
  const std::vector<std::string> channels{"ws1_left.Q_N", "ws3_right.Q_N", "ws1_left.Y_N", "axle_box.ws2_left.ay_m_s2",
                                          "axle_box.ws2_left.az_m_s2"};
  io::SimulationFile file = over_waves(waves, 800.0);
  file.history.channels = channels;
  SurfaceStore store;
  const io::SimulationResult r = run_simulation(file, store, {}, {});
  ASSERT_EQ(r.status, "complete") << r.message;
  for (const std::string& channel : channels) {
    // Columns of the first wheel have no prefix.
    const std::string column = channel.starts_with("ws1_left.") ? channel.substr(9) : channel;
    const std::vector<Complex> measured = amplitudes(r, column, waves, 9.0);
    for (std::size_t w = 0; w < waves.size(); ++w) {
      const Wave& wave = waves[w];
      const std::string name(kIrregularityNames[static_cast<std::size_t>(wave.function)]);
      const Complex truth = std::polar(wave.amplitude, wave.phase + 2.0 * pi * wave.frequency * kLeading / kFast) *
                            curve(run, name, channel)[given[w].at];
      // Beside 2 % of the response: what remains of motions from the start.
      const double floor = channel.ends_with("_N") ? 2e-3 : 1e-6;
      EXPECT_LT(std::abs(measured[w] - truth), 0.02 * std::abs(truth) + floor)
          << channel << ", " << name << " at " << wave.frequency << " Hz: " << measured[w] << " for " << truth;
    }
  }
}

/// Wheels pass the roughness of their rail one after the other, as they pass a level.
TEST(Response, RoughRailsTogetherAreALevel) {
  ResponseRequest request;
  request.file = kVehicleRuns;
  request.overrides = round_wheels(1.0);
  request.from = 2.0, request.to = 40.0, request.count = 3;
  request.inputs = {"*_rail.roughness", "longitudinal_level", "ws1_left.roughness"};
  request.channels = {"ws*.Q_N", "car.*_m"};
  const ResponseRun run = run_response(request);
  for (const std::string channel : {"ws1_left.Q_N", "ws4_right.Q_N", "car.z_m"}) {
    const std::vector<Complex>&left = curve(run, "left_rail.roughness", channel),
          &right = curve(run, "right_rail.roughness", channel), &level = curve(run, "longitudinal_level", channel);
    for (std::size_t i = 0; i < level.size(); ++i)
      EXPECT_LT(std::abs(left[i] + right[i] - level[i]), 1e-6 * std::abs(level[i])) << channel;
  }
  // Below one wheel alone it moves others little, and at 40 Hz that wheel as if there were no others.
  const Complex alone = curve(run, "ws1_left.roughness", "ws1_left.Q_N").back(),
                together = curve(run, "left_rail.roughness", "ws1_left.Q_N").back();
  EXPECT_LT(std::abs(alone - together), 0.1 * std::abs(alone));
}

/// Independent inputs: densities of a channel add up, each times the square of its transfer function.
TEST(Response, SpectraAreThoseOfTheTrackTimesSquares) {
  ResponseRequest request;
  request.file = std::string(TREADMARK_SOURCE_DIR) + "/examples/curve.toml";
  constexpr double kSpeed = 25.0;
  request.from = 0.2, request.to = 12.0, request.count = 40;
  request.inputs = {"longitudinal_level", "alignment"};
  request.channels = {"ws1_left.Q_N", "ws1_left.Y_N"};
  const ResponseRun run = run_response(request);
  ASSERT_EQ(run.spectra.size(), 2u);
  double sum = 0.0, before = 0.0;
  for (const ResponseSpectrum& s : run.spectra)
    for (std::size_t i = 0; i < run.frequency.size(); ++i) {
      const double f = run.frequency[i], k = 2.0 * pi * f / kSpeed;
      const bool occurs = kSpeed / f >= 3.0 && kSpeed / f <= 70.0;
      const double c = 0.8246 * 0.8246, form = c / ((k * k + c) * (k * k + 0.0206 * 0.0206));
      const double level = std::norm(curve(run, "longitudinal_level", s.channel)[i]),
                   alignment = std::norm(curve(run, "alignment", s.channel)[i]);
      const double truth =
          occurs ? (4.032e-7 * level + 2.119e-7 * alignment) * form * 2.0 * pi / kSpeed : 0.0;  // a hertz is 2 pi/V
      EXPECT_NEAR(s.density[i], truth, 1e-9 * truth) << s.channel << ' ' << f << " Hz";
      if (&s != run.spectra.data()) continue;
      if (i > 0) sum += 0.5 * (s.density[i] + before) * (f - run.frequency[i - 1]);
      before = s.density[i];
    }
  EXPECT_NEAR(run.spectra.front().rms, std::sqrt(sum), 1e-9 * std::sqrt(sum));
  EXPECT_EQ(run.spectra.front().unit, "N");
  EXPECT_FALSE(run.modes.empty());
  for (const vehicle::Eigenmode& mode : run.modes) EXPECT_LE(mode.frequency, request.to);
  const std::string picture = modes_svg(run);
  EXPECT_TRUE(picture.find("car.") != std::string::npos && picture.ends_with("</svg>\n")) << picture.size();
}

/// 13 dB in the third of an octave about 0.25 m, which 25 m/s makes 100 Hz.
TEST(Response, RoughnessOfBothRailsIsThatOfTheStandard) {
  ResponseRequest request;
  request.file = kVehicleRuns;
  request.overrides = {"simulation.wheels=[]", "simulation.speed_m_s=25", "simulation.distance_m=1"};
  request.from = 10.0, request.to = 100.0, request.count = 2;
  request.inputs = {"*_rail.roughness"};
  request.channels = {"ws1_left.Q_N"};
  EXPECT_TRUE(run_response(request).spectra.empty());
  request.iso_3095 = true;
  const ResponseRun run = run_response(request);
  ASSERT_EQ(run.spectra.size(), 1u);
  const double middle = std::pow(10.0, -0.6), side = std::pow(10.0, 0.05);
  const double of_track = 1e-12 * std::pow(10.0, 1.3) / (2.0 * pi * (side - 1.0 / side) / middle) * 2.0 * pi / 25.0;
  const double truth = of_track * (std::norm(curve(run, "left_rail.roughness", "ws1_left.Q_N")[1]) +
                                   std::norm(curve(run, "right_rail.roughness", "ws1_left.Q_N")[1]));
  EXPECT_NEAR(run.spectra.front().density[1], truth, 1e-9 * truth);
  EXPECT_EQ(run.spectra.front().density[0], 0.0) << "2.5 m: the standard says nothing";
}

TEST(Response, RefusesWhatItCannotDo) {
  ResponseRequest request;
  request.file = kVehicleRuns;
  request.overrides = round_wheels(1.0);
  request.channels = {"car.w_m"};
  EXPECT_THROW(run_response(request), Error);
  request.channels = {};
  request.from = 5.0;
  request.to = 5.0;
  EXPECT_THROW(run_response(request), Error);
  request.to = 6.0;
  request.overrides = {};
  EXPECT_THROW(run_response(request), Error);  // a wheel with full contact
}

}  // namespace
}  // namespace treadmark::app
