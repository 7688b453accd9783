// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Manual pages, from what --help is made of.
#include <fmt/format.h>

#include <cctype>
#include <iostream>
#include <string>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/shell_words.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::cli {
namespace {

/// As roff prints it.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
      out += std::string("\\&") + c;
    else
      out += c;
  }
  return out;
}

std::string synopsis(const std::string& name, const CLI::App& app) {
  std::string line = fmt::format(".B {}\n[\\fIOPTIONS\\fR]", escaped(name));
  for (const OptionWords& words : option_words(app))
    if (words.names.empty())
      line += fmt::format(" {}\\fI{}\\fR{}{}", words.required ? "" : "[", escaped(words.value),
                          words.repeated ? "..." : "", words.required ? "" : "]");
  return line;
}

std::string options(const CLI::App& app) {
  std::string text;
  for (const OptionWords& words : option_words(app)) {
    std::string head;
    for (const std::string& name : words.names)
      head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", escaped(name));
    if (!words.value.empty()) head += fmt::format("{}\\fI{}\\fR", head.empty() ? "" : " ", escaped(words.value));
    text += fmt::format(".TP\n{}\n{}\n", head, escaped(words.description));
    if (!words.choices.empty())
      text += fmt::format("({})\n", escaped(fmt::format("{}", fmt::join(words.choices, ", "))));
  }
  return text;
}

std::string page(const CLI::App& program, const CLI::App* verb) {
  std::string title = "treadmark", call = "treadmark", upper;
  if (verb != nullptr) title += '-' + verb->get_name(), call += ' ' + verb->get_name();
  ranges::transform(title, std::back_inserter(upper), [](unsigned char c) { return std::toupper(c); });
  const CLI::App& app = verb != nullptr ? *verb : program;
  std::string out = fmt::format(".TH {} 1 \"\" \"Treadmark {}\" \"Treadmark\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
                                upper, app::version(), escaped(title), escaped(app.get_description()));
  out += synopsis(call, app);
  if (verb == nullptr) out += " \\fIVERB\\fR ...";
  out += "\n.SH OPTIONS\n" + options(app);
  std::string others;
  if (verb == nullptr) {
    out += ".SH VERBS\n";
    std::string group;
    for (const CLI::App* each : verbs_of(program)) {
      if (each->get_group() != group) out += fmt::format(".SS {}\n", group = each->get_group());
      out += fmt::format(".TP\n\\fB{}\\fR\n{}\n", each->get_name(), escaped(each->get_description()));
      others += fmt::format("{}\\fBtreadmark\\-{}\\fR(1)", others.empty() ? "" : ", ", each->get_name());
    }
  } else {
    out += ".PP\nOptions of \\fBtreadmark\\fR(1) may stand here too.\n";
    const auto row = ranges::find(verbs(), verb->get_name(), [](const Verb& v) { return std::string(v.name); });
    out += ".SH EXAMPLES\n.nf\n" + escaped(example_lines(*row)) + ".fi\n";
    others = "\\fBtreadmark\\fR(1)";
  }
  return out + ".SH NOTES\n" + escaped(program.get_footer()) + "\n.SH SEE ALSO\n" + others + "\n";
}

}  // namespace

Command add_man(CLI::App& verb) {
  auto name = std::make_shared<std::string>();
  verb.add_option("VERB", *name, "Page of this verb; default: that of the program");
  return [name, program = verb.get_parent()](const CommonOptions&) -> int {
    const CLI::App* found = nullptr;
    std::vector<std::string> names;
    for (const CLI::App* each : verbs_of(*program)) {
      if (each->get_name() == *name) found = each;
      names.push_back(each->get_name());
    }
    if (found == nullptr && !name->empty())
      throw Error(ErrorKind::configuration, "there is no verb '" + *name + "'", {},
                  advice_on_name(*name, names, "see treadmark list verbs"));
    std::cout << page(*program, found);
    return kOk;
  };
}

}  // namespace treadmark::cli
