// Frames and measures with made-up numbers: no two fields have the same, and all need every digit of a
// double.
#pragma once

#include <cmath>

#include "engine/measure/columns.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/observers.hpp"
#include "engine/state/state.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel::test {

inline Vec3 vector_of(double seed) {
    return {std::sin(seed), std::cos(3 * seed) * 1e-9, -std::exp(seed / 7)};
}

inline State made_frame(int grains, int number, bool orientation = false) {
    State f;
    f.step = (std::int64_t{1} << 40) + number;  // more than 32 bits
    f.time = number / 3.0;
    f.cycles = number / 7.0;
    f.phase = f.cycles - std::floor(f.cycles);
    f.container().place = vector_of(number + 0.1);
    f.container().velocity = vector_of(number + 0.2);
    f.floor().place = vector_of(number + 0.3);
    f.floor().velocity = vector_of(number + 0.4);
    for (int i = 0; i < grains; ++i) {
        f.id.push_back(2 * i + 1);  // ids need not be dense
        f.species.push_back(i % 3);
        f.radius.push_back(0.0025 + i / 3e5);
        f.position.push_back(vector_of(number + i / 11.0));
        f.velocity.push_back(vector_of(number + i / 13.0));
        f.spin.push_back(vector_of(number + i / 17.0));
        if (orientation) f.orientation.push_back(Quaternion(i + 1.0, 2, number, -1).normalized());
    }
    return f;
}

// A row of measures.csv. number: its step.
inline Measures made_measures(int number, const std::vector<std::string>& species) {
    std::vector<std::string> names;
    std::vector<double> values;
    FilmedScene scene;
    for (const std::string& name : species) scene.species.emplace_back().name = name;
    for (const ObserverEntry& observer : all_observers()) {
        if (observer.instrument != nullptr || observer.wanted != nullptr) continue;
        for (const ColumnGroup& group : observer.columns(scene))
            for (const MeasureColumn& column : group.columns) {
                values.push_back(std::sin(number + static_cast<double>(names.size())) * 1e-7);
                names.push_back(column.name);
            }
    }
    Measures measures(std::make_shared<const std::vector<std::string>>(names), values);
    measures.set("step", number);
    return measures;
}

}  // namespace grainreel::test
