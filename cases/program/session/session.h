#pragma once
// What the command line asked for, and where to say things.

#include "cases/program/session/export_words.h"
#include "cases/program/session/mesh_store.h"
#include "cases/program/session/sensitivity_words.h"
#include "cases/program/session/terminal/log.h"
#include "physics/tensor.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CaseFile;
struct FieldPlace;
struct RunnableCase;

/// Of a run whose page is kept up to date: the commands that the page names.
struct LiveCommands {
  std::string command;  ///< makes the results again
  std::string report;   ///< makes the whole page
};

struct Session {
  std::filesystem::path results;   ///< directory
  bool restart = false;            ///< continue from the last complete output
  std::optional<Index> max_steps;  ///< stop after so many steps of this run
  std::optional<double> until;     ///< stop after the step that brings the curve's displacement here [m]
  int threads = 1;
  std::string version;
  RunnableCase (*read_case)(const CaseFile& file) = nullptr;  ///< of any kind: for jobs that run other cases
  Log& log;
  bool strict = false;               ///< a fit that is not sound is an error
  bool slurm = false;                ///< hand the runs of a sweep to Slurm
  std::filesystem::path curve_to{};  ///< where a script reads the rows of the curve while the run goes on
  bool figures_only = false;         ///< of many runs: summary and curves, no fields
  bool records_laws = false;         ///< and of these the laws of interfaces too
  MeshStore* meshes = nullptr;       ///< where meshes are kept that several runs share
  ExportWords exports{};             ///< of cohesive
  SensitivityWords sensitivity{};
  std::optional<LiveCommands> live{};               ///< report/index.html is kept up to date while the run goes on
  const std::vector<FieldPlace>* places = nullptr;  ///< whose displacements a run records, step by step
  /// CaseKind::numbers_like of a kind by name: for jobs that take numbers from runs to come; null: nothing is known.
  std::string (*numbers_like)(std::string_view kind, std::string_view file) = nullptr;
};

}  // namespace pfdm
