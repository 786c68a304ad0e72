// Ctrl-C, SIGTERM and SIGHUP (the terminal is gone): the first asks the run to end in good order, a second
// Ctrl-C or SIGTERM ends the program at once.
#pragma once

namespace grainreel {

// A SIGHUP that is ignored already, as under nohup, stays ignored. SIGPIPE and SIGXFSZ are ignored from then
// on: a closed pipe or a full quota shows as a failed write.
void install_signal_handlers();

// SIGINT, SIGTERM or SIGHUP, whichever came first; 0 while none did.
int stop_signal();

}  // namespace grainreel
