#include "engine/handover/handover_folder.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/files/run_names.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/handover/peer_process.hpp"
#include "engine/handover/triangle_walls.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/text/toml_text.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

bool grains_leave(const CarriedScene& carried) {
    return !carried.scene.exits.empty() || (carried.scene.container.outlet && !carried.scene.container.tray);
}

std::string facts_text(const CarriedScene& carried, const StartState& start, const std::string& version) {
    SceneText out;
    std::int64_t glued = 0, fed = 0;
    for (const StartState::Grain& grain : start.grains) glued += carried.types[grain.type - 1].glued;
    for (const Species& one : carried.scene.species) fed += one.fed;
    out.comment(
        "What was handed over, and what was changed for it. `render` and `inspect` of this folder read it.");
    out.put("scene", quoted("scene.toml"));
    out.put("from", quoted(carried.scene.file));
    out.put("engine", quoted(key_of(carried.engine)));
    out.put("written_for", quoted(version_of(carried.engine)));
    out.put("written_by", quoted("grainreel " + version));
    out.put("ranks", std::to_string(carried.ranks));
    out.put("frame", quoted(carried.frame == ReferenceFrame::container ? "container" : "lab"));
    out.put("step", toml_number(carried.step));
    out.put("shift", std::to_string(carried.shift()));
    out.put("first", std::to_string(carried.first));
    out.put("last", std::to_string(carried.last));
    out.put("grains", std::to_string(static_cast<std::int64_t>(start.grains.size()) - glued));
    out.put("glued", std::to_string(glued));
    out.put("fed", std::to_string(fed));
    out.put("leave", grains_leave(carried) ? "true" : "false");
    out.put("dumps", std::to_string(carried.dumps.size()));
    out.put("dump", quoted(dump_name(carried.engine)));
    for (const CarryNote& note : carried.changes) {
        out.element("change");
        if (!note.where.empty()) out.put("where", quoted(note.where));
        out.put("what", quoted(note.what));
        out.put("why", quoted(note.why));
    }
    return out.take();
}

[[noreturn]] void fail(const fs::path& file, const toml::source_region& at, const std::string& what) {
    throw UserError("{}:{}:{}: {}", file.string(), at.begin.line, at.begin.column, what);
}

// Reads a value that must be there.
class FactsReader {
  public:
    FactsReader(const fs::path& file, const toml::table& table) : file_(file), table_(table) {}

    std::string word(const char* key) const {
        const toml::node& node = at(key);
        if (const auto value = node.value<std::string>()) return *value;
        fail(file_, node.source(), fmt::format("'{}' is no text", key));
    }
    std::int64_t whole(const char* key, std::int64_t least = 0) const {
        const toml::node& node = at(key);
        const auto value = node.value<std::int64_t>();
        if (!value || *value < least)
            fail(file_, node.source(), fmt::format("'{}' is no whole number from {} on", key, least));
        return *value;
    }
    double number(const char* key) const {
        const toml::node& node = at(key);
        const auto value = node.value<double>();
        if (!value || !(*value > 0))
            fail(file_, node.source(), fmt::format("'{}' is no positive number", key));
        return *value;
    }
    std::string choice(const char* key, const char* first, const char* second) const {
        const std::string text = word(key);
        if (text != first && text != second)
            fail(file_, at(key).source(),
                 fmt::format("'{}' is \"{}\"; it is \"{}\" or \"{}\"", key, text, first, second));
        return text;
    }
    bool truth(const char* key) const { return at(key).value<bool>().value_or(false); }

  private:
    const toml::node& at(const char* key) const {
        const toml::node* node = table_.get(key);
        if (node == nullptr)
            throw UserError("{}:1:1: '{}' is missing; hand the scene over again", file_.string(), key);
        return *node;
    }
    const fs::path& file_;
    const toml::table& table_;
};

std::vector<std::string> changes_of(const toml::table& table) {
    std::vector<std::string> all;
    const toml::array* changes = table["change"].as_array();
    if (changes == nullptr) return all;
    for (const toml::node& one : *changes) {
        const toml::table* change = one.as_table();
        if (change == nullptr) continue;
        all.push_back(fmt::format("{} ({})", (*change)["what"].value_or(std::string()),
                                  (*change)["why"].value_or(std::string())));
    }
    return all;
}

void make_executable(const fs::path& file) {
    std::error_code ignored;
    fs::permissions(file, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                    fs::perm_options::add, ignored);
}

}  // namespace

void write_handover(const fs::path& folder, const CarriedScene& carried, const StartState& start,
                    const std::string& version) {
    const bool lammps = carried.engine == PeerEngine::lammps;
    write_data_file(folder / data_name, carried, start,
                    lammps ? carried.type_count() : liggghts_types(carried));
    if (!lammps) write_triangle_walls(folder, carried);
    replace_file(folder / deck_name(carried.engine), lammps ? lammps_deck(carried) : liggghts_deck(carried));
    keep_mesh_files(carried.scene, folder);
    replace_file(folder / "scene.toml", resolved_scene(carried.scene, carried.plan));
    replace_file(folder / "run.sh", run_script(carried));
    make_executable(folder / "run.sh");
    replace_file(folder / "job.slurm", slurm_script(carried));
    // This file is written last, so that a folder that has it is complete.
    replace_file(folder / kHandoverFacts, facts_text(carried, start, version));
}

bool is_handover(const fs::path& folder) {
    return is_plain(folder / kHandoverFacts);
}

HandoverFacts read_handover(const fs::path& folder) {
    const fs::path file = folder / kHandoverFacts;
    toml::table table;
    try {
        table = toml::parse_file(file.string());
    } catch (const toml::parse_error& error) {
        fail(file, error.source(), std::string(error.description()));
    }
    const FactsReader facts(file, table);
    HandoverFacts all;
    all.engine =
        facts.choice("engine", "lammps", "liggghts") == "lammps" ? PeerEngine::lammps : PeerEngine::liggghts;
    all.frame =
        facts.choice("frame", "container", "lab") == "lab" ? ReferenceFrame::lab : ReferenceFrame::container;
    all.ranks = static_cast<int>(std::min<std::int64_t>(facts.whole("ranks", 1), 1'000'000'000));
    all.step = facts.number("step");
    all.shift = facts.whole("shift");
    all.first = facts.whole("first");
    all.last = facts.whole("last");
    all.grains = facts.whole("grains");
    all.glued = facts.whole("glued");
    all.fed = facts.whole("fed");
    all.leave = facts.truth("leave");
    all.dumps = facts.whole("dumps");
    all.dump = folder / fs::path(facts.word("dump")).filename();
    all.changes = changes_of(table);
    return all;
}

namespace {

std::string program_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "lmp" : "liggghts";
}

// The time limit "hours:minutes:00": twice what is expected, but at least ten minutes.
std::string wall_time(const CarriedScene& carried) {
    const double seconds = peer_seconds(carried.engine, carried.frame, carried.grains(),
                                        carried.last - carried.first + carried.packing_steps, carried.ranks);
    const auto minutes = static_cast<std::int64_t>(std::max(10.0, std::ceil(2 * seconds / 60)));
    return fmt::format("{}:{:02}:00", minutes / 60, minutes % 60);
}

// A text as one line, for a comment in a shell script.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

// Prints the first error in the engine's log and output, with the line of the deck at which it came. The
// words of deck and log are compared without comments and with one blank between them.
constexpr const char* error_text = R"sh(error_of() {
    awk 'function plain(s) { sub(/#.*/, "", s); gsub(/[ \t\r]+/, " ", s); gsub(/^ | $/, "", s); return s }
        NR == FNR { if (plain($0) != "") line[plain($0)] = FNR; next }
        /^ERROR/ { print deck (at ? ":" at : "") ": " $0 (at ? " (at `" command "`)" : ""); exit }
        plain($0) in line { command = plain($0); at = line[command] }' deck="$1" "$@" 2> /dev/null
}
)sh";

constexpr const char* run_text = R"sh(#!/bin/sh
# {title}
# Runs the deck on {name} under MPI:  sh run.sh            from the start
#                                     sh run.sh --continue from its last restart file
# RANKS and ENGINE in the environment take the place of what stands here.
cd "$(dirname "$0")" || exit 1
ranks=${{RANKS:-{ranks}}}
engine=${{ENGINE:-{program}}}
command -v "$engine" > /dev/null || {{
    echo "run.sh: there is no program $engine; Debian's package is {package}" >&2
    exit 2
}}
{check}export OMP_NUM_THREADS=1
if [ "$(id -u)" = 0 ]; then  # Open MPI refuses root otherwise
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
{error}# The first line of {status} is "running" or an exit status, the second names the job.
note() {{ printf '%s\njob %s\n' "$1" "$name" > {status}.part && mv -f {status}.part {status}; }}
{restart}rm -f {status}  # of a job before
name="$(uname -n) $$ $(date +%s) $way"
note running
mpirun -np "$ranks" "$engine" -in {deck} -log log.{key} "$@" > out.{key} 2>&1 < /dev/null &
job=$!
signal=0  # the one that this script gets; the ranks end with it
trap 'signal=1; kill "$job" 2> /dev/null' HUP
trap 'signal=2; kill "$job" 2> /dev/null' INT
trap 'signal=15; kill "$job" 2> /dev/null' TERM
wait "$job"
status=$?
while kill -0 "$job" 2> /dev/null; do  # a signal ended the wait
    wait "$job"
    status=$?
done
[ "$signal" = 0 ] || [ "$status" = 0 ] || status=$((128 + signal))
{forced}note "$status"  # so that whoever follows the dump knows
[ "$signal" = 0 ] || {{ echo "run.sh: a signal ended the job; go on with: sh \"$0\" --continue" >&2; exit "$status"; }}
[ "$status" = 0 ] && exit 0
error=$(error_of {deck} log.{key} out.{key})
[ -n "$error" ] || tail -n 5 out.{key} >&2
echo "run.sh: {name} ended with $status${{error:+: $error}}; all that it printed is in out.{key}" >&2
exit $status
)sh";

constexpr const char* lammps_check = R"sh(case $("$engine" -h 2>/dev/null | head -n 5) in
*"28 Mar 2023"*)
    echo "run.sh: in LAMMPS of 28 Mar 2023 walls act on all grains whatever their type; take another one" >&2
    exit 2 ;;
esac
)sh";

constexpr const char* restart_text = R"sh(if [ "$1" = --continue ]; then
    step=$(ls {restart}.* 2>/dev/null | sed 's/.*\.//' | sort -n | tail -n 1)
    [ -n "$step" ] || {{ echo "run.sh: there is no restart file to go on from; begin anew with: sh \"$0\"" >&2; exit 2; }}
    # Log and output of the job before may tell why it ended; they are kept as log.{key}.1, log.{key}.2 ...
    for file in log.{key} out.{key}; do
        number=1
        while [ -e "$file.$number" ]; do number=$((number + 1)); done
        [ ! -e "$file" ] || mv "$file" "$file.$number"
    done
    # What the dump has of later steps comes again; its last frame may have been cut off.
    size=$(LC_ALL=C awk -v last="$step" -v size="$(wc -c < {dump})" '
        {{ bytes += length($0) + 1 }}
        wanted == "step" {{ now = $1; wanted = "" }}
        wanted == "rows" {{ rows = $1; wanted = "" }}
        /^ITEM: TIMESTEP/ {{ wanted = "step"; counts = 0 }}
        /^ITEM: NUMBER/ {{ wanted = "rows" }}
        counts {{ if (++row == rows && now <= last && bytes <= size) whole = bytes }}
        /^ITEM: ATOMS/ {{ counts = 1; row = 0; if (rows == 0 && now <= last) whole = bytes }}
        END {{ printf "%.0f", whole }}' {dump}) || exit 1
    truncate -s "$size" {dump}
    set -- -var goes_on 1 -var restart {restart}."$step"
    way=continue
else
    rm -f {restart}.* {end} {dump} log.{key} log.{key}.* out.{key} out.{key}.*  # of a run before
    set --
    way=start
fi
)sh";

// A restart file that a signal made LIGGGHTS write goes by the name of the others if it is whole.
constexpr const char* forced_text = R"sh(for file in {begin}*; do
    [ -e "$file" ] || continue
    step=${{file#{begin}}}
    if grep -q "{words}" out.liggghts; then
        mv "$file" {restart}."${{step%{end}}}"
    else
        rm -f "$file"
    fi
done
)sh";

constexpr const char* slurm_text = R"sh(#!/bin/sh
#SBATCH --job-name={job}
#SBATCH --ntasks={ranks}
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu={memory}M
#SBATCH --time={time}
#SBATCH --output=slurm-%j.out
# A minute before the time ends, run.sh ends the ranks and notes it.
#SBATCH --signal=B:TERM@60
# The cluster's modules, for instance:
# module load openmpi {key}
cd "${{SLURM_SUBMIT_DIR:-.}}" || exit 1
RANKS=${{SLURM_NTASKS:-{ranks}}} exec sh run.sh "$@"
)sh";

}  // namespace

std::string run_script(const CarriedScene& carried) {
    const bool lammps = carried.engine == PeerEngine::lammps;
    const std::string restart =
        fmt::format(restart_text, fmt::arg("restart", restart_name(carried.engine)),
                    fmt::arg("key", key_of(carried.engine)), fmt::arg("dump", dump_name(carried.engine)),
                    fmt::arg("end", end_name));
    const std::string forced =
        fmt::format(forced_text, fmt::arg("begin", forced_begin), fmt::arg("end", forced_end),
                    fmt::arg("words", forced_words), fmt::arg("restart", restart_name(carried.engine)));
    return fmt::format(
        run_text, fmt::arg("forced", lammps ? "" : forced), fmt::arg("error", error_text),
        fmt::arg("title", one_line(carried.scene.title)), fmt::arg("name", name_of(carried.engine)),
        fmt::arg("ranks", carried.ranks), fmt::arg("program", program_of(carried.engine)),
        fmt::arg("package", key_of(carried.engine)), fmt::arg("check", lammps ? lammps_check : ""),
        fmt::arg("restart", restart), fmt::arg("deck", deck_name(carried.engine)),
        fmt::arg("key", key_of(carried.engine)), fmt::arg("status", status_name));
}

std::string slurm_script(const CarriedScene& carried) {
    const double megabytes =
        200 + 2 * peer_bytes(carried.engine, carried.grains()) / (1e6 * std::max(1, carried.ranks));
    std::string job = carried.scene.name.empty() ? "grainreel" : carried.scene.name;
    std::replace_if(
        job.begin(), job.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-'; },
        '_');
    return fmt::format(slurm_text, fmt::arg("job", job), fmt::arg("ranks", carried.ranks),
                       fmt::arg("memory", static_cast<std::int64_t>(std::ceil(megabytes))),
                       fmt::arg("time", wall_time(carried)), fmt::arg("key", key_of(carried.engine)));
}

PeerRate rate_of(PeerEngine engine) {
    if (engine == PeerEngine::lammps) return {4.0e6, 3.1e6, 2100};
    return {7.0e6, 6.7e6, 1400};
}

std::int64_t useful_ranks(std::int64_t grains) {
    return std::max<std::int64_t>(1, grains / 5000);
}

double peer_seconds(PeerEngine engine, ReferenceFrame frame, std::int64_t grains, std::int64_t steps,
                    int ranks) {
    const PeerRate rate = rate_of(engine);
    const double one = frame == ReferenceFrame::container ? rate.standing : rate.moving;
    const double together = ranks > 1 ? 0.8 * ranks : 1;
    return static_cast<double>(grains) * static_cast<double>(steps) / (one * together);
}

double peer_bytes(PeerEngine engine, std::int64_t grains) {
    return rate_of(engine).bytes_a_grain * static_cast<double>(grains);
}

}  // namespace grainreel
