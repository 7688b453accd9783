// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/tests/io/splines/sample_splines.hpp"
#include "treadmark/tests/support/mutation.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::hierarchical_rail;
using treadmark::testing::kWheelShell;
using treadmark::testing::two_plates;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// "file:line:column: message (advice)"; empty where there is no error.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string refusal(const std::string& text) {
  return error_of([&] { parse_splines(text, "a.xml"); });
}

TEST(Splines, ARationalSurface) {
  TREADMARK_NEEDS("expat");
  const SplineFile file = parse_splines(kWheelShell, "a.xml");
  ASSERT_EQ(file.surfaces.size(), 1u);
  const SplineSurface& s = file.surfaces[0];
  EXPECT_EQ(s.name, "Geometry 7");
  EXPECT_EQ(s.where.to_string(), "a.xml:4:2");
  EXPECT_FALSE(s.hierarchical);
  ASSERT_EQ(s.levels.size(), 1u);
  EXPECT_EQ(s.levels[0][0].degree, 2);
  EXPECT_EQ(s.levels[0][1].knots, (std::vector<double>{0, 0, 1, 1}));
  ASSERT_EQ(s.points.size(), 6u);
  EXPECT_EQ(s.weights[4], 0.70710678118654757);
  EXPECT_DOUBLE_EQ(s.points[1].z(), 0.65053823869162374);
  EXPECT_DOUBLE_EQ(s.points[5].y(), 0.03);
}

TEST(Splines, UnitsAreToldByTheScale) {
  TREADMARK_NEEDS("expat");
  EXPECT_DOUBLE_EQ(parse_splines(kWheelShell, "a.xml", 10.0).surfaces[0].points[5].y(), 0.3);
  EXPECT_THAT(error_of([] { parse_splines(kWheelShell, "a.xml", 1e-3); }),
              ::testing::AllOf(HasSubstr("all of it measures"), HasSubstr("1000 for a file in m")));
  EXPECT_THAT(error_of([] { parse_splines(kWheelShell, "a.xml", 1e4); }), HasSubstr("scale_to_mm"));
  EXPECT_THAT(error_of([] { parse_splines(kWheelShell, "a.xml", 0.0); }), HasSubstr("must be positive"));
}

TEST(Splines, AHierarchyWithItsLevels) {
  TREADMARK_NEEDS("expat");
  const SplineFile file = parse_splines(hierarchical_rail(1.0), "a.xml");
  const SplineSurface& s = file.surfaces.at(0);
  EXPECT_TRUE(s.hierarchical && s.truncated);
  ASSERT_EQ(s.levels.size(), 2u);
  EXPECT_EQ(s.levels[1][0].knots, (std::vector<double>{0, 0, 0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1, 1, 1}));
  ASSERT_EQ(s.boxes.size(), 1u);
  EXPECT_EQ(s.boxes[0].lower, (std::array<int, 2>{2, 2}));
  EXPECT_EQ(s.boxes[0].line, 13);
  EXPECT_EQ(s.points.size(), 40u);
  EXPECT_FALSE(parse_splines(hierarchical_rail(1.0, "HB"), "a.xml").surfaces[0].truncated);
}

TEST(Splines, LevelsOfTheirOwnCountBoxesInTheTree) {
  TREADMARK_NEEDS("expat");
  // level 1 has one knot more, in the third interval only: index 5 of the tree
  const std::string level = R"(<Basis type="TensorBSplineBasis2" level="1">
    <Basis type="BSplineBasis" index="0">
     <KnotVector degree="2">0 0 0 0.25 0.5 0.6 0.75 1 1 1 </KnotVector>
    </Basis>
    <Basis type="BSplineBasis" index="1">
     <KnotVector degree="2">0 0 0 0.125 0.25 0.375 0.5 0.625 0.75 0.875 1 1 1 </KnotVector>
    </Basis>
   </Basis>
   <box level="1">)";
  std::string text = replaced(hierarchical_rail(1.0), "<box level=\"1\">2 2 6 6", level + "2 2 5 6");
  text = replaced(text, "SplineBasis2\">", "SplineBasis2\" manualLevels=\"true\">");
  const SplineSurface s = parse_splines(text, "a.xml").surfaces[0];
  EXPECT_EQ(s.boxes[0].lower, (std::array<int, 2>{1, 2}));
  EXPECT_EQ(s.boxes[0].upper, (std::array<int, 2>{3, 6}));
  EXPECT_THAT(refusal(replaced(text, "2 2 5 6", "1 2 5 6")), HasSubstr("is that of no knot"));
  EXPECT_THAT(refusal(replaced(text, "0.6 0.75", "0.6 0.7 0.75")), HasSubstr("at most one more in each interval"));
  EXPECT_THAT(refusal(replaced(text, "0.25 0.5 0.6", "0.5 0.6")), HasSubstr("level before"));
  EXPECT_THAT(refusal(replaced(text, "<box level=\"1\"", "<box level=\"2\"")), HasSubstr("there are 2 levels"));
}

TEST(Splines, PatchesAndTheirSides) {
  TREADMARK_NEEDS("expat");
  const SplineFile file = parse_splines(two_plates(0.0), "a.xml");
  ASSERT_EQ(file.surfaces.size(), 2u);
  ASSERT_EQ(file.interfaces.size(), 1u);
  EXPECT_EQ(file.interfaces[0].first_side, 2);
  EXPECT_EQ(file.interfaces[0].second, 1u);
  EXPECT_EQ(parse_splines(replaced(two_plates(0.0), "\"id_range\">0 1", "\"id_index\">1 0"), "a.xml").surfaces[0].name,
            "Geometry 1");
  // without a MultiPatch: all of them
  std::string plain = two_plates(0.0);
  plain.erase(plain.find("<MultiPatch"), plain.find("</xml>") - plain.find("<MultiPatch"));
  EXPECT_EQ(parse_splines(plain, "a.xml").surfaces.size(), 2u);
  // a MultiPatch leaves out what it does not name
  EXPECT_EQ(parse_splines(replaced(two_plates(0.0, ""), ">0 1<", ">1 1<"), "a.xml").surfaces.size(), 1u);
}

TEST(Splines, NumbersInBase64) {
  TREADMARK_NEEDS("expat");
  // 0 0 0 1 1 1 as doubles
  const std::string packed = "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAADwPwAAAAAAAPA/";
  const std::string text = replaced(kWheelShell, "<KnotVector degree=\"2\">0 0 0 1 1 1 ",
                                    "<KnotVector degree=\"2\" format=\"B64Float64\">" + packed);
  EXPECT_EQ(parse_splines(text, "a.xml").surfaces[0].levels[0][0].knots, (std::vector<double>{0, 0, 0, 1, 1, 1}));
  EXPECT_THAT(refusal(replaced(text, packed, packed.substr(5))), HasSubstr("no list of doubles in Base64"));
  EXPECT_THAT(refusal(replaced(text, "B64Float64", "B64Float32")), HasSubstr("ASCII and B64Float64 are"));
}

TEST(Splines, WhatIsWrongIsNamedWithItsPlace) {
  TREADMARK_NEEDS("expat");
  const auto wheel = [](const char* what, const char* by) { return refusal(replaced(kWheelShell, what, by)); };
  const auto rail = [](const char* what, const char* by) {
    return refusal(replaced(hierarchical_rail(1.0), what, by));
  };
  const auto plates = [](const char* what, const char* by) { return refusal(replaced(two_plates(0.0), what, by)); };
  // XML
  EXPECT_THAT(refusal(""), HasSubstr("no XML"));
  EXPECT_THAT(wheel("</Geometry>", "</geometry>"), HasSubstr("a.xml:25:4: this is no XML: mismatched tag"));
  EXPECT_THAT(wheel("<xml>", "<!DOCTYPE a [<!ENTITY b \"c\">]><xml>"), HasSubstr("a document type is declared"));
  EXPECT_THAT(wheel("0 0 0 1 1 1 ", "0 0 0 &b; 1 1"), HasSubstr("undefined entity"));
  EXPECT_THAT(refusal("<a><b/></a>"), HasSubstr("the root is 'a'"));
  std::string deep;
  for (int i = 0; i < 40; ++i) deep += "<xml>";
  EXPECT_THAT(refusal(deep), HasSubstr("nested too deeply"));
  // blocks
  EXPECT_THAT(refusal("<xml><Basis/></xml>"), HasSubstr("there is no Geometry"));
  EXPECT_THAT(wheel(" type=\"TensorNurbs2\"", ""), HasSubstr("a.xml:4:2: Geometry 7: <Geometry> has no type"));
  EXPECT_THAT(wheel("\"TensorNurbs2\"", "\"TensorNurbs3\""), HasSubstr("Geometry 7: type 'TensorNurbs3' is not read"));
  EXPECT_THAT(wheel("\"TensorNurbsBasis2\"", "\"TensorBSplineBasis2\""), HasSubstr("not TensorNurbsBasis2"));
  EXPECT_THAT(wheel("index=\"0\"", "index=\"1\""), HasSubstr("put 0 before 1"));
  EXPECT_THAT(wheel("weights>1", "woights>1"), HasSubstr("mismatched tag"));
  EXPECT_THAT(refusal(replaced(replaced(kWheelShell, "<weights>", "<w>"), "</weights>", "</w>")),
              HasSubstr("a.xml:5:3: Geometry 7: <Basis> has no <weights>"));
  EXPECT_THAT(wheel(" geoDim=\"3\"", ""), HasSubstr("has no geoDim"));
  EXPECT_THAT(wheel("geoDim=\"3\"", "geoDim=\"2\""), HasSubstr("a surface in space has 3"));
  // knots
  EXPECT_THAT(wheel("degree=\"2\"", "degree=\"4\""), HasSubstr("a.xml:8:6: Geometry 7: 6 knots are too few for"));
  EXPECT_THAT(wheel("degree=\"2\"", "degree=\"26\""), HasSubstr("degree 26 is not known: 1 to 25 are"));
  EXPECT_THAT(rail("degree=\"2\"", "degree=\"4\""), HasSubstr("Geometry 0: degree 4 is not known: 1 to 3 are"));
  EXPECT_THAT(wheel("degree=\"2\"", "degree=\"two\""), HasSubstr("no whole number"));
  EXPECT_THAT(wheel("0 0 0 1 1 1 ", "0 0 0 1 1"), HasSubstr("5 knots are too few for degree 2"));
  EXPECT_THAT(wheel("0 0 0 1 1 1 ", "0 0 1 0 1 1"), HasSubstr("a.xml:8:35: Geometry 7: knot 4 is less"));
  EXPECT_THAT(wheel("0 0 0 1 1 1 ", "0 0 0 0 0 0"), HasSubstr("no interval"));
  EXPECT_THAT(wheel("0 0 0 1 1 1 ", "0 0 0 .5 .5 .5 1 1 1"), HasSubstr("knot 6 is repeated 3 times"));
  // numbers
  EXPECT_THAT(wheel("0 -30 650", "x -30 650"), HasSubstr("a.xml:19:1: Geometry 7: a number is expected, this is 'x'"));
  EXPECT_THAT(wheel("0 -30 650", "nan -30 650"), HasSubstr("a.xml:19:1: Geometry 7: 'nan' is not finite"));
  EXPECT_THAT(wheel("0 -30 650", "1e999 -30 650"), HasSubstr("is not finite"));
  EXPECT_THAT(wheel("0 -30 650", "-30 650"), HasSubstr("<coefs> has 17 numbers, where 18 are expected"));
  EXPECT_THAT(wheel("0 -30 650", "0 0 -30 650"), HasSubstr("a.xml:23:23: Geometry 7: <coefs> has more than the 18"));
  EXPECT_THAT(wheel("weights>1 0", "weights>1 -0"), HasSubstr("a.xml:14:15: Geometry 7: weight 2 is -0.7"));
  // what is not read
  EXPECT_THAT(wheel("geoDim=\"3\"", "geoDim=\"3\" order=\"coordinates\""),
              HasSubstr("a.xml:18:3: Geometry 7: coefficients in the order 'coordinates' are not read"));
  EXPECT_THAT(wheel("<KnotVector degree=\"2\">", "<KnotVector degree=\"2\" mode=\"uniform\">"),
              HasSubstr("a.xml:8:6: Geometry 7: knots by their mode ('uniform') are not read"));
  EXPECT_THAT(wheel(" </Geometry>", "  <transform>1 0 0</transform>\n </Geometry>"),
              HasSubstr("a.xml:25:3: Geometry 7: a transform is not read"));
  // boxes
  EXPECT_THAT(rail("2 2 6 6", "2 2 6 9"), HasSubstr("a.xml:13:4: Geometry 0: the box 2 2 6 9 of level 1 is empty or"));
  EXPECT_THAT(rail("2 2 6 6", "2 2 2 6"), HasSubstr("is empty"));
  EXPECT_THAT(rail("2 2 6 6", "-1 2 6 6"), HasSubstr("leaves its 8 x 8 cells"));
  EXPECT_THAT(rail("2 2 6 6", "2 2 6"), HasSubstr("this has 3"));
  EXPECT_THAT(rail("level=\"1\"", "lovel=\"1\""), HasSubstr("<box> has no level"));
  EXPECT_THAT(rail("level=\"1\"", "level=\"-1\""), HasSubstr("a box is of level -1"));
  EXPECT_THAT(rail("level=\"1\"", "level=\"2000000000\""), HasSubstr("more than 65536 intervals"));
  // patches
  EXPECT_THAT(plates("\"id_range\">0 1", "\"id_range\">0 3"), HasSubstr("MultiPatch: there is no Geometry of id 2"));
  EXPECT_THAT(plates("\"id_range\">0 1", "\"id_index\">0 0"), HasSubstr("Geometry 0 is named twice"));
  EXPECT_THAT(plates("\"id_range\">0 1", "\"id_set\">0 1"), HasSubstr("id_range and id_index are"));
  EXPECT_THAT(plates("id=\"1\"", "id=\"0\""), HasSubstr("there is another Geometry of id 0"));
  EXPECT_THAT(plates("parDim=\"2\"", "parDim=\"3\""), HasSubstr("a surface has 2"));
  EXPECT_THAT(plates("0 2 1 1 0 1 1 1", "0 2 1 1 0 1 1"), HasSubstr("8 numbers each"));
  EXPECT_THAT(plates("0 2 1 1 0 1 1 1", "0 2 5 1 0 1 1 1"), HasSubstr("Geometry 5 is none of the patches"));
  EXPECT_THAT(plates("0 2 1 1 0 1 1 1", "0 5 1 1 0 1 1 1"), HasSubstr("a surface has sides 1 to 4, this is 5"));
}

TEST(Splines, ComeBackFromAFile) {
  TREADMARK_NEEDS("expat");
  const OutputFolder folder(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path file = folder.path() / "a.xml";
  for (const std::string& text : {kWheelShell, hierarchical_rail(0.1), hierarchical_rail(0.1, "HB"), two_plates(0.0)}) {
    const SplineFile given = parse_splines(text, "a.xml");
    write_splines(file, given.surfaces, given.interfaces);
    const SplineFile back = read_splines(file);
    ASSERT_EQ(back.surfaces.size(), given.surfaces.size());
    EXPECT_EQ(back.interfaces.size(), given.interfaces.size());
    for (std::size_t k = 0; k < back.surfaces.size(); ++k) {
      const SplineSurface &a = given.surfaces[k], &b = back.surfaces[k];
      EXPECT_EQ(a.hierarchical, b.hierarchical);
      EXPECT_EQ(a.truncated, b.truncated);
      EXPECT_EQ(a.weights, b.weights);
      ASSERT_EQ(a.levels.size(), b.levels.size());
      for (std::size_t l = 0; l < a.levels.size(); ++l)
        for (std::size_t d = 0; d < 2; ++d) EXPECT_EQ(a.levels[l][d].knots, b.levels[l][d].knots);
      ASSERT_EQ(a.points.size(), b.points.size());
      for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_LT((a.points[i] - b.points[i]).norm(), 1e-15);
      ASSERT_EQ(a.boxes.size(), b.boxes.size());
      for (std::size_t i = 0; i < a.boxes.size(); ++i) {
        EXPECT_EQ(a.boxes[i].lower, b.boxes[i].lower);
        EXPECT_EQ(a.boxes[i].upper, b.boxes[i].upper);
      }
    }
  }
  const SplineFile one = parse_splines(kWheelShell, "a.xml");
  EXPECT_THAT(error_of([&] { write_splines(folder.path() / "a.step", one.surfaces); }), HasSubstr("use .xml"));
  EXPECT_THAT(error_of([&] { write_splines(file, {}); }), HasSubstr("no surface"));
  EXPECT_THAT(error_of([&] { read_splines(folder.path() / "none.xml"); }), HasSubstr("none.xml"));
}

/// An error or a result, nothing else.
void survives(const std::string& text) {
  try {
    parse_splines(text, "a.xml");
  } catch (const Error& e) {
    EXPECT_FALSE(e.message().empty());
  }
}

TEST(Splines, TruncatedAndChangedFilesAreRefusedOrRead) {
  TREADMARK_NEEDS("expat");
  std::mt19937 random(5);
  for (const std::string& text : {kWheelShell, hierarchical_rail(0.1), two_plates(0.01)}) {
    for (std::size_t size = 0; size < text.size(); size += 7)
      EXPECT_THROW(parse_splines(text.substr(0, size), "a.xml"), Error) << size;
    for (int k = 0; k < treadmark::testing::mutants(2000); ++k) {
      std::string changed = text;
      const unsigned kind = random() % 3;
      if (kind == 0) changed = treadmark::testing::with_other_numbers(text, random);
      if (kind == 1) changed = treadmark::testing::with_other_lines(text, random);
      if (kind == 2)
        for (unsigned i = 0; i < 1 + random() % 4; ++i)
          changed[random() % changed.size()] = static_cast<char>(random());
      survives(changed);
    }
  }
}

}  // namespace
}  // namespace treadmark::io
