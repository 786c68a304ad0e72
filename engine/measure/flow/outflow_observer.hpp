// The observer of outflow: the mass of each species that has left, its rate, and the time at which the
// container was empty. Masses are whole numbers of a quantum, so that no rounding adds up.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"
#include "engine/scene/scene.hpp"
#include "engine/step/geometry/wall_sums.hpp"

namespace grainreel {

// Masses as whole numbers, species by species. The masses that have come, stayed and left then agree to the
// last digit, in whatever order they are summed.
using MassCounts = std::vector<WideInt>;

WideInt total(const MassCounts& counts);

// The mass (kg) of one count, a power of two. It is 1 to 2 times 2^-60 of `largest`, the mass of the heaviest
// grain.
double mass_quantum(double largest);
WideInt mass_count(double mass, double quantum);

// The largest mass (kg) that a grain of the scene may have.
double largest_mass(const Scene& scene);

// Sums the mass that the feeds have given, and goes on from the last call.
class FedMass {
  public:
    // The scene must outlive this object.
    explicit FedMass(const Scene& scene) : scene_(scene) {}

    // Masses in counts, by species, of the first `given` grains of each feed. No number of `given` may be
    // smaller than at the last call.
    const MassCounts& of(std::span<const std::int64_t> given, double quantum);

  private:
    const Scene& scene_;
    double quantum_ = 0;
    std::vector<std::int64_t> given_;  // numbers of grains that are summed already
    MassCounts sums_;
};

}  // namespace grainreel

namespace grainreel::observers {

// The mass that has left is the mass at the start of the drive, plus what feeds have given since, minus the
// present mass. If grains have come from anywhere but the feeds, this mass is not known, and all values are
// NaN. A grain that has fallen below the floor into a tray has left.
class Outflow final : public Observer {
  public:
    static constexpr const char* instrument = "outflow";

    static std::vector<ColumnGroup> columns(const Scene& scene) {
        std::vector<ColumnGroup> groups{
            {{{"outflow_kg", "mass that flowed out", Dimension::mass}}, "kg", "since the drive started"},
            {{{"outflow_rate", "mass flow", Dimension::mass_flow}},
             "kg/s",
             "mean mass flow since the row before"}};
        for (const Species& species : scene.species)
            groups.push_back(
                {{{column_part(species.name) + "_outflow", "share of " + species.name + " in the outflow"}},
                 "1",
                 "share of a species in the mass that has flowed out"});
        groups.push_back({{{"emptied_s", "time to empty", Dimension::time}},
                          "s",
                          "when less than 1 % of the most that was inside was left; NaN until then"});
        return groups;
    }

    Outflow(const Scene& scene, const Plan& plan) : rows_(plan), fed_(scene) {}

    std::int64_t gathers_after(std::int64_t step) const override { return rows_.after(step); }
    void start(const ObservedState& m) override {
        double largest = largest_mass(m.scene);
        for (std::size_t i = 0; i < m.grains.size(); ++i) largest = std::max(largest, m.grains.mass(i));
        for (const Departure& one : m.left_at_start) largest = std::max(largest, one.mass);
        quantum_ = mass_quantum(largest);
        at_start_ = inside(m);
        const MassCounts& came = fed_.of(m.fed, quantum_);
        for (std::size_t s = 0; s < came.size(); ++s) at_start_[s] -= came[s];
        WideInt left = 0;
        for (const Departure& one : m.left_at_start) {
            const WideInt mass = mass_count(one.mass, quantum_);
            at_start_[one.species] += mass;
            left += mass;
        }
        most_ = total(inside(m));
        before_ = last_ = {m.step, left};
    }
    void gather(const ObservedState& m) override {
        before_ = last_;
        last_ = {m.step, total(gone(m))};
        const WideInt now = total(inside(m));
        most_ = std::max(most_, now);
        if (std::isnan(emptied_) && most_ > 0 && 100 * now < most_) emptied_ = m.clock.time(m.step);
    }
    void look(const ObservedState& m, std::vector<double>& row) override {
        const std::int64_t fed = std::accumulate(m.fed.begin(), m.fed.end(), std::int64_t{0});
        if (m.traffic.came > fed) return add_no_values(row, 3 + m.scene.species.size());
        const Noted& from = last_.step < m.step ? last_ : before_;
        const MassCounts left = gone(m);
        const auto kilograms = [&](WideInt counts) { return quantum_ * static_cast<double>(counts); };
        const double all = kilograms(total(left));
        row.insert(row.end(), {all, kilograms(total(left) - from.gone) / m.clock.time(m.step - from.step)});
        for (const WideInt species : left) row.push_back(kilograms(species) / all);
        row.push_back(emptied_);
    }
    void save(std::ostream& out) const override { name_all(*this, Writing{out}); }
    void load(const ObservedState& m, Bytes& in) override {
        name_all(*this, Reading{in});
        if (at_start_.size() != m.scene.species.size() || before_.step > last_.step || last_.step > m.step ||
            before_.step < 0 || !(quantum_ > 0 && std::isfinite(quantum_)) || !are_sound(at_start_) ||
            !are_sound({before_.gone, last_.gone, most_}))
            in.fail();
    }

  private:
    struct Noted {
        std::int64_t step = 0;
        WideInt gone = 0;
    };
    // Members are saved one by one, because padding between them could have any bytes. Their order is that of
    // the checkpoint.
    template <class Self, class Each>
    static void name_all(Self& self, const Each& each) {
        each(self.quantum_), each(self.at_start_), each(self.most_), each(self.emptied_);
        for (auto* noted : {&self.before_, &self.last_}) each(noted->step), each(noted->gone);
    }

    MassCounts inside(const ObservedState& m) const {
        MassCounts sums(m.scene.species.size(), 0);
        for (std::size_t i = 0; i < m.grains.size(); ++i)
            if (!is_in_tray(m, i)) sums[m.grains.species[i]] += mass_count(m.grains.mass(i), quantum_);
        return sums;
    }
    MassCounts gone(const ObservedState& m) {
        const MassCounts now = inside(m), &came = fed_.of(m.fed, quantum_);
        MassCounts left = at_start_;
        for (std::size_t s = 0; s < left.size(); ++s) left[s] += came[s] - now[s];
        return left;
    }
    static bool is_in_tray(const ObservedState& m, std::size_t i) {
        return m.scene.container.tray && m.grains.place[i].position.z() < m.floor_height();
    }

    const Rows rows_;
    FedMass fed_;
    double quantum_ = 1;         // kg
    MassCounts at_start_;        // masses at the start, minus what feeds had given by then
    WideInt most_ = 0;           // largest mass that was inside at a row
    Noted before_, last_;        // at the last two rows
    double emptied_ = kUnknown;  // s
};

}  // namespace grainreel::observers
