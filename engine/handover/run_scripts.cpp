#include "engine/handover/run_scripts.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "engine/handover/decks.hpp"
#include "engine/handover/peer_rates.hpp"

namespace grainreel {

namespace {

std::string program_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "lmp" : "liggghts";
}

// "hours:minutes:00", twice what is expected, at least ten minutes.
std::string wall_time(const CarriedScene& carried) {
    const double seconds = peer_seconds(carried.engine, carried.frame, carried.grains(),
                                        carried.last - carried.first + carried.packing_steps, carried.ranks);
    const auto minutes = static_cast<std::int64_t>(std::max(10.0, std::ceil(2 * seconds / 60)));
    return fmt::format("{}:{:02}:00", minutes / 60, minutes % 60);
}

// A shell's comment has one line.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

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
{restart}mpirun -np "$ranks" "$engine" -in {deck} -log log.{key} "$@" > out.{key} 2>&1
status=$?
[ $status = 0 ] || {{ echo "run.sh: {name} ended with $status; the end of out.{key}:" >&2; tail -n 5 out.{key} >&2; }}
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
    [ -n "$step" ] || {{ echo "run.sh: there is no restart file to go on from" >&2; exit 2; }}
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
else
    rm -f {restart}.*  # of a run before
    set --
fi
)sh";

constexpr const char* slurm_text = R"sh(#!/bin/sh
#SBATCH --job-name={job}
#SBATCH --ntasks={ranks}
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu={memory}M
#SBATCH --time={time}
#SBATCH --output=slurm-%j.out
# The cluster's modules, for instance:
# module load openmpi {key}
cd "${{SLURM_SUBMIT_DIR:-.}}" || exit 1
RANKS=${{SLURM_NTASKS:-{ranks}}} exec sh run.sh "$@"
)sh";

}  // namespace

std::string run_script(const CarriedScene& carried) {
    const bool lammps = carried.engine == PeerEngine::lammps;
    const std::string restart = fmt::format(restart_text, fmt::arg("restart", restart_name(carried.engine)),
                                            fmt::arg("dump", dump_name(carried.engine)));
    return fmt::format(run_text, fmt::arg("title", one_line(carried.scene.title)),
                       fmt::arg("name", name_of(carried.engine)), fmt::arg("ranks", carried.ranks),
                       fmt::arg("program", program_of(carried.engine)),
                       fmt::arg("package", key_of(carried.engine)),
                       fmt::arg("check", lammps ? lammps_check : ""), fmt::arg("restart", restart),
                       fmt::arg("deck", deck_name(carried.engine)), fmt::arg("key", key_of(carried.engine)));
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

}  // namespace grainreel
