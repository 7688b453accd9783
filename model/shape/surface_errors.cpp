// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/surface_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark {
namespace {

constexpr double kOfDraws = 1.0, kOfSources = 2.0;  ///< versions: draws alone, and with what they share
constexpr std::size_t kMostSources = 100;           ///< motions or fields
constexpr double kDrawsPerMetre = 1e8;
constexpr std::string_view kSourceNames[] = {"lateral placement", "tilt",         "height", "registration",
                                             "smoothing",         "filled holes", "scanner"};
constexpr double kFarthest = 10.0;      ///< places across, and what is off [m]
constexpr double kFarthestAlong = 1e7;  ///< stations, of rails from wherever they count [m]

[[noreturn]] void refuse_lines(const std::string& why) {
  throw Error(ErrorKind::input_data, fmt::format("the lines '{}' are damaged: {}", kSurfaceErrors, why), {},
              "take the file as it was written, or remove all of these lines; results then do not say what scatter of "
              "the scan leaves uncertain");
}

/// Numbers one after the other.
class Numbers {
 public:
  void add(std::string_view line) {
    const char *at = line.data(), *const end = at + line.size();
    while (true) {
      while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
      if (at == end) return;
      double value = 0.0;
      const auto [next, error] = from_chars(at, end, value);
      if (error != std::errc{} || !std::isfinite(value) ||
          (next < end && *next != ' ' && *next != '\t' && *next != '\r'))
        refuse_lines("a number is expected");
      values_.push_back(value);
      at = next;
    }
  }
  std::size_t left() const { return values_.size() - at_; }
  double take() {
    if (left() == 0) refuse_lines("they end too early");
    return values_[at_++];
  }
  double take(double factor, double most) {
    const double value = factor * take();
    if (!(std::fabs(value) <= most)) refuse_lines("a number is too large");
    return value;
  }
  std::size_t count(std::size_t least) { return count(least, values_.size()); }
  std::size_t count(std::size_t least, std::size_t most) {
    const double value = take();
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) || value != std::floor(value))
      refuse_lines("they do not hold as much as they say");
    return to_whole<std::size_t>(value);
  }
  ErrorSource source() { return static_cast<ErrorSource>(count(0, std::size(kSourceNames) - 1)); }
  /// Errors at places.
  std::vector<double> curve(std::size_t places) {
    if (left() < places) refuse_lines("they do not hold as much as they say");
    std::vector<double> out;
    out.reserve(places);
    for (std::size_t i = 0; i < places; ++i) out.push_back(take(1.0 / kDrawsPerMetre, kFarthest));
    return out;
  }

 private:
  std::vector<double> values_;
  std::size_t at_ = 0;
};

}  // namespace

std::string_view name_of(ErrorSource source) { return kSourceNames[static_cast<std::size_t>(source)]; }

std::vector<double> arc_lengths(const SurfaceErrors& errors) {
  std::vector<double> out(errors.y.size(), 0.0);
  for (std::size_t i = 1; i < out.size(); ++i)
    out[i] = out[i - 1] + std::hypot(errors.y[i] - errors.y[i - 1], errors.z[i] - errors.z[i - 1]);
  return out;
}

std::vector<std::size_t> nearest_draws(const SurfaceErrors& errors, double u, std::size_t most, double period) {
  std::vector<std::size_t> out(errors.u.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  const auto distance = [&](std::size_t k) {
    return std::fabs(period > 0.0 ? std::remainder(errors.u[k] - u, period) : errors.u[k] - u);
  };
  ranges::stable_sort(out, {}, distance);
  out.resize(std::min(most, out.size()));
  return out;
}

ErrorSize size_of(const SurfaceErrors& errors) {
  ErrorSize out;
  double squares = 0.0, count = 0.0;
  for (const std::vector<double>& draw : errors.draws)
    for (const double error : draw) {
      squares += error * error;
      count += 1.0;
      out.largest = std::max(out.largest, std::fabs(error));
    }
  if (count > 0.0) out.rms = std::sqrt(squares / count);
  return out;
}

double deviation_at(const SurfaceErrors& errors, std::size_t place, std::span<const std::size_t> near, double tilt) {
  double variance = 0.0;
  for (const std::size_t draw : near)
    variance += std::pow(errors.draws[draw][place], 2) / static_cast<double>(near.size());
  if (!near.empty())
    for (const SurfaceErrors::Field& field : errors.fields) variance += std::pow(field.at(near.front())[place], 2);
  const double y = errors.y[place], z = errors.z[place];
  for (const SurfaceErrors::Motion& motion : errors.motions)
    variance +=
        std::pow(std::cos(tilt) * (motion.z + motion.roll * y) - std::sin(tilt) * (motion.y - motion.roll * z), 2);
  return std::sqrt(variance);
}

SurfaceErrors changed(SurfaceErrors errors, double factor, bool mirror_y, bool mirror_z, Stations stations) {
  for (double& y : errors.y) y *= mirror_y ? -factor : factor;
  for (double& z : errors.z) z *= mirror_z && stations != Stations::round ? -factor : factor;
  for (double& u : errors.u)
    u = stations == Stations::along ? factor * u : stations == Stations::round && mirror_z ? kPi - u : u;
  const auto each_curve = [&](const auto& change) {
    for (std::vector<double>& draw : errors.draws) change(draw);
    for (SurfaceErrors::Field& field : errors.fields)
      for (std::vector<double>& sigma : field.sigma) change(sigma);
  };
  each_curve([factor](std::vector<double>& curve) {
    for (double& error : curve) error *= factor;
  });
  const double across = mirror_y ? -1.0 : 1.0, down = mirror_z && stations != Stations::round ? -1.0 : 1.0;
  for (SurfaceErrors::Field& field : errors.fields) field.length *= factor;
  for (SurfaceErrors::Motion& motion : errors.motions)
    motion.y *= across * factor, motion.z *= down * factor, motion.roll *= across * down;
  if (!mirror_y) return errors;
  ranges::reverse(errors.y);
  ranges::reverse(errors.z);
  each_curve([](std::vector<double>& curve) { ranges::reverse(curve); });
  return errors;
}

std::vector<std::string> to_lines(const SurfaceErrors& errors) {
  constexpr std::size_t kLongest = 200;
  const bool sources = !errors.motions.empty() || !errors.fields.empty();
  std::vector<std::string> out{fmt::format("what {} uncertain of this surface, for results of contacts:",
                                           sources ? "its import leaves" : "scatter of the scan leaves")};
  std::string line{kSurfaceErrors};
  const auto put = [&](const std::string& number) {
    if (line.size() + 1 + number.size() > kLongest) out.push_back(std::exchange(line, std::string(kSurfaceErrors)));
    line += ' ';
    line += number;
  };
  const auto put_curve = [&](const std::vector<double>& curve) {
    for (const double error : curve) put(fmt::format("{}", to_whole<std::int64_t>(std::round(kDrawsPerMetre * error))));
  };
  put(fmt::format("{:g}", sources ? kOfSources : kOfDraws));
  put(fmt::format("{}", errors.y.size()));
  put(fmt::format("{}", errors.draws.size()));
  if (sources) put(fmt::format("{}", errors.motions.size())), put(fmt::format("{}", errors.fields.size()));
  for (std::size_t i = 0; i < errors.y.size(); ++i) {
    put(fmt::format("{:.4f}", kMilli * errors.y[i]));
    put(fmt::format("{:.4f}", kMilli * errors.z[i]));
  }
  for (std::size_t k = 0; k < errors.draws.size(); ++k) {
    put(fmt::format("{:.6f}", errors.u[k]));
    put_curve(errors.draws[k]);
  }
  for (const SurfaceErrors::Motion& motion : errors.motions) {
    put(fmt::format("{}", static_cast<int>(motion.source)));
    for (const double number : {motion.y, motion.z, motion.roll}) put(fmt::format("{:.6g}", number));
  }
  for (const SurfaceErrors::Field& field : errors.fields) {
    put(fmt::format("{}", static_cast<int>(field.source)));
    put(fmt::format("{:.6g}", field.length));
    put(fmt::format("{}", field.sigma.size()));
    for (const std::vector<double>& sigma : field.sigma) put_curve(sigma);
  }
  out.push_back(std::move(line));
  return out;
}

std::shared_ptr<const SurfaceErrors> errors_of_lines(std::span<const std::string> lines) {
  Numbers numbers;
  for (const std::string& line : lines)
    if (line.starts_with(kSurfaceErrors)) numbers.add(std::string_view(line).substr(kSurfaceErrors.size()));
  if (numbers.left() == 0) return nullptr;
  const double version = numbers.take();
  if (version != kOfDraws && version != kOfSources) refuse_lines("they are of another version");
  auto out = std::make_shared<SurfaceErrors>();
  const std::size_t places = numbers.count(2), draws = numbers.count(1);
  const bool sources = version == kOfSources;
  const std::size_t motions = sources ? numbers.count(0, kMostSources) : 0,
                    fields = sources ? numbers.count(0, kMostSources) : 0;
  for (std::size_t i = 0; i < places; ++i) {
    out->y.push_back(numbers.take(kMillimetre, kFarthest));
    out->z.push_back(numbers.take(kMillimetre, kFarthest));
  }
  for (std::size_t k = 0; k < draws; ++k) {
    out->u.push_back(numbers.take(1.0, kFarthestAlong));
    out->draws.push_back(numbers.curve(places));
  }
  for (std::size_t k = 0; k < motions; ++k) {
    SurfaceErrors::Motion& motion = out->motions.emplace_back();
    motion.source = numbers.source();
    motion.y = numbers.take(1.0, kFarthest), motion.z = numbers.take(1.0, kFarthest);
    motion.roll = numbers.take(1.0, kPi);
  }
  for (std::size_t k = 0; k < fields; ++k) {
    SurfaceErrors::Field& field = out->fields.emplace_back();
    field.source = numbers.source();
    field.length = numbers.take(1.0, kFarthestAlong);
    if (!(field.length > 0.0)) refuse_lines("an error has no length");
    const std::size_t curves = numbers.count(1, draws);
    if (curves != 1 && curves != draws) refuse_lines("they do not hold as much as they say");
    for (std::size_t i = 0; i < curves; ++i) field.sigma.push_back(numbers.curve(places));
  }
  if (numbers.left() != 0) refuse_lines("they do not hold as much as they say");
  return out;
}

}  // namespace treadmark
