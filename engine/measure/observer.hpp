// An observer measures something in a run: it looks at the state and changes nothing.
//
// An observer is a class in the folder of its subject, beside the formulas that it uses (for example
// bed/bed_observers.hpp). Its name is listed in observer_list.hpp. Besides the virtual functions below it has
//     static std::vector<ColumnGroup> columns(const Scene& scene);
// which names its columns without a state, for the reader of scenes. An observer that is made only if the
// scene asks for it (output.instruments or Scene::wishes) also has
//     static constexpr const char* instrument = "walls";
// one that has a key of its own in the scene has
//     static bool wanted(const Scene& scene);
// and one whose columns stay empty in some scenes has
//     static std::string why_empty(const Scene& scene, const std::string& column);
// which gives the reason, or nothing where the column may have values.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/base/clock.hpp"
#include "engine/measure/measures.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/times.hpp"
#include "engine/scene/output.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/traffic.hpp"
#include "engine/step/contact_view.hpp"
#include "engine/step/geometry/wall_sums.hpp"

namespace grainreel {

struct Surroundings;
class StepLoop;

// The state that an observer may look at.
struct ObservedState {
    const Scene& scene;
    const Clock& clock;
    const Grains& grains;
    std::int64_t step;
    Vec3 gravity;            // m/s2
    double period;           // m, period of x; 0 if x is not periodic
    DrivePose pose;          // pose of what the drive moves
    double start_energy;     // J, of all grains and contacts when the drive started
    const Traffic& traffic;  // grains that came and left since the drive started
    std::span<const Face> faces = {};
    const WallSums* wall_sums = nullptr;  // since the drive started; null unless an observer needs them
    // Surroundings and step loop of the run; null for a state that was made by hand.
    const Surroundings* around = nullptr;
    const StepLoop* loop = nullptr;
    std::span<const std::int64_t> fed = {};  // number of grains that each of the scene's feeds has given
    // Grains that left when the drive started, before start() was called; only start() may look at them.
    std::span<const Departure> left_at_start = {};

    double floor_height() const { return pose.offset.z() + scene.container.base(); }  // m
    // Whether there are two species or more, and grains.
    bool has_two_kinds() const { return scene.species.size() > 1 && grains.size() > 0; }
};

class Observer {
  public:
    virtual ~Observer() = default;

    // Whether contact() is called. The contacts are visited once per moment, for all observers that need
    // them.
    virtual bool needs_contacts() const { return false; }
    // Called before the first contact of a moment.
    virtual void begin(const ObservedState&) {}
    virtual void contact(const ObservedState&, const ContactView&) {}
    // Called after the last contact. Adds one value for each column to `row`, in the order of columns().
    virtual void look(const ObservedState& moment, std::vector<double>& row) = 0;

    // For an observer of fields: fields() describes its fields and stays the same for the whole run.
    // look_at_fields() gives the values at a moment, and is called in place of look(), after the same calls.
    virtual const FieldSet* fields() const { return nullptr; }
    virtual FieldValues look_at_fields(const ObservedState&) { return {}; }

    // The first step after `step` at which gather() is called, for an observer that gathers. The result must
    // not depend on what was gathered, so that it does not matter where a run was stopped and resumed.
    // gather() comes after the same calls as look(), and before look().
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
    virtual std::int64_t gathers_after(std::int64_t) const { return kNever; }
    // Whether the observer needs ObservedState::wall_sums.
    virtual bool needs_wall_sums() const { return false; }
    // Called once, before all gathering: when the drive starts, or when a run goes on from a checkpoint
    // without data of this observer.
    virtual void start(const ObservedState&) {}
    virtual void gather(const ObservedState&) {}
    // Saves everything that was gathered, bit by bit, for the checkpoint. load() takes the place of start().
    // Reading fails for anything that save() cannot have written.
    virtual void save(std::ostream&) const {}
    virtual void load(const ObservedState&, Bytes&) {}
};

// Facts about an observer before it is made.
struct ObserverEntry {
    const char* instrument;              // null if it is always made, unless `wanted` says otherwise
    bool (*wanted)(const Scene& scene);  // null: `instrument` decides
    std::vector<ColumnGroup> (*columns)(const Scene& scene);
    std::unique_ptr<Observer> (*make)(const Scene& scene, const Plan& plan);
};

template <class T>
ObserverEntry entry_of() {
    ObserverEntry entry{nullptr, nullptr, &T::columns, nullptr};
    if constexpr (requires { T::instrument; }) entry.instrument = T::instrument;
    if constexpr (requires { &T::wanted; }) entry.wanted = &T::wanted;
    entry.make = [](const Scene& scene, const Plan& plan) -> std::unique_ptr<Observer> {
        if constexpr (std::is_constructible_v<T, const Scene&, const Plan&>)
            return std::make_unique<T>(scene, plan);
        else
            return std::make_unique<T>();
    };
    return entry;
}

// The steps of the rows of measures.csv, for observers that gather at them.
class Rows {
  public:
    explicit Rows(const Plan& plan)
        : rhythm_(plan.measures_every, plan.measures_periods), clock_(plan.clock) {}

    // The first such step after `step`; `step` is at least -1.
    std::int64_t after(std::int64_t step) const { return rhythm_.next(step + 1, clock_); }

  private:
    Rhythm rhythm_;
    Clock clock_;
};

}  // namespace grainreel
