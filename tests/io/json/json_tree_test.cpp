// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/json/json_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using treadmark::testing::error_of;

class JsonTreeFile : public ::testing::Test {
 protected:
  JsonTree read(const std::string& text) const { return read_json_file(folder_.write("a.json", text)); }
  treadmark::testing::TemporaryFolder folder_;
};

TEST_F(JsonTreeFile, HoldsValuesOfEveryKind) {
  const std::string text =
      R"({"n": -1.5e3, "big": 9007199254740992, "none": null, "t": "µ <b>\n\u00e9", "f": true, "list": [1, null, 3],
                               "words": ["a", ""], "inner": {"z": 1, "a": {"deep": [[], {}]}}})";
  const JsonTree root = read(text);
  EXPECT_EQ(root.number("n"), -1500.0);
  EXPECT_EQ(root.count("big"), std::size_t{1} << 53);
  EXPECT_TRUE(std::isnan(root.number("none")));
  EXPECT_TRUE(root.at("none").is_null());
  EXPECT_TRUE(root.has("none"));
  EXPECT_FALSE(root.has("nothing"));
  EXPECT_FALSE(root.find("none").has_value());
  EXPECT_FALSE(root.find("nothing").has_value());
  EXPECT_EQ(root.text("t"), "µ <b>\né");
  EXPECT_TRUE(root.flag("f"));
  const std::vector<double> list = root.at("list").numbers();
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[2], 3.0);
  EXPECT_TRUE(std::isnan(list[1]));
  EXPECT_THAT(root.at("words").texts(), ElementsAre("a", ""));
  const auto entries = root.at("inner").entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].first, "z");  // the order of the file
  EXPECT_EQ(entries[1].second.at("deep").items().size(), 2u);
}

TEST_F(JsonTreeFile, ValuesOutliveTheFile) {
  const auto inner = [&] { return read(R"({"rows": [{"a": 1}, {"a": 2}]})").at("rows").items().back(); }();
  EXPECT_EQ(inner.number("a"), 2.0);
}

TEST_F(JsonTreeFile, ErrorsNameThePlace) {
  const JsonTree root = read(R"({"rows": [{"a": 1}, {"a": "x", "b": 1.5, "c": -1, "d": [true]}]})");
  const JsonTree row = root.at("rows").items().back();
  EXPECT_THAT(error_of([&] { row.number("a"); }), EndsWith("a.json: rows[1].a is a text where a number is expected"));
  EXPECT_THAT(error_of([&] { row.number("z"); }), EndsWith("rows[1].z is missing"));
  EXPECT_THAT(error_of([&] { row.count("b"); }), HasSubstr("rows[1].b is 1.5 where a whole number"));
  EXPECT_THAT(error_of([&] { row.count("c"); }), HasSubstr("rows[1].c is -1"));
  EXPECT_EQ(row.at("c").integer(), -1);
  EXPECT_THAT(error_of([&] { row.at("d").numbers(); }), HasSubstr("rows[1].d[0] is true or false where a number"));
  EXPECT_THAT(error_of([&] { row.text("b"); }), HasSubstr("rows[1].b is a number where a text"));
  EXPECT_THAT(error_of([&] { row.flag("b"); }), HasSubstr("where true or false is expected"));
  EXPECT_THAT(error_of([&] { row.at("a").has("q"); }), HasSubstr("rows[1].a is a text where an object"));
  EXPECT_THAT(error_of([&] { row.items(); }), HasSubstr("rows[1] is an object where a list"));
  EXPECT_THAT(error_of([&] { row.at("a").one_of({"y", "z"}); }), HasSubstr("rows[1].a is \"x\" where y or z is"));
  EXPECT_THAT(error_of([&] { root.at("rows").entries(); }), HasSubstr("rows is a list where an object"));
}

TEST_F(JsonTreeFile, RefusesWhatIsNoJson) {
  EXPECT_THAT(error_of([&] { read_json_file(folder_.path() / "missing.json"); }),
              HasSubstr("missing.json' does not exist"));
  EXPECT_THAT(error_of([&] { read("{\n \"a\": 1,\n \"b\" 2}"); }), HasSubstr("a.json:3:"));
  for (const char* text : {"", "{", "{\"a\": [1, 2", "nothing", "{\"a\": 1} x", "{\"a\": 1e999}", "{\"a\": \"\xff\"}"})
    EXPECT_THAT(error_of([&] { read(text); }), HasSubstr("is no JSON, or was cut off")) << text;
  EXPECT_THAT(error_of([&] { read("[1]"); }), HasSubstr("the file is a list where an object"));
  const std::string deep = std::string(200000, '[');
  EXPECT_THAT(error_of([&] { read(deep); }), HasSubstr("a.json:1:101: the file is nested too deeply"));
  const auto nested = [](int depth) {
    return "{\"text\": \"\\\"[[[\",\n\"a\": " + std::string(static_cast<std::size_t>(depth - 1), '[') +
           std::string(static_cast<std::size_t>(depth - 1), ']') + "}";
  };
  EXPECT_EQ(error_of([&] { read(nested(100)); }), "");
  EXPECT_THAT(error_of([&] { read(nested(101)); }), HasSubstr("a.json:2:105: the file is nested too deeply"));
}

}  // namespace
}  // namespace treadmark::io
