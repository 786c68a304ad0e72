// The verb `handover` writes a scene as a folder that LAMMPS or LIGGGHTS runs, here or on a cluster.
#include <filesystem>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/handover/carry.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/handover/start_state.hpp"
#include "engine/handover/triangle_walls.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/folder/listener.hpp"
#include "engine/scene/text/units.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/app/messages/stop_signal.hpp"
#include "render/app/messages/version.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "render/app/verbs/verbs.hpp"
#include "render/film/run/peer_job.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

class Handover final : public Verb {
  public:
    Handover()
        : Verb("handover", "Write a scene as a folder that LAMMPS or LIGGGHTS runs under MPI",
               "The folder has the data file, the deck (the engine's input script), walls, run.sh, "
               "job.slurm for sbatch, and\n"
               "handover.toml, which says what was changed and why. Its path goes to stdout.\n"
               "Then:   sh DIR/run.sh        or   cd DIR && sbatch job.slurm\n"
               "        grainreel render DIR\n"
               "If the engine cannot do something, a message names each such line of the scene, and nothing "
               "is written.\n"
               "\n" +
                   std::string(exit_statuses)) {}

    void add_options(CLI::App& parser) override {
        parser.add_option("--to", engine_, "Engine that will run the scene: lammps or liggghts")
            ->required()
            ->type_name("ENGINE")
            ->check(CLI::IsMember({"lammps", "liggghts"}));
        parser.add_option("--ranks", request_.ranks, "MPI processes (ranks) that run.sh starts [1]")
            ->check(CLI::Range(1, 1'000'000))
            ->type_name("N");
        parser
            .add_option("--accept", accepted_,
                        "law: replace a contact law that the engine lacks by the nearest that it has")
            ->check(CLI::IsMember({"law"}))
            ->type_name("WHAT");
        parser
            .add_option("--law", law_,
                        "edinburgh: keep Walton-Braun, with LIGGGHTS' model edinburgh on one rank")
            ->check(CLI::IsMember({"edinburgh"}))
            ->type_name("LAW");
        parser
            .add_option("--pack-there", request_.packs_above,
                        "Let the engine pack the bed if it has more than N grains [1000000]")
            ->check(CLI::Range(std::int64_t{0}, std::int64_t{1'000'000'000'000}))
            ->type_name("N");
        parser.add_flag("--force", folder_.force, "Replace an earlier hand-over in DIR");
        add_out_folder(parser, folder_.out, "Folder to make [output/NAME-ENGINE]");
        add_scene(parser, scene_, sets_);
        add_reporting(parser, report);
    }

    int run(Reporter& reporter) override {
        const FilmedScene scene = read_filmed_scene(scene_, sets_, measurable_in);
        const Plan plan = plan_with_film(scene);
        request_.engine = engine_ == "lammps" ? PeerEngine::lammps : PeerEngine::liggghts;
        request_.accept_law = !accepted_.empty();
        request_.edinburgh = law_ == "edinburgh";
        check_schedule(scene, count_film(scene, plan.clock, plan.steps));
        CarriedScene carried = carry(scene, plan, request_);
        throw_refusals(carried, [&](const std::string& line) { reporter.error(line); });
        want_pictures(carried, scene);
        folder_.name = fmt::format("{}-{}", scene.name, engine_);
        folder_.base = output_base();
        folder_.command = command;
        check_replaceable();
        if (folder_.out && !folder_.force) RunFolder::check(*folder_.out, false);
        const int processors = scene.run.threads > 0 ? scene.run.threads : usable_processors();
        const int threads = plan_threads(processors, false, scene.grains()).engine;
        const StartState start = start_state(carried, threads, watcher(reporter));
        if (start.stopped) return signal_base + stop_signal();
        if (carried.engine == PeerEngine::liggghts) make_room_for_walls(carried);
        if (folder_.force && folder_.out) fs::remove_all(*folder_.out);
        const RunFolder folder(folder_);
        write_handover(folder.path(), carried, start, build_info::version);
        tell(reporter, carried, start, folder.path());
        print_exact(folder.path().string() + "\n");
        return 0;
    }

  private:
    // Checks that a folder which would be replaced is a hand-over and nothing else.
    void check_replaceable() {
        std::error_code ignored;
        if (!folder_.out || !folder_.force || !is_there(*folder_.out)) return;
        if (is_folder(*folder_.out) && (is_handover(*folder_.out) || fs::is_empty(*folder_.out, ignored)))
            return;
        throw UserError("--out {}: holds no hand-over, and nothing else is replaced; name another folder",
                        folder_.out->string());
    }

    PackingWatcher watcher(Reporter& reporter) const {
        return [&reporter](const PackingProgress& packing) {
            Progress progress;
            progress.stage = packing.stage == PackingProgress::Stage::growing   ? Progress::Stage::growing
                             : packing.stage == PackingProgress::Stage::raining ? Progress::Stage::raining
                                                                                : Progress::Stage::settling;
            progress.done = packing.done;
            reporter.progress(progress);
            return stop_signal() == 0;
        };
    }

    static void tell(Reporter& reporter, const CarriedScene& carried, const StartState& start,
                     const fs::path& folder) {
        reporter.clear();
        for (const CarryNote& note : carried.changes)
            reporter.info(
                fmt::format("{}{}{}: {}", note.where, note.where.empty() ? "" : ": ", note.what, note.why));
        if (carried.frame == ReferenceFrame::container)
            reporter.info(
                "the deck and its dump are in the container's frame, where walls stand still and grains feel "
                "minus its acceleration; what reads the folder here adds the motion again");
        if (!start.settled)
            reporter.warning("the grains had not come to rest when the time limit of settling ended");
        const double seconds =
            peer_seconds(carried.engine, carried.frame, carried.grains(),
                         carried.last - carried.first + carried.packing_steps, carried.ranks);
        reporter.info(fmt::format("{} for {} on {}, about {} there; {}", folder.string(),
                                  name_of(carried.engine), counted(carried.ranks, "rank"),
                                  duration_text(seconds), counted(carried.dumps.size(), "dump")));
        const std::string word = shell_word(folder.string());
        reporter.info(fmt::format("run it:      sh {}, or on a cluster: cd {} && sbatch job.slurm",
                                  shell_word((folder / "run.sh").string()), word));
        reporter.info(fmt::format("draw it:     {} render {}", program_call(), word));
    }

    fs::path scene_;
    Assignments sets_;
    std::string engine_, accepted_, law_;
    CarryRequest request_;
    FolderRequest folder_;
};

}  // namespace

std::unique_ptr<Verb> handover_verb() {
    return std::make_unique<Handover>();
}

}  // namespace grainreel
