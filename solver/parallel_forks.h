#pragma once
// The threads of parallel.h in a process that makes others by fork(), as an interpreter may.

namespace pfdm {

/// A process that fork() makes has one thread, whatever the other one had. From this call on the workers end before
/// each fork, once the loop of whichever thread has them is done; in the parent they begin again. In the child
/// n_threads() is 1, and set_threads() starts workers of its own. Called more than once it does what one call does.
void keep_threads_out_of_forks();

}  // namespace pfdm
