// A scene as another engine's deck needs it: numbers in SI units and exact formulas, and what could not be
// kept. LAMMPS and LIGGGHTS are the engines; each has a deck of its own (lammps_deck.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/frame.hpp"
#include "engine/handover/drive_formula.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

enum class PeerEngine { lammps, liggghts };
const char* name_of(PeerEngine engine);  // "LAMMPS"
const char* key_of(PeerEngine engine);   // "lammps", as on the command line
// The version that the decks were measured with.
const char* version_of(PeerEngine engine);

// A type of the engine's atoms, counted from 1 there: species in their order, then glued grains.
struct CarriedType {
    std::string name;
    double mean = 0, smallest = 0, largest = 0;  // m, diameters
    double density = 0;                          // kg/m3
    bool glued = false;                          // parts of walls, which never move in the run's frame
    bool spread() const { return largest > smallest; }
};

enum class CarriedLaw {
    spring_dashpot,  // N = k d - c v, and a linear tangential spring with Coulomb's cap
    hertz,           // N = 4/3 E* sqrt(R) d^1.5, and Mindlin's spring
    luding,          // Walton-Braun whose restitution falls with speed: K2 = K1 + S F_max
    edinburgh        // Walton-Braun, on one rank alone
};

// One kind of contact: two types, or a type and a surface.
struct CarriedPair {
    CarriedLaw law = CarriedLaw::spring_dashpot;
    bool touches = true;             // false: the scene says nothing of them because they never meet
    double stiffness = 0;            // N/m; Hertz: 4/3 E*, Pa; K1 of luding and edinburgh
    double unloading = 0;            // N/m, K2 of edinburgh
    double hardening = 0;            // 1/m, S of luding
    double tangential = 0;           // N/m; Hertz: 8 G*, Pa
    double damping = 0;              // 1/s, times m_eff; hertz: alpha of Tsuji's dashpot, see dashpot.hpp
    double tangential_damping = 0;   // 1/s, as above
    double restitution = 1;          // wanted, of two of mean size
    double lowest = 1, highest = 1;  // restitution of others of these types, with one damping for all
    double effective_mass = 0;       // kg, of two of mean size; a surface and a glued grain weigh nothing
    double effective_radius = 0;     // m, as above
    double friction = 0;             // finite: kEndlessFriction stands for infinity
    double rolling = 0;              // torque at most so much x effective radius x N
    bool attraction = false;         // the dashpot may pull
};
inline constexpr double kEndlessFriction = 1e4;

// What walls are made of: the contacts of each type with it.
struct CarriedSurface {
    std::string name;               // "walls", or a mesh's name
    std::vector<CarriedPair> with;  // by type
};

// A wall of triangles.
struct CarriedMesh {
    std::size_t number = 0;   // of the scene's meshes
    std::size_t surface = 0;  // of CarriedScene::surfaces
};

// Why the command ends, or what the run will have in place of what the scene says.
struct CarryNote {
    std::string where;  // "file:line:column"; empty: of no key
    std::string what;   // one line
    std::string why;    // one line; what it costs, in our figures. Empty for refusals
};

// In whose frame the run is. In the container's all walls stand still, and grains feel minus its
// acceleration.
enum class RunFrame { lab, container };

struct CarriedScene {
    PeerEngine engine = PeerEngine::lammps;
    int ranks = 1;
    Scene scene;  // with the laws of the other engine, the plan's choices filled in: our own run of it
                  // is the one to compare with
    Plan plan;    // of that scene

    std::vector<CarriedType> types;
    std::vector<CarriedPair> pairs;        // types x types, row-major, symmetric
    std::vector<CarriedSurface> surfaces;  // 0: the container and the scene's planes; then meshes
    std::vector<Face> faces;               // all planes, cylinders and plates at rest, as the run begins
    std::vector<Face> opened;              // those of the time after the outlet opens; empty: none opens
    std::vector<CarriedMesh> meshes;
    RunFrame frame = RunFrame::lab;
    DriveFormula drive;              // empty where nothing is driven
    std::vector<TurnFormula> turns;  // by face: its angle; empty expressions where it does not turn

    double step = 0;                   // s
    std::int64_t first = 0, last = 0;  // steps of the run in our count
    std::int64_t opens = 0;            // step at which the outlet opens, where `opened` has faces
    // Steps with a dump, in our count, rising; `first` and `last` are among them.
    std::vector<std::int64_t> dumps;

    // m: where grains can be, in the run's frame, with a margin. x is periodic where the depth is.
    Vec3 low{0, 0, 0}, high{0, 0, 0};
    bool periodic = false;
    double skin = 0;                   // m, of the neighbour lists
    std::array<int, 3> grid{0, 0, 0};  // of ranks; 0: the engine chooses
    bool balances = false;             // wants a load balancer: the bed is no slab

    // Whether the deck packs by itself, for so many steps before `first`. Its grains then lie apart on a
    // lattice, with radii and ids of ours.
    bool packs = false;
    std::int64_t packing_steps = 0;
    double packing_drag = 0;  // 1/s
    // Added to our count of steps there, so that packing has steps of its own.
    std::int64_t shift() const { return packs ? packing_steps - first : 0; }

    std::vector<CarryNote> changes, refusals;

    std::size_t type_count() const { return types.size(); }
    const CarriedPair& between(std::size_t a, std::size_t b) const { return pairs[a * types.size() + b]; }
    std::int64_t grains() const { return scene.grains_at_start(); }
    bool rides() const { return frame == RunFrame::container && !drive.empty(); }
};

// Dumps as the engines want them: so many steps apart, so often, from a step on.
struct DumpStretch {
    std::int64_t from = 0, every = 0, count = 0;  // dumps at from + every, ..., from + count * every
};
// steps: rising, at least one. The first of them is the start of the first stretch.
std::vector<DumpStretch> dump_stretches(const std::vector<std::int64_t>& steps);

}  // namespace grainreel
