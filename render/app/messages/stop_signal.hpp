// Handles Ctrl-C, SIGTERM and SIGHUP (the terminal is gone). The first one asks the run to end in good order.
// A second Ctrl-C or SIGTERM ends the program at once, unless a run has a state to keep: then the run writes
// that state first and leaves the film as it is. A third one ends it at once in any case.
#pragma once

#include <csignal>
#include <string>

namespace grainreel {

// The exit status of a verb that a signal stopped is this and the signal's number, as shells have it.
inline constexpr int signal_base = 128;

// Ignores SIGPIPE and SIGXFSZ from then on, so that a closed pipe or a full quota appears as a failed write.
void ignore_write_signals();

// Installs the handlers for verbs that look at stop_signal(); any other verb is ended by the first signal. A
// SIGHUP that is ignored already, as under nohup, stays ignored. last_words: text for stderr when the program
// is ended at once.
void install_stop_handlers(const std::string& last_words);

// The signal that came first: SIGINT, SIGTERM or SIGHUP; 0 when none has come.
int stop_signal();

// While an object of this class exists, Ctrl-C, SIGTERM and SIGHUP wait, also in threads that are made
// meanwhile. They take effect when it is destroyed. It is meant for short work that would leave files behind
// if it were killed.
class HeldSignals {
  public:
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;
    bool waiting() const;  // whether a signal has come

  private:
    sigset_t before_{};
};

// Says that from now on there is something to keep, which a second signal must not destroy.
void keep_before_exit();

// Whether a second Ctrl-C or SIGTERM has come while there was something to keep.
bool in_a_hurry();

}  // namespace grainreel
