#include "cases/program/new_case.h"

#include "cases/program/chain/chain_case.h"
#include "cases/program/input/case_files/case_file.h"
#include "cases/program/input/config/toml_document.h"
#include "cases/program/input/fields/frame_list.h"
#include "cases/program/kinds.h"
#include "cases/program/session/page_origin.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

fs::path whole(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

/// Of `folder`, the way to `file`, neither of which need be there.
std::string way_to(const fs::path& file, const fs::path& folder) {
  return whole(file).lexically_relative(whole(folder)).string();
}

/// Data files of an old case, and where they go in the new one.
struct DataCopies {
  std::map<fs::path, fs::path> places;
  std::set<fs::path> taken;

  /// `path`, as the old case names a file, for the new one; as it is where there is no such file.
  std::string renamed(const std::string& path, const fs::path& old_directory) {
    const fs::path file = old_directory / path;
    if (!fs::is_regular_file(file)) return path;
    const fs::path key = whole(file);
    if (!places.contains(key)) {
      places[key] = place_of(file, old_directory);
      if (file.extension() == ".pvd") take_frames(file, places[key]);
    }
    return places[key].string();
  }

  void copy_to(const fs::path& directory) const {
    for (const auto& [from, place] : places) {
      make_folder((directory / place).parent_path());
      write_file(directory / place, read_file(from));
    }
  }

 private:
  /// The frames that a list names stand to it as they did.
  void take_frames(const fs::path& list, const fs::path& place) {
    for (const ListedFrame& frame : read_frame_list(list))
      if (const std::string way = way_to(frame.file, list.parent_path()); !way.starts_with(".."))
        places[whole(frame.file)] = place.parent_path() / way;
  }

  fs::path place_of(const fs::path& file, const fs::path& old_directory) {
    fs::path place = fs::relative(whole(file), whole(old_directory));
    if (place.empty() || *place.begin() == "..") place = fs::path("data") / file.filename();
    for (int n = 2; !taken.insert(place).second; ++n)
      place.replace_filename(fmt::format("{}_{}{}", file.stem().string(), n, file.extension().string()));
    return place;
  }
};

std::string readme(const std::string& name, const std::string& like) {
  return fmt::format(
      "# {}\n\nWhat this case shows, where its numbers come from, what to expect.\n\nBegun as a copy of `{}`"
      " with `pfdm init`.\n",
      name, like);
}

/// The schema that editors take is named in a comment, from the case on.
std::string with_schema_from(const std::string& text, const fs::path& old_directory, const fs::path& directory) {
  constexpr std::string_view mark = "#:schema ";
  if (!text.starts_with(mark)) return text;
  const std::size_t end = text.find('\n');
  const std::string schema = text.substr(mark.size(), end - mark.size());
  return fmt::format("{}{}{}", mark, way_to(old_directory / schema, directory), text.substr(end));
}

/// The case of a step, in its new place.
struct CopiedStep {
  CaseFile old;
  fs::path place;
};

/// The new place of what lies in the results of a step; nothing of other files.
std::optional<fs::path> place_in_results(const std::vector<CopiedStep>& steps, const fs::path& file) {
  for (const CopiedStep& step : steps) {
    const fs::path within = way_to(file, step.old.directory / "results");
    if (!within.string().starts_with("..")) return step.place / "results" / within;
  }
  return std::nullopt;
}

void copy_step(const CopiedStep& step, const std::vector<CopiedStep>& steps) {
  DataCopies data;
  const std::string text = with_paths(step.old, [&](const std::string& path) {
    const auto taken = place_in_results(steps, step.old.directory / path);
    return taken ? way_to(*taken, step.place) : data.renamed(path, step.old.directory);
  });
  data.copy_to(step.place);
  make_folder(step.place);
  write_file(step.place / "case.toml", with_schema_from(text, step.old.directory, step.place));
}

/// What the steps take from each other stays so, a case that an earlier step writes too; other cases and data are
/// copied. The cases of the steps lie within the new directory, whose case.toml names them there.
std::string copy_steps(const CaseFile& chain, const fs::path& directory) {
  std::vector<CopiedStep> steps;
  std::string text = chain.text;
  const auto set_case = [&](std::size_t i, const fs::path& place) {
    text = with_value(text, fmt::format("step[{}].case", i), quoted_toml(way_to(place, directory)));
  };
  const std::vector<ChainStep> old_steps = read_chain_case(chain.config.root(), chain.directory).steps;
  for (std::size_t i = 0; i < old_steps.size(); ++i) {
    if (const auto written = place_in_results(steps, old_steps[i].where)) {
      set_case(i, *written);
      continue;
    }
    const CaseFile old = open_case(old_steps[i].where);
    const std::string inside = way_to(old.directory, chain.directory);
    steps.push_back({old, directory / (inside.starts_with("..") ? fs::path(case_name(old)) : fs::path(inside))});
    set_case(i, steps.back().place);
    if (old_steps[i].outside) text = with_value(text, fmt::format("step[{}].outside", i), "false");
  }
  for (const CopiedStep& step : steps) copy_step(step, steps);
  return text;
}

/// A case to be copied, and what is to be said of its record.
struct CaseToCopy {
  CaseFile file;
  std::string made, to_edit;  ///< words after the old name, and after "edit case.toml"
};

bool has_table(const CaseFile& file, const char* table) {
  const TomlValue root = parse_toml(file.text, "case.toml");
  return std::ranges::count(std::get<TomlTable>(root.value), table, &TomlEntry::key) > 0;
}

/// Without [experiment], whose record is of another body than the new case will be; a [fit] needs it.
CaseToCopy to_copy(const fs::path& like) {
  const CaseFile old = open_case(like);
  if (knows_kind(old)) read_case(old);  // a copy of what is wrong helps nobody
  if (!has_table(old, "experiment")) return {old, "", ""};
  const CaseFile without = with_text(old, with_table(old, "experiment", "", old.directory));
  const bool may_leave_it = !has_table(old, "fit") && !has_table(without, "experiment");  // it may stand in braces
  if (may_leave_it) {
    try {
      if (knows_kind(without)) read_case(without);
      return {without, ", without its [experiment]",
              fmt::format(" (a record of your own goes into [experiment]: {} help experiment)", called_as())};
    } catch (const InputError&) {  // something else needs it
    }
  }
  return {old, "", fmt::format(", also [experiment], whose record is of {}", case_name(old))};
}

}  // namespace

void require_empty(const fs::path& directory) {
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory))
    throw InputError(fmt::format("{}: this is a file; a new directory is required", directory.string()));
  if (!fs::is_empty(directory))
    throw InputError(
        fmt::format("{}: the directory is not empty; a new case goes into a new directory", directory.string()));
}

void make_case(const fs::path& directory, const fs::path& like, std::ostream& out) {
  require_empty(directory);
  const CaseToCopy copied = to_copy(like);
  const CaseFile& old = copied.file;
  const std::string old_name = case_name(old);
  DataCopies data;
  std::string text = old.config.root().string("kind") == "chain"
                         ? copy_steps(old, directory)
                         : with_paths(old, [&](const std::string& path) { return data.renamed(path, old.directory); });
  text = with_value(text, "title", quoted_toml("begun as a copy of " + old_name) + "  # edit this title");
  make_folder(directory);
  data.copy_to(directory);
  write_file(directory / "README.md", readme(whole(directory).filename().string(), old_name));
  write_file(directory / "case.toml", with_schema_from(text, old.directory, directory));
  out << fmt::format("made {} like {}{}: case.toml, README.md", directory.string(), old_name, copied.made);
  for (const auto& [from, place] : data.places) out << ", " << place.string();
  out << fmt::format("\nedit case.toml{}, then: {} check {}\n", copied.to_edit, called_as(), directory.string());
}

}  // namespace pfdm
