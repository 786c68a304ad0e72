// Ctrl-C, SIGTERM and SIGHUP (the terminal is gone): the first asks the run to end in good order. A second
// Ctrl-C or SIGTERM ends the program at once, but for a run whose state is yet to be kept: that is kept
// first, and the film left as it is. A third ends it at once in any case.
#pragma once

namespace grainreel {

// SIGPIPE and SIGXFSZ are ignored from then on: a closed pipe or a full quota shows as a failed write.
void ignore_write_signals();

// For verbs that look at stop_signal(); any other is ended by the first signal. A SIGHUP that is ignored
// already, as under nohup, stays ignored.
void install_stop_handlers();

// SIGINT, SIGTERM or SIGHUP, whichever came first; 0 while none did.
int stop_signal();

// From here, until told otherwise, there is a state that a second signal may not cost.
void keep_state_before_exit(bool keep);

// A second Ctrl-C or SIGTERM has come while there was.
bool in_a_hurry();

}  // namespace grainreel
