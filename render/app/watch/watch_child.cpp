#include "render/app/watch/watch_child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

// In the new process, before the program is another one: nothing but system calls. It has a process group of
// its own, so that Ctrl-C comes to the run alone.
[[noreturn]] void become(char* const* words, int nothing, int socket, int alive, pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // it has died already
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(nothing, STDOUT_FILENO);
    ::fcntl(socket, F_SETFD, 0);
    ::fcntl(alive, F_SETFD, 0);
    ::execv("/proc/self/exe", words);
    ::_exit(127);
}

std::vector<std::string> words_of(const std::filesystem::path& run, const std::string& host, int socket,
                                  int alive, const ReporterOptions& report) {
    std::vector<std::string> words = {"grainreel",
                                      "watch",
                                      run.string(),
                                      "--watch-host",
                                      host,
                                      "--socket",
                                      std::to_string(socket),
                                      "--until",
                                      std::to_string(alive)};
    if (report.quiet) words.emplace_back("--quiet");
    if (report.form == ReporterOptions::Form::json) words.insert(words.end(), {"--progress", "json"});
    return words;
}

}  // namespace

WatchChild::WatchChild(const std::filesystem::path& run, const std::string& host, Listening listening,
                       const ReporterOptions& report) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        throw RunError(fmt::format("--watch: no pipe: {}", std::strerror(errno)));
    std::vector<std::string> words = words_of(run, host, listening.socket(), ends[0], report);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    const pid_t parent = ::getpid();
    process_ = nothing < 0 ? -1 : ::fork();
    if (process_ == 0) become(pointers.data(), nothing, listening.socket(), ends[0], parent);
    const int why = errno;
    if (nothing >= 0) ::close(nothing);
    ::close(ends[0]);
    alive_ = ends[1];
    if (process_ > 0) return;
    ::close(alive_);
    throw RunError(fmt::format("--watch: no process for the page: {}", std::strerror(why)));
}

WatchChild::~WatchChild() {
    ::close(alive_);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
}

}  // namespace grainreel
