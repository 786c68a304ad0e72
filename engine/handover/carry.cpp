#include "engine/handover/carry.hpp"

#include <algorithm>

#include "engine/base/error.hpp"
#include "engine/handover/carry_parts.hpp"
#include "engine/plan/resolved_scene.hpp"

namespace grainreel {

const char* name_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "LAMMPS" : "LIGGGHTS";
}

const char* key_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "lammps" : "liggghts";
}

const char* version_of(PeerEngine engine) {
    return engine == PeerEngine::lammps ? "29 Sep 2021" : "3.8.0";
}

void add_change(CarriedScene& carried, const std::string& where, const std::string& what,
                const std::string& why) {
    carried.changes.push_back({where, what, why});
}

void add_refusal(CarriedScene& carried, const std::string& where, const std::string& what) {
    carried.refusals.push_back({where, what, {}});
}

CarriedScene carry(const Scene& scene, const Plan& plan, const CarryRequest& request) {
    CarriedScene carried;
    carried.engine = request.engine;
    carried.ranks = request.ranks;
    carried.scene = with_choices(scene, plan);
    carry_laws(request, plan, carried);
    if (!carried.refusals.empty()) {
        // The rest is looked at all the same, so that everything is said at once.
        carried.plan = plan;
        carry_walls(carried);
        carry_run(request, carried);
        return carried;
    }
    carried.plan = make_plan(carried.scene);
    carry_contacts(request, carried);
    carry_walls(carried);
    carry_run(request, carried);
    return carried;
}

std::string refusal_text(const CarryNote& note) {
    return note.where + (note.where.empty() ? "" : ": ") + note.what;
}

void throw_refusals(const CarriedScene& carried) {
    std::string text;
    for (const CarryNote& note : carried.refusals) text += (text.empty() ? "" : "\n") + refusal_text(note);
    if (!text.empty()) throw UserError(text);
}

std::vector<DumpStretch> dump_stretches(const std::vector<std::int64_t>& steps) {
    std::vector<DumpStretch> all;
    for (std::size_t i = 1; i < steps.size(); ++i) {
        const std::int64_t every = steps[i] - steps[i - 1];
        if (!all.empty() && all.back().every == every)
            ++all.back().count;
        else
            all.push_back({steps[i - 1], every, 1});
    }
    return all;
}

}  // namespace grainreel
