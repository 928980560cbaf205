#include "postproc/curves/figures_summary.h"

#include "postproc/curves/instruction_set.h"
#include "postproc/curves/summary.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/json.h"

namespace pfdm {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<NamedFigures>& tests) {
  Json list = Json::array();
  for (const NamedFigures& test : tests) {
    Json entry = {{"name", test.name}};
    for (const auto& [name, value] : test.figures) entry[name] = value;
    for (const auto& [name, count] : test.counts) entry[name] = count;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace

void write_figures_summary(const std::filesystem::path& path, const FiguresSummary& s) {
  Json json = {{"case", s.case_name},           {"status", s.status},
               {"version", s.version},          {"instruction_set", instruction_set()},
               {"processor", processor_name()}, {"case_hash", s.case_hash},
               {"threads", s.threads},          {"wall_seconds", s.wall_seconds},
               {"cpu_seconds", cpu_seconds()},  {"peak_memory_bytes", std::llround(peak_memory())}};
  for (const auto& [name, value] : s.figures) json[name] = value;
  if (!s.tests.empty()) json["tests"] = to_json(s.tests);
  write_file(path, json_text(json));
}

std::vector<NamedFigures> read_test_figures(const std::filesystem::path& path) {
  return read_json(path, "summary", [](const Json& json) {
    std::vector<NamedFigures> tests;
    for (const Json& test : json.value("tests", Json::array())) {
      tests.push_back({.name = test.at("name"), .figures = {}});
      for (const auto& [name, value] : test.items())
        if (value.is_number() || value.is_null()) tests.back().figures[name] = number_of(value);
    }
    return tests;
  });
}

std::vector<std::string> tests_of_figures_summary(const std::filesystem::path& path) {
  try {
    return read_json(path, "summary", [](const Json& json) {
      std::vector<std::string> names;
      for (const Json& test : json.at("tests")) names.push_back(std::filesystem::path(test.at("name")).filename());
      return names;
    });
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace pfdm
