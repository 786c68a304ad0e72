// Ctrl-C and SIGTERM: the first asks the run to end in good order, the second ends the program at once.
#pragma once

namespace grainreel {

// SIGPIPE and SIGXFSZ are ignored from then on: a closed pipe or a full quota shows as a failed write.
void install_signal_handlers();

// SIGINT or SIGTERM, whichever came first; 0 while neither did.
int stop_signal();

}  // namespace grainreel
