// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "treadmark/io/files/sha256.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kNasty = "<img src=x onerror=alert(1)> & \"q\" 'a' </script><script>alert(2)</script>";

Page nasty_page() {
  Page page{"run", kNasty, kNasty};
  Section section{kNasty, kNasty};
  section.blocks.emplace_back(Banner{Banner::Kind::failed, kNasty, kNasty});
  section.blocks.emplace_back(Facts{{{kNasty, kNasty}}});
  section.blocks.emplace_back(Cards{{{kNasty, kNasty, kNasty}}});
  section.blocks.emplace_back(Table{kNasty, kNasty, {{kNasty, kNasty}}, {{{kNasty}}, {{Number{1.5}}, 0}}});
  section.blocks.emplace_back(Listing{kNasty + "\n" + kNasty});
  section.blocks.emplace_back(Paragraph{kNasty});
  ChartView chart;
  chart.x = Axis{kNasty, kNasty, false, {0.0, 1.0}};
  chart.panels = {{kNasty, kNasty, false, {{kNasty, {1.0, 2.0}}}, {{1.0, kNasty}}}};
  section.blocks.emplace_back(Figure{kNasty, kNasty, chart, kNasty});
  page.sections.push_back(std::move(section));
  page.document = R"({"name": "</script><script>alert(3)</script>"})";
  return page;
}

TEST(Html, TextsFromResultsStayText) {
  for (const bool live : {true, false}) {
    const std::string html = to_html(nasty_page(), {live});
    const std::string without_script =
        live && !page_script().empty() ? html.substr(0, html.size() - page_script().size()) : html;
    EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(without_script, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(html, HasSubstr("&lt;img src=x onerror=alert(1)&gt; &amp; &quot;q&quot; &#39;a&#39;"));
  }
}

TEST(Html, DataCannotEndTheirElement) {
  const std::string data = page_data(nasty_page(), 1000);
  EXPECT_THAT(data, Not(HasSubstr("<")));
  const auto json = nlohmann::json::parse(data);
  EXPECT_EQ(json["title"], kNasty);
  EXPECT_EQ(json["document"]["name"], "</script><script>alert(3)</script>");
  EXPECT_EQ(json["views"][0]["panels"][0]["series"][0]["name"], kNasty);
}

TEST(Html, BytesThatAreNoTextDoNotBreakThePage) {
  Page page{"run", "caf\xE9 \x01 \xF0\x9F\x9A\x82", ""};
  const auto json = nlohmann::json::parse(page_data(page, 1000));
  EXPECT_TRUE(json["title"].is_string());
  EXPECT_THAT(to_html(page), HasSubstr("\xF0\x9F\x9A\x82"));
  EXPECT_THAT(to_html(page), Not(HasSubstr("\xE9 ")));
}

TEST(Html, RefersToNothingOutside) {
  for (const bool live : {true, false}) {
    const std::string html = to_html(nasty_page(), {live});
    const std::string page = html.substr(0, html.find("<script>"));
    for (const char* reference : {"src=\"http", "href=\"http", "url(http", "@import", "src=\"//"})
      EXPECT_THAT(page, Not(HasSubstr(reference)));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  }
}

/// What stands between the first such tags, from there on.
std::string element(const std::string& html, const std::string& tag, std::size_t from = 0) {
  const std::size_t begin = html.find('<' + tag + '>', from) + tag.size() + 2;
  return html.substr(begin, html.find("</" + tag + '>', begin) - begin);
}

/// The tags of a text, without the values of their attributes.
std::string tags(const std::string& html) {
  std::string out;
  bool inside = false, quoted = false;
  for (const char c : html) {
    if (c == '<') inside = true;
    if (inside && c == '"') quoted = !quoted;
    if (inside && !quoted) out += c;
    if (c == '>' && !quoted) inside = false;
  }
  return out;
}

TEST(Html, NoOtherScriptAndNoOtherStyleTakesEffect) {
  for (const bool live : {true, false}) {
    const std::string html = to_html(nasty_page(), {live});
    EXPECT_THAT(html.substr(0, html.find("<style>")), Not(HasSubstr("unsafe")));
    EXPECT_THAT(html, HasSubstr("style-src 'sha256-" + io::sha256_base64(element(html, "style")) + "'"));
    if (live && !page_script().empty()) {
      const std::string script = element(html, "script", html.size() - page_script().size() - 100);
      EXPECT_THAT(html, HasSubstr("script-src 'sha256-" + io::sha256_base64(script) + "'"));
    } else {
      EXPECT_THAT(html, HasSubstr("script-src 'none'"));
    }
    // Attributes with styles and handlers would need more than hashes.
    const std::string body = html.substr(html.find("<body"), html.rfind("<footer>") - html.find("<body"));
    for (const char* attribute : {" style=", " on"}) EXPECT_THAT(tags(body), Not(HasSubstr(attribute)));
  }
}

TEST(Html, StaticPagesSaySoAndHavePictures) {
  const std::string html = to_html(nasty_page(), {false});
  EXPECT_THAT(html, HasSubstr("Static pictures."));
  EXPECT_THAT(html, HasSubstr("data:image/svg+xml;base64,"));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
}

TEST(Html, TheSamePageHasTheSameBytes) { EXPECT_EQ(to_html(nasty_page()), to_html(nasty_page())); }

TEST(Html, NumbersAsPeopleReadThem) {
  EXPECT_EQ(shown({1234.5678}), "1235");
  EXPECT_EQ(shown({0.00123456}), "0.001235");
  EXPECT_EQ(shown({-99.994}), "-99.99");
  EXPECT_EQ(shown({99.9996}), "100.0");
  EXPECT_EQ(shown({0.99996}), "1.000");
  // Halves as in charts of browsers, whose toPrecision takes the larger one.
  EXPECT_EQ(shown({224.25}), "224.3");
  EXPECT_EQ(shown({-0.03125, 3}), "-0.0313");
  EXPECT_EQ(shown({-1.24e-14}), "0");
  EXPECT_EQ(shown({12}), "12");
  EXPECT_EQ(shown({1.5e9}), "1.500e+09");
  EXPECT_EQ(shown({0.0}), "0");
  EXPECT_EQ(shown({NAN}), "–");
}

TEST(Html, IdsAreIds) {
  EXPECT_EQ(html_id("Contact patches (2)"), "contact-patches-2");
  EXPECT_EQ(html_id("<\"'>"), "part");
}

}  // namespace
}  // namespace treadmark::report
