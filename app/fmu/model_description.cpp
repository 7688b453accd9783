// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/fmu/model_description.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "treadmark/app/version.hpp"
#include "treadmark/io/files/replaced.hpp"
#include "treadmark/report/pictures/svg_text.hpp"

namespace treadmark::fmi {
namespace {

using Kind = Variable::Kind;

std::string escaped(std::string_view text) { return io::replaced(pictures::xml_text(text), "\"", "&quot;"); }

template <class Value>
std::string attribute(std::string_view name, const Value& value) {
  return fmt::format(" {}=\"{}\"", name, escaped(fmt::format("{}", value)));
}

/// Exponents of base units, in this order.
constexpr std::array<const char*, 5> kBases = {"kg", "m", "s", "K", "rad"};
using Exponents = std::array<int, kBases.size()>;
struct Symbol {
  std::string_view name;
  Exponents exponents;
};
constexpr Symbol kSymbols[] = {
    {"kg", {1}},       {"m", {0, 1}},       {"s", {0, 0, 1}},  {"K", {0, 0, 0, 1}}, {"rad", {0, 0, 0, 0, 1}},
    {"N", {1, 1, -2}}, {"Pa", {1, -1, -2}}, {"J", {1, 2, -2}}, {"W", {1, 2, -3}},   {"1", {}},
};

/// Of a unit such as "N.m", "rad/s" or "m2": symbols with exponents, those after a '/' below the line.
Exponents exponents_of(std::string_view unit) {
  Exponents sum{};
  int sign = 1;
  while (!unit.empty()) {
    std::size_t length = 0;
    while (length < unit.size() && std::isalpha(static_cast<unsigned char>(unit[length]))) ++length;
    if (length == 0) length = 1;  // the "1" of "1/m"
    const std::string_view name = unit.substr(0, length);
    unit.remove_prefix(length);
    int power = 1;
    if (!unit.empty() && std::isdigit(static_cast<unsigned char>(unit.front()))) {
      power = unit.front() - '0';
      unit.remove_prefix(1);
    }
    for (const Symbol& symbol : kSymbols)
      if (symbol.name == name)
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sign * power * symbol.exponents[i];
    if (unit.empty()) break;
    if (unit.front() == '/') sign = -1;
    unit.remove_prefix(1);  // '/' or '.'
  }
  return sum;
}

std::string units(const Variables& variables) {
  std::set<std::string> names;
  for (const Variable& v : variables.all()) names.insert(v.unit);
  std::string out = "  <UnitDefinitions>\n";
  for (const std::string& name : names) {
    out += fmt::format("    <Unit{}><BaseUnit", attribute("name", name));
    const Exponents exponents = exponents_of(name);
    for (std::size_t i = 0; i < exponents.size(); ++i)
      if (exponents[i] != 0) out += attribute(kBases[i], exponents[i]);
    out += "/></Unit>\n";
  }
  return out + "  </UnitDefinitions>\n";
}

std::string_view causality(const Variable& v) {
  switch (v.kind) {
    case Kind::time:
      return "independent";
    case Kind::parameter:
    case Kind::tunable:
      return "parameter";
    case Kind::input:
      return "input";
    case Kind::output:
      break;
  }
  return "output";
}

std::string_view variability(const Variable& v) {
  if (v.kind == Kind::parameter) return "fixed";
  if (v.kind == Kind::tunable) return "tunable";
  return v.integer ? "discrete" : "continuous";
}

std::string common(const Variable& v, const std::string& name, std::uint32_t reference) {
  return attribute("name", name) + attribute("valueReference", reference) +
         (v.description.empty() ? std::string() : attribute("description", v.description)) +
         attribute("causality", causality(v)) + attribute("variability", variability(v)) +
         (v.kind == Kind::output ? attribute("initial", "calculated") : std::string());
}

/// Unit and start value; integers have no unit.
std::string value(const Variable& v) {
  return (v.integer ? std::string() : attribute("unit", v.unit)) +
         (v.settable() ? attribute("start", v.start) : std::string());
}

std::string variable_3(const Variable& v) {
  const char* type = v.integer ? "Int32" : "Float64";
  const std::string head = fmt::format("    <{}{}{}", type, common(v, v.name, v.reference), value(v));
  if (v.size == 0) return head + "/>\n";
  return fmt::format("{}><Dimension{}/></{}>\n", head, attribute("start", v.size), type);
}

std::string variable_2(const Variable& v) {
  std::string out;
  for (std::uint32_t k = 0; k < v.elements(); ++k)
    out += fmt::format("    <ScalarVariable{}><{}{}/></ScalarVariable>\n",
                       common(v, v.size == 0 ? v.name : fmt::format("{}[{}]", v.name, k + 1), v.reference + k),
                       v.integer ? "Integer" : "Real", value(v));
  return out;
}

std::string head(const Description& about) {
  return attribute("modelName", about.name) + attribute("description", about.title) +
         attribute("version", app::version()) + attribute("generationTool", "Treadmark " + app::version()) +
         attribute("variableNamingConvention", "flat");
}

/// Outputs and what they depend on. Scalars of FMI 2 are numbered from 1 in the order of their references.
std::string structure(const Model& model, Version version) {
  const auto all = model.variables().all();
  const bool three = version == Version::fmi3;
  std::string outputs, unknowns;
  for (const Variable& v : all) {
    if (v.kind != Kind::output) continue;
    std::string inputs;
    for (const Variable& other : all)
      if (depends(v, other))
        inputs += fmt::format("{}{}", inputs.empty() ? "" : " ", other.reference + (three ? 0 : 1));
    const std::string dependencies = attribute("dependencies", inputs);
    for (std::uint32_t k = 0; k < (three ? 1 : v.elements()); ++k) {
      const std::string which =
          three ? attribute("valueReference", v.reference) : attribute("index", v.reference + k + 1);
      outputs += fmt::format("    <{}{}{}/>\n", three ? "Output" : "Unknown", which, dependencies);
      unknowns += fmt::format("    <{}{}/>\n", three ? "InitialUnknown" : "Unknown", which);
    }
  }
  if (three) return fmt::format("  <ModelStructure>\n{}{}  </ModelStructure>\n", outputs, unknowns);
  return fmt::format(
      "  <ModelStructure>\n    <Outputs>\n{}    </Outputs>\n    <InitialUnknowns>\n{}    </InitialUnknowns>\n"
      "  </ModelStructure>\n",
      outputs, unknowns);
}

std::string middle(const Model& model) {
  std::string out = units(model.variables()) + "  <LogCategories>\n";
  for (const Category& category : kCategories)
    out += fmt::format("    <Category{}{}/>\n", attribute("name", category.name),
                       attribute("description", category.description));
  out += "  </LogCategories>\n  <DefaultExperiment startTime=\"0\"";
  if (std::isfinite(model.end())) out += attribute("stopTime", model.end());
  return out + attribute("stepSize", model.usual_step()) + "/>\n";
}

}  // namespace

std::string model_description(const Model& model, const Description& about, Version version) {
  const bool three = version == Version::fmi3;
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += fmt::format("<fmiModelDescription{}{}{}>\n", attribute("fmiVersion", three ? "3.0" : "2.0"), head(about),
                     attribute(three ? "instantiationToken" : "guid", about.token));
  out += fmt::format(
      "  <CoSimulation{}{}{}{}{}/>\n", attribute("modelIdentifier", kModelIdentifier),
      attribute("canHandleVariableCommunicationStepSize", true),
      attribute(three ? "canGetAndSetFMUState" : "canGetAndSetFMUstate", true),
      attribute(three ? "canSerializeFMUState" : "canSerializeFMUstate", true),
      attribute(three ? "providesDirectionalDerivatives" : "providesDirectionalDerivative", model.differentiable()));
  out += middle(model) + "  <ModelVariables>\n";
  for (const Variable& v : model.variables().all()) out += three ? variable_3(v) : variable_2(v);
  return out + "  </ModelVariables>\n" + structure(model, version) + "</fmiModelDescription>\n";
}

std::string model_page(const Model& model, const Description& about, Version version) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
      "charset=\"utf-8\"><title>{0}</title></head>\n<body>\n<h1>{0}</h1>\n"
      "<p>{1}</p>\n<p>Co-simulation by FMI {2}.0, made by Treadmark {3}. The case is "
      "<code>resources/case.toml</code>. Frames, signs and units are those of Treadmark: x forward, y to the right, z "
      "down, forces on the rail, SI units.</p>\n<p>{4}. Licences are in <code>licenses</code>.</p>\n"
      "<table>\n<tr><th>variable</th><th>reference</th><th>causality</th><th>unit</th><th>start</th><th>meaning</th></"
      "tr>"
      "\n",
      escaped(about.name), escaped(about.title), static_cast<int>(version), app::version(),
      escaped(app::build_description()));
  for (const Variable& v : model.variables().all())
    out += fmt::format("<tr><td>{}{}</td><td>{}</td><td>{}, {}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       escaped(v.name), v.size == 0 ? std::string() : fmt::format("[{}]", v.size), v.reference,
                       causality(v), variability(v), escaped(v.unit),
                       v.settable() ? fmt::format("{}", v.start) : std::string(), escaped(v.description));
  return out + "</table>\n</body></html>\n";
}

}  // namespace treadmark::fmi
