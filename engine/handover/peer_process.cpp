#include "engine/handover/peer_process.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <vector>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text.hpp"
#include "engine/handover/decks/decks.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

struct Known {
    const char *program, *package;
};

Known known(PeerEngine engine) {
    return engine == PeerEngine::lammps ? Known{"lmp", "lammps"} : Known{"liggghts", "liggghts"};
}

// The first lines that a program prints.
std::string said_by(const fs::path& program, const std::string& option) {
    const std::string command = shell_word(program.string()) + " " + option + " </dev/null 2>/dev/null";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    if (!pipe) return "";
    std::array<char, 2000> text{};
    const std::size_t size = std::fread(text.data(), 1, text.size(), pipe.get());
    return {text.data(), size};
}

// The text between `begin` and the first of the characters in `ends`.
std::string between(const std::string& text, const std::string& begin, const char* ends) {
    const std::size_t at = text.find(begin);
    if (at == std::string::npos) return "";
    const std::size_t from = at + begin.size(), to = text.find_first_of(ends, from);
    return text.substr(from, to == std::string::npos ? to : to - from);
}

}  // namespace

fs::path program_named(const std::string& name) {
    const char* const path = std::getenv("PATH");
    if (path == nullptr) return {};
    const std::string folders = path;
    for (std::size_t from = 0; from <= folders.size();) {
        const std::size_t to = std::min(folders.find(':', from), folders.size());
        const fs::path place = fs::path(folders.substr(from, to - from)) / name;
        if (to > from && is_plain(place) && ::access(place.c_str(), X_OK) == 0) return fs::absolute(place);
        from = to + 1;
    }
    return {};
}

std::string version_in(PeerEngine engine, const std::string& text) {
    return engine == PeerEngine::lammps ? between(text, "Massively Parallel Simulator - ", "\r\n")
                                        : between(text, "LIGGGHTS-PUBLIC ", " ,)\r\n");
}

void check_version(PeerEngine engine, const std::string& version) {
    if (engine == PeerEngine::lammps && version.rfind("28 Mar 2023", 0) == 0)
        throw UserError(
            "LAMMPS {}: its `fix wall/gran` ignores the group, so that each wall would act several times on "
            "every grain; use another version (Debian 12 has 29 Sep 2021)",
            version);
}

EngineProgram find_engine(PeerEngine engine) {
    const Known what = known(engine);
    EngineProgram found;
    found.path = program_named(what.program);
    if (found.path.empty())
        throw UserError(
            "{}: there is no program `{}` in PATH; Debian has it in the package {} "
            "(sudo apt-get install {})",
            name_of(engine), what.program, what.package, what.package);
    // Even with -h, LIGGGHTS opens its log in the working folder, unless it gets -log none.
    found.version = version_in(engine, said_by(found.path, "-log none -h"));
    if (found.version.empty())
        throw UserError("{}: {} does not say which version it is; try `{} -h`", name_of(engine),
                        found.path.string(), what.program);
    check_version(engine, found.version);
    return found;
}

RankWords rank_words(PeerEngine engine, const EngineProgram& program, const std::string& deck, int ranks,
                     bool goes_on) {
    const int processors = usable_processors();
    if (ranks < 1) throw UserError("--ranks {}: must be at least 1", ranks);
    if (ranks > processors && goes_on)
        throw UserError(
            "the run has {} ranks, but there are {} processors here; resume it where "
            "there are as many",
            ranks, processors);
    if (ranks > processors)
        throw UserError(
            "--ranks {}: usable here: {}; give --ranks {}, or hand the scene over to "
            "a cluster (`handover`)",
            ranks, counted(processors, "processor"), processors);
    const fs::path mpirun = program_named("mpirun");
    if (mpirun.empty())
        throw UserError("{}: there is no program `mpirun` in PATH; Debian has it in the package openmpi-bin",
                        name_of(engine));
    RankWords all;
    all.words = {mpirun.string(), "-n", std::to_string(ranks)};
    if (said_by(mpirun, "--version").find("Open MPI") != std::string::npos) {
        // Open MPI counts cores and not hardware threads, and would bind two runs to the same cores.
        all.words.insert(all.words.end(), {"--oversubscribe", "--bind-to", "none"});
        if (::geteuid() == 0) {
            all.words.emplace_back("--allow-run-as-root");
            all.notes.emplace_back("this is root, whom Open MPI refuses: mpirun gets --allow-run-as-root");
        }
    }
    // LIGGGHTS loses an error message that is still in its buffer, so stdbuf makes it write line by line.
    const fs::path stdbuf = program_named("stdbuf");
    if (!stdbuf.empty()) all.words.insert(all.words.end(), {stdbuf.string(), "-oL"});
    all.words.insert(all.words.end(), {program.path.string(), "-echo", "both", "-in", deck});
    return all;
}

namespace {

constexpr std::size_t kLongest = 400;  // most characters of a line that are quoted

// The words of a line up to a comment, with one blank between them.
std::string words_of(const std::string& line) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string text;
    for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
    return text;
}

// The numbers of a deck's lines by their words. If two lines are the same, the later one counts.
std::map<std::string, int> lines_of(const fs::path& deck) {
    std::map<std::string, int> lines;
    std::ifstream file = read_plain(deck);
    int number = 1;
    for (std::string line; std::getline(file, line); ++number)
        if (const std::string words = words_of(line); !words.empty()) lines[words] = number;
    return lines;
}

// Whether the line is an error of the engine and not of Open MPI.
bool is_error(const std::string& line) {
    return line.rfind("ERROR", 0) == 0;
}

std::string cut(const std::string& text) {
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

bool says(const fs::path& file, const std::string& words) {
    std::ifstream said = read_plain(file);
    for (std::string line; std::getline(said, line);)
        if (line.find(words) != std::string::npos) return true;
    return false;
}

// How an engine ended that gave this exit status, and said nothing of it in `output`.
std::string ended_with(PeerEngine engine, int status, const fs::path& output) {
    const std::string how = status > 128 ? fmt::format("was ended by signal {}", status - 128)
                                         : fmt::format("ended with exit status {}", status);
    return fmt::format("{} {}; its output is in {}", name_of(engine), how, output.string());
}

}  // namespace

std::string engine_error(const fs::path& output, const fs::path& deck) {
    const std::map<std::string, int> lines = lines_of(deck);
    std::ifstream said = read_plain(output);
    std::string command, last;
    int at = 0;
    for (std::string line; std::getline(said, line);) {
        const std::string words = words_of(line);
        if (is_error(line)) {
            const std::string where =
                at > 0 ? fmt::format("{}:{}", deck.filename().string(), at) : deck.filename().string();
            return fmt::format("{}: {}{}", where, cut(line),
                               command.empty() ? "" : fmt::format(" (at `{}`)", cut(command)));
        }
        const auto found = lines.find(words);
        if (found == lines.end()) continue;
        command = words;
        at = found->second;
    }
    return "";
}

PeerProcess::PeerProcess(PeerEngine engine, int ranks, const std::string& deck, const std::string& restart)
    : engine_(engine),
      deck_(deck),
      program_(find_engine(engine)),
      ranks_(rank_words(engine, program_, deck, ranks, !restart.empty())) {
    if (!restart.empty())
        for (const char* word : {"-var", "goes_on", "1", "-var", "restart", restart.c_str()})
            ranks_.words.emplace_back(word);
}

std::string PeerProcess::command() const {
    std::string text;
    for (const std::string& word : ranks_.words) text += (text.empty() ? "" : " ") + word;
    return text;
}

void PeerProcess::start(const std::filesystem::path& folder) {
    folder_ = folder;
    process_ = std::make_unique<GuardedProcess>(ranks_.words, folder, folder / kOutput);
}

bool PeerProcess::is_running() {
    return process_ && !process_->status();
}

std::string PeerProcess::failure() {
    const std::string said = engine_error(folder_ / kOutput, folder_ / deck_);
    if (!said.empty()) return fmt::format("{} ended: {}", name_of(engine_), said);
    const int status = process_->status().value_or(0);
    if (status == 0) return "";
    return ended_with(engine_, status, folder_ / kOutput);
}

std::string log_name(PeerEngine engine) {
    return fmt::format("log.{}", key_of(engine));
}

std::string output_name(PeerEngine engine) {
    return fmt::format("out.{}", key_of(engine));
}

JobEnd job_end(const fs::path& folder, const HandoverFacts& facts) {
    JobEnd end;
    std::ifstream said = read_plain(folder / status_name);
    std::string first, second;
    std::getline(said, first);
    std::getline(said, second);
    end.begun = !first.empty();
    if (second.starts_with("job ")) end.job = second.substr(4);
    end.goes_on = end.job.ends_with(" continue");
    int status = 0;
    end.ended = static_cast<bool>(std::istringstream(first) >> status);
    if (!end.ended || status == 0) return end;
    // A killed engine loses what it had not written of its log, and prints the error to its output as well.
    for (const std::string& file : {log_name(facts.engine), output_name(facts.engine)}) {
        const std::string error = engine_error(folder / file, folder / deck_name(facts.engine));
        if (error.empty()) continue;
        end.failure = fmt::format("{} ended: {}", name_of(facts.engine), error);
        return end;
    }
    // Where a rank was killed, mpirun asks the others to end.
    const bool asked = status == 128 + SIGTERM || status == 128 + SIGINT || status == 128 + SIGHUP;
    if (asked || (status <= 128 && says(folder / output_name(facts.engine), "SIGINT/SIGTERM caught"))) {
        end.failure = fmt::format("{} was asked to end by a signal (Ctrl-C, scancel or a time limit)",
                                  name_of(facts.engine));
        return end;
    }
    end.failure = ended_with(facts.engine, status, folder / output_name(facts.engine));
    return end;
}

std::optional<std::int64_t> newest_restart(const fs::path& folder, PeerEngine engine) {
    const std::string begin = restart_name(engine) + ".";
    std::optional<std::int64_t> newest;
    std::error_code missing;
    for (const fs::directory_entry& one : fs::directory_iterator(folder, missing)) {
        const std::string name = one.path().filename().string();
        if (!name.starts_with(begin)) continue;
        std::int64_t step = 0;
        const char* const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + begin.size(), end, step);
        if (read.ec == std::errc() && read.ptr == end) newest = std::max(newest.value_or(0), step);
    }
    return newest;
}

void take_forced_restarts(const fs::path& folder, const fs::path& output) {
    bool whole = false;
    std::ifstream said = read_plain(output);
    for (std::string line; !whole && std::getline(said, line);)
        whole = line.find(forced_words) != std::string::npos;
    std::vector<fs::path> forced;
    std::error_code missing;
    for (const fs::directory_entry& one : fs::directory_iterator(folder, missing))
        if (one.path().filename().string().starts_with(forced_begin)) forced.push_back(one.path());
    const std::string begin = forced_begin, end = forced_end;
    for (const fs::path& one : forced) {
        const std::string name = one.filename().string();
        if (whole && name.ends_with(end))
            fs::rename(
                one,
                folder / fmt::format("{}.{}", restart_name(PeerEngine::liggghts),
                                     name.substr(begin.size(), name.size() - begin.size() - end.size())),
                missing);
        else
            fs::remove(one, missing);
    }
}

std::string came_so_far(const fs::path& folder, const HandoverFacts& facts, double until, double wanted) {
    const JobEnd end = job_end(folder, facts);
    const std::string why = end.failure.empty() ? "" : end.failure + "; it";
    return fmt::format("{} has come to {:.4g} s of {:.4g} s; what there is is shown",
                       why.empty() ? name_of(facts.engine) : why, until, wanted);
}

}  // namespace grainreel
