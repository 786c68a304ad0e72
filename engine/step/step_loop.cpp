#include "engine/step/step_loop.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/system/processor.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/step/forces/contact_forces.hpp"
#include "engine/step/lists/large_bed.hpp"
#include "engine/step/motion/integrate.hpp"

namespace grainreel {

StepLoop::StepLoop(const Plan& plan, const Surroundings& surroundings, Grains& grains, Team& team)
    : around_(surroundings),
      grains_(grains),
      team_(team),
      rules_(plan, surroundings.period),
      scheme_(scheme_of(plan.integrator)),
      clock_(plan.clock),
      lists_(rules_, around_, grains_, team_),
      members_(team.size()) {
    check_meshes();
}

// Runs until step `from` + `count`. Where grains may leave, the threads stop, and the run goes on without
// those that leave.
void StepLoop::run(std::int64_t from, std::int64_t count, double step, double drag) {
    const std::int64_t to = from + count;
    while (from < to && grains_.size() > 0) {
        grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
        KickInput kicks{around_.gravity, rules_.rubs};
        if (fresh_) {
            lists_.life().set_step(static_cast<double>(from));
            first_step_ = from;
            if (scheme_.corrects) begin_derivatives(grains_, kicks);
        }
        fresh_ = false;
        if (drag > 0) kicks.keep = math::exp(-drag * step / static_cast<double>(scheme_.stages.size()));
        const auto work = [&](int member) { run_member(member, from, to, step, kicks); };
        if (device_)
            run_on_device(from, to, step, kicks);
        else
            team_.run(std::ref(work));  // by reference: no copy on the heap
        first_step_ = kGoesOn;
        from = members_[0].reached;
        end_with_fault();
        if (!around_.exits.empty()) let_leave(from);
    }
}

// One thread's part of the steps `from` to `to`. It stops earlier where a grain may leave. A thread reads and
// writes only its own grains. Of other threads' grains it reads copies, which exchange() brings.
//
// A kick is a change of velocity by the forces. The half kick that ends a step is made in move(), together
// with the half kick that begins the next step. In most integrators a step has one stage, that is, one
// evaluation of forces.
void StepLoop::run_member(int member, std::int64_t from, std::int64_t to, double step, KickInput kicks) {
    const FlushDenormals flush(rules_.has_floats);
    Member& mine = members_[member];
    ThreadContacts& contacts = lists_.contacts(member);
    mine.clock.start();
    Evaluations evaluations(scheme_, around_.motion, step, from, first_step_);
    Evaluation at = evaluations.now();
    kicks.loaded = &contacts.loaded;
    set_kicks(evaluations, at, step, kicks);
    copy_foreign(member);
    for (bool first = true; evaluations.step_number() < to; first = false) {
        move(member, first, kicks);  // half a kick and the drift
        const bool leaves = evaluations.ends_step() && (contacts.fault || may_leave(member, step));
        mine.clock.lap(Cost::integrate);

        mine.walls.set(around_, at.before, at.now, at.since);
        if (mine.walls.tally) mine.tally.begin_evaluation(at.acts / step);
        const Told all = exchange(member, {kicks, first}, leaves);
        mine.clock.lap(Cost::other);
        lists_.renew(member, all.fastest, all.parted, at, step, kicks.frame);
        mine.clock.lap(Cost::neighbours);

        const std::int64_t at_step = evaluations.step_number();
        const ForceTimes times{at.since,
                               scheme_.ahead,
                               at.acts,
                               scheme_.corrects ? 0 : at.since,
                               lists_.life().reach(member).moved,
                               kicks.keep < 1};
        evaluations.go_on();
        if (all.may_leave) to = evaluations.step_number();
        const bool goes_on = evaluations.step_number() < to;
        if (goes_on) {
            at = evaluations.now();
            set_kicks(evaluations, at, step, kicks);
        }
        send_ahead(member, goes_on, kicks);
        // From here to the formula of a contact law: add_contact_forces() -> the law's kernel
        // (docs/notes/step.md).
        add_contact_forces({rules_, grains_, mine.walls, around_.glued, around_.meshes, times}, grains_,
                           contacts, mine.memory, mine.ahead, mine.clock);
        if (contacts.fault && contacts.fault->step < 0) contacts.fault->step = at_step;
    }
    end_run(member, step, kicks);
    mine.reached = evaluations.step_number();
    mine.clock.lap(Cost::integrate);
}

void StepLoop::set_kicks(const Evaluations& evaluations, const Evaluation& at, double step,
                         KickInput& kicks) const {
    evaluations.set_kicks(kicks);
    kicks.frame = lists_.life().frame(at, step);
}

void StepLoop::move(int member, bool first, const KickInput& kicks) {
    Member& mine = members_[member];
    const std::int32_t begin = lists_.begin(member), end = lists_.end(member);
    if (scheme_.corrects) {
        if (!first) correct(grains_, kicks, begin, end);
        mine.fastest = predict(grains_, kicks, begin, end);
    } else if (first) {
        mine.fastest = kick_and_drift(grains_, kicks, begin, end);
    } else {
        const Vec3 behind = kick_and_go_on(grains_, kicks, mine.ahead.next, end);
        mine.fastest = mine.ahead.fastest.cwiseMax(behind);
    }
}

// Allows grains to begin the next step as soon as their loads are complete. Vanguard
// (forces/contact_forces.hpp) says where this pays.
void StepLoop::send_ahead(int member, bool goes_on, const KickInput& kicks) {
    const bool pays = team_.size() > 1 || is_large_bed(grains_);
    const bool may = goes_on && pays && !scheme_.corrects;
    const std::int32_t begin = lists_.begin(member);
    members_[member].ahead = {begin, may ? lists_.end(member) : begin, kicks};
}

// Copies the grains of other threads as they are now. No thread may move a grain meanwhile, so there is a
// barrier before and after.
void StepLoop::copy_foreign(int member) {
    if (team_.size() == 1) return;
    team_.barrier(member);
    lists_.contacts(member).halo.copy(grains_);
    team_.barrier(member);
}

// Exchanges grains and messages with the other threads, in each evaluation. This is the only place in a step
// where threads wait for each other, unless lists are made. Returns the messages of all threads together,
// which are the same on every thread.
StepLoop::Told StepLoop::exchange(int member, const FreeFlight& flight, bool may_leave) {
    Member& mine = members_[member];
    ThreadContacts& contacts = lists_.contacts(member);
    mine.box = 1 - mine.box;
    mine.told[mine.box] = {mine.fastest, contacts.parted(), may_leave};
    const Loaded* const loaded = scheme_.corrects ? nullptr : &contacts.loaded;
    for (int other = 0; other < team_.size(); ++other)
        if (other != member) lists_.contacts(other).halo.put(grains_, loaded, member, mine.box);
    team_.barrier(member);
    contacts.halo.get(grains_, mine.box, flight);
    Told all;
    for (const Member& m : members_) {
        all.fastest = all.fastest.cwiseMax(m.told[mine.box].fastest);
        all.parted += m.told[mine.box].parted;
        all.may_leave |= m.told[mine.box].may_leave;
    }
    return all;
}

void StepLoop::end_run(int member, double step, KickInput kicks) {
    const std::int32_t begin = lists_.begin(member), end = lists_.end(member);
    kicks.drift = step;
    if (scheme_.corrects) return correct(grains_, kicks, begin, end);
    kicks.end_kick = step * scheme_.stages.back().kick;
    kick(grains_, kicks, begin, end);
    kicks.drift = step * scheme_.closing_drift;
    if (kicks.drift > 0) drift(grains_, kicks, begin, end);
}

void StepLoop::restart() {
    grains_.rounded.resize(rules_.rounds ? grains_.size() : 0);
    fresh_ = true;
    if (grains_.size() == 0) return lists_.begin_empty();
    lists_.restart();
    for (Member& m : members_) m.fastest.setZero();
    const DrivePose rest = around_.motion.at(-1);
    team_.run([&](int member) {
        WallState& walls = members_[member].walls;
        walls.set(around_, rest, rest, 0);
        lists_.rebuild(member, rest, 0, ListLife::kLastsWell);
        // The first half kick needs the forces at the present positions. A step of length zero computes them.
        const std::int32_t begin = lists_.begin(member), end = lists_.end(member);
        round_motion(grains_, {}, begin, end);
        for (std::int32_t i = begin; i < end; ++i) grains_.load[i] = {};
        copy_foreign(member);
        Vanguard none;
        CostClock idle;
        add_contact_forces({rules_, grains_, walls, around_.glued, around_.meshes, {}}, grains_,
                           lists_.contacts(member), members_[member].memory, none, idle);
    });
    lists_.clear_counts();
    end_with_fault();
}

void StepLoop::time_costs(bool on) {
    for (Member& m : members_) m.clock.turn(on);
}

void StepLoop::clear_costs() {
    for (Member& m : members_) m.clock.clear();
}

std::array<double, kCosts> StepLoop::cost_shares() const {
    std::array<double, kCosts> shares{};
    double all = 0;
    for (const Member& m : members_) {
        for (int s = 0; s < kCosts; ++s) shares[s] += m.clock.spent()[s], all += m.clock.spent()[s];
    }
    for (double& share : shares) share /= all;
    return shares;
}

void StepLoop::visit_contacts(std::int64_t at_step,
                              const std::function<void(const ContactView&)>& visit) const {
    WallState walls;
    const DrivePose pose = around_.motion.at(at_step);
    walls.set(around_, pose, pose, 0);
    const ForceInput in{rules_, grains_, walls, around_.glued, around_.meshes, {}};
    std::vector<ContactView> late;
    const auto keep = [&](const ContactView& seen) { late.push_back(seen); };
    for (std::size_t g = 0; g < rules_.groups.size(); ++g) {
        late.clear();
        for (int m = 0; m < team_.size(); ++m) view_contacts(in, g, lists_.contacts(m), visit, keep);
        // Each thread owns a stretch of the grains, so visiting the threads in turn gives the ordered
        // contacts the same order on any number of threads.
        std::sort(late.begin(), late.end(), [](const ContactView& a, const ContactView& b) {
            if (a.first != b.first) return a.first < b.first;
            if (a.second != b.second) return a.second > b.second;
            return a.glued != b.glued ? a.glued < b.glued : a.triangle < b.triangle;
        });
        for (const ContactView& seen : late) visit(seen);
    }
}

void StepLoop::save(std::ostream& out) const {
    lists_.save(out);
    if (traffic_.any()) write_value(out, traffic_);
}

void StepLoop::load(Bytes& in, std::int64_t at_step) {
    lists_.load(in, around_.motion.at(at_step));
    if (!in.failed() && in.left() > 0) read_value(in, traffic_);
    if (in.failed() || !is_traffic_sound()) return in.fail();
    fresh_ = false;
}

bool StepLoop::is_traffic_sound() const {
    constexpr std::int64_t kMostIds = std::int64_t{1} << 31;
    const Traffic& t = traffic_;
    const auto known = [&](std::int32_t id) { return id < t.next_id; };
    return !t.any() || (t.came >= 0 && t.left >= 0 && t.openings >= 0 && std::isfinite(t.energy_in) &&
                        std::isfinite(t.energy_out) && std::isfinite(t.work_out) && t.next_id <= kMostIds &&
                        (t.came == 0 || std::all_of(grains_.id.begin(), grains_.id.end(), known)));
}

void StepLoop::take_histories(const HistoryOf& history_of) {
    constexpr std::int64_t kBefore = -1;  // walls are where restart() had them
    lists_.take_histories(history_of);
    sum_loads_anew(std::vector<bool>(grains_.size(), true), kBefore);
}

// Faults that end a run within the step loop. Threads note them and stop together at the end of the next
// step.

namespace {

std::string text_of(const MeshFault& fault, const Clock& clock, const std::string& mesh) {
    const Vec3& x = fault.position;
    const std::string where =
        fmt::format("step {} ({:.6g} s): grain {} at ({:.4g}, {:.4g}, {:.4g}) m", fault.step,
                    clock.time(fault.step), fault.grain, x.x(), x.y(), x.z());
    if (fault.kind == MeshFault::Kind::many_patches)
        return fmt::format(
            "{} touches the mesh {} at more than {} places at once; take larger grains or a mesh without "
            "such "
            "fine folds",
            where, mesh, kMostPatches);
    return fmt::format(
        "{} went through the mesh {} (its centre came to triangle {}); take a smaller run.step or a larger "
        "contact.wall.stiffness",
        where, mesh, fault.triangle);
}

}  // namespace

// Checks that triangles can be numbered: a history holds the number of a triangle as a float or a double.
void StepLoop::check_meshes() const {
    constexpr std::int32_t kMostInFloats = 1 << 24;
    GRAINREEL_CHECK(rules_.group_of_mesh.size() >=
                    around_.meshes.size() * static_cast<std::size_t>(rules_.species));
    for (std::size_t m = 0; m < around_.meshes.size(); ++m) {
        const std::int32_t triangles = around_.meshes[m].surface->size();
        for (std::int32_t s = 0; s < rules_.species && triangles > kMostInFloats; ++s)
            if (rules_.groups[rules_.group_of(static_cast<std::int32_t>(m), s)].number_size() ==
                sizeof(float))
                throw UserError(
                    "the mesh {} has {} triangles, and with run.precision = \"mixed\" a mesh may "
                    "have at most {}; "
                    "take run.precision = \"full\" or a coarser mesh",
                    around_.meshes[m].name, triangles, kMostInFloats);
    }
}

// Throws for the earliest fault of all threads. Among the faults of one step, the grain with the lowest id
// counts.
void StepLoop::end_with_fault() const {
    const MeshFault* first = nullptr;
    for (int m = 0; m < team_.size(); ++m) {
        const auto& fault = lists_.contacts(m).fault;
        if (fault && (!first || std::tie(fault->step, fault->grain) < std::tie(first->step, first->grain)))
            first = &*fault;
    }
    if (first) throw RunError(text_of(*first, clock_, around_.meshes[first->mesh].name));
}

}  // namespace grainreel
