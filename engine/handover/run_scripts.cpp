#include "engine/handover/run_scripts.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "engine/handover/deck_parts.hpp"
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

constexpr const char* lammps_restart = R"sh(if [ "$1" = --continue ]; then
    last=$(ls -t {restart}.1 {restart}.2 2>/dev/null | head -n 1)
    [ -n "$last" ] || {{ echo "run.sh: there is no restart file to go on from" >&2; exit 2; }}
    set -- -var goes_on 1 -var restart "$last"
else
    set --
fi
)sh";

constexpr const char* liggghts_restart = R"sh(if [ "$1" = --continue ]; then
    echo "run.sh: LIGGGHTS' deck begins anew; meshes and their motion are in no restart file" >&2
    exit 2
fi
set --
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
    const std::string restart =
        lammps ? fmt::format(lammps_restart, fmt::arg("restart", restart_name(carried.engine)))
               : liggghts_restart;
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
