// A single large grain: how high it is in the bed, and when it came up.
#pragma once

#include <cmath>
#include <optional>

#include "engine/measure/bed/intruder.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/observer.hpp"
#include "engine/measure/rows.hpp"

namespace grainreel::observers {

class Intruder final : public Observer {
  public:
    static constexpr const char* instrument = "intruder";

    static std::vector<ColumnGroup> columns(const Scene&) {
        return {
            {{{"intruder_level", "level of the intruder"}},
             "1",
             "of the one grain of the largest species: its top over the bed's surface around it, both above "
             "the floor; 1 when it comes to the surface"},
            {{{"rise_time_s", "rise time", Dimension::time}},
             "s",
             "when `intruder_level` first reached 1; NaN until then"}};
    }
    Intruder(const Scene&, const Plan& plan) : rows_(plan) {}

    std::int64_t gathers_after(std::int64_t step) const override { return rows_.after(step); }
    void start(const Moment& m) override { gather(m); }
    void gather(const Moment& m) override {
        if (std::isnan(rise_time_) && height_at(m) >= 1) rise_time_ = m.clock.time(m.step);
    }
    void look(const Moment& m, std::vector<double>& row) override {
        row.insert(row.end(), {height_at(m), rise_time_});
    }
    void save(std::ostream& out) const override { write_value(out, rise_time_); }
    void load(const Moment& m, Bytes& in) override {
        read_value(in, rise_time_);
        if (rise_time_ < 0 || rise_time_ > m.clock.time(m.step)) in.fail();
    }

  private:
    static double height_at(const Moment& m) {
        const std::optional<std::size_t> intruder = find_intruder(m.scene, m.grains);
        return intruder ? intruder_height(m.scene, m.grains, *intruder, m.floor_height()) : kNoValue;
    }

    const Rows rows_;
    double rise_time_ = kNoValue;  // s
};

}  // namespace grainreel::observers
