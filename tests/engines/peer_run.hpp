// Hands a scene over in a test and runs it on one rank, where the engine is installed.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/handover/carry.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/handover/start_state.hpp"
#include "engine/scene/file/reader.hpp"
#include "engine/state/wall_motion.hpp"
#include "tests/cli/temporary_folder.hpp"

namespace grainreel::test {

inline bool has_lammps() {
    return std::system("command -v lmp > /dev/null 2>&1 && command -v mpirun > /dev/null 2>&1") == 0;
}

struct PeerGrain {
    Vec3 position, velocity, spin;
};
// By step of the engine and id there.
using PeerDump = std::map<std::int64_t, std::map<std::int64_t, PeerGrain>>;

inline PeerDump read_dump(const std::filesystem::path& path) {
    PeerDump dump;
    std::ifstream file(path);
    std::string line;
    std::int64_t step = 0;
    while (std::getline(file, line)) {
        if (line == "ITEM: TIMESTEP") {
            file >> step;
            std::getline(file, line);
        } else if (line.rfind("ITEM: ATOMS", 0) == 0) {
            while (file.peek() != 'I' && std::getline(file, line)) {
                std::istringstream row(line);
                std::int64_t id;
                int type;
                double radius;
                PeerGrain g;
                row >> id >> type >> radius;
                for (Vec3* v : {&g.position, &g.velocity, &g.spin})
                    for (int axis = 0; axis < 3; ++axis) row >> (*v)[axis];
                dump[step][id] = g;
            }
        }
    }
    return dump;
}

struct PeerRun {
    CarriedScene carried;
    PeerDump dump;
    int status = 0;
    std::string words;  // of the engine
};

inline PeerRun run_on_lammps(const std::string& text, CarryRequest request = {}) {
    const TemporaryFolder folder;
    const Scene scene = read_scene_text(text, "handed.toml");
    PeerRun run;
    run.carried = carry(scene, make_plan(scene), request);
    throw_refusals(run.carried);
    const StartState start = start_state(run.carried, 1, [](const PackingProgress&) { return true; });
    write_handover(folder.path(), run.carried, start, "test");
    run.status = std::system(("sh " + (folder / "run.sh").string() + " 2> /dev/null").c_str());
    run.words = text_of(folder / "out.lammps");
    run.dump = read_dump(folder / "lammps.dump");
    return run;
}

}  // namespace grainreel::test
