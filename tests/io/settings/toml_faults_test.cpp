// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/toml_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "treadmark/io/settings/toml_value.hpp"

// What people write in place of TOML: the message says what is wrong, its place, and what to write; and what it says to
// write is TOML.

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

/// The error of a text; an empty message: none.
Error error_of(const std::string& text) {
  try {
    parse_toml(text, "a.toml");
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::configuration, ""};
}

struct Slip {
  std::string text;
  int line;
  std::string message;  ///< a part of it
  std::string advice;   ///< all of it, or with a last '*' its beginning
};
void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.text; }

class TomlSlip : public ::testing::TestWithParam<Slip> {};

TEST_P(TomlSlip, IsNamedWithWhatToWrite) {
  const Slip& slip = GetParam();
  const Error error = error_of(slip.text);
  EXPECT_EQ(error.kind(), ErrorKind::configuration);
  EXPECT_EQ(error.where().file, "a.toml");
  EXPECT_EQ(error.where().line, slip.line);
  EXPECT_THAT(error.message(), HasSubstr(slip.message));
  EXPECT_EQ(error.message().find("Error while parsing"), std::string::npos) << error.message();
  if (slip.advice.ends_with('*'))
    EXPECT_EQ(error.advice().substr(0, slip.advice.size() - 1), slip.advice.substr(0, slip.advice.size() - 1));
  else
    EXPECT_EQ(error.advice(), slip.advice);
  constexpr std::string_view kWrite = "write ";
  if (!error.advice().starts_with(kWrite)) return;
  const std::string written = error.advice().substr(kWrite.size(), error.advice().find(", or ") - kWrite.size());
  if (written.find(" = ") != std::string::npos && written[0] != '{' && written.find("value") == std::string::npos) {
    EXPECT_EQ(error_of(written).message(), "") << written;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Text, TomlSlip,
    ::testing::Values(
        Slip{"shape.file = wheel.csv\n", 1, "'wheel.csv' is text, and text stands in quotes",
             "write shape.file = \"wheel.csv\""},
        Slip{"shape.file = wheel.csv\"\n", 1, "text stands in quotes", "write shape.file = \"wheel.csv\""},
        Slip{"shape.file = ./2024/60E1_worn.csv\n", 1, "text stands in quotes",
             "write shape.file = \"./2024/60E1_worn.csv\""},
        Slip{"shape.file = 60E1_worn.csv # ours\n", 1, "text stands in quotes", "write shape.file = \"60E1_worn.csv\""},
        Slip{"shape.file = 2024.csv\n", 1, "text stands in quotes", "write shape.file = \"2024.csv\""},
        Slip{"shape.file = C:\\data\\w.csv\n", 1, "text stands in quotes", "write shape.file = \"C:/data/w.csv\""},
        Slip{"a = 1\n[case]\nside = left\n", 3, "text stands in quotes", "write side = \"left\""},
        Slip{"file = \"C:\\data\\w.csv\"\n", 1, "a backslash in double quotes",
             "write file = \"C:/data/w.csv\", or single quotes round it"},
        Slip{"file = \"C:\\Users\\w.csv\"\n", 1, "a backslash in double quotes",
             "write file = \"C:/Users/w.csv\", or single quotes round it"},
        Slip{"file = \"C:\\data\\\"\nb = 3\n", 1, "a backslash in double quotes", "write file = \"C:/data/*"},
        Slip{"file = \"wheel.csv\nb = 3\n", 1, "the quote is not closed", "write file = \"wheel.csv\""},
        Slip{"file = 'wheel.csv\nb = 3\n", 1, "the quote is not closed", "write file = \"wheel.csv\""},
        Slip{"file = \"wheel.csv", 1, "the quote is not closed", "write file = \"wheel.csv\""},
        Slip{"file = \u201cwheel.csv\u201d\n", 1, "typographic quotes", "write file = \"wheel.csv\""},
        Slip{"file = \u201ewheel.csv\u201c\n", 1, "typographic quotes", "write file = \"wheel.csv\""},
        Slip{"name = 'it's'\n", 1, "the text ends at its second quote", "within double quotes *"},
        Slip{"names = \"a\", \"b\"\n", 1, "several values are a list", "write names = [\"a\", \"b\"]"},
        Slip{"cant = 1:40\n", 1, "'1:40' is text, and text stands in quotes", "write cant = \"1:40\""},
        Slip{"on = True\n", 1, "small letters", "write on = true"},
        Slip{"on = yes\n", 1, "neither a number nor text in quotes",
             "write on = true, or \"yes\" where a word is taken"},
        Slip{"mirror_z = no\n", 1, "neither a number", "write mirror_z = false, or \"no\" where a word is taken"},
        Slip{"a = null\n", 1, "there is no value 'null'", "leave the line out*"}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, TomlSlip,
    ::testing::Values(Slip{"f = 100,000\n", 1, "thousands are not separated", "write f = 100000, or 100.000"},
                      Slip{"f = 1,000,000\n", 1, "thousands are not separated", "write f = 1000000"},
                      Slip{"f = 100'000\n", 1, "thousands are not separated", "write f = 100000"},
                      Slip{"f = 100 000\n", 1, "thousands are not separated", "write f = 100000"},
                      Slip{"f = 1.000.000\n", 1, "thousands are not separated", "write f = 1000000"},
                      Slip{"f = 100,000.5\n", 1, "thousands are not separated", "write f = 100000.5"},
                      Slip{"f = 100.000,5\n", 1, "decimals are separated by a point", "write f = 100000.5"},
                      Slip{"f = 0,5 # half\n", 1, "decimals are separated by a point", "write f = 0.5"},
                      Slip{"f = -0,025\n", 1, "decimals are separated by a point", "write f = -0.025"},
                      Slip{"f = 1435,2\n", 1, "decimals are separated by a point", "write f = 1435.2"},
                      Slip{"f = .5\n", 1, "a digit must stand before and behind the point", "write f = 0.5"},
                      Slip{"f = 5.\n", 1, "a digit must stand before and behind the point", "write f = 5.0"},
                      Slip{"f = 007\n", 1, "do not begin with 0", "write f = 7"},
                      Slip{"f = 1.0D5\n", 1, "exponents are written with e", "write f = 1.0e5"},
                      Slip{"f = \u22123\n", 1, "only looks like one of a number", "write f = -3"},
                      Slip{"f = \u20133.5\n", 1, "only looks like one of a number", "write f = -3.5"},
                      Slip{"f = --3\n", 1, "more than one sign", ""},
                      Slip{"f = 3 mm\n", 1, "a number stands without its unit, here 'mm' follows", "write it alone*"},
                      Slip{"f = 100kN\n", 1, "a number stands without its unit, here 'kN' follows", "write it alone*"},
                      Slip{"f = 1.5 \u00b0\n", 1, "a number stands without its unit", "write it alone*"},
                      Slip{"f = 1/40\n", 1, "a calculation stands in place of a number", "write f = 0.025"},
                      Slip{"f = 3 - 5\n", 1, "a calculation stands in place of a number", "write its result"},
                      Slip{"f = 1e400\n", 1, "beyond what can be held", "is its exponent right?"},
                      Slip{"f = 1, 2\n", 1, "several values are a list", "write f = [1, 2]"}));

INSTANTIATE_TEST_SUITE_P(
    Lines, TomlSlip,
    ::testing::Values(
        Slip{"f == 3\n", 1, "'=' stands twice", "write f = 3"}, Slip{"f = = 3\n", 1, "'=' stands twice", "write f = 3"},
        Slip{"f = g = 3\n", 1, "'=' stands twice on the line", "begin a new line for the next key"},
        Slip{"a = 1 b = 2\n", 1, "'=' stands twice on the line", "begin a new line for the next key"},
        Slip{"a = 1; b = 2\n", 1, "'=' stands twice on the line", "begin a new line for the next key"},
        Slip{"a = \"x\" b = 2\n", 1, "a line holds one key", "begin a new line for the next one"},
        Slip{"f 3\n", 1, "'=' is missing", "write f = 3"}, Slip{"f: 3\n", 1, "separated by '='", "write f = 3"},
        Slip{"track:\n  cant: 3\n", 1, "the header of a table stands in square brackets", "write [track]"},
        Slip{"a =\n", 1, "the value of a is missing", "write a = and its value, or leave the line out"},
        Slip{"a = # nothing\n", 1, "the value of a is missing", "write a = and its value, or leave the line out"},
        Slip{"= 3\n", 1, "the name of the key is missing", "write key = value"},
        Slip{"gauge mm = 3\n", 1, "the name of a key has no blanks", "did you mean gauge_mm?"},
        Slip{"gr\u00f6\u00dfe = 3\n", 1, "is no name of a key", "names have *"},
        Slip{"a = 3;\n", 1, "nothing stands behind a value", "leave it out"},
        Slip{"a = 3,\n", 1, "nothing stands behind a value", "leave it out"},
        Slip{"a = \"x\",\n", 1, "nothing stands behind a value", "leave it out"},
        Slip{"// words\na = 1\n", 1, "comments begin with '#'", "write # before it"},
        Slip{"; words\n", 1, "comments begin with '#'", "write # before it"},
        Slip{"% words\n", 1, "comments begin with '#'", "write # before it"},
        Slip{"a = 1 // words\n", 1, "comments begin with '#'", "write a = 1 # ..."},
        Slip{"a = 1 ; words\n", 1, "comments begin with '#'", "write a = 1 # ..."},
        Slip{"just some words\n", 1, "neither key = value nor the [header] of a table", "comments begin with #"},
        Slip{"{ \"a\": 3 }\n", 1, "looks like JSON", "write key = value*"},
        Slip{"<case/>\n", 1, "looks like XML", "is it the right file?"},
        Slip{"a\u00a0= 1\n", 1, "an invisible no-break space (U+00A0) stands here", "write a blank in its place"}));

INSTANTIATE_TEST_SUITE_P(
    Tables, TomlSlip,
    ::testing::Values(
        Slip{"[track\na = 1\n", 1, "the header of a table is not closed", "write [track]"},
        Slip{"[[cases]\na = 1\n", 1, "the header of a table is not closed", "write [[cases]]"},
        Slip{"[track] a = 1\n", 1, "stands alone on its line, here 'a = 1' follows", "begin a new line for it"},
        Slip{"[track]\na = 1\nb = 2\na = 3\n", 4, "the key a stands in line 2 already", "leave one of them out"},
        Slip{"[track]\na = 1\n[wheel]\nb = 2\n[track]\nc = 3\n", 5, "the table [track] stands in line 1 already",
             "put its keys together*"},
        Slip{"track.a = 1\n[track]\nb = 2\n", 2, "track is given above in another way", "put its keys together*"},
        Slip{"wheelset.y = 3\nwheelset = 3\n", 2, "wheelset is given above in another way", "leave one of them out"},
        Slip{"[cases]\na = 1\n[[cases]]\nb = 1\n", 3, "cases is given above in another way",
             "write [[cases]] each time*"},
        Slip{"a = [1 2 3]\n", 1, "a comma is missing", "write [1, 2, 3]"},
        Slip{"a = [1; 2]\n", 1, "separated by commas", "write , in place of ;"},
        Slip{"a = [1, 2\nb = 3\n", 2, "the list that begins in line 1 is not closed", "write ] behind its last value"},
        Slip{"a = [\n  one,\n  two]\n", 2, "'one' is text", "write \"one\""},
        Slip{"a = [1, 2]x\n", 1, "nothing but a comment stands behind a value", "leave it out*"},
        Slip{"a = (1, 2)\n", 1, "square brackets", "write a = [1, 2]"},
        Slip{"a = { x = 1,\n y = 2 }\n", 1, "ends on the line where it begins", "write it on one line*"},
        Slip{"a = { x: 1 }\n", 1, "separated by '='", "write { key = value }"},
        Slip{"a = { x = 1, }\n", 1, "a comma stands before '}'", "leave it out"}));

TEST(TomlEncoding, IsReadOrNamed) {
  EXPECT_EQ(error_of("\xEF\xBB\xBF"
                     "a = 1\n")
                .message(),
            "");
  const auto utf16 = [](const std::string& text, bool little) {
    std::string out = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text) out += little ? std::string{c, '\0'} : std::string{'\0', c};
    return out;
  };
  EXPECT_EQ(error_of(utf16("a = 1\nb = \"x\"\n", true)).message(), "");
  EXPECT_EQ(error_of(utf16("a = 1\nb = \"x\"\n", false)).message(), "");
  EXPECT_THAT(error_of(utf16("a = 1\nb = x\n", true)).what(), HasSubstr("a.toml:2:5: not valid TOML: 'x' is text"));
  const Error latin = error_of(
      "a = 1\ntitle = \"R\xE4"
      "der\"\n");
  EXPECT_EQ(latin.where().line, 2);
  EXPECT_THAT(latin.message(), HasSubstr("the byte 0xE4 is not of UTF-8, '\u00e4' in Latin-1"));
  EXPECT_THAT(latin.advice(), HasSubstr("UTF-8"));
  EXPECT_THAT(error_of(std::string("a = 1\0b", 7)).message(), HasSubstr("zero bytes"));
  EXPECT_THAT(error_of("a = 1\rb = 2\r").message(), HasSubstr("carriage return"));
  EXPECT_EQ(error_of("\ta\t=\t1\t# tabs\r\n").message(), "");
}

TEST(NumberFault, LeavesTextAlone) {
  for (const char* text : {"", "wheel.csv", "60E1_worn.csv", "2024.csv", "S1002", "-", "1a2b3c4d5e6f7g"})
    EXPECT_EQ(number_fault(text).message, "") << text;
  EXPECT_EQ(number_fault("3.5").advice, "write 3.5 without quotes");
}

}  // namespace
}  // namespace treadmark::io
