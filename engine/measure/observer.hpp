// What measures: an observer sees the state and changes nothing.
//
// An observer is a class in a file of engine/measure/observers, and a name in observer_list.hpp. Besides what
// is virtual here it has
//     static std::vector<ColumnGroup> columns(const std::vector<std::string>& species);
// which says what it gives, without a state: the scene's reader knows columns from it. `species` are names.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/scene/film/measure_columns.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/drive_pose.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/contact_view.hpp"
#include "engine/step/traffic.hpp"

namespace grainreel {

// The state that an observer may look at.
struct Moment {
    const Scene& scene;
    const Clock& clock;
    const Grains& grains;
    std::int64_t step;
    Vec3 gravity;            // m/s2
    double period;           // m, of x; 0 for none
    Pose pose;               // of what the drive moves
    double start_energy;     // J, of all grains and contacts when the drive started
    const Traffic& traffic;  // what came and left since then

    double floor_height() const { return pose.offset.z(); }  // m
    // Whether there is anything to segregate.
    bool has_two_kinds() const { return scene.species.size() > 1 && grains.size() > 0; }
};

class Observer {
  public:
    virtual ~Observer() = default;

    // Whether contact() is called. The contacts are visited once a moment, for all who want them.
    virtual bool needs_contacts() const { return false; }
    // Before the first contact of a moment.
    virtual void begin(const Moment&) {}
    virtual void contact(const Moment&, const ContactView&) {}
    // After the last contact: adds a value for each of its columns to `row`.
    virtual void look(const Moment& moment, std::vector<double>& row) = 0;
};

// What is known of an observer before one is made.
struct ObserverEntry {
    std::vector<ColumnGroup> (*columns)(const std::vector<std::string>& species);
    std::unique_ptr<Observer> (*make)();
};

template <class T>
ObserverEntry entry_of() {
    return {&T::columns, []() -> std::unique_ptr<Observer> { return std::make_unique<T>(); }};
}

}  // namespace grainreel
