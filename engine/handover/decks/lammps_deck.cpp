// Writes the deck of LAMMPS: contacts in the words of pair_style granular, walls as regions with fixes,
// forces, and times.
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/handover/carry.hpp"
#include "engine/handover/decks/decks.hpp"

namespace grainreel {

namespace {

// A kind of contact in the words of LAMMPS' pair_style granular and its walls:
// "hooke 9600 2647 tangential linear_history 2742 0 0.5 damping mass_velocity limit_damping"
std::string lammps_law(const CarriedPair& pair) {
    const bool hertz = pair.law == CarriedLaw::hertz;
    GRAINREEL_CHECK(hertz || pair.law == CarriedLaw::spring_dashpot);
    // LAMMPS divides by the tangential stiffness, even without friction.
    const double tangential = pair.tangential > 0 ? pair.tangential : 2.0 / 7 * pair.stiffness;
    // For Hertz, tangential_damping is a ratio already.
    const double share = hertz              ? pair.tangential_damping
                         : pair.damping > 0 ? pair.tangential_damping / pair.damping
                                            : 0;
    std::string text =
        hertz ? fmt::format("hertz {} {} tangential mindlin_rescale/force", pair.stiffness,
                            tsuji_restitution(pair.damping).value_or(1))
              : fmt::format("hooke {} {} tangential linear_history", pair.stiffness, pair.damping);
    text += fmt::format(" {} {} {}", tangential, share, pair.friction);
    if (pair.rolling > 0) text += fmt::format(" rolling sds {} 0.0 {}", tangential, pair.rolling);
    text += hertz ? " damping tsuji" : " damping mass_velocity";
    if (!pair.attraction) text += " limit_damping";
    return text;
}

// A face of the scene as a region of LAMMPS.
struct LammpsRegion {
    std::string name;                    // "w0_floor"; a floor with a slot has two: "w0_floor_left_open"
    std::string text;                    // the whole command
    std::vector<std::string> variables;  // commands that must come before it
};

constexpr double kEndless = 1000;   // m, length of a cylinder, so that no grain reaches its ends
constexpr double kThickness = 0.5;  // thickness of a plate, divided by the smallest radius of grains

std::string word(const std::string& name, std::size_t number) {
    std::string word = fmt::format("w{}_", number);
    for (const char c : name) word += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return word;
}

class Regions {
  public:
    Regions(const CarriedScene& carried, bool opened)
        : carried_(carried), faces_(opened ? carried.opened : carried.faces) {
        double smallest = INFINITY;
        for (const CarriedType& type : carried.types) smallest = std::min(smallest, type.smallest / 2);
        thick_ = kThickness * smallest;
    }

    std::vector<LammpsRegion> all() {
        for (std::size_t f = 0; f < faces_.size(); ++f) add_face(f);
        return std::move(regions_);
    }

  private:
    void add_face(std::size_t f) {
        const Face& face = faces_[f];
        const std::string name = word(face.name, f);
        if (face.kind == Face::Kind::cylinder)
            return add(f, name,
                       fmt::format("cylinder z {} {} {} {} {} side in", face.point.x(), face.point.y(),
                                   face.radius, -kEndless, kEndless));
        if (face.ends && face.gap > 0) return add_slot(f, name);
        if (face.ends && face.normal.z() > 0 && face.normal.y() != 0) return add_slant(f, name);
        // A wall that ends at the floor becomes an endless plane. Below the floor it does no harm, because
        // grains that fall through the slot do not reach it.
        add(f, name, fmt::format("plane {} {} side in", three(face.point), three(face.normal)));
    }
    // A floor with a slot along x is a thin block on each side. A wide gap leaves no block.
    void add_slot(std::size_t f, const std::string& name) {
        const double half = carried_.scene.container.floor_half_width(), gap = faces_[f].gap;
        if (gap >= half) return;
        const double x = beyond();
        for (const double side : {-1.0, 1.0})
            add(f, fmt::format("{}_{}_open", name, side < 0 ? "left" : "right"),
                fmt::format("block {} {} {} {} {} 0.0 side out", -x, x, std::min(side * gap, side * half),
                            std::max(side * gap, side * half), -thick_));
    }
    // A slanted wall that ends at the floor is a prism, sheared along y.
    void add_slant(std::size_t f, const std::string& name) {
        const Container& c = carried_.scene.container;
        const double x = beyond(), foot = c.floor_half_width(), out = c.half_width - foot;
        const bool left = faces_[f].normal.y() > 0;
        add(f, name + "_open",
            fmt::format("prism {} {} {} {} 0.0 {} 0.0 0.0 {} side out", -x, x,
                        left ? -foot - 2 * thick_ : foot, left ? -foot : foot + 2 * thick_, c.slant_height,
                        left ? -out : out));
    }
    double beyond() const { return carried_.scene.container.depth; }  // m, a distance beyond the container

    void add(std::size_t f, const std::string& name, const std::string& shape) {
        LammpsRegion region{name, {}, {}};
        region.text = fmt::format("region {} {} units box{}", name, shape, motion(f, region.variables));
        regions_.push_back(region);
    }
    std::string motion(std::size_t f, std::vector<std::string>& variables) const {
        const Body& body = faces_[f].body;
        const bool driven = body.driven && !carried_.drive.empty() && !carried_.rides();
        std::string text;
        if (driven || !body.velocity.isZero(0)) {
            text += " move";
            for (int axis = 0; axis < 3; ++axis) {
                const double along = driven ? carried_.drive.direction[axis] : 0, speed = body.velocity[axis];
                if (along == 0 && speed == 0) {
                    text += " NULL";
                    continue;
                }
                std::string way;
                if (along != 0) way = fmt::format("{}*v_shift", peer_number(along));
                if (speed != 0) way += fmt::format("{}{}*v_t", way.empty() ? "" : "+", peer_number(speed));
                const std::string variable = fmt::format("move{}{}", f, "xyz"[axis]);
                variables.push_back(fmt::format("variable {} equal {}", variable, way));
                text += " v_" + variable;
            }
        }
        if (body.turn && !carried_.turns[f].empty())
            text +=
                fmt::format(" rotate v_angle{} {} {}", f, three(body.turn->through), three(body.turn->axis));
        return text;
    }

    const CarriedScene& carried_;
    const std::vector<Face>& faces_;
    double thick_ = 0;  // m
    std::vector<LammpsRegion> regions_;
};

// The regions of all faces when the run begins, or after the outlet has opened. Names of faces that the
// outlet changes end in "_open".
std::vector<LammpsRegion> lammps_regions(const CarriedScene& carried, bool opened) {
    return Regions(carried, opened).all();
}

// The regions in which grains leave the run: the scene's exits, and the room below its outlet.
std::vector<LammpsRegion> lammps_exits(const CarriedScene& carried) {
    std::vector<LammpsRegion> all;
    const auto add = [&](const std::string& shape) {
        const std::string name = fmt::format("exit{}", all.size());
        all.push_back({name, fmt::format("region {} {} units box", name, shape), {}});
    };
    for (const ExitBox& exit : carried.scene.exits)
        add(fmt::format("block {} {} {} {} {} {} side {}", exit.low.x(), exit.high.x(), exit.low.y(),
                        exit.high.y(), exit.low.z(), exit.high.z(), exit.outside ? "out" : "in"));
    if (const auto& outlet = carried.scene.container.outlet; outlet && !carried.scene.container.tray)
        add(fmt::format("block INF INF INF INF INF {} side in", -outlet->exit_depth));
    return all;
}

constexpr int kLookForGone = 200;  // steps between two searches for grains to remove

class LammpsDeck {
  public:
    explicit LammpsDeck(const CarriedScene& carried) : carried_(carried) {
        for (std::size_t t = 0; t < carried.type_count(); ++t)
            (carried.types[t].glued ? glued_ : free_) += fmt::format(" {}", t + 1);
        for (const CarriedPair& pair : carried.pairs) hertz_ |= pair.law == CarriedLaw::hertz;
    }

    std::string text() {
        head();
        contacts();
        motion();
        walls(!carried_.opened.empty() && carried_.opens <= carried_.first);
        forces();
        course();
        std::string all;
        for (const std::string& line : lines_) all += line + "\n";
        return all;
    }

  private:
    template <class... Parts>
    void add(fmt::format_string<Parts...> format, Parts&&... parts) {
        lines_.push_back(fmt::format(format, std::forward<Parts>(parts)...));
    }
    void add_all(const std::vector<std::string>& more) {
        lines_.insert(lines_.end(), more.begin(), more.end());
    }
    std::string there(std::int64_t step) const { return fmt::format("{}", step + carried_.shift()); }

    void head() {
        add("# Handed over by grainreel, for LAMMPS {}. Goes on with: -var goes_on 1 -var restart {}.STEP",
            version_of(carried_.engine), restart_name(carried_.engine));
        add("variable goes_on index 0");
        add("variable restart index none");
        add("units si");
        add("atom_style sphere");
        add("boundary {} f f", carried_.periodic ? 'p' : 'f');
        add("newton off");
        add("comm_modify mode single vel yes");
        lines_.push_back(processors_line(carried_));
        add("if \"${{goes_on}} == 0\" then \"read_data {}\" else \"read_restart ${{restart}}\"", data_name);
        add("neighbor {} bin", carried_.skin);
        add("neigh_modify delay 0 every 1 check yes one 4000");
        add("timestep {}", carried_.step);
    }

    void contacts() {
        add("pair_style granular");
        const std::size_t types = carried_.type_count();
        for (std::size_t a = 0; a < types; ++a)
            for (std::size_t b = a; b < types; ++b)
                add("pair_coeff {} {} {}", a + 1, b + 1, lammps_law(carried_.between(a, b)));
        add("group free type{}", free_);
        for (std::size_t a = 0; a < types; ++a)
            if (!carried_.types[a].glued) add("group type{} type {}", a + 1, a + 1);
        if (glued_.empty()) return;
        add("group glued type{}", glued_);
        add("neigh_modify exclude group glued glued");
    }

    void motion() {
        std::vector<std::string> variables = variable_lines(carried_);
        const bool steady = std::any_of(carried_.faces.begin(), carried_.faces.end(),
                                        [](const Face& face) { return !face.body.velocity.isZero(0); });
        if (variables.empty() && steady)
            variables.push_back("variable t equal " + time_variable(carried_.shift()).expression);
        add_all(variables);
    }

    // A fix for each face and type, or one for all types if they have the same law.
    void walls(bool opened) {
        const std::vector<CarriedPair>& with = carried_.surfaces.front().with;
        std::vector<std::string> laws;
        for (std::size_t t = 0; t < with.size(); ++t)
            if (!carried_.types[t].glued) laws.push_back(lammps_law(with[t]));
        const bool same = std::set<std::string>(laws.begin(), laws.end()).size() == 1;
        std::set<std::string> now;
        for (const LammpsRegion& region : lammps_regions(carried_, opened)) {
            now.insert(region.name);
            if (standing_.count(region.name) > 0) continue;
            add_all(region.variables);
            lines_.push_back(region.text);
            for (std::size_t t = 0; t < (same ? 1 : laws.size()); ++t) {
                const std::string group = same ? "free" : fmt::format("type{}", t + 1);
                add("fix {}_{} {} wall/gran/region granular {} region {}", region.name, group, group, laws[t],
                    region.name);
                fixes_.push_back({region.name, fmt::format("{}_{}", region.name, group)});
            }
        }
        for (const auto& [region, fix] : fixes_)
            if (now.count(region) == 0) add("unfix {}", fix);
        std::erase_if(fixes_, [&](const auto& one) { return now.count(one.first) == 0; });
        standing_ = now;
    }

    void forces() {
        add_all(gravity_lines(carried_));
        if (!glued_.empty()) add("fix stuck glued freeze");
        add("fix motion free nve/sphere");
        const std::vector<LammpsRegion> exits = lammps_exits(carried_);
        for (std::size_t e = 0; e < exits.size(); ++e) {
            lines_.push_back(exits[e].text);
            add("fix gone{} free evaporate {} {} {} {}", e, kLookForGone, 1000000000, exits[e].name,
                1 + carried_.scene.run.seed % 900000000);
        }
        if (carried_.balances) add("fix share all balance 10000 1.1 shift xy 10 1.05");
        add("thermo {}", std::max<std::int64_t>(1, (carried_.last - carried_.first) / 100));
        add("thermo_style custom step atoms ke cpu");
        add("thermo_modify lost error flush yes");
    }

    void drag() {
        double first = 0;
        std::string scales;
        for (std::size_t t = 0; t < carried_.type_count(); ++t) {
            const CarriedType& type = carried_.types[t];
            const double force =
                std::numbers::pi / 6 * math::cube(type.mean) * type.density * carried_.packing_drag;
            if (t == 0)
                first = force;
            else
                scales += fmt::format(" scale {} {}", t + 1, force / first);
        }
        if (first > 0) add("fix drag free viscous {}{}", first, scales);
    }

    // A run that continues leaves out the commands `run` up to steps that it has passed. `pre no` is for
    // Hertz: LAMMPS of 29 Sep 2021 changes a wall's damping at each further run that is set up.
    void run_up_to(std::int64_t step, bool again) {
        const std::string target = there(step);
        add("if \"$(step) < {}\" then \"run {} upto{}\"", target, target, again && hertz_ ? " pre no" : "");
    }

    void course() {
        if (carried_.packs) {
            drag();
            run_up_to(carried_.first, false);
            if (carried_.packing_drag > 0) add("unfix drag");
        }
        lines_.push_back(restart_line(carried_));
        bool waits = !carried_.opened.empty() && carried_.opens > carried_.first, begun = false;
        for (const DumpPace& pace : dump_paces(carried_.dumps)) {
            add("variable nextdump equal {}", pace.next_text(carried_.shift()));
            if (!begun) {
                add("dump grains free custom 1 {} id type radius x y z vx vy vz omegax omegay omegaz",
                    dump_name(carried_.engine));
                add("if \"${{goes_on}} == 0\" then \"dump_modify grains first yes\" else \"dump_modify "
                    "grains "
                    "append yes\"");
                add("dump_modify grains every v_nextdump sort id format float %.9g flush yes");
            }
            if (waits && carried_.opens < pace.end()) {
                if (carried_.opens > pace.from) run_up_to(carried_.opens, begun);
                walls(true);
                waits = false;
            }
            run_up_to(pace.end(), begun);
            begun = true;
        }
        add("write_restart {}", end_name);
    }

    const CarriedScene& carried_;
    std::string free_, glued_;  // types of free and of glued grains
    bool hertz_ = false;
    std::set<std::string> standing_;                          // regions that stay as they are
    std::vector<std::pair<std::string, std::string>> fixes_;  // the region and the name of each fix
    std::vector<std::string> lines_;
};

}  // namespace

std::string lammps_deck(const CarriedScene& carried) {
    return LammpsDeck(carried).text();
}

}  // namespace grainreel
