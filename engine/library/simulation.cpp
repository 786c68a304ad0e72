// The library's Simulation, with which another program runs a scene step by step.
#include "engine/library/internal.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/library/new_grains.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/start/restart.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "grainreel/simulation.hpp"

namespace grainreel::v1 {
namespace {

// Puts the caller's laws into the plan, for the contacts that were chosen.
class LawChooser {
  public:
    LawChooser(const grainreel::Scene& scene, Plan& plan) : scene_(scene), plan_(plan) {}

    void choose(const LawChoice& choice, const LawKernel& law) {
        const std::vector<bool> first = named(choice.first, "first");
        const bool only_walls = choice.second == "wall" || choice.second == "walls";
        const bool walls = choice.second.empty() || only_walls;
        const std::vector<bool> second =
            only_walls ? std::vector<bool>(first.size(), false) : named(choice.second, "second");
        const std::size_t n = first.size();
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < n; ++b)
                if ((first[a] && second[b]) || (first[b] && second[a])) take(plan_.grain[a * n + b], law);
        for (std::size_t a = 0; a < n && walls; ++a) {
            if (!first[a]) continue;
            take(plan_.wall[a], law);
            if (!plan_.glued.empty()) take(plan_.glued[a], law);
            for (std::size_t m = 0; m < scene_.meshes.size(); ++m) take(plan_.mesh[m * n + a], law);
        }
    }

  private:
    static void take(PairPlan& pair, const LawKernel& law) {
        pair.model.own = &law;
        pair.model.precision = Precision::full;
        // This makes the loop compute spins and arms, which the law needs.
        if (pair.model.tangential == TangentialLaw::none)
            pair.model.tangential = TangentialLaw::linear_spring;
    }
    // member: that of LawChoice from which the name comes.
    std::vector<bool> named(const std::string& name, const std::string& member) const {
        std::vector<bool> chosen;
        std::vector<std::string> names;
        for (const Species& one : scene_.species) {
            chosen.push_back(name.empty() || one.name == name);
            names.push_back(one.name);
        }
        if (contains(chosen, true)) return chosen;
        throw Error(fmt::format("a contact law is chosen for {} = \"{}\"; it may be {}{}, or empty for any",
                                member, name, fmt::join(names, ", "), member == "second" ? ", walls" : ""));
    }

    const grainreel::Scene& scene_;
    Plan& plan_;
};

// The name of a law in messages: "law 0 of SimulationOptions::laws (of "big" and "walls")".
std::string name_of_law(std::size_t number, const LawChoice& choice) {
    const auto named = [](const std::string& name) { return name.empty() ? "any" : '"' + name + '"'; };
    return fmt::format("law {} of SimulationOptions::laws (of {} and {})", number, named(choice.first),
                       named(choice.second));
}

double share_of(const PackingProgress& progress) {
    return std::clamp(progress.done, 0.0, 1.0);
}

}  // namespace

struct Simulation::Impl {
    Impl(const v1::Scene& read, const SimulationOptions& options)
        : scene(read), inner(read.impl().scene), plan(read.impl().plan) {
        check_threads(options.threads);
        inner.run.threads = options.threads > 0 ? options.threads : inner.run.threads;
        LawChooser chooser(inner, plan);
        for (const LawChoice& choice : options.laws)
            chooser.choose(choice, laws.emplace_back(choice.law, name_of_law(laws.size(), choice)).kernel());
    }
    void rethrow() {
        for (OwnLaw& law : laws) law.rethrow();
    }
    // Calls a function of the program, in which laws of the caller may act. What a law has thrown goes before
    // what the program says, because the program sees only what came of it.
    template <class Call>
    auto with_laws(const Call& call) -> decltype(call()) {
        try {
            return told(call);
        } catch (const Error&) {
            rethrow();
            throw;
        }
    }

    v1::Scene scene;
    std::deque<OwnLaw> laws;  // declared before `running`, so that they outlive it
    grainreel::Scene inner;
    Plan plan;
    std::unique_ptr<grainreel::SimulatedBed> running;
    bool packed = false;

    void need_grains() {
        if (!packed) throw Error("the grains are not placed yet; call pack() or advance() first");
    }
};

Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Simulation::Simulation(const Scene& scene, const SimulationOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {
    Impl& m = *impl_;
    m.running = told(
        [&] { return std::make_unique<grainreel::SimulatedBed>(m.inner, m.plan, engine_threads(m.inner)); });
}

namespace {

// The run at a checkpoint. The program's messages name the scene's key start.file, which a user of the
// library has not written; here they begin with the checkpoint's name.
std::unique_ptr<grainreel::SimulatedBed> at_checkpoint(const grainreel::Scene& scene, const Plan& plan,
                                                       const std::filesystem::path& file) {
    const std::string name = file.string();
    if (!is_plain(file)) throw Error(fmt::format("{}: there is no such file", name));
    if (!is_checkpoint(file))
        throw Error(
            fmt::format("{}: is no checkpoint; give a file that save_checkpoint() or a run wrote", name));
    try {
        return std::make_unique<grainreel::SimulatedBed>(
            grainreel::SimulatedBed::at_checkpoint(scene, plan, file, engine_threads(scene)));
    } catch (const UserError& error) {
        grainreel::Scene there = scene;
        there.start.file = name;
        const std::string what = error.what(), damaged = damaged_checkpoint(there).what();
        if (what == damaged && is_whole_checkpoint(file))
            throw Error(
                fmt::format("{}: its contacts do not fit the contact laws of this simulation; give the same "
                            "SimulationOptions::laws as in the run that wrote it",
                            name));
        const std::string start = fmt::format("{}: '{}' ", scene.where("start.file"), name);
        throw Error(what.starts_with(start) ? fmt::format("{}: {}", name, what.substr(start.size())) : what);
    }
}

}  // namespace

Simulation Simulation::from_checkpoint(const Scene& scene, const std::filesystem::path& checkpoint,
                                       const SimulationOptions& options) {
    auto impl = std::make_unique<Impl>(scene, options);
    impl->running = told([&] { return at_checkpoint(impl->inner, impl->plan, checkpoint); });
    impl->packed = true;
    return Simulation(std::move(impl));
}

bool Simulation::pack(const std::function<bool(double)>& watcher) {
    Impl& m = *impl_;
    if (m.packed) return true;
    const PackingResult result = m.with_laws([&] {
        return m.running->pack([&](const PackingProgress& progress) {
            m.rethrow();
            return !watcher || watcher(share_of(progress));
        });
    });
    m.rethrow();
    m.packed = result.finished;
    return m.packed;
}

namespace {

// The last step for which a double still holds every step before it: 2^53.
constexpr double most_steps = 9007199254740992.0;

}  // namespace

double Simulation::advance(double until) {
    Impl& m = *impl_;
    if (!std::isfinite(until)) throw Error(fmt::format("advance({}): is no time", until));
    const double target = std::round(until / m.plan.clock.step);
    if (target > most_steps)
        throw Error(
            fmt::format("advance({}): is later than {:.4g} s, after which steps of {:.4g} s cannot be "
                        "counted",
                        until, most_steps * m.plan.clock.step, m.plan.clock.step));
    pack();
    if (target > static_cast<double>(step())) advance_steps(static_cast<std::int64_t>(target) - step());
    return time();
}

void Simulation::advance_steps(std::int64_t steps) {
    Impl& m = *impl_;
    if (steps < 0) throw Error(fmt::format("advance_steps({}): must be at least 0", steps));
    pack();
    if (static_cast<double>(step()) + static_cast<double>(steps) > most_steps)
        throw Error(
            fmt::format("advance_steps({}): steps can be counted up to {:.4g}, and the run is at step {}",
                        steps, most_steps, step()));
    m.with_laws([&] { m.running->advance(m.running->step() + steps); });
    m.rethrow();
}

double Simulation::time() const {
    return impl_->plan.clock.time(impl_->running->step());
}
std::int64_t Simulation::step() const {
    return impl_->running->step();
}
bool Simulation::finished() const {
    return step() >= impl_->plan.steps;
}
const Scene& Simulation::scene() const {
    return impl_->scene;
}

Frame Simulation::frame() const {
    impl_->need_grains();
    return outside(impl_->running->frame());
}

std::vector<Contact> Simulation::contacts() const {
    impl_->need_grains();
    std::vector<Contact> contacts;
    for (const grainreel::DetailedContact& one : impl_->running->contact_forces())
        contacts.push_back({.first = one.first,
                            .second = one.second,
                            .normal = outside(one.normal),
                            .point = outside(one.point),
                            .overlap = one.overlap,
                            .normal_force = one.normal_force,
                            .tangential_force = outside(one.tangential),
                            .stored_energy = one.stored_energy,
                            .triangle = one.triangle});
    impl_->rethrow();
    return contacts;
}

std::vector<Measure> Simulation::measures() const {
    impl_->need_grains();
    const Measures row = impl_->running->measures();
    impl_->rethrow();
    std::vector<Measure> measures;
    for (std::size_t k = 0; k < row.names().size(); ++k)
        measures.push_back({row.names()[k], row.values()[k]});
    return measures;
}

namespace {

// Says what to write for a column that an instrument would give, and else names the nearest column.
Error no_column(const grainreel::Scene& scene, const std::vector<std::string>& there,
                const std::string& name) {
    const std::string what = fmt::format("'{}' is no column of this scene's measures", name);
    for (const MeasureColumn& column : measure_columns(scene))
        if (column.name == name && !column.instrument.empty())
            return Error(
                fmt::format("{}; the instrument {} gives it: the scene needs output.instruments = [\"{}\"]",
                            what, column.instrument, column.instrument));
    const std::optional<std::string> meant = nearest_name(name, there);
    return Error(meant ? fmt::format("{}; '{}' is one", what, *meant) : what);
}

}  // namespace

double Simulation::measure(const std::string& column) const {
    impl_->need_grains();
    const std::vector<std::string>& names = impl_->running->measured();
    if (!contains(names, column)) throw no_column(impl_->inner, names, column);
    const double value = impl_->running->measure(column);
    impl_->rethrow();
    return value;
}

std::vector<Field> Simulation::fields() const {
    impl_->need_grains();
    const std::vector<const FieldSet*> sets = impl_->running->field_sets();
    std::vector<FieldValues> values = impl_->running->fields();
    impl_->rethrow();
    std::vector<Field> fields;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (std::size_t f = 0; f < sets[s]->fields.size(); ++f) {
            const FieldInfo& info = sets[s]->fields[f];
            Field& field = fields.emplace_back();
            field.name = info.name;
            field.unit = info.unit;
            field.values = std::move(values[s][f]);
            for (const std::string& name : info.axes)
                for (const grainreel::MeasuredAxis& axis : sets[s]->axes)
                    if (axis.name == name) field.axes.push_back({axis.name, axis.unit, axis.at});
        }
    }
    return fields;
}

std::uint64_t Simulation::state_hash() const {
    impl_->need_grains();
    return impl_->running->state_hash();
}

std::int32_t Simulation::insert(const std::vector<NewGrain>& grains) {
    Impl& m = *impl_;
    m.need_grains();
    const grainreel::State now = m.running->frame();
    RoomForGrains room(m.inner, m.plan, now);
    std::vector<grainreel::ComingGrain> inner;
    for (const NewGrain& grain : grains) inner.push_back(room.take(grain));
    return told([&] { return m.running->insert(inner); });
}

void Simulation::remove(const std::vector<std::int32_t>& ids) {
    Impl& m = *impl_;
    m.need_grains();
    const std::vector<std::int32_t> there = m.running->frame().id;
    for (const std::int32_t id : ids)
        if (!std::binary_search(there.begin(), there.end(), id))
            throw Error(fmt::format("remove: there is no grain {}", id));
    told([&] { m.running->remove(ids); });
}

void Simulation::save_checkpoint(const std::filesystem::path& file) const {
    impl_->need_grains();
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (!is_folder(folder))
        throw Error(fmt::format("{}: there is no folder {}; make it first", file.string(), folder.string()));
    told([&] { impl_->running->save_checkpoint(file); });
}

}  // namespace grainreel::v1
