#include "tests/engines/handed.hpp"

#include <fmt/format.h>
#include <chrono>
#include <thread>

#include "engine/handover/decks/decks.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/handover/peer_process.hpp"
#include "engine/handover/start_state.hpp"
#include "engine/handover/triangle_walls.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel::test {

bool has_engine(PeerEngine engine) {
    return !program_named(engine == PeerEngine::lammps ? "lmp" : "liggghts").empty() &&
           !program_named("mpirun").empty();
}

std::string balls_in_box(double restitution, double friction, const std::string& more) {
    return fmt::format(R"(
[[species]]
name = "ball"
count = 60
diameter = "3 mm"
density = 2500
[contact]
law = "spring-dashpot"
friction_law = "linear-spring"
stiffness = 300
restitution = {}
friction = {}
[container]
shape = "box"
width = "24 mm"
depth = "15 mm"
height = "24 mm"
{})",
                       restitution, friction, more);
}

CarriedScene hand_over(const std::string& text, const CarryRequest& request,
                       const std::filesystem::path& folder) {
    const Scene scene = read_scene_text(text, folder / "handed.toml");
    CarriedScene carried = carry(scene, make_plan(scene), request);
    throw_refusals(carried, [](const std::string& line) { throw UserError(line); });
    const StartState start = start_state(carried, 1, [](const PackingProgress&) { return true; });
    if (request.engine == PeerEngine::liggghts) make_room_for_walls(carried);
    write_handover(folder, carried, start, "test");
    return carried;
}

std::string run_engine(PeerProcess job, const std::filesystem::path& folder) {
    job.start(folder);
    while (job.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return job.failure();
}

std::map<std::int64_t, State> frames_of(PeerEngine engine, const std::filesystem::path& folder) {
    std::map<std::int64_t, State> all;
    DeckDump dump(folder / dump_name(engine));
    while (std::optional<State> rows = dump.next()) {
        const std::int64_t step = rows->step;
        all[step] = std::move(*rows);
    }
    return all;
}

}  // namespace grainreel::test
