// Cases of runs that are killed at random moments and resumed: they end like a run that was left alone.
#include <signal.h>

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

using Words = std::vector<std::string>;

Words movie(const fs::path& here, const std::string& out) {
    test::write_small_scene(here);
    return {"movie",      "fifty.toml",
            "--duration", "3 s",
            "--set",      "start.settle_limit=0.02 s",
            "--set",      "output.contacts=true",
            "--set",      "output.fields.grid=yz",
            "--set",      "film.segment=[{playback=5}]",
            "--frames",   "--out",
            out};
}

// A run with everything that a checkpoint holds, long enough for several checkpoints.
Words busy_movie(const fs::path& here, const std::string& out) {
    test::write_text(here / "busy.toml", test::busy_scene_text);
    return {"movie",    "busy.toml", "--duration", "1 s", "--set", "output.trajectory_interval=20 ms",
            "--frames", "--out",     out};
}

std::size_t checkpoints_in(const fs::path& run) {
    std::error_code none;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(run / "checkpoints", none))
        count += entry.path().extension() == ".grs";
    return count;
}

// Kills a program that still runs after that time. Returns whether it did.
bool kill_later(test::Program& program, std::chrono::milliseconds later) {
    const auto end = std::chrono::steady_clock::now() + later;
    while (program.running() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const bool killed = program.running();
    if (killed) program.send(SIGKILL);
    program.wait();
    return killed;
}

// Kills the program a given time after its run has so many checkpoints.
bool kill_at(std::size_t checkpoints, const Words& words, const fs::path& here,
             std::chrono::milliseconds later) {
    test::Program program(words, limits(here));
    test::wait_until(program, [&] { return checkpoints_in(here / "run") >= checkpoints; });
    return kill_later(program, later);
}

bool kill_after(const Words& words, const fs::path& here, std::chrono::milliseconds later) {
    test::Program program(words, limits(here));
    return kill_later(program, later);
}

std::string engine_hash(const fs::path& run) {
    const auto record = nlohmann::json::parse(test::text_of(run / "run.json"), nullptr, false);
    return record.is_object() ? record["engine"]["state_hash"].dump() : "no run.json";
}

// The first difference between the two runs; empty if there is none.
std::string difference(const fs::path& whole, const fs::path& run) {
    if (engine_hash(whole) != engine_hash(run)) return "another end state";
    for (const char* file : {"trajectory.nc", "measures.csv", "contacts.nc", "fields.nc", "film_moments.nc",
                             "key_moments.nc", "key_contacts.nc", "outflow.csv", "final.csv", "scene.toml"})
        if (test::text_of(whole / file) != test::text_of(run / file)) return fmt::format("{} differs", file);
    for (const auto& entry : fs::directory_iterator(whole / "frames"))
        if (test::text_of(entry.path()) != test::text_of(run / "frames" / entry.path().filename()))
            return fmt::format("picture {} differs", entry.path().filename().string());
    const int pictures = test::decoded_pictures(run / "movie.mp4");
    if (pictures != test::decoded_pictures(whole / "movie.mp4"))
        return fmt::format("the film has {} pictures", pictures);
    return "";
}

// Kills a run, which takes about as long as `took`, at a random time.
Outcome killed_at_any_time(int number, Dice& dice, const fs::path& here, std::chrono::milliseconds took) {
    // The time is as long as the run takes on this machine, so that most kills come during the run.
    const auto some_time = [&] {
        return std::chrono::milliseconds(dice.below(static_cast<std::uint64_t>(took.count()) + 1));
    };
    int kills = kill_after(movie(here, "run"), here, some_time());
    if (kills == 0) return {"ended before it was killed", difference(here / "whole", here / "run")};
    if (!fs::exists(here / "run/checkpoint.grs")) {
        const Ran refused = attempt({"resume", "run"}, here);
        const bool said = refused.status == 2 && (!fs::exists(here / "run/scene.toml") ||
                                                  refused.err.find("has no checkpoint") != std::string::npos);
        return {"killed while packing", said ? "" : "resume says: " + first_line(refused.err)};
    }
    for (int more = number % 3; more > 0; --more) kills += kill_after({"resume", "run"}, here, some_time());
    const Ran resumed = attempt({"resume", "run"}, here);
    const bool over = resumed.err.find("has come to 3 s already") != std::string::npos;
    if (resumed.status != 0 && !over)
        return {"", fmt::format("after {} kills: {}", kills, first_line(resumed.err))};
    return {fmt::format("resumed after {} kill{}", kills, kills == 1 ? "" : "s"),
            difference(here / "whole", here / "run")};
}

// Kills a run when it has several checkpoints, and a second time when it has some more.
Outcome killed_late(Dice& dice, const fs::path& here) {
    std::size_t checkpoints = 2 + dice.below(5);
    const auto some_time = [&] { return std::chrono::milliseconds(dice.below(30)); };
    int kills = kill_at(checkpoints, busy_movie(here, "run"), here, some_time());
    if (kills == 0) return {"ended before it was killed", difference(here / "whole", here / "run")};
    if (dice.one_in(2)) {
        checkpoints = checkpoints_in(here / "run") + 1 + dice.below(3);
        kills += kill_at(checkpoints, {"resume", "run"}, here, some_time());
    }
    const Ran resumed = attempt({"resume", "run"}, here);
    const bool over = resumed.err.find("has come to 1 s already") != std::string::npos;
    if (resumed.status != 0 && !over)
        return {"", fmt::format("after {} kills: {}", kills, first_line(resumed.err))};
    if (resumed.err.find("goes on from 0 s") != std::string::npos)
        return {"", fmt::format("goes on from 0 s, though it had {} checkpoints", checkpoints)};
    return {"resumed from a later checkpoint", difference(here / "whole", here / "run")};
}

}  // namespace

Group resumed_runs(const Ground&) {
    return {"resumed", 50,
            [](int number, Dice& dice, const fs::path& here) -> Outcome {
                const bool late = number % 2 == 1;
                const auto start = std::chrono::steady_clock::now();
                const Ran whole = attempt(late ? busy_movie(here, "whole") : movie(here, "whole"), here);
                const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(
                    std::chrono::steady_clock::now() - start);
                if (whole.status != 0) return {"", "cannot be run: " + first_line(whole.err)};
                return late ? killed_late(dice, here) : killed_at_any_time(number, dice, here, took);
            },
            36};
}

}  // namespace grainreel::hard
