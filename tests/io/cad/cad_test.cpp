// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cad/cad_process.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using treadmark::testing::content_of;
using treadmark::testing::error_of;

constexpr double kRadius = 0.08;  ///< of the samples: a cylinder along x with its crown at z = 0, 0.4 rad to both sides

/// Made by OpenCASCADE itself, in mm:
/// - rail.step, rail.igs; hole.step, with a hole of 6 mm at x = 5, y = 4;
/// - solid.step: a crown of 80 with corners of 13, and below it sides, web with three holes, foot, fillets of 2;
/// - nose.step: crown and corners as of solid.step, three ruled faces, 1.2 times as large at x = 100;
/// - trimmed.step: z = 0.0375 y^2 + 2e-5 (x - 50)^2, cut off askew 55 deep; slanted.step: the same, cut askew in sight;
/// - halves.step: z = 0.005 y^2 + 2e-5 (x - 50)^2, two faces that meet at y = 4.
std::string sample(const std::string& name) {
  return content_of(std::filesystem::path(TREADMARK_SOURCE_DIR) / "tests/io/cad/data" / name);
}

class Cad : public ::testing::Test {
 protected:
  CadSurface read(const std::string& text, const std::string& name = "rail.step", Body body = Body::rail) const {
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
    const CadSurface s = read(sample(name), name);
    ASSERT_TRUE(std::holds_alternative<Profile>(s.shape)) << name;
    expect_crown(std::get<Profile>(s.shape), 1e-9);
    EXPECT_THAT(s.note, HasSubstr(name == std::string("rail.igs") ? "1 faces in MM" : "1 faces in millimetre"));
  }
}

TEST_F(Cad, CountsInTheUnitOfTheFile) {
  // ten times as large: in centimetres
  const CadSurface s = read(replaced(sample("rail.step"), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.CENTI.,.METRE.)"));
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
  EXPECT_THAT(error_of([&] { read_cad(folder_.path() / "none.step", Body::rail, 0.0); }), HasSubstr("does not exist"));
  // as a wheel the cylinder's axis lies across
  EXPECT_THAT(refusal(sample("rail.step"), "rail.step", Body::wheel),
              HasSubstr("its greatest radius about the y axis is 6.31512 mm, the nominal radius 460 mm"));
}

double paraboloid(double x, double y, double b) { return b * y * y + 0.02 * (x - 0.05) * (x - 0.05); }

/// x = u and y = v of a polynomial of degree 3 in each, over knots that divide it.
SplineSurface polynomial_rail() {
  const auto z = [](const std::array<double, 3>& x, const std::array<double, 3>& y) {
    // the blossom of 4 y^2 + 20 x^3 - 100 x^2 y^3
    const auto second = [](const auto& a) { return (a[0] * a[1] + a[1] * a[2] + a[2] * a[0]) / 3.0; };
    const auto third = [](const auto& a) { return a[0] * a[1] * a[2]; };
    return 4.0 * second(y) + 20.0 * third(x) - 100.0 * second(x) * third(y);
  };
  SplineSurface s;
  s.levels.push_back({SplineKnots{3, {0.0, 0.0, 0.0, 0.0, 0.01, 0.025, 0.06, 0.06, 0.06, 0.06}},
                      SplineKnots{3, {-0.03, -0.03, -0.03, -0.03, 0.005, 0.03, 0.03, 0.03, 0.03}}});
  const auto& [u, v] = s.levels.front();
  for (std::size_t j = 0; j < v.functions(); ++j)
    for (std::size_t i = 0; i < u.functions(); ++i) {
      const std::array<double, 3> x{u.knots[i + 1], u.knots[i + 2], u.knots[i + 3]},
          y{v.knots[j + 1], v.knots[j + 2], v.knots[j + 3]};
      s.points.emplace_back((x[0] + x[1] + x[2]) / 3.0, (y[0] + y[1] + y[2]) / 3.0, z(x, y));
    }
  return s;
}

TEST_F(Cad, WritesSectionsThatItReads) {
  CadContent wheel;
  wheel.body = Body::wheel;
  wheel.spline.levels.push_back(
      {SplineKnots{1, {0.0, 0.0, 1.0, 1.0}}, SplineKnots{3, {-0.05, -0.05, -0.05, -0.05, 0.05, 0.05, 0.05, 0.05}}});
  for (int j = 0; j <= 3; ++j)
    for (const double x : {0.0, 1.0}) wheel.spline.points.emplace_back(x, -0.05 + 0.1 * j / 3.0, j < 2 ? 0.46 : 0.466);
  const auto radius = [](double y) {  // of these poles: a smooth step
    const double t = (y + 0.05) / 0.1;
    return 0.46 + 0.006 * t * t * (3.0 - 2.0 * t);
  };
  wheel.swept = {0.0, 2.0 * std::acos(-1.0)};
  wheel.description = "a smooth step";
  const auto file = folder_.path() / "wheel.step";
  write_cad(file, wheel);
  const CadSurface s = read_cad(file, Body::wheel, 0.46);
  ASSERT_TRUE(std::holds_alternative<Profile>(s.shape));
  const auto& p = std::get<Profile>(s.shape);
  EXPECT_GT(p.y.front(), p.y.back());
  for (std::size_t i = 0; i < p.y.size(); ++i) EXPECT_NEAR(p.z[i], radius(p.y[i]) - 0.46, 1e-12) << i;
  const std::string bytes = content_of(file);
  EXPECT_THAT(bytes, HasSubstr("FILE_DESCRIPTION(('a smooth step')"));
  write_cad(file, wheel);
  EXPECT_EQ(bytes, content_of(file)) << "the same surface, the same bytes";
  EXPECT_THAT(error_of([&] { write_cad(folder_.path() / "wheel.igs", wheel); }), HasSubstr("written as STEP"));
}

TEST_F(Cad, WritesAndReadsTheVeryCoefficients) {
  const auto file = folder_.path() / "rail.stp";
  const SplineSurface given = polynomial_rail();
  write_cad(file, {Body::rail, given, {}, {}});
  const CadSurface s = read_cad(file, Body::rail, 0.0);
  ASSERT_TRUE(std::holds_alternative<SplineSurface>(s.shape)) << s.note;
  const auto& back = std::get<SplineSurface>(s.shape);
  check(back);
  for (std::size_t d = 0; d < 2; ++d) ASSERT_EQ(back.levels[0][d].knots, given.levels[0][d].knots);
  for (std::size_t k = 0; k < given.points.size(); ++k) EXPECT_LT((back.points[k] - given.points[k]).norm(), 1e-14);
  for (double x = 0.0; x <= 0.06; x += 0.003)
    for (double y = -0.03; y <= 0.03; y += 0.002)
      EXPECT_LT(
          (evaluate(back, x, y).p - Vec3(x, y, 4.0 * y * y + 20.0 * x * x * x - 100.0 * x * x * y * y * y)).norm(),
          1e-14);
  EXPECT_THAT(s.note, AllOf(HasSubstr("the B-spline of #"), HasSubstr("degrees 3 x 3, 6 x 5 poles")));
}

TEST_F(Cad, TakesWhatIsWholeOfAFaceThatIsTrimmedOutOfSight) {
  const CadSurface s = read(sample("trimmed.step"), "trimmed.step");
  ASSERT_TRUE(std::holds_alternative<SplineSurface>(s.shape)) << s.note;
  const auto& spline = std::get<SplineSurface>(s.shape);
  double deepest = 0.0;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const auto at = [](const std::vector<double>& knots, int k) {
        return knots.front() + (knots.back() - knots.front()) * k / 40.0;
      };
      const Vec3 p = evaluate(spline, at(spline.levels[0][0].knots, i), at(spline.levels[0][1].knots, j)).p;
      EXPECT_NEAR(p.z(), paraboloid(p.x(), p.y(), 37.5), 1e-12);
      deepest = std::max(deepest, p.z());
    }
  EXPECT_NEAR(deepest, 0.045, 2e-4);
}

TEST_F(Cad, SeveralFacesBecomeSlices) {
  const CadSurface s = read(sample("halves.step"), "halves.step");
  ASSERT_TRUE(std::holds_alternative<SliceSet>(s.shape)) << s.note;
  const auto& slices = std::get<SliceSet>(s.shape);
  ASSERT_GT(slices.u.size(), 10u);
  EXPECT_NEAR(slices.u.front(), 0.0, 3e-5);
  EXPECT_NEAR(slices.u.back(), 0.1, 3e-5);
  for (std::size_t i = 0; i < slices.u.size(); ++i)
    for (std::size_t k = 0; k < slices.profiles[i].y.size(); ++k)
      EXPECT_NEAR(slices.profiles[i].z[k], paraboloid(slices.u[i], slices.profiles[i].y[k], 5.0), 1e-9) << slices.u[i];
  EXPECT_THAT(s.note, HasSubstr("2 faces seen"));
}

/// Crown and corners of solid.step and nose.step at their angle.
Vec2 crowned(double angle) {
  const double a = std::fabs(angle), side = angle < 0.0 ? -1.0 : 1.0;
  if (a <= 0.2) return {side * 0.08 * std::sin(a), 0.08 * (1.0 - std::cos(a))};
  return {side * (0.067 * std::sin(0.2) + 0.013 * std::sin(a)), 0.08 - 0.067 * std::cos(0.2) - 0.013 * std::cos(a)};
}

/// z over y.
double crown_height(double y) {
  double low = -1.3, high = 1.3;
  for (int k = 0; k < 80; ++k) (crowned(0.5 * (low + high)).x() < y ? low : high) = 0.5 * (low + high);
  return crowned(low).y();
}

TEST_F(Cad, ASolidIsReducedToWhatAWheelCanTouch) {
  const CadSurface s = read(sample("solid.step"), "solid.step");
  ASSERT_TRUE(std::holds_alternative<Profile>(s.shape)) << s.note;
  EXPECT_THAT(s.note, HasSubstr("29 faces in millimetre"));
  const auto& p = std::get<Profile>(s.shape);
  const Vec2 end = crowned(1.2);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    if (std::fabs(p.y[i]) > end.x()) continue;
    EXPECT_NEAR(p.z[i], crown_height(p.y[i]), 1e-9) << p.y[i];
    ++compared;
  }
  EXPECT_GT(compared, 200u);
  EXPECT_NEAR(p.y.front(), -p.y.back(), 5e-5);
  EXPECT_GT(p.y.back(), end.x()) << "the side below the corner belongs to it";
  EXPECT_LT(p.z.back(), 0.03) << "web and foot do not";
}

TEST_F(Cad, SidesThatMoveBecomeTriangles) {
  const CadSurface s = read(sample("nose.step"), "nose.step");
  ASSERT_TRUE(std::holds_alternative<TriangleMesh>(s.shape)) << s.note;
  const auto& mesh = std::get<TriangleMesh>(s.shape);
  EXPECT_THAT(s.note, AllOf(HasSubstr("its sides move"), HasSubstr("3 faces, sides up to 0.5 mm")));
  for (const Vec3& p : mesh.vertices) {
    const double scale = 1.0 + 2.0 * p.x();
    EXPECT_NEAR(p.z(), scale * crown_height(p.y() / scale), 3e-9);
  }
  double area = 0.0, longest = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 normal = (b - a).cross(c - a);
    EXPECT_LE(normal.z(), 0.0) << "outwards is up";
    area += 0.5 * normal.norm();
    longest = std::max({longest, (b - a).norm(), (c - b).norm(), (a - c).norm()});
  }
  EXPECT_LE(longest, 0.5e-3 * (1.0 + 1e-9));
  // rulings stretch a little: the area of a cone-like strip lies between those of its sections
  const double arc = 2.0 * (0.2 * 0.08 + 1.0 * 0.013);
  EXPECT_NEAR(area, 0.1 * 1.1 * arc, 0.01 * area);
}

TEST_F(Cad, AFaceCutAskewBecomesTriangles) {
  const CadSurface s = read(sample("slanted.step"), "slanted.step");
  ASSERT_TRUE(std::holds_alternative<TriangleMesh>(s.shape)) << s.note;
  const auto& mesh = std::get<TriangleMesh>(s.shape);
  double first = 1.0, last = 0.0;
  for (const Vec3& p : mesh.vertices) {
    EXPECT_NEAR(p.z(), paraboloid(p.x(), p.y(), 37.5), 1e-12);
    first = std::min(first, p.x()), last = std::max(last, p.x());
  }
  EXPECT_NEAR(first, 0.0, 1e-9);
  EXPECT_NEAR(last, 0.1, 1e-9);
}

/// Entities of a STEP file as they are made.
class StepText {
 public:
  template <class... Parts>
  int add(const Parts&... parts) {
    text_ += fmt::format("#{}=", ++last_);
    (text_.append(parts), ...);
    text_ += ";\n";
    return last_;
  }
  int point(const Vec3& p) {
    return add(fmt::format("CARTESIAN_POINT('',({:.12f},{:.12f},{:.12f}))", p.x(), p.y(), p.z()));
  }
  int direction(const Vec3& d) {
    return add(fmt::format("DIRECTION('',({:.15f},{:.15f},{:.15f}))", d.x(), d.y(), d.z()));
  }
  /// A plane quadrilateral.
  int face(const std::array<Vec3, 4>& corners) {
    std::array<int, 4> vertex{};
    std::string loop;
    for (std::size_t k = 0; k < 4; ++k) vertex[k] = add(fmt::format("VERTEX_POINT('',#{})", point(corners[k])));
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 along = (corners[(k + 1) % 4] - corners[k]).normalized();
      const int vector = add(fmt::format("VECTOR('',#{},1.)", direction(along)));
      const int line = add(fmt::format("LINE('',#{},#{})", point(corners[k]), vector));
      const int edge = add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", vertex[k], vertex[(k + 1) % 4], line));
      loop += fmt::format("{}#{}", k > 0 ? "," : "", add(fmt::format("ORIENTED_EDGE('',*,*,#{},.T.)", edge)));
    }
    const Vec3 x = (corners[1] - corners[0]).normalized(), normal = x.cross(corners[3] - corners[0]).normalized();
    const int place =
        add(fmt::format("AXIS2_PLACEMENT_3D('',#{},#{},#{})", point(corners[0]), direction(normal), direction(x)));
    const int plane = add(fmt::format("PLANE('',#{})", place));
    const int bound = add(fmt::format("FACE_BOUND('',#{},.T.)", add(fmt::format("EDGE_LOOP('',({}))", loop))));
    return add(fmt::format("ADVANCED_FACE('',(#{}),#{},.T.)", bound, plane));
  }
  const std::string& text() const { return text_; }

 private:
  int last_ = 1000;
  std::string text_;
};

/// rail.step with these faces in place of its own.
std::string with_faces(const StepText& text, const std::string& faces) {
  std::string file = sample("rail.step");
  file.replace(file.find("(#17)"), 5, "(" + faces + ")");
  return file.insert(file.rfind("ENDSEC;"), text.text());
}

TEST_F(Cad, ManyFacesAreOneRunningSurface) {
  StepText text;
  std::string faces;
  const auto add = [&](const std::array<Vec3, 4>& corners) {
    faces += fmt::format("{}#{}", faces.empty() ? "" : ",", text.face(corners));
  };
  constexpr int kStrips = 400, kBelow = 1600;
  const auto on_crown = [](double x, int k) {
    const double angle = -0.4 + 0.8 * k / kStrips;
    return Vec3(x, 80.0 * std::sin(angle), 80.0 * (1.0 - std::cos(angle)));
  };
  for (int k = 0; k < kStrips; ++k)
    add({on_crown(0.0, k), on_crown(100.0, k), on_crown(100.0, k + 1), on_crown(0.0, k + 1)});
  for (int k = 0; k < kBelow; ++k) {
    const double x = 2.5 * (k % 40), y = -30.0 + 1.5 * static_cast<double>(k / 40), z = 60.0 + 0.01 * k;
    add({Vec3(x, y, z), Vec3(x + 2.0, y, z), Vec3(x + 2.0, y + 1.0, z), Vec3(x, y + 1.0, z)});
  }
  const CadSurface s = read(with_faces(text, faces));
  ASSERT_TRUE(std::holds_alternative<Profile>(s.shape)) << s.note;
  EXPECT_THAT(s.note, HasSubstr("2000 faces"));
  // the sagitta of a strip, seen askew
  expect_crown(std::get<Profile>(s.shape), kRadius * 0.5 * 1e-3 * 1e-3 / std::cos(0.4));
}

TEST_F(Cad, RefusesMoreFacesThanItCounts) {
  StepText text;
  std::string faces;
  for (int k = 0; k < 100'001; ++k)
    faces += fmt::format("{}#{}", k > 0 ? "," : "", text.add("ADVANCED_FACE('',(#18),#32,.T.)"));
  EXPECT_THAT(refusal(with_faces(text, faces)), HasSubstr("holds 100002 faces, more than 100000"));
}

TEST_F(Cad, RefusesWhatIsLargerThanAnyRail) {
  EXPECT_THAT(refusal(replaced(sample("rail.step"), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.KILO.,.METRE.)")),
              HasSubstr("the part is 2e+05 m long"));
}

/// Texts with their bytes, numbers, entities or ends changed.
class Mutations {
 public:
  explicit Mutations(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    switch (random_() % 5) {
      case 0:
        text.resize(at(text.size()));
        return text;
      case 1:
        for (std::size_t k = 0; k <= at(3); ++k) change_number(text);
        return text;
      case 2:
        for (std::size_t k = 0; k <= at(3); ++k) swap_entities(text);
        return text;
      case 3:
        for (std::size_t k = 0; k <= at(6); ++k) text[at(text.size())] = kLetters[at(kLetters.size())];
        return text;
      default:
        for (std::size_t k = 0; k <= at(3); ++k) text.erase(at(text.size()), at(30));
        return text;
    }
  }

 private:
  std::size_t at(std::size_t size) { return random_() % size; }
  /// Another number in place of the next one.
  void change_number(std::string& text) {
    static const std::vector<std::string> numbers{"0.",     "-1.",  "1.E+300", "1.E-300",    "-1.E+12", "1000000.",
                                                  "0.0001", "NAN.", "1.E+3",   "2147483648", "-0.",     "3."};
    const std::size_t from = text.find_first_of("0123456789", at(text.size()));
    if (from == std::string::npos) return;
    const std::size_t to = text.find_first_not_of("0123456789.E+-", from);
    text.replace(from, (to == std::string::npos ? text.size() : to) - from, numbers[at(numbers.size())]);
  }
  /// What two places refer to.
  void swap_entities(std::string& text) {
    const auto reference = [&] {
      const std::size_t from = text.find("#", at(text.size()));
      if (from == std::string::npos) return std::pair<std::size_t, std::size_t>{0, 0};
      return std::pair{from, text.find_first_not_of("0123456789", from + 1) - from};
    };
    auto a = reference(), b = reference();
    if (a.first > b.first) std::swap(a, b);
    if (a.second < 2 || b.second < 2 || a.first + a.second > b.first) return;
    const std::string first = text.substr(a.first, a.second), second = text.substr(b.first, b.second);
    text.replace(b.first, b.second, first);
    text.replace(a.first, a.second, second);
  }

  static inline const std::string kLetters = "0123456789#$*().,-'E ";
  std::mt19937 random_;
};

/// What a reader may hand on.
void expect_sound(const CadSurface& s, const std::string& which) {
  const auto finite = [](const std::vector<double>& list) {
    return ranges::all_of(list, [](double x) { return std::isfinite(x); });
  };
  if (const auto* profile = std::get_if<Profile>(&s.shape)) {
    EXPECT_TRUE(finite(profile->y) && finite(profile->z) && profile->y.size() == profile->z.size()) << which;
    EXPECT_TRUE(ranges::is_sorted(profile->y)) << which;
  } else if (const auto* slices = std::get_if<SliceSet>(&s.shape)) {
    EXPECT_TRUE(finite(slices->u) && ranges::is_sorted(slices->u)) << which;
    for (const Profile& p : slices->profiles) EXPECT_TRUE(finite(p.y) && finite(p.z)) << which;
  } else if (const auto* spline = std::get_if<SplineSurface>(&s.shape)) {
    EXPECT_NO_THROW(check(*spline)) << which;
  } else {
    const auto& mesh = std::get<TriangleMesh>(s.shape);
    for (const Vec3& p : mesh.vertices) EXPECT_TRUE(p.allFinite()) << which;
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t corner : t) EXPECT_LT(corner, mesh.vertices.size()) << which;
  }
}

TEST_F(Cad, RefusesPointsThatLieNowhere) {
  const std::string valid = sample("rail.step");
  const std::size_t point = valid.find("CARTESIAN_POINT"), from = valid.rfind(',', valid.find("))", point)) + 1;
  const auto with = [&](const std::string& number) {
    return valid.substr(0, from) + number + valid.substr(valid.find(')', from));
  };
  for (const char* nowhere : {"1e300", "1.E999", "1.E300", "$"})
    EXPECT_THAT(refusal(with(nowhere)), HasSubstr("points that lie nowhere")) << nowhere;
  const auto line = std::count(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(from), '\n') + 1;
  for (const std::string none : {"three", "-inf", "nan", "+", "-", "1.2.3", "1.E", "-x", "1/**/2"})
    EXPECT_THAT(refusal(with(none)), HasSubstr(fmt::format("rail.step:{}:", line))) << none;
  for (const char* number : {"-0.E+3", " 0. ", "/* three */ 0.", "0"}) {
    SCOPED_TRACE(number);
    EXPECT_NO_THROW(read(with(number)));
  }
}

/// Their triangles would take minutes, or miss what the edges cut away.
TEST_F(Cad, RefusesEdgesBesideTheirFaces) {
  for (const char* middle : {"(0.,0.,65536)", "(0.,0.,85.)", "(0.,-70.,80.)"})
    EXPECT_THAT(refusal(replaced(sample("nose.step"), "(0.,0.,80.)", middle), "nose.step"),
                HasSubstr("m beside the face that it bounds"))
        << middle;
}

TEST_F(Cad, RefusesWhatIsHigherThanAnyRail) {
  const std::string metres = "SI_UNIT(.MILLI.,.METRE.)";
  EXPECT_THAT(refusal(replaced(sample("nose.step"), metres, "SI_UNIT($,.METRE.)"), "nose.step"), HasSubstr("m high"));
}

/// Waits for what the other end never says.
void ask_nothing(Channel& channel) { channel.take<std::int64_t>(); }

TEST_F(Cad, HearsThatItsWorkIsToEnd) {
  std::atomic<bool> stop{false};
  const std::unique_ptr<Channel> channel = cad::start_opencascade("a.step");
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop = true;
  });
  const CancellationScope scope(&stop);
  EXPECT_THROW(ask_nothing(*channel), Cancelled);
  later.join();
}

/// The state of a process as /proc has it: 'T' stopped, 'Z' dead but not yet waited for; ' ': gone.
char state_of(pid_t process) {
  const std::string stat = content_of(fmt::format("/proc/{}/stat", process));
  const std::size_t name_end = stat.rfind(')');
  return name_end == std::string::npos ? ' ' : stat.at(name_end + 2);
}

TEST_F(Cad, DiesWithItsParent) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    const std::unique_ptr<Channel> channel = cad::start_opencascade("a.step");
    for (;;) ::pause();
  }
  const auto wait_for = [](const auto& what) {
    for (int i = 0; i < 3000 && !what(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return what();
  };
  pid_t child = 0;
  const auto has_begun = [&] {
    std::istringstream(content_of(fmt::format("/proc/{0}/task/{0}/children", parent))) >> child;
    return child > 0 && content_of(fmt::format("/proc/{}/comm", child)).starts_with("treadmark-openc");
  };
  ASSERT_TRUE(wait_for(has_begun));
  // Once it sleeps it has done what it does first. Stopped, it cannot see that its socket is closed.
  ASSERT_TRUE(wait_for([&] { return state_of(child) == 'S'; }));
  ::kill(child, SIGSTOP);
  ASSERT_TRUE(wait_for([&] { return state_of(child) == 'T'; }));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  EXPECT_TRUE(wait_for([&] { return state_of(child) == ' ' || state_of(child) == 'Z'; }));
  ::kill(child, SIGKILL);
}

TEST_F(Cad, SurvivesDamagedFiles) {
  Mutations mutated(5);
  const std::vector<std::string> names{"rail.igs", "hole.step", "rail.step", "halves.step", "trimmed.step"};
  int read_well = 0, refused = 0;
  double longest = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    const std::string& name = names[static_cast<std::size_t>(trial) % names.size()];
    const std::string text = mutated(sample(name)), which = fmt::format("{} of {}", trial, name);
    const auto start = std::chrono::steady_clock::now();
    const std::string said = error_of([&] { expect_sound(read(text, name), which); });
    longest = std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    EXPECT_THAT(said, ::testing::AnyOf(std::string(), HasSubstr("input data: "))) << which;
    ++(said.empty() ? read_well : refused);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no process is left behind: " << which;
    EXPECT_EQ(errno, ECHILD);
  }
  EXPECT_GT(refused, 25);
  EXPECT_GT(read_well, 10);
  EXPECT_LT(longest, 120.0);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, names.size()) << "only what this test wrote";
}

}  // namespace
}  // namespace treadmark::io
