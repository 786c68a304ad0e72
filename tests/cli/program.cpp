// Starts the program with words and limits, sends it signals, and reads its outputs.
#include "tests/cli/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace grainreel::test {

namespace {

int exit_status(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void limit(int resource, rlim_t most) {
    const rlimit both{most, most};
    if (most > 0) ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// Runs in the child, between fork and exec.
void become_program(const std::vector<std::string>& words, const Program::Setting& setting, const char* out,
                    const char* err) {
    ::dup2(::open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    if (int ends[2]; setting.out_closed && ::pipe(ends) == 0) {
        ::close(ends[0]);
        ::dup2(ends[1], STDOUT_FILENO);
        ::close(ends[1]);
    }
    ::dup2(::open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    if (::chdir(setting.folder.c_str()) != 0) ::_exit(127);
    // The cache is not the tester's own one; all tests together measure the machine once.
    const std::filesystem::path cache = std::filesystem::temp_directory_path() / "grainreel-test-cache";
    ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    ::setenv("GRAINREEL_PACKINGS", "off", 1);
    for (const std::string& variable : setting.environment) ::putenv(const_cast<char*>(variable.c_str()));
    ::signal(SIGHUP, setting.hang_up_ignored ? SIG_IGN : SIG_DFL);
    limit(RLIMIT_FSIZE, setting.file_size_limit);
    limit(RLIMIT_AS, setting.memory_limit);
    limit(RLIMIT_CPU, static_cast<rlim_t>(setting.seconds_limit));
    std::vector<char*> arguments{const_cast<char*>(GRAINREEL_BINARY)};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ::execv(GRAINREEL_BINARY, arguments.data());
    ::_exit(127);
}

}  // namespace

Program::Program(const std::vector<std::string>& words, const Setting& setting) {
    const char* out = setting.out.empty() ? out_.c_str() : setting.out.c_str();
    process_ = ::fork();
    if (process_ == 0) become_program(words, setting, out, err_.c_str());
}

Program::~Program() {
    if (running()) {
        send(SIGKILL);
        wait();
    }
}

void Program::send(int signal) const {
    if (process_ > 0) ::kill(process_, signal);  // -1, after the end, would mean every process there is
}

bool Program::running() {
    if (process_ < 0) return false;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) collect(status);
    return process_ >= 0;
}

Ended Program::wait() {
    int status = 0;
    if (process_ >= 0 && ::waitpid(process_, &status, 0) == process_) collect(status);
    return {status_, text_of(out_), text_of(err_)};
}

void Program::collect(int status) {
    process_ = -1;
    status_ = exit_status(status);
}

Ended run_program(const std::vector<std::string>& words, const Program::Setting& setting) {
    return Program(words, setting).wait();
}

bool wait_until(Program& program, const std::function<bool()>& condition) {
    while (!condition()) {
        if (!program.running()) return condition();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

}  // namespace grainreel::test
