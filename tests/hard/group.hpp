// The hard day in small: groups of cases in which something is wrong with the program's input. The program
// may refuse, or go on and be right. It may not crash, hang, use up memory, or report success when something
// is wrong.
#pragma once

#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace grainreel::hard {

// Random numbers that are the same for the same seed, group and case, on every machine.
class Dice {
  public:
    Dice(std::uint64_t seed, const std::string& group, int number);
    std::uint64_t word() { return engine_(); }
    std::size_t below(std::size_t count) { return engine_() % count; }
    bool one_in(std::size_t count) { return below(count) == 0; }
    template <class T>
    const T& of(const std::vector<T>& values) {
        return values[below(values.size())];
    }

  private:
    std::mt19937_64 engine_;
};

// How a case ended.
struct Outcome {
    std::string kind;     // for the summary: "refused", "drawn alike"
    std::string problem;  // what is wrong; empty: nothing
};

struct Group {
    std::string name;
    int cases;
    // Runs a case in an empty folder of its own, which is kept if there is a problem.
    std::function<Outcome(int number, Dice& dice, const std::filesystem::path& here)> run;
    int when_all_run = 0;  // number of cases when all groups run; 0: all of them
    int in_a_turn = 0;     // number of cases in a turn of --turn; 0: as when all groups run
};

// A finished run of fifty grains and pictures of it, with which the cases begin.
struct Ground {
    std::filesystem::path run;       // the run's folder
    std::filesystem::path pictures;  // the folder of its pictures
    std::filesystem::path
        full;  // a folder over which a small file system may be laid; empty: not allowed here
};
// Makes the ground. Throws std::runtime_error when the program cannot do even that.
Ground lay_ground(const std::filesystem::path& folder);

// The end of the program within 10 s of processor time and 6 GB. `problem`: something that no run may do,
// whatever its input.
struct Ran {
    int status = 0;
    std::string out, err, problem;
};
Ran attempt(const std::vector<std::string>& words, const std::filesystem::path& folder,
            std::size_t file_size_limit = 0);
// Waits for the end of a program that was started with these limits; see attempt().
Ran end_of(test::Program& program, int signal_sent = 0);
test::Program::Setting limits(const std::filesystem::path& folder);

// A command for messages; long words are cut.
std::string command_text(const std::vector<std::string>& words);

// The error among a run's messages, or the beginning of the messages.
std::string first_line(const std::string& text);

Group damaged_trajectories(const Ground& ground);
Group mutated_scenes(const Ground& ground);
Group changed_continuations(const Ground& ground);
Group killed_runs(const Ground& ground);
Group resumed_runs(const Ground& ground);
Group full_disks(const Ground& ground);
Group random_scenes();

}  // namespace grainreel::hard
