// The library's Simulation, with which another program runs a scene step by step.
#include "engine/library/internal.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "grainreel/simulation.hpp"

namespace grainreel::v1 {
namespace {

// Puts the caller's laws into the plan, for the contacts that were chosen.
class LawChooser {
  public:
    LawChooser(const grainreel::Scene& scene, Plan& plan) : scene_(scene), plan_(plan) {}

    void choose(const LawChoice& choice, const LawKernel& law) {
        const std::vector<bool> first = named(choice.first);
        const bool walls = choice.second.empty() || choice.second == "walls";
        const std::vector<bool> second =
            choice.second == "walls" ? std::vector<bool>(first.size(), false) : named(choice.second);
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
    std::vector<bool> named(const std::string& name) const {
        std::vector<bool> chosen;
        std::vector<std::string> names;
        for (const Species& one : scene_.species) {
            chosen.push_back(name.empty() || one.name == name);
            names.push_back(one.name);
        }
        if (std::find(chosen.begin(), chosen.end(), true) != chosen.end()) return chosen;
        throw Error(fmt::format("a contact law is chosen for '{}'; the species are {}", name,
                                fmt::join(names, ", ")));
    }

    const grainreel::Scene& scene_;
    Plan& plan_;
};

double share_of(const PackingProgress& progress) {
    return std::clamp(progress.done, 0.0, 1.0);
}

}  // namespace

struct Simulation::Impl {
    Impl(const v1::Scene& read, const SimulationOptions& options)
        : scene(read), inner(read.impl().scene), plan(read.impl().plan) {
        if (options.threads < 0) throw Error("threads: must be at least 0");
        inner.run.threads = options.threads > 0 ? options.threads : inner.run.threads;
        LawChooser chooser(inner, plan);
        for (const LawChoice& choice : options.laws)
            chooser.choose(choice, laws.emplace_back(choice.law).kernel());
    }
    void rethrow() {
        for (OwnLaw& law : laws) law.rethrow();
    }

    v1::Scene scene;
    std::deque<OwnLaw> laws;  // declared before `running`, so that they outlive it
    grainreel::Scene inner;
    Plan plan;
    std::unique_ptr<grainreel::Simulation> running;
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
        [&] { return std::make_unique<grainreel::Simulation>(m.inner, m.plan, engine_threads(m.inner)); });
}

Simulation Simulation::from_checkpoint(const Scene& scene, const std::filesystem::path& checkpoint,
                                       const SimulationOptions& options) {
    auto impl = std::make_unique<Impl>(scene, options);
    impl->running = told([&] {
        return std::make_unique<grainreel::Simulation>(grainreel::Simulation::at_checkpoint(
            impl->inner, impl->plan, checkpoint, engine_threads(impl->inner)));
    });
    impl->packed = true;
    return Simulation(std::move(impl));
}

bool Simulation::pack(const std::function<bool(double)>& watcher) {
    Impl& m = *impl_;
    if (m.packed) return true;
    const PackingResult result = told([&] {
        return m.running->pack([&](const PackingProgress& progress) {
            m.rethrow();
            return !watcher || watcher(share_of(progress));
        });
    });
    m.rethrow();
    m.packed = result.finished;
    return m.packed;
}

double Simulation::advance(double until) {
    Impl& m = *impl_;
    if (!std::isfinite(until)) throw Error(fmt::format("advance({}): is no time", until));
    pack();
    const auto target = static_cast<std::int64_t>(std::llround(until / m.plan.clock.step));
    if (target > step()) advance_steps(target - step());
    return time();
}

void Simulation::advance_steps(std::int64_t steps) {
    Impl& m = *impl_;
    if (steps < 0) throw Error(fmt::format("advance_steps({}): must be at least 0", steps));
    pack();
    told([&] { m.running->advance(m.running->step() + steps); });
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
    for (const grainreel::ContactForce& one : impl_->running->contact_forces())
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
    std::vector<Measure> measures;
    for (std::size_t k = 0; k < row.names().size(); ++k)
        measures.push_back({row.names()[k], row.values()[k]});
    return measures;
}

double Simulation::measure(const std::string& column) const {
    impl_->need_grains();
    const std::vector<std::string>& names = impl_->running->measured();
    if (std::find(names.begin(), names.end(), column) != names.end()) return impl_->running->measure(column);
    const std::optional<std::string> meant = nearest_name(column, names);
    throw Error(fmt::format("'{}' is no column of this scene's measures{}", column,
                            meant ? fmt::format("; '{}' is one", *meant) : ""));
}

std::vector<Field> Simulation::fields() const {
    impl_->need_grains();
    const std::vector<const FieldSet*> sets = impl_->running->field_sets();
    std::vector<FieldValues> values = impl_->running->fields();
    std::vector<Field> fields;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (std::size_t f = 0; f < sets[s]->fields.size(); ++f) {
            const FieldInfo& info = sets[s]->fields[f];
            Field& field = fields.emplace_back();
            field.name = info.name;
            field.unit = info.unit;
            field.values = std::move(values[s][f]);
            for (const std::string& name : info.axes)
                for (const grainreel::FieldAxis& axis : sets[s]->axes)
                    if (axis.name == name) field.axes.push_back({axis.name, axis.unit, axis.at});
        }
    }
    return fields;
}

std::uint64_t Simulation::state_hash() const {
    impl_->need_grains();
    return impl_->running->state_hash();
}

namespace {

grainreel::NewGrain grain_inside(const NewGrain& grain, const grainreel::Scene& scene) {
    if (grain.species < 0 || grain.species >= std::ssize(scene.species))
        throw Error(
            fmt::format("a new grain is of species {}; there are {}", grain.species, scene.species.size()));
    const Species& kind = scene.species[static_cast<std::size_t>(grain.species)];
    const bool fits = grain.radius >= 0.5 * kind.diameter.smallest * (1 - 1e-9) &&
                      grain.radius <= 0.5 * kind.diameter.largest * (1 + 1e-9);
    if (!fits)
        throw Error(fmt::format("a new grain has a radius of {} m; those of {} have {} to {} m", grain.radius,
                                kind.name, 0.5 * kind.diameter.smallest, 0.5 * kind.diameter.largest));
    grainreel::NewGrain inner;
    inner.species = grain.species;
    inner.radius = grain.radius;
    inner.density = grain.density > 0 ? grain.density : kind.density;
    inner.position = inside(grain.position);
    inner.velocity = inside(grain.velocity);
    inner.spin = inside(grain.spin);
    if (!inner.position.allFinite() || !inner.velocity.allFinite() || !inner.spin.allFinite() ||
        !std::isfinite(inner.density))
        throw Error("a new grain has a number that is none");
    return inner;
}

void check_is_free(const grainreel::NewGrain& grain, const Vec3& other, double radius) {
    if ((grain.position - other).norm() >= grain.radius + radius) return;
    throw Error(fmt::format("a new grain at ({:.4g}, {:.4g}, {:.4g}) m touches another; choose a free place",
                            grain.position.x(), grain.position.y(), grain.position.z()));
}

}  // namespace

std::int32_t Simulation::insert(const std::vector<NewGrain>& grains) {
    Impl& m = *impl_;
    m.need_grains();
    const grainreel::Frame now = m.running->frame();
    std::vector<grainreel::NewGrain> inner;
    for (const NewGrain& grain : grains) {
        inner.push_back(grain_inside(grain, m.inner));
        for (std::size_t i = 0; i < now.size(); ++i)
            check_is_free(inner.back(), now.position[i], now.radius[i]);
        for (std::size_t i = 0; i + 1 < inner.size(); ++i)
            check_is_free(inner.back(), inner[i].position, inner[i].radius);
    }
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
    told([&] { impl_->running->save_checkpoint(file); });
}

}  // namespace grainreel::v1
