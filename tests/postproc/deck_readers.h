#pragma once
// Small readers of the formats that laws are exported in.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace pfdm::test {

/// What an Abaqus deck holds: rows of numbers by block (*MATERIAL or *SURFACE INTERACTION) and keyword line.
using Deck = std::map<std::string, std::map<std::string, std::vector<std::vector<double>>>>;

inline Deck read_abaqus(const std::string& text) {
  Deck deck;
  std::string block, keyword;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("**")) continue;
    if (line.starts_with("*")) {
      const std::size_t name = line.find("NAME=");
      if (name != std::string::npos) block = line.substr(name + 5);
      keyword = line;
      deck[block][keyword];
      continue;
    }
    std::vector<double> row;
    std::istringstream entries(line);
    for (std::string entry; std::getline(entries, entry, ',');) row.push_back(std::stod(entry));
    deck[block][keyword].push_back(row);
  }
  return deck;
}

/// Lines "key = value" that are no comments; MOOSE and Akantu.
inline std::map<std::string, std::string> read_assignments(const std::string& text) {
  std::map<std::string, std::string> values;
  std::istringstream lines(text);
  const std::regex assignment(R"(\s*(\w+) = (\S+))");
  std::smatch found;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("#") && std::regex_match(line, found, assignment)) values[found[1]] = found[2];
  return values;
}

/// Lines of fields of fixed width after each keyword; `$` are comments. A field of blanks is NaN.
inline std::map<std::string, std::vector<std::vector<double>>> read_fields(
    const std::string& text, const std::function<std::size_t(const std::string&, std::size_t)>& width) {
  std::map<std::string, std::vector<std::vector<double>>> cards;
  std::string keyword;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$")) continue;
    if (line.starts_with("*")) {
      keyword = line;
      cards[keyword];
      continue;
    }
    std::vector<double> row;
    const std::size_t w = width(keyword, cards[keyword].size());
    for (std::size_t i = 0; i < line.size(); i += w) {
      const std::string field = line.substr(i, w);
      row.push_back(field.find_first_not_of(' ') == std::string::npos ? std::nan("") : std::stod(field));
    }
    cards[keyword].push_back(row);
  }
  return cards;
}

/// Fields 2 to 5 of each half line.
inline std::vector<std::string> read_large_fields(const std::string& text) {
  std::vector<std::string> fields;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$")) continue;
    EXPECT_NE(line.substr(0, 8).find('*'), std::string::npos) << line;
    line.resize(72, ' ');
    for (std::size_t i = 8; i < 72; i += 16) fields.push_back(line.substr(i, 16));
  }
  return fields;
}

/// "name [ dimensions ] value" of a dictionary of OpenFOAM, by the dictionary it is in.
inline std::map<std::string, double> read_dimensioned(const std::string& text, const std::string& dictionary) {
  const std::size_t begin = text.find("\n" + dictionary + "\n{"), end = text.find("\n}\n", begin);
  std::map<std::string, double> values;
  const std::string part = text.substr(begin, end - begin);
  const std::regex entry(R"((\w+)\s+(\w+) \[ 1 (-?\d) -2 0 0 0 0 \] (\S+);)");
  for (std::sregex_iterator i(part.begin(), part.end(), entry), last; i != last; ++i) {
    EXPECT_EQ((*i)[1], (*i)[2]);
    EXPECT_EQ((*i)[3], (*i)[1].str().starts_with("G") ? "0" : "-1") << i->str();
    values[(*i)[1]] = std::stod((*i)[4]);
  }
  return values;
}

}  // namespace pfdm::test
