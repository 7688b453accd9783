// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/write_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/version.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/report/blob_store.hpp"
#include "treadmark/report/html_text.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/shown_steps.hpp"
#include "treadmark/report/static_figure.hpp"

namespace treadmark::report {

namespace {

template <class... Ts>
struct Overload : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overload(Ts...) -> Overload<Ts...>;

const char* class_of(Banner::Kind kind) {
  return kind == Banner::Kind::failed ? "failed" : kind == Banner::Kind::warning ? "warning" : "note";
}

std::string html(const Banner& banner) {
  return fmt::format("<div class=\"banner {}\" role=\"{}\"><strong>{}</strong> {}</div>\n", class_of(banner.kind),
                     banner.kind == Banner::Kind::note ? "status" : "alert", html_text(banner.heading),
                     html_text(banner.text));
}

std::string html(const Facts& facts) {
  std::string out = "<dl class=\"facts\">\n";
  for (const auto& [label, value] : facts.entries)
    out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", html_text(label), html_text(value));
  return out + "</dl>\n";
}

std::string html(const Cards& cards) {
  std::string out = "<div class=\"cards\">\n";
  for (const auto& card : cards.cards)
    out += fmt::format(
        "<div class=\"card\"><span class=\"card-label\">{}</span><span class=\"card-value\">{}</span><span "
        "class=\"card-note\">{}</span></div>\n",
        html_text(card.label), html_text(card.value), html_text(card.note));
  return out + "</div>\n";
}

std::string head_of(const Column& column) {
  return html_text(column.label) +
         (column.unit.empty() ? "" : fmt::format(" <span class=\"unit\">[{}]</span>", html_text(column.unit)));
}

std::string html(const Cell& cell) {
  constexpr std::size_t kWords = 24;  // texts of so many bytes want room
  if (const auto* text = std::get_if<std::string>(&cell))
    return fmt::format("<td{}>{}</td>", text->size() > kWords ? " class=\"words\"" : "", html_text(*text));
  const Number& number = std::get<Number>(cell);
  if (!std::isfinite(number.value)) return "<td class=\"number\">–</td>";
  return fmt::format("<td class=\"number\" data-value=\"{:.12g}\">{}</td>", number.value, shown(number));
}

std::string html(const Table& table) {
  const std::string id = html_id(table.id);
  std::string out = fmt::format(
      "<div class=\"table-frame\"><table class=\"data\" id=\"table-{0}\" "
      "data-name=\"{0}\"><caption>{1}</caption>\n<thead><tr>",
      id, html_text(table.caption));
  for (const Column& column : table.columns)
    out += fmt::format("<th scope=\"col\" data-unit=\"{}\">{}</th>", html_text(column.unit), head_of(column));
  out += "</tr></thead>\n<tbody>\n";
  for (const Table::Row& row : table.rows) {
    out += row.step >= 0 ? fmt::format("<tr data-step=\"{}\">", row.step) : "<tr>";
    for (const Cell& cell : row.cells) out += html(cell);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string html(const Listing& listing) {
  return "<pre class=\"listing\" tabindex=\"0\">" + [&] {
    std::string out;
    std::size_t begin = 0;
    while (begin <= listing.text.size()) {  // escaping makes blanks of line ends
      const std::size_t end = std::min(listing.text.find('\n', begin), listing.text.size());
      out += html_text(std::string_view(listing.text).substr(begin, end - begin)) + "\n";
      begin = end + 1;
    }
    return out;
  }() + "</pre>\n";
}

std::string html(const Paragraph& paragraph) { return fmt::format("<p>{}</p>\n", html_text(paragraph.text)); }

const char* view_name(const Figure& figure) {
  return std::visit(Overload{[](const ChartView&) { return "chart"; }, [](const ContactView&) { return "contact"; },
                             [](const SceneView&) { return "scene"; }, [](const SectionView&) { return "section"; },
                             [](const TrackView&) { return "track"; }, [](const MapView&) { return "map"; },
                             [](const CloudView&) { return "cloud"; }, [](const PictureView&) { return "picture"; }},
                    figure.view);
}

/// An image has its own style sheet and ids: pictures in one document do not disturb each other.
std::string image(const std::string& svg, const std::string& title) {
  const std::string text = io::to_base64(std::as_bytes(std::span(svg)));
  return fmt::format("<img class=\"picture\" alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">", html_text(title), text);
}

std::string html(const Figure& figure, const Page& page, bool live) {
  if (!live && (std::holds_alternative<TrackView>(figure.view) || std::holds_alternative<SceneView>(figure.view) ||
                std::holds_alternative<CloudView>(figure.view)))
    return {};
  std::string plot;
  if (!live || std::holds_alternative<PictureView>(figure.view))
    for (const std::string& svg : static_figure(figure, page)) plot += image(svg, figure.title);
  std::string out = fmt::format(
      "<figure class=\"view\" id=\"{}\" data-view=\"{}\"><figcaption>{}</figcaption><div class=\"plot\">{}</div>",
      html_id(figure.id), view_name(figure), html_text(figure.title), plot);
  if (!figure.note.empty()) out += fmt::format("<p class=\"view-note\">{}</p>", html_text(figure.note));
  return out + "</figure>\n";
}

std::string html(const Section& section, const Page& page, bool live) {
  const std::string id = html_id(section.id);
  std::string out = fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-title\"><h2 id=\"{0}-title\">{1}</h2>\n", id,
                                html_text(section.title));
  for (const Block& block : section.blocks)
    out += std::visit(Overload{[&](const Figure& figure) { return html(figure, page, live); },
                               [](const auto& other) { return html(other); }},
                      block);
  return out + "</section>\n";
}

constexpr const char* kHead =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src {}; script-src {}; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'\">\n"
    "<meta name=\"generator\" content=\"Treadmark {}\">\n<meta name=\"color-scheme\" content=\"light "
    "dark\">\n<title>{}</title>\n";

/// The one text that the policy lets in for scripts, or for styles.
std::string source_of(const std::string& text) { return fmt::format("'sha256-{}'", io::sha256_base64(text)); }

constexpr const char* kWithoutScript =
    "<noscript><div class=\"banner warning\"><strong>Scripts are switched off.</strong> Tables are here; pictures "
    "need scripts, or "
    "the command <code>treadmark report --static</code>.</div></noscript>\n";
constexpr const char* kStatic =
    "<div class=\"banner note\" role=\"status\"><strong>Static pictures.</strong> {}</div>\n";

/// A text that scripts read and no browser runs. Its end mark must not be in it: a loader is no place for one.
std::string text_for_scripts(const char* id, std::string_view text) {
  if (text.find("</script") != std::string_view::npos || text.find("<!--") != std::string_view::npos)
    throw Error(ErrorKind::input_data, "the loader of the program for browsers holds markup");
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
}

}  // namespace

std::string to_html(const Page& whole, const PageOptions& options) {
  const Page page = with_shown_steps(whole);
  const bool live = options.live && !page_script().empty();
  const std::string style = "\n" + page_style(), script = "\n" + page_script() + "\n";
  const bool solves = live && page.solving;
  const std::string solver = "\n" + solving_script() + "\n";
  std::string scripts = live ? source_of(script) : "'none'";
  // The program runs in a worker that the page makes of its own text; there is still nothing that it could load.
  if (solves) scripts += " " + source_of(solver) + " 'wasm-unsafe-eval'; worker-src blob:";
  std::string out = fmt::format(kHead, source_of(style), scripts, version(), html_text(page.title));
  out += "<style>" + style;
  out += fmt::format(
      "</style>\n</head>\n<body data-kind=\"{}\">\n<header class=\"page-head\"><h1>{}</h1><p "
      "class=\"lead\">{}</p>\n<nav "
      "class=\"sections\" aria-label=\"Sections\">",
      html_text(page.kind), html_text(page.title), html_text(page.lead));
  for (const Section& section : page.sections)
    out += fmt::format("<a href=\"#{}\">{}</a>", html_id(section.id), html_text(section.title));
  out += "</nav></header>\n<div id=\"toolbar\"></div>\n<div id=\"timeline\" hidden></div>\n<main>\n";
  if (live)
    out += kWithoutScript;
  else
    out += fmt::format(
        kStatic, options.live
                     ? "This build of Treadmark has no Node.js: the report shows fixed pictures in place of live views."
                     : "They were asked for in place of live views.");
  for (const Section& section : page.sections) out += html(section, page, live);
  out += fmt::format("</main>\n<footer><p>Made by Treadmark {} ({}).</p></footer>\n", html_text(version()),
                     html_text(git_revision()));
  if (live) {
    // What tables and scripts take of the whole page is not there for fields.
    constexpr std::size_t kMostPage = 7'500'000, kFewestFields = 1'000'000;
    const std::size_t taken = std::min(out.size() + script.size(), kMostPage - kFewestFields);
    const std::size_t budget = std::min(options.field_budget, kMostPage - taken);
    out += "<script type=\"application/json\" id=\"treadmark-data\">" + page_data(page, budget) + "</script>\n";
    if (solves) {
      out += text_for_scripts("treadmark-loader", page.solving->loader);
      const std::vector<std::byte> module = deflated(std::as_bytes(std::span(page.solving->module)));
      out += text_for_scripts("treadmark-module", io::to_base64(module));
      out += "<script>" + solver + "</script>\n";
    }
    out += "<script>" + script + "</script>\n";
  }
  return out + "</body>\n</html>\n";
}

}  // namespace treadmark::report
