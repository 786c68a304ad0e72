// Ctrl-C, SIGTERM and SIGHUP (the terminal is gone): the first asks the run to end in good order. A second
// Ctrl-C or SIGTERM ends the program at once, but for a run that has something to keep: its state is kept
// first, and the film left as it is. A third ends it at once in any case.
#pragma once

#include <csignal>
#include <string>

namespace grainreel {

// SIGPIPE and SIGXFSZ are ignored from then on: a closed pipe or a full quota shows as a failed write.
void ignore_write_signals();

// For verbs that look at stop_signal(); any other is ended by the first signal. A SIGHUP that is ignored
// already, as under nohup, stays ignored. last_words: for stderr when the program is ended at once.
void install_stop_handlers(const std::string& last_words);

// SIGINT, SIGTERM or SIGHUP, whichever came first; 0 while none did.
int stop_signal();

// While one is there, Ctrl-C, SIGTERM and SIGHUP wait, in threads made meanwhile too; they come when it goes.
// For work that ends soon and leaves nothing behind only when it ends by itself.
class HeldSignals {
  public:
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;
    bool waiting() const;  // one has come

  private:
    sigset_t before_{};
};

// From here there is something that a second signal may not cost.
void keep_before_exit();

// A second Ctrl-C or SIGTERM has come while there was.
bool in_a_hurry();

}  // namespace grainreel
