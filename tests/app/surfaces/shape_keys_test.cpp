// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Every key of a shape acts on every kind of shape, or is refused by its name. The keys come from the table that the
// reader has, so that a new one is walked without being named here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/surfaces/convert_profile.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

/// A standard profile as points, with what the keys of profiles look for: a corner, a step, a point twice.
std::string points_text(const std::filesystem::path& folder, const std::string& name, bool wheel) {
  const std::filesystem::path file = folder / (wheel ? "all_wheel.csv" : "all_rail.csv");
  convert_profile(name, file, {}, {});
  std::ifstream in(file);
  std::string line, out;
  const double corner = wheel ? 40.0 : 15.0, step = wheel ? 10.0 : -5.0, down = wheel ? -1.0 : 1.0;
  int count = 0;
  double y_before = 0.0, z_before = 0.0;
  const auto add = [&](double y, double z) {
    if (y > corner) z += down * 0.8 * (y - corner);  // a corner of 39 degrees
    if (y > step) z += down * 0.5;                   // up and down again within the spacing of the points
    out += fmt::format("{:.9f} {:.9f}\n", y, z);
  };
  while (std::getline(in, line)) {
    std::istringstream words(line);
    double y = 0.0, z = 0.0;
    char comma = ',';
    if (!(words >> y >> comma >> z)) continue;
    if (wheel ? y < -71.0 : std::fabs(y) > 34.0) continue;
    if (count > 0 && (y_before - corner) * (y - corner) < 0.0)
      add(corner, z_before + (z - z_before) * (corner - y_before) / (y - y_before));
    add(y, z);
    if (++count == 20) add(y, z);
    y_before = y, z_before = z;
  }
  return out;
}

/// Wheel or rail of each kind, by the lines of a case file that make it.
class Shapes {
 public:
  explicit Shapes(Body body) { write(body); }

  std::vector<std::pair<std::string, std::string>> kinds(Body body) const {
    const std::string b = body == Body::wheel ? "wheel" : "rail";
    const auto file = [&](const char* extension) { return fmt::format("{0}.shape.file = \"{0}{1}\"\n", b, extension); };
    std::vector<std::pair<std::string, std::string>> all{
        {"points", file(".txt")},
        {"slices", file(body == Body::wheel ? ".slcw" : ".slcs")},
        {"standard", fmt::format("{}.shape.standard = \"{}\"\n", b, body == Body::wheel ? "S1002" : "60E1")},
        {"arcs", b + ".shape.start_y_mm = -30\n" + b +
                     ".shape.arcs = [{ length_mm = 30, radius_mm = 300 }, { length_mm = 30, radius_mm = 400 }]\n"}};
    all.emplace_back("triangles", file(".ply"));
    if (has_part("openvdb")) all.emplace_back("offsets", file(".vdb"));
    if (has_part("cad")) all.emplace_back("CAD", file(".step"));
    if (has_part("expat")) all.emplace_back("splines", file(".xml"));
    if (body == Body::rail) {
      all.emplace_back("crossing", "rail.shape.standard = \"60E1\"\nrail.shape.crossing = \"nose\"\n");
      all.emplace_back("parts",
                       "[[rail.parts]]\nstandard = \"60E1\"\n[[rail.parts]]\nstandard = \"54E1\"\ny_mm = 80\n");
    }
    return all;
  }

  /// Heights of the surface, or why there is none.
  struct Outcome {
    std::vector<double> heights;
    std::string error;
  };

  Outcome made(Body body, const std::string& lines, const std::vector<std::string>& overrides) const {
    const std::string other =
        body == Body::wheel ? "rail.shape.standard = \"60E1\"\n" : "wheel.shape.standard = \"S1002\"\n";
    input_.write("case.toml", "wheelset.vertical_force_N = 1e5\nwheelset.nominal_radius_mm = 460\n" + other + lines);
    Outcome out;
    try {
      const io::CaseFile file = io::read_any_case((input_.folder() / "case.toml").string(), overrides);
      const auto& input = std::get<io::WheelRailCase>(file.cases.at(0).content);
      SurfaceStore store;
      const bool wheel = body == Body::wheel;
      constexpr double kAround = 0.08, kAlong = 0.06;
      const Region region = wheel ? Region{-kAround, kAround} : Region{-kAlong, kAlong};
      const StoredSurface& surface = store.get(wheel ? input.wheel : input.rail, body, wheel ? 0.46 : 0.0, region);
      std::vector<double> y;
      for (double at = -45e-3; at < 45e-3; at += 1.37e-3) y.push_back(at);
      std::vector<double> z(y.size());
      for (const double u : {-0.041, 0.0, 0.013, 0.033}) {
        section_heights(*surface.represented.surface, body, u, y, {z, {}, {}});
        out.heights.insert(out.heights.end(), z.begin(), z.end());
      }
    } catch (const Error& error) {
      out.error = error.what();
    }
    return out;
  }

 private:
  void write(Body body) const {
    const bool wheel = body == Body::wheel;
    const std::string b = wheel ? "wheel" : "rail", standard = wheel ? "S1002" : "60E1";
    const std::string points = points_text(input_.folder(), standard, wheel);
    // those of a wheel from the back of its flange, so that it is placed
    std::string placed;
    std::istringstream lines(points);
    for (double y = 0.0, z = 0.0; lines >> y >> z;) placed += fmt::format("{:.9f} {:.9f}\n", wheel ? y + 70.0 : y, z);
    input_.write(b + ".txt", placed);
    // four sections along, or eight round, each a little lower
    const int count = wheel ? 8 : 4;
    std::string index = fmt::format("0.0 1.0\n{}\n0 0 0\n1\n", count);
    for (int i = 0; i < count; ++i) {
      std::string text;
      std::istringstream in(points);
      for (double y = 0.0, z = 0.0; in >> y >> z;) text += fmt::format("{:.9f} {:.9f}\n", y, z + 0.01 * i);
      input_.write(fmt::format("{}_{}.txt", b, i), text);
      index += fmt::format("{:.6f} '{}_{}.txt'\n", wheel ? -3.1 + 0.78 * i : -90.0 + 60.0 * i, b, i);
    }
    input_.write(b + (wheel ? ".slcw" : ".slcs"), index);
    ConvertSettings settings;
    settings.body = body;
    settings.resolution = 4e-3;
    settings.tolerance = 1e-3;
    if (wheel) settings.nominal_radius = 0.46;
    input_.write("source.toml",
                 "wheelset.vertical_force_N = 1e5\nwheelset.nominal_radius_mm = 460\n"
                 "wheel.shape.standard = \"S1002\"\nrail.shape.standard = \"60E1\"\n"
                 "[[rail.squats]]\nlength_mm = 40\nwidth_mm = 30\ndepth_mm = 0.2\ny_center_mm = 4\n"
                 "[[wheel.flats]]\nlength_mm = 40\ndepth_mm = 0.2\n");
    if (wheel)
      settings.range_theta = {-0.15, 0.15};
    else
      settings.range_x = {-0.08, 0.08};
    const auto convert = [&](const char* part, const char* extension) {
      if (has_part(part)) convert_surface(input_.folder() / "source.toml", input_.folder() / (b + extension), settings);
    };
    convert_surface(input_.folder() / "source.toml", input_.folder() / (b + ".ply"), settings);
    convert("openvdb", ".vdb");
    convert("cad", ".step");
    convert("expat", ".xml");
    std::string table = "x,-20,0,20\n";
    for (int x = -10; x <= 10; ++x) table += fmt::format("{},0,{},0\n", x, x == 0 ? 0.05 : 0.0);
    input_.write("table.csv", table);
  }

  const treadmark::testing::SampleInput input_;
};

bool differ(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kLeast = 1e-9;  // [m]
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isnan(a[i]) != std::isnan(b[i]) || std::fabs(a[i] - b[i]) > kLeast) return true;
  return false;
}

/// Values other than the default that a key may have.
std::vector<std::string> values_of(const io::KeyInfo& key) {
  using Type = io::KeyType;
  std::vector<std::string> values;
  if (key.type == Type::flag) values = {"true", "false"};
  if (key.type == Type::choice)
    for (const std::string& choice : key.choices) values.push_back('"' + choice + '"');
  if (key.path.ends_with(".backend"))
    for (const std::string_view name : backend_names()) values.push_back(fmt::format("\"{}\"", name));
  if (key.path.ends_with("offsets.file")) values = {"\"table.csv\""};
  if (key.type == Type::number)
    for (const double value : {0.0, 0.002, 0.3, 0.8, 3.0, 20.0, 50.0, 170.0})
      if (!(key.above && value <= *key.above) && !(key.at_least && value < *key.at_least) &&
          !(key.at_most && value > *key.at_most))
        values.push_back(fmt::format("{:g}", value));
  std::erase(values, key.default_text);
  return values;
}

/// What has to be said before a key can act.
std::vector<std::vector<std::string>> preludes_of(const std::string& body, const std::string& name) {
  std::vector<std::vector<std::string>> all{{}};
  if (name == "smoothing_method") all.push_back({body + ".shape.smoothing_wavelength_mm=5"});
  if (name.starts_with("crossing_"))
    for (const char* part : {"nose", "wing"}) all.push_back({body + ".shape.crossing=" + part});
  if (name == "resolution_mm") all.push_back({body + ".backend=spline"});
  if (name == "unit" || name == "deviation_unit" || name == "angles_deg")
    all.push_back({body + ".offsets.file=table.csv"});
  return all;
}

/// Whether a message speaks of the key, by its name or as readers of its file call it.
bool names(const std::string& message, const io::KeyInfo& key) {
  const std::string name = key.path.substr(key.path.rfind('.') + 1);
  const std::pair<const char*, const char*> others[] = {
      {"resolution_mm", "resolution"}, {"max_omit", "share"}, {"crossing", "move along the track"}};
  for (const auto& [one, other] : others)
    if (name == one && message.find(other) != std::string::npos) return true;
  const bool table = key.path.find(".offsets.") != std::string::npos && message.find("offsets") != std::string::npos;
  return table || message.find(name) != std::string::npos;
}

/// What happened instead, where none of the values has an effect or is refused by the key's name.
std::string fault_of(const Shapes& shapes, Body body, const std::string& lines, const io::KeyInfo& key,
                     const std::vector<std::string>& prelude, const Shapes::Outcome& before) {
  std::string seen;
  for (const std::string& value : values_of(key)) {
    std::vector<std::string> overrides = prelude;
    overrides.push_back(key.path + "=" + value);
    const Shapes::Outcome after = shapes.made(body, lines, overrides);
    if (after.error.empty() ? differ(before.heights, after.heights) : names(after.error, key)) return "";
    seen += fmt::format(" {}: {};", value, after.error.empty() ? "no effect" : after.error);
  }
  return seen;
}

class ShapeKeys : public ::testing::TestWithParam<Body> {};

INSTANTIATE_TEST_SUITE_P(Bodies, ShapeKeys, ::testing::Values(Body::rail, Body::wheel),
                         [](const auto& body) { return std::string(body_name(body.param)); });

TEST_P(ShapeKeys, ActOrAreRefusedOnEveryKindOfShape) {
  const Body body = GetParam();
  const Shapes shapes(body);
  const std::string b(body_name(body));
  int walked = 0;
  for (const auto& [kind, lines] : shapes.kinds(body)) {
    const Shapes::Outcome plain = shapes.made(body, lines, {});
    ASSERT_EQ(plain.error, "") << kind;
    for (const io::CaseKey& key : io::case_keys()) {
      const std::string& path = key.info.path;
      const bool shape = path.starts_with(b + ".shape.") && key.info.group != b + ".shape.";
      if (!shape && !path.starts_with(b + ".offsets.") && path != b + ".backend" && path != b + ".resolution_mm")
        continue;
      for (const auto& prelude : preludes_of(b, path.substr(path.rfind('.') + 1))) {
        const Shapes::Outcome before = prelude.empty() ? plain : shapes.made(body, lines, prelude);
        if (!before.error.empty()) continue;  // what the key would need is refused already
        EXPECT_EQ(fault_of(shapes, body, lines, key.info, prelude, before), "")
            << b << " from " << kind << ": " << path << (prelude.empty() ? "" : " with " + prelude.front());
        ++walked;
      }
    }
  }
  EXPECT_GT(walked, 100);
}

}  // namespace
}  // namespace treadmark::app
