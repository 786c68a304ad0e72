// The program: finds the verb, runs it, and turns mistakes and failures into exit codes.
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/own_files.hpp"
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

}  // namespace
}  // namespace grainreel

int main(int argc, char** argv) {
    grainreel::open_missing_streams();
    grainreel::ignore_write_signals();
    grainreel::use_own_files();
    return grainreel::parse_and_run(argc, argv);
}
