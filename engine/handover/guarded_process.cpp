#include "engine/handover/guarded_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/error.hpp"

extern char** environ;

namespace grainreel {

namespace {

constexpr int kNap = 20;     // ms, between two checks
constexpr int kGrace = 100;  // naps between SIGTERM and SIGKILL
constexpr int kNoProgram = 127;

// All that the new processes need. It is made before the fork. After the fork of a process with threads, only
// system calls are allowed until exec, and the guard never calls exec. So nothing below, up to _exit, may
// allocate memory or take a lock.
struct Launch {
    char* const* words;
    const char* folder;
    int nothing, output, alive, result;
};

[[noreturn]] void become_program(const Launch& launch, pid_t guard) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != guard) ::_exit(1);  // the guard has died already
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::dup2(launch.nothing, STDIN_FILENO);
    ::dup2(launch.output, STDOUT_FILENO);
    ::dup2(launch.output, STDERR_FILENO);
    if (::chdir(launch.folder) != 0) ::_exit(kNoProgram);
    ::execve(launch.words[0], launch.words, environ);
    ::_exit(kNoProgram);
}

// Closes all other open files, so that the guard does not keep our locks and sockets.
void close_all_but(int one, int other) {
    const int low = one < other ? one : other, high = one < other ? other : one;
    const auto close_between = [](int from, int to) {
        if (from > to) return;
#ifdef SYS_close_range
        if (::syscall(SYS_close_range, from, to, 0) == 0) return;
#endif
        for (int file = from; file <= to && file < 4096; ++file) ::close(file);
    };
    close_between(0, low - 1);
    close_between(low + 1, high - 1);
    close_between(high + 1, 65535);
}

// Sends SIGKILL to each child of the guard. Their children then become the guard's, and the next call kills
// them.
void kill_children() {
    const int file = ::open("/proc/thread-self/children", O_RDONLY);
    if (file < 0) return;
    std::array<char, 4096> text{};
    pid_t child = 0;
    for (ssize_t got = 0; (got = ::read(file, text.data(), text.size())) > 0;) {
        for (ssize_t k = 0; k < got; ++k) {
            const char c = text[k];
            if (c >= '0' && c <= '9') {
                child = 10 * child + (c - '0');
            } else if (child > 0) {
                ::kill(std::exchange(child, 0), SIGKILL);
            }
        }
    }
    ::close(file);
}

// Kills and reaps children until there are none, for at most some five seconds.
void end_children(pid_t program) {
    for (int k = 0; k < 50 * kGrace; ++k) {
        kill_children();
        ::kill(program, SIGKILL);  // in case /proc does not list it
        pid_t one = 0;
        while ((one = ::waitpid(-1, nullptr, WNOHANG)) > 0) continue;
        if (one < 0 && errno == ECHILD) return;
        ::poll(nullptr, 0, 1);
    }
}

// Waits for a moment (kNap). Tells whether the pipe was closed: by stop(), or because the process that
// started the guard has ended.
bool is_to_stop(int alive) {
    pollfd look{alive, POLLIN, 0};
    return ::poll(&look, 1, kNap) > 0 && look.revents != 0;
}

[[noreturn]] void stand_guard(const Launch& launch) {
    ::setsid();
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    sigset_t all;
    ::sigfillset(&all);
    ::sigprocmask(SIG_SETMASK, &all, nullptr);
    const pid_t guard = ::getpid(), program = ::fork();
    if (program == 0) become_program(launch, guard);
    close_all_but(launch.alive, launch.result);
    int status = program < 0 ? kNoProgram << 8 : 0;
    bool ended = program < 0, told = false;
    for (int naps = 0; !ended && naps < kGrace;) {
        if (told) {
            ++naps;
            ::poll(nullptr, 0, kNap);
        } else if (is_to_stop(launch.alive)) {
            told = true;
            ::kill(program, SIGTERM);
        }
        for (pid_t one = 0; (one = ::waitpid(-1, &status, WNOHANG)) > 0;) {
            if (one == program) {
                ended = true;
                break;
            }
        }
    }
    if (!ended) status = SIGKILL;
    if (program > 0) end_children(program);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    [[maybe_unused]] const ssize_t written = ::write(launch.result, &code, sizeof code);
    ::_exit(0);
}

}  // namespace

GuardedProcess::GuardedProcess(const std::vector<std::string>& words, const std::filesystem::path& folder,
                               const std::filesystem::path& output) {
    std::vector<std::string> kept = words;
    std::vector<char*> pointers;
    for (std::string& word : kept) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const std::string place = folder.string();
    int alive[2] = {-1, -1}, result[2] = {-1, -1};
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    constexpr int kPlain = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;  // neither a link nor a pipe without a reader
    const int into = ::open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND | kPlain, 0644);
    const bool ready =
        nothing >= 0 && into >= 0 && ::pipe2(alive, O_CLOEXEC) == 0 && ::pipe2(result, O_CLOEXEC) == 0;
    if (ready) {
        const Launch launch{pointers.data(), place.c_str(), nothing, into, alive[0], result[1]};
        guard_ = ::fork();
        if (guard_ == 0) stand_guard(launch);
    }
    const int why = errno;
    for (const int file : {nothing, into, alive[0], result[1]})
        if (file >= 0) ::close(file);
    alive_ = alive[1];
    result_ = result[0];
    if (guard_ > 0) {
        ::fcntl(result_, F_SETFL, O_NONBLOCK);
        return;
    }
    for (const int file : {alive_, result_})
        if (file >= 0) ::close(file);
    throw RunError("{}: cannot be started, with its output in {}: {}", words.front(), output.string(),
                   std::strerror(why));
}

GuardedProcess::~GuardedProcess() {
    stop();
    reap();
    ::close(result_);
}

std::optional<int> GuardedProcess::status() {
    if (status_) return status_;
    int code = 0;
    const ssize_t got = ::read(result_, &code, sizeof code);
    if (got == static_cast<ssize_t>(sizeof code)) return status_ = code;
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
    throw RunError("the process that watches over the engine was killed");
}

void GuardedProcess::stop() {
    if (alive_ >= 0) ::close(std::exchange(alive_, -1));
}

void GuardedProcess::reap() {
    int status = 0;
    while (::waitpid(guard_, &status, 0) < 0 && errno == EINTR) continue;
}

}  // namespace grainreel
