// What one scene file says, after reading: plain values in SI units, with defaults filled in. x runs along
// the hopper's depth, y across its width, z up. The origin is the middle of the floor.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/measurable.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/output.hpp"

namespace grainreel {

class EnclosedRoom;   // engine/mesh/room.hpp, which only those include that look into a room
class Surface;        // engine/mesh/surface.hpp
struct TriangleMesh;  // engine/base/triangle_mesh.hpp

// A place in the scene file, for messages. Line and column count from 1. Line 0 means that the value is not
// in the file: it is a default, or it was set on the command line and `file` says so, e.g. "--set
// run.duration".
struct Location {
    std::string file;
    int line = 0;
    int column = 0;
};

// A large value that a scene shares with its copies. Two are equal if their hashes are.
template <class T>
struct Shared {
    std::shared_ptr<const T> of;
    const T* operator->() const { return of.get(); }
    const T& operator*() const { return *of; }
    explicit operator bool() const { return of != nullptr; }
    bool operator==(const Shared& other) const {
        return of == other.of || (of && other.of && of->hash() == other.of->hash());
    }
};

// Diameters of one species, m. `uniform`: evenly distributed between smallest and largest. `normal`: with
// mean and deviation, cut off at smallest and largest (two deviations from the mean).
struct SizeSpread {
    enum class Kind { fixed, uniform, normal };
    Kind kind = Kind::fixed;
    double smallest = 0, largest = 0;  // m; both equal the diameter when fixed
    double mean = 0, deviation = 0;    // m; deviation only with `normal`
    bool operator==(const SizeSpread&) const = default;
};

struct Species {
    std::string name;
    std::int64_t count = 0;  // at the start
    std::int64_t fed = 0;    // grains that come during the run
    SizeSpread diameter;
    double density = 0;       // kg/m3; from the mass at the mean diameter when the scene gives a mass
    std::string colour_text;  // as TOML; the engine only keeps it for drawing; empty if none is given
    std::int64_t all() const { return count + fed; }
    bool operator==(const Species&) const = default;
};

enum class NormalLaw { walton_braun, spring_dashpot, hertz };
enum class TangentialLaw { incremental_slip, linear_spring, mindlin, none };
// Where forces act: at the contact plane, which keeps angular momentum, or at the full radius, as in the
// original program (docs/notes/step.md compares it with this one).
enum class LeverArms { contact_plane, radius };

constexpr std::size_t kTablePoints = 8;  // largest number of points of a restitution that depends on speed

// One point of a restitution that depends on the speed of impact.
struct RestitutionPoint {
    double speed = 0;  // m/s
    double restitution = 1;
    bool operator==(const RestitutionPoint&) const = default;
};

// One kind of contact: between two species, or a species and the walls.
struct PairContact {
    NormalLaw normal = NormalLaw::walton_braun;
    TangentialLaw tangential = TangentialLaw::incremental_slip;  // none without friction
    double restitution = 0.9;                                    // in (0, 1]
    std::optional<double> restitution_speed;  // m/s, impact speed at which `restitution` holds; it falls with
                                              // speed. Empty: it holds at any speed
    std::vector<RestitutionPoint>
        restitution_table;                 // in place of `restitution`, by rising speed; empty: not used
    double friction = 0.5;                 // >= 0, may be infinite
    double rolling_friction = 0;           // the torque is at most this value x effective radius x N
    std::optional<double> stiffness;       // N/m: K1 or kn; Hertz: Pa, E*; the plan chooses it when empty
    double tangential_ratio = 0.8;         // K0 / K1, or kt / kn; Mindlin: 2 (1 - nu) / (2 - nu)
    double gamma = 1.0 / 3.0;              // exponent of Walton's incremental slip
    bool attraction = false;               // laws with a dashpot may pull at the end of contact
    std::optional<double> normal_damping;  // 1/s, force = value * m_eff * v; from the restitution when empty
    std::optional<double> tangential_damping;  // 1/s, as above; half of the normal damping when empty
    // Stiffness of contacts with glued grains, between grains of one species and glued ones of the other.
    // When empty it is `stiffness`; when both are empty the plan chooses it.
    std::optional<double> glued_stiffness;
    bool operator==(const PairContact&) const = default;
};

struct SceneContacts {
    LeverArms arms = LeverArms::contact_plane;
    std::vector<PairContact> grain;  // species x species, symmetric, row-major
    std::vector<PairContact> wall;   // one for each species
    std::vector<PairContact> mesh;   // mesh x species, row-major
    bool rubs() const;               // whether any of them has friction
    bool operator==(const SceneContacts&) const = default;
};

// An opening in the floor through which grains leave. It must be wider than the largest grain.
struct Outlet {
    enum class Shape { slot, hole };
    Shape shape = Shape::slot;  // a slot over the whole depth, or a round hole; both in the floor's middle
    double half_width = 0;      // m, along y; the radius of a hole
    double opens = 0;           // s, since the drive started
    double exit_depth = 0;      // m below the floor's rest position, where grains leave the run
    bool operator==(const Outlet&) const = default;
};

// A tray that stands still below an outlet and catches what flows out, so that nothing leaves the run. Its
// cross-section is that of a box as deep as the container, or round below a cylinder.
struct Tray {
    double depth = 0;       // m, of its floor below the container's floor at rest
    double half_width = 0;  // m, along y; the radius of a round one
    bool operator==(const Tray&) const = default;
};

// A layer of grains glued to faces of the container, which makes these rough. They are parts of the container
// and do not count as grains.
struct WallGrains {
    std::size_t species = 0;
    std::vector<std::string> faces;  // names of faces of the container at rest: "floor", "left slant"
    double spacing = 0;              // m, between neighbours in the layer
    double disorder = 0.2;  // the most by which each grain is moved at random, divided by the spacing
    bool operator==(const WallGrains&) const = default;
};

struct Container {
    enum class Shape { wedge, box, cylinder, mesh, none };
    Shape shape = Shape::wedge;  // none: empty space; the sizes are then those of the part that is looked at
    // For the shape `mesh`: the vessel's name, and the room that it encloses. Half-width, depth and height
    // are then those of the room, with the height from z = 0 to lid or rim.
    std::string mesh;
    Shared<EnclosedRoom> room;
    double half_width = 0;    // m, along y: y_max, at and above the slanted part; the radius of a cylinder
    double depth = 0;         // m, along x (front to back); unused by a cylinder
    double height = 0;        // m, from z = 0 (the floor) to lid or rim
    double half_angle = 0;    // rad, between slanted walls and the vertical; wedge only
    double slant_height = 0;  // m, H: height of the slanted part; wedge only
    bool lid = true;
    std::optional<Outlet> outlet;  // empty: a closed floor
    std::optional<Tray> tray;      // only below an outlet
    std::optional<WallGrains> wall_grains;
    bool periodic_depth = false;          // no front and back walls: what leaves at one enters at the other
    std::optional<BodyTurn> turn;         // turns walls, floor and lid together
    double base() const;                  // m, z of the lowest place: 0 except for a mesh
    double floor_half_width() const;      // m, along y, of the floor (y_max - H tan(half-angle) for a wedge)
    double volume() const;                // m3, base to height
    double volume_below(double z) const;  // m3, base to z, z in [base, height]
    // The free half-width (m) at height z above the floor.
    double half_width_at(double z) const;
    bool operator==(const Container&) const = default;
};

// A rotation about an axis through the origin, by the right-hand rule.
struct AxisRotation {
    Vec3 axis{0, 0, 1};  // unit
    double angle = 0;    // rad
    Quaternion quaternion() const;
    bool operator==(const AxisRotation&) const = default;
};

// A wall whose shape comes from a file.
struct SceneMesh {
    std::string name;
    std::string file;  // path
    std::string hash;  // of the file, as in load_mesh.hpp; a run writes it into its scene.toml, and reading
                       // that checks it
    double scale = 1;
    Vec3 position{0, 0, 0};  // m
    AxisRotation rotation;   // before it is moved to its position
    // Its motion: it has at most one of driven, turn, velocity and a path.
    bool driven = false;  // moves with the drive
    std::optional<BodyTurn> turn;
    Vec3 velocity{0, 0, 0};  // m/s, steady
    std::string path_file, path_hash;
    Shared<Surface> surface;  // where it is in the scene before anything moves
    Shared<MotionPath> path;
    // Corners (m) of the box in which it stays during the run, apart from the drive's motion. They follow
    // from the other members.
    Vec3 low{0, 0, 0}, high{0, 0, 0};
    bool moves() const { return driven || turn || !path_file.empty() || !velocity.isZero(0); }
    const TriangleMesh& shape() const;  // that of the surface
    // Compares the files by their hashes, not by their paths.
    bool operator==(const SceneMesh& other) const;
};

// A box that does not move. A grain leaves the run when its centre is in the box or, with `outside`, when it
// is not.
struct ExitBox {
    Vec3 low{0, 0, 0}, high{0, 0, 0};  // m
    bool outside = false;
    bool holds(const Vec3& place) const {  // m; whether a grain there leaves
        return ((place - low).minCoeff() >= 0 && (high - place).minCoeff() >= 0) != outside;
    }
    bool operator==(const ExitBox&) const = default;
};

// A box to fill with grains.
struct Region {
    Vec3 low{0, 0, 0}, high{0, 0, 0};                      // m
    double volume() const { return (high - low).prod(); }  // m3
    bool holds(const Vec3& place, double margin) const {   // at least margin (m) away from its sides
        return (place - low).minCoeff() >= margin && (high - place).minCoeff() >= margin;
    }
    bool operator==(const Region&) const = default;
};

// A plane anywhere, with the grains on one side of it.
struct ScenePlane {
    std::string name;
    Vec3 point{0, 0, 0};     // m
    Vec3 normal{0, 0, 1};    // unit, towards the grains
    Vec3 velocity{0, 0, 0};  // m/s, steady
    bool moves = false;      // follows the drive as well
    bool operator==(const ScenePlane&) const = default;
};

// A stage of the drive: from a certain time of the run on, the drive does something else.
struct DriveStage {
    enum class Kind { vibrate, taps, rest };
    Kind kind = Kind::vibrate;
    double from = 0;       // s; the change begins with the first period that starts then or later
    int over = 3;          // periods that the change takes, at least 3
    double frequency = 0;  // Hz; for a tap 1 / its duration; no meaning at rest
    double amplitude = 0;  // m; a tap goes up by twice as much and comes back; 0 at rest
    double interval = 0;   // s, from the start of a tap to that of the next; else 0
    bool operator==(const DriveStage&) const = default;
};

struct Drive {
    enum class Moves { container, floor };
    bool present = false;
    double frequency = 0;     // Hz
    double amplitude = 0;     // m
    Vec3 direction{0, 0, 1};  // unit
    double phase = 0;         // turns, of the sine at t = 0
    double ramp = 3;          // periods over which the amplitude grows; >= 3, or 0 for none
    Moves moves = Moves::container;
    std::vector<DriveStage> stages = {};   // by rising time; the values above hold until the first
    double g_level(double gravity) const;  // Gamma = a (2 pi f)^2 / g; infinite without gravity
    double speed() const;                  // m/s, a 2 pi f
    bool changes() const { return !stages.empty(); }
    // The largest values over all stages and the drive before them.
    double highest_frequency() const;                // Hz
    double largest_amplitude() const;                // m
    double top_speed() const;                        // m/s
    double strongest_g_level(double gravity) const;  // infinite without gravity
    bool operator==(const Drive&) const = default;
};

// A grain placed by hand.
struct ListedGrain {
    std::size_t species = 0;
    double diameter = 0;     // m
    Vec3 position{0, 0, 0};  // m
    Vec3 velocity{0, 0, 0};  // m/s
    Vec3 spin{0, 0, 0};      // rad/s
    bool operator==(const ListedGrain&) const = default;
};

// Grains that come during the run, one after the other at even intervals, at random places in a box.
struct Feed {
    std::size_t species = 0;
    double rate = 0;                      // 1/s
    std::optional<std::int64_t> count;    // the feed ends after so many grains
    double from = 0;                      // s
    std::optional<double> until;          // s; the run's end when empty
    Vec3 low{0, 0, 0}, high{0, 0, 0};     // m, corners of the box in which their centres appear
    Vec3 velocity{0, 0, 0};               // m/s
    std::int64_t due(double time) const;  // grains that have come up to this time (s)
    bool operator==(const Feed&) const = default;
};

struct Start {
    enum class Method { layers, rain, file, grains };
    Method method = Method::layers;
    std::string file;         // path: checkpoint of an earlier run, or its final.csv
    bool keep_clock = false;  // go on at the file's step and phase; needs a checkpoint, same step and drive
    double settle_limit = 5;  // s, the longest time of settling
    double settle_damping = 10;       // 1/s, extra drag on every grain while settling only; 0 for none
    std::optional<double> rain_rate;  // 1/s; the plan chooses it when empty
    std::optional<Region> region;     // box in which to pack the grains; the container's room when empty
    std::vector<ListedGrain> grains;  // with the method `grains`
    // Whether the grains are packed and settled before the drive starts.
    bool packs() const { return method == Method::layers || method == Method::rain; }
    bool operator==(const Start&) const = default;
};

// The method that makes the step; see engine/step/motion/scheme.hpp.
enum class Integrator { velocity_verlet, leapfrog, position_verlet, forest_ruth, gear };

// The level that decides the defaults of stiffness, step and corrections; docs/reference/accuracy.md has what
// each costs.
enum class Accuracy { draft, standard, reference };

// mixed: contact laws, their histories and relative motion in single precision, all else in double.
enum class Precision { full, mixed };

struct Run {
    double duration = 10;  // s, of vibration (or of simulated time without a drive)
    std::uint64_t seed = 1;
    int threads = 0;             // 0: as many as the machine gives
    std::optional<double> step;  // s; the plan chooses it when empty
    Accuracy accuracy = Accuracy::standard;
    double overlap = 0.01;  // wanted largest overlap, divided by the smaller diameter
    Integrator integrator = Integrator::velocity_verlet;
    Precision precision = Precision::full;
    bool contact_corrections = false;      // for onset, peak and exit (Walton-Braun)
    std::optional<int> steps_per_contact;  // the plan chooses by restitution when empty
    bool operator==(const Run&) const = default;
};

// What is kept on disk beside the film.
struct Output {
    std::optional<double>
        trajectory_interval;  // s between frames; one period when empty (1/30 s without drive)
    std::optional<double> measures_interval;  // s between rows; 1/8 of a period when empty
    bool orientation = false;                 // keep orientations in the trajectory
    bool contacts = false;                    // write contacts.nc beside it
    bool trajectory = true;
    // Whether film_moments.nc keeps the states that the film's pictures show. When empty, they are kept if
    // they are few.
    std::optional<bool> film_moments;
    AlsoFormats also;  // formats of other programs that the run also writes
    // Largest size (bytes) of all checkpoints that are kept along the run; none are kept when empty.
    std::optional<std::int64_t> checkpoints = 64'000'000;
    std::vector<std::string> instruments;  // names of what is measured in addition to the usual columns
    FieldOutput fields;
    bool operator==(const Output&) const = default;
};

// What a film or other users of a run need in addition to what [output] asks for.
struct Wishes {
    std::vector<std::string> instruments;  // also measured
    bool orientation = false;              // also kept, in frames and files
    bool operator==(const Wishes&) const = default;
};

struct Scene {
    std::string name;  // the file's stem, for the output folder
    std::string title;
    std::vector<Species> species;
    SceneContacts contact;
    Container container;
    std::vector<ScenePlane> walls;
    std::vector<SceneMesh> meshes;
    std::vector<ExitBox> exits;
    std::vector<Feed> feeds;
    Vec3 gravity{0, 0, -9.81};  // m/s2
    Drive drive;
    Start start;
    Run run;
    Output output;
    Wishes wishes;
    // The tables of [film] as TOML. The engine keeps them as they are; render/scene reads them.
    std::string film_text;

    // What can be measured, as far as the reader of the scene was told.
    Measurable measurable;

    // Notes to the user about values that the reader took in place of those written.
    std::vector<std::string> notes;

    // Where each value was written, by its key path ("species[1].count"), for messages about mistakes that
    // are found after reading.
    std::string file;
    std::map<std::string, Location> written;
    // "file:line:column" of the key, of its nearest written parent, or of the file's first line; for a
    // value from an option, the option: "--size".
    std::string where(const std::string& key) const;

    const SceneMesh* mesh_named(const std::string& mesh) const;             // null where there is none
    const SceneMesh* vessel() const { return mesh_named(container.mesh); }  // null except with Shape::mesh

    std::int64_t grains() const;  // number of all grains in the course of the run
    std::int64_t grains_at_start() const;
    bool keeps_orientations() const { return output.orientation || wishes.orientation; }
    // The instruments of [output] and those of `wishes`, each once.
    std::vector<std::string> instruments() const;
    const PairContact& between(std::size_t a, std::size_t b) const {
        return contact.grain[a * species.size() + b];
    }
};

}  // namespace grainreel
