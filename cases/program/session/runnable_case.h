#pragma once
// What can be done with a case of any kind.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pfdm {

struct CasePage;

/// A case that was read and found in order. A kind leaves out the jobs that mean nothing to it.
struct RunnableCase {
  std::string title;
  std::function<void(Session&)> check{};  ///< says what would run
  std::function<void(Session&)> mesh{};   ///< meshes only
  std::function<void(Session&)> run{};
  std::function<void(Session&)> cohesive{};         ///< traction-separation laws from the results
  std::function<void(Session&)> compare{};          ///< results against experiments
  std::function<void(Session&)> reduce{};           ///< records of fracture tests, as standards do
  std::function<void(Session&)> fit{};              ///< estimates the parameters that the case names
  std::function<void(Session&)> sweep{};            ///< runs with the sets of values that the case names
  std::function<void(Session&)> sensitivity{};      ///< of its curve to its parameters
  std::function<void(Session&)> analyse{};          ///< what records say without a fit
  std::function<void(Session&)> report{};           ///< pictures and plots on one page; read_case() makes it of `page`
  std::function<CasePage(const Session&)> page{};   ///< what the results show
  std::function<void(Session&)> prepare{};          ///< makes what runs with other values share, as the mesh
  std::vector<std::filesystem::path> data_files{};  ///< that decide the results of `run` besides case.toml
  bool goes_on = false;                             ///< run with --restart, and fit, go on after an interruption
  bool has_steps = false;                           ///< a curve that grows with the run, for --curve-to and --live
};

/// A job that the kind has and this case does not ask for: throws InputError that says which table is missing, what
/// belongs into it, and which case that ships has one.
std::function<void(Session&)> job_without_table(const CaseFile& file, std::string_view table, std::string_view needed,
                                                std::string_view example);

}  // namespace pfdm
