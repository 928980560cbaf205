#include "cases/program/new_case.h"

#include "cases/program/input/case_file.h"
#include "cases/program/input/toml_document.h"
#include "cases/program/kinds.h"
#include "postproc/files/atomic_file.h"
#include "postproc/files/text_file.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace pfdm {
namespace {

namespace fs = std::filesystem;

fs::path whole(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

void require_empty(const fs::path& directory) {
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory))
    throw InputError(fmt::format("{}: this is a file; a new directory is required", directory.string()));
  if (!fs::is_empty(directory))
    throw InputError(
        fmt::format("{}: the directory is not empty; a new case goes into a new directory", directory.string()));
}

/// Of a file of the old case, in the new one.
fs::path place_of(const fs::path& file, const fs::path& old_directory, std::set<fs::path>& taken) {
  fs::path place = fs::relative(whole(file), whole(old_directory));
  if (place.empty() || *place.begin() == "..") place = fs::path("data") / file.filename();
  for (int n = 2; !taken.insert(place).second; ++n)
    place.replace_filename(fmt::format("{}_{}{}", file.stem().string(), n, file.extension().string()));
  return place;
}

std::string readme(const std::string& name, const std::string& like) {
  return fmt::format(
      "# {}\n\nWhat this case shows, where its numbers come from, what to expect.\n\nBegun as a copy of `{}`"
      " with `pfdm init`.\n",
      name, like);
}

void copy_data(const std::map<fs::path, fs::path>& places, const fs::path& directory) {
  for (const auto& [from, place] : places) {
    make_folder((directory / place).parent_path());
    write_file(directory / place, read_file(from));
  }
}

}  // namespace

void make_case(const fs::path& directory, const fs::path& like, std::ostream& out) {
  require_empty(directory);
  const CaseFile old = open_case(like);
  read_case(old);  // a copy of what is wrong helps nobody
  if (old.config.root().string("kind") == "chain")
    throw InputError(
        fmt::format("{}: the steps of a chain are cases of their own: copy its folder, and theirs", like.string()));
  const std::string name = whole(directory).filename().string(), old_name = case_name(old);
  std::map<fs::path, fs::path> places;
  std::set<fs::path> taken;
  std::string text = with_paths(old, [&](const std::string& path) {
    const fs::path file = old.directory / path;
    if (!fs::is_regular_file(file)) return path;
    const fs::path key = whole(file);
    if (!places.contains(key)) places[key] = place_of(file, old.directory, taken);
    return places[key].string();
  });
  text = with_value(text, "title",
                    quoted_toml(fmt::format("{} (begun as a copy of {}: edit this title)", name, old_name)));
  make_folder(directory);
  copy_data(places, directory);
  write_file(directory / "README.md", readme(name, old_name));
  write_file(directory / "case.toml", text);
  out << fmt::format("made {} like {}: case.toml, README.md", directory.string(), old_name);
  for (const auto& [from, place] : places) out << ", " << place.string();
  out << fmt::format("\nedit case.toml, then: pfdm check {}\n", directory.string());
}

}  // namespace pfdm
