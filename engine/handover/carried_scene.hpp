// CarriedScene holds a scene in the form that the deck (input script) of another engine (LAMMPS or LIGGGHTS)
// needs: numbers in SI units, exact formulas, and all that had to be changed or refused. carry() makes it;
// the code of the decks only writes it down and computes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/handover/drive_formula.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

enum class PeerEngine { lammps, liggghts };
const char* name_of(PeerEngine engine);  // "LAMMPS"
const char* key_of(PeerEngine engine);   // "lammps", as on the command line
// The version for which the decks were written and tested.
const char* version_of(PeerEngine engine);

// A type of atoms in the engine, which counts them from 1: species in their order, then glued grains.
struct CarriedType {
    std::string name;
    double mean = 0, smallest = 0, largest = 0;  // m, diameters
    double density = 0;                          // kg/m3
    bool glued = false;                          // part of a wall, which never moves in the run's frame
    bool spread() const { return largest > smallest; }
};

// A contact law of the other engine. N: normal force; d: overlap; v: speed at which the two part.
enum class CarriedLaw {
    spring_dashpot,  // N = k d - c v, and a linear tangential spring with Coulomb's limit
    hertz,           // N = 4/3 E* sqrt(R) d^1.5, and Mindlin's spring
    luding,          // Walton-Braun with a restitution that falls with speed: K2 = K1 + S F_max
    edinburgh        // Walton-Braun; only on one rank
};

// One kind of contact: two types, or a type and a surface.
struct CarriedPair {
    CarriedLaw law = CarriedLaw::spring_dashpot;
    bool touches = true;             // false: they never meet, and the scene does not describe them
    double stiffness = 0;            // N/m; hertz: 4/3 E* in Pa; luding and edinburgh: K1
    double unloading = 0;            // N/m, K2 of edinburgh
    double hardening = 0;            // 1/m, S of luding
    double tangential = 0;           // N/m; hertz: 8 G* in Pa
    double damping = 0;              // 1/s, c / m_eff; hertz: alpha of Tsuji's dashpot (carry.hpp)
    double tangential_damping = 0;   // 1/s; hertz: divided by the normal damping
    double restitution = 1;          // for two of mean size, as the scene wants it
    double lowest = 1, highest = 1;  // range for other sizes, because all have the same damping
    double effective_mass = 0;    // kg, for two of mean size; surfaces and glued grains are infinitely heavy
    double effective_radius = 0;  // m, as above
    double friction = 0;          // always finite; kEndlessFriction stands for infinity
    double rolling = 0;           // the torque is at most this times effective radius times N
    bool attraction = false;      // whether the dashpot may pull
};
inline constexpr double kEndlessFriction = 1e4;

// A kind of wall surface: the contact of each type of atoms with it.
struct CarriedSurface {
    std::string name;               // "walls", or the name of a mesh
    std::vector<CarriedPair> with;  // by type
};

// A wall of triangles.
struct CarriedMesh {
    std::size_t number = 0;   // index in the scene's meshes
    std::size_t surface = 0;  // index in CarriedScene::surfaces
};

// A refusal, which ends the command, or a change: what the run has in place of what the scene says.
struct CarryNote {
    std::string where;  // "file:line:column"; empty if it belongs to no key
    std::string what;   // one line
    std::string why;    // one line, with the measured effect; empty for refusals
};

// The frame of reference of the run. In the container's frame all walls stand still, and grains feel minus
// its acceleration.
enum class ReferenceFrame { lab, container };

struct CarriedScene {
    PeerEngine engine = PeerEngine::lammps;
    int ranks = 1;                           // processes of the engine (MPI)
    std::string engine_option, pack_option;  // of the verb in use (CarryRequest), for messages
    Scene scene;  // with the other engine's laws and the plan's choices; our run for comparison takes it
    Plan plan;    // of that scene

    std::vector<CarriedType> types;
    std::vector<CarriedPair> pairs;        // types x types, row-major, symmetric
    std::vector<CarriedSurface> surfaces;  // container and planes of the scene, then one for each mesh
    std::vector<Face> faces;               // all planes, cylinders and plates at rest, as the run begins
    std::vector<Face> opened;              // the same after the outlet has opened; empty if none opens
    std::vector<CarriedMesh> meshes;
    ReferenceFrame frame = ReferenceFrame::lab;
    DriveFormula drive;              // empty where nothing is driven
    std::vector<TurnFormula> turns;  // angle of each face; empty expressions where it does not turn

    double step = 0;                   // s
    std::int64_t first = 0, last = 0;  // first and last step of the run, as we count
    std::int64_t opens = 0;            // step at which the outlet opens, if `opened` has faces
    // Steps with a dump, as we count, rising. They include `first` and `last`.
    std::vector<std::int64_t> dumps;

    // Corners (m) of the box in which grains can be, in the run's frame and with a margin. x is periodic if
    // the depth is.
    Vec3 low{0, 0, 0}, high{0, 0, 0};
    bool periodic = false;
    double skin = 0;                   // m, of the neighbour lists
    std::array<int, 3> grid{0, 0, 0};  // number of ranks along x, y, z; 0: the engine chooses
    bool balances = false;             // needs a load balancer, because the bed is no slab

    // Whether the deck packs the grains itself, for so many steps before `first`. They then start on a
    // lattice, with our radii and ids.
    bool packs = false;
    std::int64_t packing_steps = 0;
    double packing_drag = 0;  // 1/s
    // The engine's steps are ours plus this number, because it counts the packing steps before our step
    // `first`.
    std::int64_t shift() const { return packs ? packing_steps - first : 0; }

    std::vector<CarryNote> changes, refusals;

    std::size_t type_count() const { return types.size(); }
    const CarriedPair& between(std::size_t a, std::size_t b) const { return pairs[a * types.size() + b]; }
    std::int64_t grains() const { return scene.grains_at_start(); }
    bool rides() const { return frame == ReferenceFrame::container && !drive.empty(); }
};

}  // namespace grainreel
