// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/response_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "treadmark/analysis/measures/bands.hpp"
#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/stability/straight_vehicle.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/histories/channels.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/model/vehicle/assessment.hpp"
#include "treadmark/solvers/vehicle/frequencies.hpp"
#include "treadmark/solvers/vehicle/stability/response.hpp"
#include "treadmark/solvers/vehicle/stability/stability.hpp"

namespace treadmark::app {
namespace {

using Complex = std::complex<double>;
using vehicle::FrequencyResponse;
using vehicle::ResponseInput;

/// Of a response at an angular frequency [rad/s].
using Channel = std::function<Complex(const FrequencyResponse&, double omega)>;

/// Parts with their names and units.
template <class Part>
struct Named {
  std::vector<std::string> names, units;
  std::vector<Part> parts;

  void add(std::string name, std::string unit, Part part) {
    names.push_back(std::move(name));
    units.push_back(std::move(unit));
    parts.push_back(std::move(part));
  }
  bool has(const std::string& pattern) const {
    return ranges::any_of(names, [&](const std::string& name) { return io::fits(name, pattern); });
  }
  /// Indices of those that fit one of the patterns. what: they are, in messages. Errors: Error(configuration) for a
  /// pattern that fits none.
  std::vector<std::size_t> chosen(const std::vector<std::string>& patterns, std::string_view what) const {
    for (const std::string& pattern : patterns)
      if (!has(pattern))
        throw Error(ErrorKind::configuration, fmt::format("no {} is called '{}'", what, pattern), {},
                    advice_on_name(pattern, names, "* stands for any letters; see docs/response.md"));
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (ranges::any_of(patterns, [&](const std::string& pattern) { return io::fits(names[i], pattern); }))
        out.push_back(i);
    return out;
  }
};

ResponseInput rough_rail(const vehicle::VehicleOnTrack& v, wheelrail::Side side) {
  const auto wheel = ranges::find(v.wheels, side, &vehicle::WheelOnRail::side);
  return {ResponseInput::Kind::rail_roughness, {}, static_cast<std::size_t>(wheel - v.wheels.begin())};
}

Named<ResponseInput> all_inputs(const vehicle::VehicleOnTrack& v) {
  using Kind = ResponseInput::Kind;
  Named<ResponseInput> all;
  for (std::size_t i = 0; i < kIrregularityNames.size(); ++i)
    all.add(std::string(kIrregularityNames[i]), "m", {Kind::irregularity, static_cast<Irregularity>(i), 0});
  for (std::size_t i = 0; i < v.wheels.size(); ++i) {
    all.add(v.wheels[i].name + ".lateral_force", "N", {Kind::lateral_force, {}, i});
    all.add(v.wheels[i].name + ".vertical_force", "N", {Kind::vertical_force, {}, i});
    all.add(v.wheels[i].name + ".roughness", "m", {Kind::wheel_roughness, {}, i});
  }
  for (const wheelrail::Side side : {wheelrail::Side::left, wheelrail::Side::right})
    all.add(side == wheelrail::Side::left ? "left_rail.roughness" : "right_rail.roughness", "m", rough_rail(v, side));
  return all;
}

/// Forces of wheels, accelerations of axle boxes and points, motions of bodies, by the names that histories have.
Named<Channel> all_channels(const io::SimulationFile& file, const vehicle::VehicleOnTrack& v) {
  Named<Channel> all;
  for (std::size_t i = 0; i < v.wheels.size(); ++i) {
    all.add(v.wheels[i].name + ".Q_N", "N", [i](const FrequencyResponse& r, double) { return r.vertical[i]; });
    all.add(v.wheels[i].name + ".Y_N", "N", [i](const FrequencyResponse& r, double) { return r.lateral[i]; });
  }
  const auto add_point = [&](const std::string& name, const vehicle::Multibody::Body& body, const Vec3& arm) {
    const auto of = [at = body.coordinate](const FrequencyResponse& r, Freedom f) {
      const int c = at[static_cast<std::size_t>(f)];
      return c < 0 ? Complex(0.0) : r.coordinate[c];
    };
    // As instruments on the body show it, which lean with it.
    all.add(name + ".ay_m_s2", "m/s2", [=, g = file.settings.gravity](const FrequencyResponse& r, double omega) {
      return -omega * omega * (of(r, Freedom::y) + of(r, Freedom::yaw) * arm.x() - of(r, Freedom::roll) * arm.z()) -
             g * of(r, Freedom::roll);
    });
    const double pitching = body.wheelset < 0 ? arm.x() : 0.0;  // axle boxes do not turn with the axle
    all.add(name + ".az_m_s2", "m/s2", [=](const FrequencyResponse& r, double omega) {
      return -omega * omega * (of(r, Freedom::z) + of(r, Freedom::roll) * arm.y() - of(r, Freedom::pitch) * pitching);
    });
  };
  for (const vehicle::WheelOnRail& wheel : v.wheels) {
    const double y = wheel.side == wheelrail::Side::left ? -file.history.axle_box_y : file.history.axle_box_y;
    const auto& set = v.system.wheelsets[static_cast<std::size_t>(wheel.wheelset)];
    add_point("axle_box." + wheel.name, v.system.bodies[static_cast<std::size_t>(set.body)], {0.0, y, 0.0});
  }
  for (const io::PointInput& point : file.history.points)
    add_point(fmt::format("{}.{}", kPointKinds[static_cast<std::size_t>(point.kind)], point.name),
              *ranges::find(v.system.bodies, point.body, &vehicle::Multibody::Body::name), point.arm);
  for (std::size_t i = 0; i < v.system.coordinates.size(); ++i) {
    const vehicle::Coordinate& c = v.system.coordinates[i];
    if (c.body < 0) continue;
    const std::string unit = static_cast<int>(c.freedom) < 3 ? "m" : "rad";
    all.add(c.name + '_' + unit, unit,
            [i](const FrequencyResponse& r, double) { return r.coordinate[static_cast<Eigen::Index>(i)]; });
  }
  return all;
}

/// An input with its power spectral density over the wavenumber [m2/(rad/m)].
struct Source {
  ResponseInput input;
  std::function<double(double wavenumber)> density;
};

/// Of the roughness of a rail that ISO 3095:2013 allows: the same within each third of an octave.
double iso_3095_density(double wavenumber) {
  const double wavelength = 2.0 * std::numbers::pi / wavenumber;
  for (const double nominal : measures::third_octaves()) {
    const measures::BandEnds ends = measures::ends_of(nominal);
    if (!(wavelength > ends.shortest && wavelength <= ends.longest)) continue;
    const double level = measures::iso_3095_limit(nominal);
    if (std::isnan(level)) return 0.0;
    constexpr double kReference = 1e-6;  // [m]
    return kReference * kReference * std::pow(10.0, level / 10.0) /
           (2.0 * std::numbers::pi * (1.0 / ends.shortest - 1.0 / ends.longest));
  }
  return 0.0;
}

/// What spectra are known of, each independent of the others.
std::vector<Source> sources_of(const std::optional<IrregularitySpec>& spec, bool iso_3095,
                               const vehicle::VehicleOnTrack& v) {
  using Kind = ResponseInput::Kind;
  std::vector<Source> out;
  for (std::size_t i = 0; spec && !spec->table && i < kIrregularityNames.size(); ++i) {
    const SpectralIrregularities& all = spec->spectral;
    if (!all.spectra[i]) continue;
    const double least = 2.0 * std::numbers::pi / all.longest, most = 2.0 * std::numbers::pi / all.shortest;
    out.push_back({{Kind::irregularity, static_cast<Irregularity>(i), 0},
                   [spectrum = *all.spectra[i], factor = spec->factor[i], least, most](double wavenumber) {
                     const bool occurs = wavenumber >= least && wavenumber <= most;
                     return occurs ? factor * factor * density(spectrum, wavenumber) : 0.0;
                   }});
  }
  if (iso_3095)
    for (const wheelrail::Side side : {wheelrail::Side::left, wheelrail::Side::right})
      out.push_back({rough_rail(v, side), iso_3095_density});
  return out;
}

/// By the trapezoidal rule.
double rms_of(const std::vector<double>& frequency, const std::vector<double>& density) {
  double sum = 0.0;
  for (std::size_t i = 1; i < frequency.size(); ++i)
    sum += 0.5 * (density[i] + density[i - 1]) * (frequency[i] - frequency[i - 1]);
  return std::sqrt(sum);
}

}  // namespace

ResponseRun run_response(const ResponseRequest& request, const Progress& progress) {
  ResponseRun run;
  run.request = request;
  run.frequency = vehicle::frequencies(request.from, request.to, request.count);
  io::SimulationFile file = straight_vehicle(request.file, request.overrides);
  run.title = file.title.empty() ? file.vehicle.name : file.title;
  run.notes = file.notes;
  run.speed = file.settings.speed;
  const std::optional<IrregularitySpec> irregularities = std::exchange(file.irregularities, {});
  if (irregularities && irregularities->table)
    run.notes.push_back(
        "irregularities measured place by place have no spectrum here: spectra of responses need spectra");
  const double base = file.layout ? file.layout->cant_base : TrackLayout{}.cant_base;
  file.layout.reset();
  SurfaceStore store;
  ContactTables tables(request.cache);
  const CancellationScope scope(progress.stop);
  vehicle::VehicleOnTrack v = build_vehicle(file, store, &tables).vehicle;
  const Named<ResponseInput> inputs = all_inputs(v);
  const Named<Channel> channels = all_channels(file, v);
  std::vector<std::string> wanted = request.inputs;
  if (wanted.empty()) {
    wanted.assign(kIrregularityNames.begin(), kIrregularityNames.end());
    wanted.push_back(v.wheels.front().name + ".*");
  }
  std::vector<std::string> asked = request.channels;
  if (asked.empty())  // a history has more
    for (const std::string& pattern : file.history.channels)
      if (channels.has(pattern)) asked.push_back(pattern);
  if (asked.empty()) asked.emplace_back("*");
  const std::vector<std::size_t> chosen_inputs = inputs.chosen(wanted, "input"),
                                 chosen = channels.chosen(asked, "channel of a response");
  std::vector<ResponseInput> shakers;
  for (const std::size_t i : chosen_inputs) {
    shakers.push_back(inputs.parts[i]);
    for (const std::size_t c : chosen)
      run.curves.push_back({inputs.names[i], channels.names[c], channels.units[c] + '/' + inputs.units[i], {}});
  }

  const std::vector<Source> sources = sources_of(irregularities, request.iso_3095, v);
  for (const Source& source : sources) shakers.push_back(source.input);
  for (std::size_t i = 0; i < chosen.size() && !sources.empty(); ++i)
    run.spectra.push_back({channels.names[chosen[i]], channels.units[chosen[i]], {}});

  const vehicle::Equilibrium balance = vehicle::find_equilibrium(v);
  if (balance.report.status != Status::ok)
    throw Error(ErrorKind::numerical, balance.report.message, {}, vehicle::kNoEquilibriumAdvice);
  if (!balance.report.message.empty()) run.notes.push_back(balance.report.message);
  for (vehicle::Eigenmode& mode : vehicle::all_eigenmodes(v, balance.state)) {
    if (mode.value.real() > vehicle::StabilitySettings{}.neutral) run.stable = false;
    if (mode.frequency > 0.0 && mode.frequency <= request.to) run.modes.push_back(std::move(mode));
  }
  if (!run.stable) run.notes.emplace_back(kUnstable);
  const vehicle::LinearVehicle linear(v, balance.state, base);
  for (const double frequency : run.frequency) {
    check_cancelled();
    const std::vector<FrequencyResponse> all = linear.at(frequency, shakers);
    const double omega = 2.0 * std::numbers::pi * frequency, wavenumber = omega / run.speed;
    auto curve = run.curves.begin();
    for (std::size_t i = 0; i < chosen_inputs.size(); ++i)
      for (const std::size_t c : chosen) (curve++)->values.push_back(channels.parts[c](all[i], omega));
    std::vector<double> densities;
    for (const auto& source : sources) densities.push_back(source.density(wavenumber));
    for (std::size_t k = 0; k < run.spectra.size(); ++k) {
      double sum = 0.0;
      for (std::size_t i = 0; i < sources.size(); ++i)
        sum += std::norm(channels.parts[chosen[k]](all[chosen_inputs.size() + i], omega)) * densities[i] * 2.0 *
               std::numbers::pi / run.speed;
      run.spectra[k].density.push_back(sum);
    }
  }
  for (ResponseSpectrum& s : run.spectra) s.rms = rms_of(run.frequency, s.density);
  run.system = std::move(v.system);
  return run;
}

}  // namespace treadmark::app
