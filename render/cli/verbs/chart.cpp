#include "render/cli/verbs/chart.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text_file.hpp"
#include "engine/chart/chart.hpp"
#include "render/cli/report/result.hpp"
#include "render/cli/report/share_watcher.hpp"

namespace grainreel {
namespace {

constexpr int signal_base = 128;

// Runs gnuplot on a file of commands in its folder. False when there is none, or it failed.
bool draw(const std::filesystem::path& folder, std::string commands) {
    posix_spawn_file_actions_t there;
    posix_spawn_file_actions_init(&there);
    posix_spawn_file_actions_addchdir_np(&there, folder.c_str());
    char name[] = "gnuplot";
    char* words[] = {name, commands.data(), nullptr};
    pid_t child = 0;
    const bool started = posix_spawnp(&child, name, &there, nullptr, words, environ) == 0;
    posix_spawn_file_actions_destroy(&there);
    int status = 1;
    return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

int make_chart(const Options& options, Reporter& reporter) {
    const auto chart = std::find_if(charts().begin(), charts().end(),
                                    [&](const Chart& c) { return c.name == options.chart; });
    GRAINREEL_CHECK(chart != charts().end());
    ChartRequest request;
    request.folder = options.out.value_or(options.base / (chart->name + (options.quick ? "-quick" : "")));
    request.quick = options.quick;
    if (std::error_code failure; !std::filesystem::create_directories(request.folder, failure) && failure)
        throw UserError(fmt::format("{}: cannot be made ({}); give another --out", request.folder.string(),
                                    failure.message()));
    const bool whole = chart->run(request, ShareWatcher(reporter, Progress::Stage::charting));
    reporter.clear();
    if (!whole) {
        reporter.info("stopped; the same command goes on");
        return signal_base + stop_signal();
    }
    const std::string commands = chart->name + ".gp";
    replace_file(request.folder / commands, chart->drawing());
    if (!draw(request.folder, commands))
        reporter.warning(
            fmt::format("gnuplot is missing or failed, so there are tables but no pictures; install "
                        "gnuplot-nox and run it on {} in the folder",
                        commands));
    print_result(request.folder.string() + "\n");
    return 0;
}

}  // namespace grainreel
