#pragma once
// A case directory: its case.toml, read strictly, and a hash that tells whether results belong to it.

#include "cases/program/input/config/config.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CaseFile {
  std::filesystem::path directory;
  std::string stem{};  ///< of the file, "case" of case.toml
  std::string text;    ///< without a byte-order mark
  Config config;
  std::filesystem::path kept_in{};  ///< of a case that a run has kept (kept_case.h), the folder of its results
  std::string kept_name{};          ///< likewise, the name of the case that ran
};

/// `where` is a case directory or a .toml file in it. A case that a run has kept is the one that ran, in its directory.
/// Throws InputError if there is none or it is no TOML.
CaseFile open_case(const std::filesystem::path& where);

/// The name of its directory, of the case that was run where that is its results or the file was kept by a run
/// (kept_case.h); of another file than case.toml with its stem: "glass_bead_fit.fitted" of
/// glass_bead_fit/results/case.fitted.toml, "glass_bead.coarse" of coarse.toml.
std::string case_name(const CaseFile& file);

/// Of a file other than case.toml in a folder "results" its name there: "fitted" of case.fitted.toml; else empty.
std::string name_among_results(const CaseFile& file);

/// Calls `see` with every value of a parsed file and its path, as in "mesh.particles[0].diameter".
void for_each_value(const TomlValue& root,
                    const std::function<void(const std::string& path, const TomlValue& value)>& see);

/// Of what case.toml says, but for title and comments, of the numbers that it takes from result files, and of the data
/// files that it uses; 16 hexadecimal digits (FNV-1a). `left_out`: tables after a change of which a run may be
/// continued.
std::string case_hash(const CaseFile& file, std::span<const std::filesystem::path> data_files,
                      std::span<const std::string_view> left_out = {});

/// The files that the case names as `csv`, `file` or `fit`, from its directory on, in the order of the text.
std::vector<std::filesystem::path> data_files_named(const CaseFile& file);

/// A number that a case takes from a result file (result_number.h).
struct TakenNumber {
  std::string into;  ///< "materials.matrix.young_modulus"
  std::string from;  ///< the file, as the case names it
  std::string key;   ///< in that file
  double value = 0.0;
};
/// In the order of the text. Throws InputError like result_number().
std::vector<TakenNumber> numbers_taken(const CaseFile& file);

/// The same case with another text; its paths still start at the directory.
CaseFile with_text(const CaseFile& file, std::string text);

/// Of what is in a file, likewise.
std::string content_hash(const std::filesystem::path& file);

/// Of what one table says, and of data files, likewise.
std::string table_hash(const CaseFile& file, std::string_view table, std::span<const std::filesystem::path> data_files);

/// case.toml with the files that it names as `csv`, `file`, `fit`, `table` or `from` called as `renamed` says of each.
std::string with_paths(const CaseFile& file, const std::function<std::string(const std::string&)>& renamed);

/// case.toml, to stand in `folder`: the files that it names as `csv`, `file`, `fit`, `table` or `from` are named from
/// there.
std::string moved(const CaseFile& file, const std::filesystem::path& folder);

/// `text` with a table below its head [table], and all below it, replaced by `by`.
std::string with_table_replaced(const std::string& text, std::string_view table, const std::string& by);

/// case.toml with one of its tables, [table] and all below it, replaced by `text`, to stand in `folder`: the files that
/// it names as `csv`, `file`, `fit`, `table` or `from` are named from there.
std::string with_table(const CaseFile& file, std::string_view table, const std::string& text,
                       const std::filesystem::path& folder);

}  // namespace pfdm
