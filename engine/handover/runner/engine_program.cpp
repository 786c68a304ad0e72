#include "engine/handover/runner/engine_program.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/team.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

struct Known {
    const char *program, *package;
};

Known known(PeerEngine engine) {
    return engine == PeerEngine::lammps ? Known{"lmp", "lammps"} : Known{"liggghts", "liggghts"};
}

std::string quoted_for_shell(const std::string& word) {
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

// The first lines that a program says.
std::string said_by(const fs::path& program, const std::string& option) {
    const std::string command = quoted_for_shell(program.string()) + " " + option + " </dev/null 2>/dev/null";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    if (!pipe) return "";
    std::array<char, 2000> text{};
    const std::size_t size = std::fread(text.data(), 1, text.size(), pipe.get());
    return {text.data(), size};
}

// From behind `begin` to the first of `ends`.
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
        std::error_code ignored;
        if (to > from && fs::is_regular_file(place, ignored) && ::access(place.c_str(), X_OK) == 0)
            return fs::absolute(place);
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
        throw UserError(fmt::format(
            "LAMMPS {}: its `fix wall/gran` ignores the group, so that each wall would act several times on "
            "every grain; use another version (Debian 12 has 29 Sep 2021)",
            version));
}

EngineProgram find_engine(PeerEngine engine) {
    const Known what = known(engine);
    EngineProgram found;
    found.path = program_named(what.program);
    if (found.path.empty())
        throw UserError(
            fmt::format("--engine {}: there is no program `{}` in PATH; Debian has it in the package {} "
                        "(sudo apt-get install {})",
                        key_of(engine), what.program, what.package, what.package));
    // LIGGGHTS opens its log for -h, too, in whatever folder the user is in.
    found.version = version_in(engine, said_by(found.path, "-log none -h"));
    if (found.version.empty())
        throw UserError(fmt::format("--engine {}: {} does not say which version it is; try `{} -h`",
                                    key_of(engine), found.path.string(), what.program));
    check_version(engine, found.version);
    return found;
}

RankWords rank_words(PeerEngine engine, const EngineProgram& program, const std::string& deck, int ranks) {
    const int processors = usable_processors();
    if (ranks < 1) throw UserError(fmt::format("--ranks {}: must be at least 1", ranks));
    if (ranks > processors)
        throw UserError(fmt::format(
            "--ranks {}: there are {} processors here; give --ranks {}, or hand the scene over to "
            "a cluster (`handover`)",
            ranks, processors, processors));
    const fs::path mpirun = program_named("mpirun");
    if (mpirun.empty())
        throw UserError(fmt::format(
            "--engine {}: there is no program `mpirun` in PATH; Debian has it in the package openmpi-bin",
            key_of(engine)));
    RankWords all;
    all.words = {mpirun.string(), "-n", std::to_string(ranks)};
    if (said_by(mpirun, "--version").find("Open MPI") != std::string::npos) {
        // Open MPI counts cores, not hardware threads, and would bind two runs to the same ones.
        all.words.insert(all.words.end(), {"--oversubscribe", "--bind-to", "none"});
        if (::geteuid() == 0) {
            all.words.emplace_back("--allow-run-as-root");
            all.notes.emplace_back("this is root, whom Open MPI refuses: mpirun gets --allow-run-as-root");
        }
    }
    // LIGGGHTS loses the text of an error that is still in its buffer.
    const fs::path stdbuf = program_named("stdbuf");
    if (!stdbuf.empty()) all.words.insert(all.words.end(), {stdbuf.string(), "-oL"});
    all.words.insert(all.words.end(), {program.path.string(), "-echo", "both", "-in", deck});
    return all;
}

}  // namespace grainreel
