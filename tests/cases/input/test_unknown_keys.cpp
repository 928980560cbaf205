// A key that the program does not know is an error that names the nearest one and lists all that its table may have.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/kinds.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace pfdm::this_file {
namespace {

std::string message_of(const CaseFile& file) {
  try {
    read_case(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Line {
  std::string before, key, after, table;
};

/// Those that begin with a key whose name the program knows.
std::vector<std::pair<std::size_t, Line>> lines_with_keys(const std::vector<std::string>& lines) {
  static const std::regex header(R"(\s*\[\[?([A-Za-z0-9_.]+)\]\]?.*)"), entry(R"((\s*)([A-Za-z_]+)(\s*=.*))");
  static const std::set<std::string> named_by_the_user{"fit.bounds", "loading.segments.control",
                                                       "fit.experiments.strain", "fit.experiments.stress"};
  std::vector<std::pair<std::size_t, Line>> found;
  std::string table;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (std::regex_match(lines[i], match, header)) table = match[1];
    if (std::regex_match(lines[i], match, entry) && !named_by_the_user.contains(table))
      found.push_back({i, {match[1], match[2], match[3], table}});
  }
  return found;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Of which the further keys depend, so that all there are is not known without them.
const std::set<std::string> choices{"kind", "generator", "law"};

/// Misspells each key of the case in turn; the list must be the same whichever key of a table it is.
void expect_complete_lists(const CaseFile& file) {
  const std::vector<std::string> lines = lines_of(file.text);
  std::map<std::string, std::string> list_of_table;
  for (const auto& [number, line] : lines_with_keys(lines)) {
    std::vector<std::string> changed = lines;
    changed[number] = line.before + line.key + "x" + line.after;
    const std::string message = message_of(with_text(file, text_of(changed)));
    const std::string where = "[" + line.table + "] " + line.key + ": " + message;
    EXPECT_NE(message.find("\"" + line.key + "x\" is not known here"), std::string::npos) << where;
    if (line.key.size() > 1) {
      EXPECT_NE(message.find("did you mean \"" + line.key + "\"?"), std::string::npos) << where;
    }
    if (choices.contains(line.key)) continue;
    const std::size_t list = message.find("(allowed: ");
    ASSERT_NE(list, std::string::npos) << where;
    EXPECT_EQ(list_of_table.emplace(line.table, message.substr(list)).first->second, message.substr(list)) << where;
  }
}

TEST(UnknownKeys, GetTheWholeListOfTheirTable) {
  for (const char* name :
       {"bar_fit", "glass_bead_quick", "glass_bead_radius", "cohesive_sphere", "l_panel_fit", "surfing_crack",
        "goodier_sphere", "endochronic_calibration", "endochronic_rates", "htpb_soft_sweep", "prony_calibration"})
    expect_complete_lists(open_case(std::filesystem::path(PFDM_CASES_DIR) / name));
}

}  // namespace
}  // namespace pfdm::this_file
