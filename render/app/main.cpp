// The program: finds the verb, runs it, and turns mistakes and failures into exit codes.
#include <sys/resource.h>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/system/own_files.hpp"
#include "engine/base/text.hpp"
#include "render/app/command_line.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/stop_signal.hpp"

namespace grainreel {
namespace {

constexpr int run_failed = 1, user_mistake = 2;

// Does the work and returns its exit status. If a mistake or failure ends it, calls tell() with the message
// and returns the status for that.
int status_of(const std::function<int()>& work, const std::function<void(const std::string&)>& tell) {
    try {
        return work();
    } catch (const UserError& mistake) {
        tell(mistake.what());
        return user_mistake;
    } catch (const std::exception& failure) {
        tell(words_of(failure));
        return run_failed;
    }
}

int run(Verb& verb) {
    Reporter reporter(verb.report);
    if (verb.ends_in_good_order()) install_stop_handlers(reporter.last_words());
    const auto work = [&] {
        const int status = verb.run(reporter);
        close_results();
        return status;
    };
    return status_of(work, [&](const std::string& text) { reporter.error(text); });
}

int parse_and_run(int argc, char** argv) {
    const auto work = [&] {
        if (const std::unique_ptr<Verb> verb = parse_command_line(argc, argv)) return run(*verb);
        close_results();
        return 0;
    };
    return status_of(work, [](const std::string& text) {
        std::fprintf(stderr, "error: %s\n", message_text(text).c_str());
    });
}

// Whether the stack is large enough for the program and its threads, which get stacks of the same size. With
// a smaller one the program would end at some deep call without a word, so this tells what to do.
bool has_stack() {
    constexpr rlim_t least = rlim_t{256} << 10;  // bytes
    rlimit stack{};
    if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= least) return true;
    const auto kilobytes = static_cast<unsigned long long>(stack.rlim_cur >> 10);
    std::fprintf(
        stderr,
        "error: the stack is limited to %llu kB, and the program needs %llu; raise the limit by: ulimit "
        "-s 8192\n",
        kilobytes, static_cast<unsigned long long>(least >> 10));
    return false;
}

}  // namespace
}  // namespace grainreel

int main(int argc, char** argv) {
    grainreel::open_missing_streams();
    if (!grainreel::has_stack()) return grainreel::user_mistake;
    grainreel::ignore_write_signals();
    grainreel::use_own_files();
    return grainreel::parse_and_run(argc, argv);
}
