#include "engine/files/foreign/amber/trial_in_child.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace grainreel {

namespace {

// The child's way: no handlers of ours, no core file, an end in time.
[[noreturn]] void work_alone(const std::function<void()>& work, unsigned seconds) {
    constexpr std::array<int, 6> signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};
    for (const int signal : signals) ::signal(signal, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::alarm(seconds);
    try {
        work();
    } catch (...) {  // the parent hears of it when it does the same
    }
    ::_exit(0);
}

}  // namespace

bool survives(const std::function<void()>& work, unsigned seconds) {
    const pid_t child = ::fork();
    if (child < 0) return true;
    if (child == 0) work_alone(work, seconds);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return true;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace grainreel
