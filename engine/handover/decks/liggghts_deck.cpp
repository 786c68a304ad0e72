// Writes the deck of LIGGGHTS: laws, walls of triangles, exit and feeds, forces, and times.
#include "engine/base/mathematics.hpp"
#include "engine/handover/decks/decks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "engine/handover/triangle_walls.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

using Lines = std::vector<std::string>;
constexpr int kSizesOfFeed = 5;  // so many sizes stand for a spread of sizes

bool is_prime(std::int64_t number) {
    for (std::int64_t k = 2; k * k <= number; ++k)
        if (number % k == 0) return false;
    return true;
}

// LIGGGHTS needs a different prime above 10000 for each random sequence.
class Seeds {
  public:
    explicit Seeds(std::uint64_t seed) : last_(static_cast<std::int64_t>(100000 + 1000 * (seed % 10000))) {}
    std::int64_t next() {
        do ++last_;
        while (!is_prime(last_));
        return last_;
    }

  private:
    std::int64_t last_;
};

class Deck {
  public:
    explicit Deck(const CarriedScene& carried)
        : carried_(carried), law_(liggghts_law(carried)), seeds_(carried.scene.run.seed) {}

    std::string text() {
        head();
        contacts();
        motion();
        set_up_walls(!carried_.opened.empty() && carried_.opens <= carried_.first);
        exit();
        feeds();
        outputs();
        run();
        std::string all;
        for (const std::string& line : lines_) all += line + "\n";
        return all;
    }

  private:
    template <class... Parts>
    void add(fmt::format_string<Parts...> form, Parts&&... parts) {
        lines_.push_back(fmt::format(form, std::forward<Parts>(parts)...));
    }
    void add_all(const Lines& lines) { lines_.insert(lines_.end(), lines.begin(), lines.end()); }
    std::int64_t there(std::int64_t step) const { return step + carried_.shift(); }
    const char* free() const { return glued_.empty() ? "all" : "free"; }

    void head() {
        add("# {}: written for LIGGGHTS-PUBLIC {}. Goes on with: -var goes_on 1 -var restart {}.STEP",
            carried_.scene.name, version_of(PeerEngine::liggghts), restart_name(PeerEngine::liggghts));
        add_all({"variable goes_on index 0", "variable restart index none"});
        add_all({"units si", "atom_style granular", "atom_modify map array"});
        add("boundary {} f f", carried_.periodic ? "p" : "f");
        add_all({"newton off", "communicate single vel yes", processors_line(carried_)});
        // The restart file also has the places of the walls, but no histories of contacts with them. So in a
        // run that continues, walls go on from where they were, and contacts with them begin anew.
        add("if \"${{goes_on}} == 0\" then \"read_data {}\" else \"read_restart ${{restart}}\"", data_name);
        add("neighbor {} bin", carried_.skin);
        add("neigh_modify delay 0 one 5000 page 200000");
        for (std::size_t t = 0; t < carried_.types.size(); ++t)
            if (carried_.types[t].glued) glued_ += fmt::format(" {}", t + 1);
        if (glued_.empty()) return;
        add("group glued type{}", glued_);
        add("group free subtract all glued");
    }

    void contacts() {
        add_all(law_.properties);
        add("pair_style gran {} {}", law_.model, law_.flags);
        add("pair_coeff * *");
        add("timestep {}", carried_.step);
    }

    void motion() {
        const Lines variables = variable_lines(carried_);
        add_all(variables);
        knows_time_ = !variables.empty();
        add_all(gravity_lines(carried_));
        if (!carried_.drive.empty() && !carried_.rides())
            for (int k = 0; k < 3; ++k)
                add("variable drive{} equal {}*v_speed", k, peer_number(carried_.drive.direction[k]));
        add("fix move {} nve/sphere", free());
        if (!glued_.empty()) add("fix glue glued freeze");
    }

    void needs_time() {
        if (!knows_time_) add("variable t equal {}", time_variable(carried_.shift()).expression);
        knows_time_ = true;
    }

    // Adds the fixes of all walls and of the contacts with them. When the outlet opens, the walls are
    // replaced: the fixes that were added before are removed first.
    void set_up_walls(bool opened) {
        for (auto fix = wall_fixes_.rbegin(); fix != wall_fixes_.rend(); ++fix) add("unfix {}", *fix);
        wall_fixes_.clear();
        const std::vector<TriangleWall> walls = triangle_walls(carried_, opened);
        if (walls.empty()) return;
        std::string names;
        for (const TriangleWall& wall : walls) {
            // LIGGGHTS refuses a mesh if a triangle has an angle smaller than `curvature`, unless it is told
            // to tolerate this. Round surfaces may have such triangles.
            add("fix {} all mesh/surface file {} type {} curvature {}{}", wall.id, wall.file,
                carried_.type_count() + wall.surface + 1, wall.curvature,
                wall.curvature > 1e-4 ? " curvature_tolerant yes" : "");
            wall_fixes_.push_back(wall.id);
            names += " " + wall.id;
            set_in_motion(wall);
        }
        const std::string force = opened ? "open_force" : "wall_force";
        add("fix {} all wall/gran {} mesh n_meshes {} meshes{} {}", force, law_.model, walls.size(), names,
            law_.flags);
        wall_fixes_.push_back(force);
    }

    void set_in_motion(const TriangleWall& wall) {
        if (wall.driven) {
            add("fix {}_drive all move/mesh mesh {} linear/variable v_drive0 v_drive1 v_drive2", wall.id,
                wall.id);
            wall_fixes_.push_back(wall.id + "_drive");
        }
        if (!wall.velocity.isZero(0)) {
            for (int k = 0; k < 3; ++k)
                add("variable {}_v{} equal (step>={})*{}", wall.id, k, there(0),
                    peer_number(wall.velocity[k]));
            add("fix {}_way all move/mesh mesh {} linear/variable v_{}_v0 v_{}_v1 v_{}_v2", wall.id, wall.id,
                wall.id, wall.id, wall.id);
            wall_fixes_.push_back(wall.id + "_way");
        }
        if (wall.rate.empty()) return;
        needs_time();
        add("variable {}_rate equal (step>={})*({})", wall.id, there(0), wall.rate);
        add("fix {}_turn all move/mesh mesh {} rotate/variable origin {} axis {} omega v_{}_rate", wall.id,
            wall.id, three(wall.through), three(wall.axis), wall.id);
        wall_fixes_.push_back(wall.id + "_turn");
    }

    void exit() {
        if (exit_plane(carried_).empty()) return;
        add("fix exit all mesh/surface file walls/exit.stl type {} curvature 1e-5",
            carried_.type_count() + 1);
        add("fix flow all massflow/mesh mesh exit count once vec_side 0. 0. -1. writeTime delete_atoms yes "
            "file "
            "outflow.txt");
    }

    void feeds() {
        const Scene& scene = carried_.scene;
        for (std::size_t f = 0; f < scene.feeds.size(); ++f) {
            const Feed& feed = scene.feeds[f];
            const double until = std::min(feed.until.value_or(scene.run.duration), scene.run.duration);
            const double most = std::floor(feed.rate * std::max(0.0, until - feed.from) + 1e-9);
            const auto count = std::min(feed.count.value_or(static_cast<std::int64_t>(most)),
                                        static_cast<std::int64_t>(most));
            if (count <= 0) continue;
            const std::vector<double> sizes = sizes_of(scene.species[feed.species]);
            std::string shares;
            for (std::size_t k = 0; k < sizes.size(); ++k) {
                add("fix feed{}_size{} all particletemplate/sphere {} atom_type {} density constant {} "
                    "radius "
                    "constant {}",
                    f, k, seeds_.next(), feed.species + 1, scene.species[feed.species].density, sizes[k] / 2);
                shares += fmt::format(" feed{}_size{} {}", f, k, 1.0 / static_cast<double>(sizes.size()));
            }
            add("fix feed{}_mix all particledistribution/discrete/numberbased {} {}{}", f, seeds_.next(),
                sizes.size(), shares);
            const auto [low, high] = clear_of_walls(feed, sizes.back() / 2);
            add("region feed{} block {} {} {} {} {} {} units box", f, low.x(), high.x(), low.y(), high.y(),
                low.z(), high.z());
            // One grain is inserted each time that one is due at the mean rate.
            const auto every = std::max<std::int64_t>(1, std::llround(1 / (feed.rate * carried_.step)));
            const auto start = there(std::max<std::int64_t>(1, std::llround(feed.from / carried_.step)));
            add("fix feed{} all insert/rate/region seed {} distributiontemplate feed{}_mix nparticles {} "
                "particlerate {} insert_every {} start {} overlapcheck yes vel constant {} region feed{} "
                "ntry_mc 10000",
                f, seeds_.next(), f, count, feed.rate, every, start, three(feed.velocity), f);
        }
    }

    // The part of a feed's box in which grains of this radius (m) touch no wall. Our feeds look for free
    // places; LIGGGHTS looks at other grains alone.
    std::pair<Vec3, Vec3> clear_of_walls(const Feed& feed, double radius) const {
        Vec3 low = feed.low, high = feed.high;
        for (const Face& face : carried_.faces) {
            if (face.body.number == kTrayBody) continue;
            if (face.kind == Face::Kind::cylinder) {
                // The square in the circle, unless all corners of the box are in it.
                const double most = face.radius - radius;
                const Vec3 corner = low.cwiseAbs().cwiseMax(high.cwiseAbs());
                if (math::hypot(corner.x(), corner.y()) <= most) continue;
                for (int k = 0; k < 2; ++k) {
                    low[k] = std::max(low[k], face.point[k] - most / std::numbers::sqrt2);
                    high[k] = std::min(high[k], face.point[k] + most / std::numbers::sqrt2);
                }
                continue;
            }
            // The box is cut along the axis nearest to the face's normal, so far that it is clear of the face
            // at all places along the other two.
            int axis = 0;
            face.normal.cwiseAbs().maxCoeff(&axis);
            double bound = radius + face.normal.dot(face.point);
            for (int k = 0; k < 3; ++k)
                if (k != axis) bound -= std::min(face.normal[k] * low[k], face.normal[k] * high[k]);
            bound /= face.normal[axis];
            if (face.normal[axis] > 0)
                low[axis] = std::max(low[axis], bound);
            else
                high[axis] = std::min(high[axis], bound);
        }
        for (int k = 0; k < 3; ++k)  // where there is no room, the engine says so
            if (low[k] > high[k]) low[k] = high[k] = 0.5 * (low[k] + high[k]);
        return {low, high};
    }

    // Diameters (m), each as frequent as the others. The spread is divided into kSizesOfFeed parts with
    // equally many grains, and the median of each part stands for it.
    static std::vector<double> sizes_of(const Species& species) {
        const SizeSpread& spread = species.diameter;
        if (spread.kind == SizeSpread::Kind::fixed || spread.smallest == spread.largest)
            return {spread.mean > 0 ? spread.mean : spread.largest};
        std::vector<double> sizes;
        for (int k = 0; k < kSizesOfFeed; ++k) {
            const double share = (k + 0.5) / kSizesOfFeed;
            if (spread.kind == SizeSpread::Kind::uniform) {
                sizes.push_back(spread.smallest + share * (spread.largest - spread.smallest));
            } else {
                // The quantiles of the normal distribution at 0.1, 0.3, ... 0.9.
                constexpr double quantiles[kSizesOfFeed] = {-1.2816, -0.5244, 0, 0.5244, 1.2816};
                sizes.push_back(std::clamp(spread.mean + quantiles[k] * spread.deviation, spread.smallest,
                                           spread.largest));
            }
        }
        return sizes;
    }

    void outputs() {
        const std::int64_t steps = carried_.last - carried_.first;
        add("thermo {}", std::max<std::int64_t>(1, steps / 100));
        add("thermo_style custom step atoms ke cpu");
        // With an exit plane below an outlet, missing grains are no error for LIGGGHTS. If a grain was lost
        // in another way, our count of grains throws (grain_count.hpp).
        add("thermo_modify lost {} norm no", exit_plane(carried_).empty() ? "error" : "ignore");
    }

    // Runs until a step. A run that continues skips this command if it is past the step already.
    void run_up_to(std::int64_t step) {
        add("if \"$(step) < {}\" then \"run {} upto\"", there(step), there(step));
    }

    void pack() {
        std::string drags;
        double first = 0;
        for (std::size_t t = 0; t < carried_.types.size(); ++t) {
            const CarriedType& type = carried_.types[t];
            const double mass = std::numbers::pi / 6 * math::cube(type.mean) * type.density;
            if (t == 0)
                first = mass * carried_.packing_drag;
            else
                drags += fmt::format(" scale {} {}", t + 1, mass * carried_.packing_drag / first);
        }
        if (first > 0) add("fix drag {} viscous {}{}", free(), first, drags);
        run_up_to(carried_.first);
        if (first > 0) add("unfix drag");
    }

    void run() {
        if (carried_.packs) pack();
        lines_.push_back(restart_line(carried_));
        bool waits = !carried_.opened.empty() && carried_.opens > carried_.first;
        bool begun = false;
        for (const DumpPace& pace : dump_paces(carried_.dumps)) {
            add("variable nextdump equal {}", pace.next_text(carried_.shift()));
            if (!begun) {
                add("dump grains {} custom 1 {} id type radius x y z vx vy vz omegax omegay omegaz", free(),
                    dump_name(PeerEngine::liggghts));
                add("if \"${{goes_on}} == 0\" then \"dump_modify grains first yes\" else \"dump_modify "
                    "grains "
                    "append yes\"");
                add("dump_modify grains every v_nextdump sort id format \"%d %d{}\"", ten_numbers());
            }
            begun = true;
            if (waits && carried_.opens < pace.end()) {
                if (carried_.opens > pace.from) run_up_to(carried_.opens);
                set_up_walls(true);
                waits = false;
            }
            run_up_to(pace.end());
        }
        add("write_restart {}", end_name);
    }

    static std::string ten_numbers() {
        std::string text;
        for (int k = 0; k < 10; ++k) text += " %.9g";
        return text;
    }

    const CarriedScene& carried_;
    const LiggghtsLaw law_;
    Seeds seeds_;
    Lines lines_, wall_fixes_;
    std::string glued_;  // types of glued grains
    bool knows_time_ = false;
};

}  // namespace

std::size_t liggghts_types(const CarriedScene& carried) {
    return carried.type_count() + std::max<std::size_t>(1, carried.surfaces.size());
}

std::string liggghts_deck(const CarriedScene& carried) {
    return Deck(carried).text();
}

}  // namespace grainreel
