#include "cases/program/manual_page.h"

#include "cases/program/command_texts.h"

#include <fmt/format.h>

#include <string_view>

namespace pfdm {
namespace {

/// As troff shows it: no character commands, and no line a request.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool begins = out.empty() || out.back() == '\n';
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", escaped(text)); }
std::string value(std::string_view text) { return text.empty() ? "" : fmt::format("\\fI{}\\fR", escaped(text)); }

/// Lines as they are.
std::string as_it_is(std::string_view text) { return fmt::format(".PP\n.nf\n{}\n.fi\n", escaped(text)); }

std::string heading(const CommandWords& command) {
  std::string words = "pfdm " + command.name + " [OPTIONS]";
  for (const CommandWords::Option& option : command.options)
    if (option.name.empty()) words += " " + option.value;
  return escaped(words);
}

std::string option_text(const CommandWords::Option& option) {
  const std::string short_name = option.short_name.empty() ? "" : bold(option.short_name) + ", ";
  const std::string name = option.name.empty() ? value(option.value)
                           : option.value.empty()
                               ? short_name + bold(option.name)
                               : fmt::format("{}{} {}", short_name, bold(option.name), value(option.value));
  return fmt::format(".TP\n{}\n{}\n", name, escaped(option.meaning));
}

std::string command_text(const CommandWords& command) {
  std::string text = fmt::format(".SS \"{}\"\n{}.\n", heading(command), escaped(command.description));
  for (const CommandWords::Option& option : command.options) text += option_text(option);
  return text + as_it_is(command.writes);
}

}  // namespace

std::string manual_page(std::span<const CommandWords> commands, const std::string& version) {
  std::string page = fmt::format(
      ".TH PFDM 1 \"\" \"pfdm {}\" \"User commands\"\n"
      ".SH NAME\npfdm \\- phase\\-field damage mechanics on cell\\-centred finite volumes\n"
      ".SH SYNOPSIS\n.B pfdm\n.I COMMAND\n[\\fIOPTIONS\\fR] [\\fICASE\\fR]\n"
      ".SH DESCRIPTION\nA case is a directory with a \\fIcase.toml\\fR. {} makes one from a case that ships, {} "
      "computes it, "
      "{} draws its results on a page, and {} says what a key of \\fIcase.toml\\fR is.\n.SH COMMANDS\n",
      escaped(version), bold("pfdm init"), bold("pfdm run"), bold("pfdm report"), bold("pfdm help KEY"));
  for (const CommandWords& command : commands) page += command_text(command);
  return page + ".SH EXIT STATUS\n" + as_it_is(exit_statuses);
}

}  // namespace pfdm
