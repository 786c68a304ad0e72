// Cases of runs that are killed, or whose disk is full.
#include <signal.h>
#include <sys/mount.h>

#include <chrono>
#include <thread>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "tests/cli/film_length.hpp"
#include "tests/hard/group.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {

namespace fs = std::filesystem;

namespace {

// The command for an hour of shaking.
std::vector<std::string> long_run(const fs::path& here, const std::string& out) {
    test::write_small_scene(here);
    return {"movie", "fifty.toml", "--duration", "3600 s", "--out", out};
}

std::uintmax_t size_of(const fs::path& file) {
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(file, failed);
    return failed ? 0 : size;
}

std::string status_in(const fs::path& run) {
    const std::string text = test::text_of(run / "run.json");
    if (text.empty()) return "";
    const nlohmann::json record = nlohmann::json::parse(text, nullptr, false);
    return record.is_object() && record.contains("status") ? record["status"].get<std::string>() : "no JSON";
}

// What is wrong with the folder of a run that cannot have reached its end, and may not even exist; empty if
// nothing is. here: a folder in which pictures can be drawn.
std::string what_is_wrong_with(const fs::path& run, const fs::path& here) {
    constexpr std::uintmax_t kBegun = 50'000;  // bytes of film that surely hold a picture
    const std::string status = status_in(run);
    if (status == "no JSON" || status == "complete") return "run.json is wrong: " + status;
    if (size_of(run / "movie.mp4") > kBegun && test::decoded_pictures(run / "movie.mp4") < 1)
        return "movie.mp4 cannot be read";
    if (!fs::exists(run / "scene.toml")) return "";
    if (fs::exists(run / "trajectory.nc")) {
        const Ran drawn = attempt({"render", run.string(), "--at", "0", "--out", "drawn.png"}, here);
        if (!drawn.problem.empty()) return drawn.problem;
        const auto says = [&](const char* words) { return drawn.err.find(words) != std::string::npos; };
        if (drawn.status != 0 && !says("holds no frame yet") && !says("it was cut off"))
            return "cannot be drawn: " + first_line(drawn.err);
    }
    for (const char* file : {"checkpoint.grs", "final.csv"}) {
        if (!fs::exists(run / file)) continue;
        const Ran check = attempt({"check", (run / "scene.toml").string(), "--set", "start.method=file",
                                   "--set", std::string("start.file=") + file},
                                  here);
        if (!check.problem.empty()) return check.problem;
        // Nobody knows where the walls of a table were.
        const bool walls_moved = check.err.find("and the checkpoint of a run") != std::string::npos;
        if (check.status != 0 && !walls_moved)
            return fmt::format("{} is half a file: {}", file, first_line(check.err));
    }
    return "";
}

}  // namespace

Group killed_runs(const Ground&) {
    return {"kills", 12, [=](int number, Dice& dice, const fs::path& here) -> Outcome {
                const int signal = number < 10 ? SIGKILL : number == 10 ? SIGTERM : SIGINT;
                test::Program program(long_run(here, "run"), limits(here));
                const std::size_t frames = dice.below(60);
                if (dice.one_in(2) || signal != SIGKILL)
                    wait_until(program,
                               [&] { return size_of(here / "run/trajectory.nc") > 4000 + 3000 * frames; });
                else
                    wait_until(program, [&] { return fs::exists(here / "run/scene.toml"); });
                std::this_thread::sleep_for(std::chrono::milliseconds(dice.below(300)));
                program.send(signal);
                const Ran ran = end_of(program, signal);
                if (!ran.problem.empty()) return {"", ran.problem};
                if (ran.status != 128 + signal) return {"", "ended before: " + first_line(ran.err)};
                if (signal != SIGKILL && status_in(here / "run") != "interrupted")
                    return {"", "run.json says " + status_in(here / "run")};
                return {signal == SIGKILL ? "killed" : "interrupted", what_is_wrong_with(here / "run", here)};
            }};
}

// The run has a file system of its own if the machine allows it; otherwise no file may grow beyond a limit.
Group full_disks(const Ground& ground) {
    return {
        "full disks", 10, [=](int number, Dice& dice, const fs::path& here) -> Outcome {
            const std::size_t room = (number + 1) * 20'000 + dice.below(20'000);
            const bool mounted = !ground.full.empty() && number % 2 == 0;
            const fs::path disk = mounted ? ground.full / std::to_string(number) : here;
            if (mounted) {
                fs::create_directories(disk);
                if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, fmt::format("size={}", room * 2).c_str()) != 0)
                    return {"", "no tmpfs"};
            }
            const std::string run = (disk / "run").string();
            const Ran ran = attempt(long_run(here, run), here, mounted ? 0 : room);
            std::string problem = ran.problem;
            if (problem.empty() && ran.status == 0) problem = "false success: an hour on a full disk";
            if (problem.empty()) problem = what_is_wrong_with(run, here);
            if (problem.empty() && status_in(run) == "running") problem = "run.json says that it still runs";
            if (mounted) {
                if (!problem.empty()) {
                    std::error_code ignored;
                    fs::copy(disk, here / "disk", fs::copy_options::recursive, ignored);
                }
                ::umount(disk.c_str());
            }
            return {ran.status == 2 ? "refused" : "failed in good order", problem};
        }};
}

}  // namespace grainreel::hard
