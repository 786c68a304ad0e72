#include "render/app/study/members/child.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_of_a_line = 1 << 16;  // characters of a line that are kept

// Runs in the new process until the child's program replaces it. After fork() it may make system calls only.
// nothing: /dev/null. errors: the end of the pipe that becomes stderr.
[[noreturn]] void become(char* const* words, int nothing, int errors, pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // the parent has died already
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(nothing, STDOUT_FILENO);
    ::dup2(errors, STDERR_FILENO);
    // This starts the file that is running, whatever has become of its name.
    ::execv("/proc/self/exe", words);
    ::_exit(127);
}

}  // namespace

std::string own_program() {
    std::error_code failure;
    const auto path = std::filesystem::read_symlink("/proc/self/exe", failure);
    return failure ? "grainreel" : path.string();
}

Child::Child(const std::vector<std::string>& words) {
    std::vector<std::string> all{own_program()};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (std::string& word : all) pointers.push_back(word.data());
    pointers.push_back(nullptr);

    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw RunError("no pipe for a member: {}", std::strerror(errno));
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    const pid_t parent = ::getpid();
    process_ = nothing < 0 ? -1 : ::fork();
    if (process_ == 0) become(pointers.data(), nothing, ends[1], parent);
    const int why = errno;
    if (nothing >= 0) ::close(nothing);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (process_ < 0) {
        ::close(pipe_);
        throw RunError("no process for a member: {}", std::strerror(why));
    }
    ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
    if (pipe_ >= 0) ::close(pipe_);
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    reap();
}

Child::Child(Child&& other) noexcept {
    *this = std::move(other);
}

Child& Child::operator=(Child&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(pipe_, other.pipe_);
    std::swap(status_, other.status_);
    std::swap(rest_, other.rest_);
    return *this;
}

std::vector<std::string> Child::read() {
    std::vector<std::string> lines;
    char part[4096];
    ssize_t got = 0;
    while (pipe_ >= 0 && (got = ::read(pipe_, part, sizeof part)) > 0) {
        for (const char c : std::string_view(part, static_cast<std::size_t>(got))) {
            if (c == '\n')
                lines.push_back(std::exchange(rest_, ""));
            else if (rest_.size() < most_of_a_line)
                rest_ += c;
        }
    }
    if (pipe_ < 0 || (got < 0 && (errno == EAGAIN || errno == EINTR))) return lines;
    if (!rest_.empty()) lines.push_back(std::exchange(rest_, ""));
    ::close(std::exchange(pipe_, -1));
    reap();
    return lines;
}

void Child::reap() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    process_ = -1;
}

void Child::send(int signal) const {
    if (process_ > 0) ::kill(process_, signal);
}

}  // namespace grainreel
