#include "render/app/messages/stop_signal.hpp"

#include <unistd.h>
#include <atomic>
#include <csignal>

namespace grainreel {

namespace {

std::atomic<int> first_signal = 0;
std::atomic<bool> something_to_keep = false, second_signal = false;
std::string words_at_once;  // set before any handler is installed
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free);  // a handler may use nothing but lock-free atomics

extern "C" void on_stop(int signal) {
    int none = 0;
    const bool first = first_signal.compare_exchange_strong(none, signal);
    // A closed terminal causes several SIGHUP, from the kernel and from the shell, so further ones do not
    // count as a second signal.
    if (first || signal == SIGHUP) return;
    const bool second = !second_signal.exchange(true);
    if (second && something_to_keep) return;
    [[maybe_unused]] const ssize_t ignored =
        ::write(STDERR_FILENO, words_at_once.data(), words_at_once.size());
    ::_exit(signal_base + signal);
}

// Whether the signal was already ignored when the program started, as under nohup. It then stays ignored.
bool ignored(int signal) {
    struct sigaction present {};
    return sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_IGN;
}

sigset_t stop_signals() {
    sigset_t all;
    sigemptyset(&all);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&all, signal);
    return all;
}

}  // namespace

void ignore_write_signals() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void install_stop_handlers(const std::string& last_words) {
    words_at_once = last_words;
    struct sigaction action {};
    action.sa_handler = on_stop;
    action.sa_flags =
        SA_RESTART;  // files are being written, and no system call of theirs should fail because of a signal
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    if (!ignored(SIGHUP)) sigaction(SIGHUP, &action, nullptr);
}

int stop_signal() {
    return first_signal;
}

HeldSignals::HeldSignals() {
    const sigset_t held = stop_signals();
    pthread_sigmask(SIG_BLOCK, &held, &before_);
}

HeldSignals::~HeldSignals() {
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool HeldSignals::waiting() const {
    sigset_t come;
    sigpending(&come);
    return sigismember(&come, SIGINT) == 1 || sigismember(&come, SIGTERM) == 1 ||
           sigismember(&come, SIGHUP) == 1;
}

void keep_before_exit() {
    something_to_keep = true;
}

bool in_a_hurry() {
    return second_signal;
}

}  // namespace grainreel
