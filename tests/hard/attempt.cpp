// Runs the program once within limits, and checks what no run may do.
#include <signal.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

#include "tests/hard/group.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::hard {

namespace fs = std::filesystem;
using test::Program;

namespace {

constexpr int kSeconds = 10;                    // s of processor time
constexpr std::size_t kMemory = 6'000'000'000;  // bytes
constexpr auto kAsleep =
    std::chrono::minutes(3);  // of real time, for a run that does nothing; leaves room for a busy machine
constexpr std::size_t kLongestMessage = 3000;  // bytes

std::string what_is_wrong(int status, int signal_sent, const std::string& err) {
    if (status == 128 + SIGXCPU || status == 128 + SIGKILL)
        return signal_sent == SIGKILL ? "" : fmt::format("hangs: more than {} s of processor time", kSeconds);
    if (signal_sent != 0 && status == 128 + signal_sent) return "";
    if (status > 2) return fmt::format("crashes: exit status {}", status);
    if (err.find("bad_alloc") != std::string::npos) return "asks for more memory than there is";
    if (status != 0 && err.find("error: ") == std::string::npos) return "fails without a message";
    if (err.size() > kLongestMessage) return fmt::format("says {} bytes", err.size());
    return "";
}

}  // namespace

Dice::Dice(std::uint64_t seed, const std::string& group, int number) {
    std::seed_seq mix{static_cast<std::uint64_t>(number), seed, static_cast<std::uint64_t>(group.size()),
                      static_cast<std::uint64_t>(group[0])};
    engine_.seed(mix);
}

Program::Setting limits(const fs::path& folder) {
    Program::Setting setting;
    setting.folder = folder;
    setting.memory_limit = kMemory;
    setting.seconds_limit = kSeconds;
    return setting;
}

Ran end_of(Program& program, int signal_sent) {
    const auto latest = std::chrono::steady_clock::now() + kAsleep;
    while (program.running() && std::chrono::steady_clock::now() < latest)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const bool asleep = program.running();
    if (asleep) program.send(SIGKILL);
    const test::Ended ended = program.wait();
    Ran ran{ended.status, ended.out, ended.err, what_is_wrong(ended.status, signal_sent, ended.err)};
    if (asleep) ran.problem = "hangs: does not end";
    if (!ran.problem.empty()) ran.problem += "; it said: " + first_line(ended.err);
    return ran;
}

Ran attempt(const std::vector<std::string>& words, const fs::path& folder, std::size_t file_size_limit) {
    Program::Setting setting = limits(folder);
    setting.file_size_limit = file_size_limit;
    Program program(words, setting);
    Ran ran = end_of(program);
    if (!ran.problem.empty()) ran.problem = command_text(words) + " " + ran.problem;
    return ran;
}

std::string command_text(const std::vector<std::string>& words) {
    constexpr std::size_t kMost = 100;
    std::string text = "`grainreel";
    for (const std::string& word : words)
        text +=
            " " +
            (word.size() > kMost ? fmt::format("{}...({} bytes)", word.substr(0, kMost), word.size()) : word);
    return text + "`";
}

std::string first_line(const std::string& text) {
    constexpr std::size_t kMost = 300;
    const std::size_t error = text.find("error: "), begin = error == text.npos ? 0 : error;
    return text.substr(begin, std::min(text.find('\n', begin) - begin, kMost));
}

Ground lay_ground(const fs::path& folder) {
    test::write_small_scene(folder);
    const auto must = [&](const std::vector<std::string>& words) {
        const Ran ran = attempt(words, folder);
        if (ran.status != 0 || !ran.problem.empty())
            throw std::runtime_error(command_text(words) + " fails: " + ran.err);
    };
    must({"movie", "fifty.toml", "--no-film", "--out", "run", "--set", "output.trajectory_interval=20 ms"});
    must({"render", "run", "--every", "1", "--no-replay", "--no-film", "--frames", "--out", "drawn"});
    return {folder / "run", folder / "drawn/frames", {}};
}

}  // namespace grainreel::hard
