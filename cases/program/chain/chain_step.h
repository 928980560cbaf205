#pragma once
// A step of a chain whose case can be read, and what is known of its figures before it is done.

#include "cases/program/chain/chain_case.h"
#include "cases/program/session/runnable_case.h"

#include <filesystem>
#include <functional>
#include <string>

namespace pfdm {

/// A step whose case can be read: all that it takes from others is there.
struct ReadyStep {
  const ChainStep& step;  ///< has to outlive it
  CaseFile file;
  RunnableCase runnable;
  std::filesystem::path results;
  std::string key;

  std::filesystem::path outcome() const { return results / step.job->outcome; }
  const std::function<void(Session&)>& job() const { return runnable.*(step.job->job); }
};

/// Where the results of a step are, also of one whose case cannot be read yet.
std::filesystem::path results_of(const ChainStep& step);

/// Throws InputError, also where a number that the step takes is not there.
ReadyStep get_ready(const ChainStep& step, const Session& session);

/// Throws InputError for a figure that no run or fit of the step's kind has, as far as that is known before; a case
/// that an earlier step is to write is taken as it comes.
void require_known_figures(const ChainStep& step, const Session& session);

/// Of results that are there already: another run may give other numbers.
void warn_of_absent_figures(const ReadyStep& ready, Log& log);

}  // namespace pfdm
