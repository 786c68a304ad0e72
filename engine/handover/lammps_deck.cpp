#include "engine/handover/decks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

namespace grainreel {

namespace {

constexpr int kLookForGone = 200;  // steps between looks for grains to remove

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

    // A fix a face and type, or one for all types that have the same law.
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
                std::numbers::pi / 6 * std::pow(type.mean, 3) * type.density * carried_.packing_drag;
            if (t == 0)
                first = force;
            else
                scales += fmt::format(" scale {} {}", t + 1, force / first);
        }
        if (first > 0) add("fix drag free viscous {}{}", first, scales);
    }

    // In a run that goes on, what lies behind it is left out.
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
    std::string free_, glued_;  // their types
    bool hertz_ = false;
    std::set<std::string> standing_;                          // regions
    std::vector<std::pair<std::string, std::string>> fixes_;  // region and fix
    std::vector<std::string> lines_;
};

}  // namespace

std::string lammps_deck(const CarriedScene& carried) {
    return LammpsDeck(carried).text();
}

}  // namespace grainreel
