#pragma once
// Runs of one case with other values, each in a folder of its own under the hash of all that decides its results: what
// has been run is there, what was interrupted continues, and no run is done twice.

#include "cases/program/input/case_files/case_file.h"
#include "cases/program/session/session.h"
#include "cases/program/session/terminal/side_by_side.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pfdm {

/// A case and what sets it apart, for messages.
struct CaseVariant {
  CaseFile file;
  std::string shown;  ///< "materials.glass.young_modulus = 70 GPa"
};

struct DoneRun {
  std::filesystem::path folder;  ///< of its results; empty if there can be no such case
  std::string failure;           ///< why it did not converge, or why there is no such case; empty if it went well
  bool went_well() const { return failure.empty(); }
};

/// A run that is not there yet; the hash of all that decides its results names it.
struct MissingRun {
  std::string key;
  const CaseVariant* variant;
};

class CaseRuns {
 public:
  /// `folder` will hold the runs' folders. Runs are side by side on `session.threads` cores.
  CaseRuns(std::filesystem::path folder, const Session& session);
  /// Runs record the displacements at these places, which have to stay; others than those of earlier runs make new
  /// ones.
  void record(const std::vector<FieldPlace>& places);
  /// Runs record the laws of interfaces too; other runs are not theirs.
  void record_laws();
  CaseRuns(const CaseRuns&) = delete;
  CaseRuns& operator=(const CaseRuns&) = delete;

  /// Runs what is not there yet; with `until`, only up to the step that brings the curve's displacement there [m], from
  /// where a later call continues. Comes back in the order of the variants; the results do not depend on how many run
  /// at a time. Throws ComputationError if a run breaks off for another reason than that it does not converge.
  std::vector<DoneRun> run(const std::vector<CaseVariant>& variants, std::optional<double> until = std::nullopt);

  /// What run() would have to run, each once; nothing is run.
  std::vector<MissingRun> missing(const std::vector<CaseVariant>& variants);

  /// One run that is not there yet, in this process, whose log tells of it. Throws InputError if `key` is not the
  /// variant's.
  void run_here(const CaseVariant& variant, const std::string& key);

  int n_made() const { return static_cast<int>(made_.size()); }      ///< runs that were done, or continued, here
  int n_reused() const { return static_cast<int>(reused_.size()); }  ///< that were there before
  int n_failed() const { return static_cast<int>(failed_.size()); }  ///< of all, that did not converge or cannot be

 private:
  struct Wanted {
    std::string key;
    const CaseVariant* variant;
    std::optional<double> until;
    std::filesystem::path folder;
    std::string known_as() const;
  };
  std::string key_of(const CaseVariant& variant);
  std::vector<Wanted> wanted(const std::vector<CaseVariant>& variants, std::optional<double> until);
  std::vector<Wanted> not_there(const std::vector<Wanted>& all);
  bool find(const Wanted& wanted);
  void make(const std::vector<Wanted>& missing);
  int do_run(const Wanted& wanted, int threads, Log& log);
  void ended(const Wanted& wanted, const JobEnd& end);
  void remember(const Wanted& wanted, const DoneRun& done);

  std::filesystem::path folder_;
  MeshStore meshes_;
  Session session_;
  std::string recorded_;  // hash of the places
  std::map<std::string, DoneRun> known_;
  std::set<std::string> made_, reused_, failed_;  // keys
};

}  // namespace pfdm
