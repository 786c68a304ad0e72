// What has flowed out: how much of each species, how fast, and when the container was empty.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/rows.hpp"

namespace grainreel::observers {

// What has left is what there was when the drive started less what is there. That is not known by species
// once other grains come in: then all is NaN. A grain that has fallen below the floor into a tray has left.
class Outflow final : public Observer {
  public:
    static constexpr const char* instrument = "outflow";

    static std::vector<ColumnGroup> columns(const Scene& scene) {
        std::vector<ColumnGroup> groups{
            {{{"outflow_kg", "mass that flowed out", Dimension::mass}}, "kg", "since the drive started"},
            {{{"outflow_rate", "mass flow (kg/s)"}}, "kg/s", "mean mass flow since the row before"}};
        for (const Species& species : scene.species)
            groups.push_back(
                {{{column_part(species.name) + "_outflow", "share of " + species.name + " in the outflow"}},
                 "1",
                 "share of a species in the mass that has flowed out"});
        groups.push_back({{{"emptied_s", "time to empty", Dimension::time}},
                          "s",
                          "when fewer than 1 % of the mass at the start was left; NaN until then"});
        return groups;
    }

    Outflow(const Scene&, const Plan& plan) : rows_(plan) {}

    std::int64_t gathers_after(std::int64_t step) const override { return rows_.after(step); }
    void start(const Moment& m) override {
        at_start_ = masses(m);
        before_ = last_ = {m.step, 0};
    }
    void gather(const Moment& m) override {
        before_ = last_;
        last_ = {m.step, left(m)};
        if (std::isnan(emptied_) && left(m) > 0.99 * total(at_start_)) emptied_ = m.clock.time(m.step);
    }
    void look(const Moment& m, std::vector<double>& row) override {
        if (m.traffic.came > 0) return add_no_values(row, 3 + m.scene.species.size());
        const Noted& from = last_.step < m.step ? last_ : before_;
        const double gone = left(m);
        row.insert(row.end(), {gone, (gone - from.left) / m.clock.time(m.step - from.step)});
        const std::vector<double> now = masses(m);
        for (std::size_t s = 0; s < now.size(); ++s) row.push_back((at_start_[s] - now[s]) / gone);
        row.push_back(emptied_);
    }
    void save(std::ostream& out) const override {
        const Writing each{out};
        each(at_start_), each(before_), each(last_), each(emptied_);
    }
    void load(const Moment& m, Bytes& in) override {
        const Reading each{in};
        each(at_start_), each(before_), each(last_), each(emptied_);
        const auto is_mass = [](double mass) { return std::isfinite(mass) && mass >= 0; };
        if (at_start_.size() != m.scene.species.size() || before_.step > last_.step || last_.step > m.step ||
            before_.step < 0 || !std::all_of(at_start_.begin(), at_start_.end(), is_mass))
            in.fail();
    }

  private:
    struct Noted {
        std::int64_t step = 0;
        double left = 0;  // kg
    };

    // kg, of each species. Summed by mass alone, so that the order of the grains does not show.
    static std::vector<double> masses(const Moment& m) {
        std::vector<std::vector<double>> of(m.scene.species.size());
        for (std::size_t i = 0; i < m.grains.size(); ++i)
            if (!is_in_tray(m, i))
                of[static_cast<std::size_t>(m.grains.species[i])].push_back(m.grains.mass(i));
        std::vector<double> sums;
        for (std::vector<double>& all : of) {
            std::sort(all.begin(), all.end());
            sums.push_back(total(all));
        }
        return sums;
    }
    static bool is_in_tray(const Moment& m, std::size_t i) {
        return m.scene.container.tray && m.grains.place[i].position.z() < m.floor_height();
    }
    static double total(const std::vector<double>& masses) {
        return std::accumulate(masses.begin(), masses.end(), 0.0);
    }
    double left(const Moment& m) const { return total(at_start_) - total(masses(m)); }

    const Rows rows_;
    std::vector<double> at_start_;  // kg, by species
    Noted before_, last_;           // at the last two rows
    double emptied_ = kNoValue;     // s
};

}  // namespace grainreel::observers
