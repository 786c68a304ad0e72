// Observers measure: they look at the state of a run and change nothing.
//
// An observer is a class in the folder of its subject, beside the formula that it uses (bed/bed_observers.hpp
// and others), and a name in observer_list.hpp. Besides the virtual functions below it has
//     static std::vector<ColumnGroup> columns(const Scene& scene);
// which names its columns without a state; the reader of scenes knows them from it. An observer that is made
// only where the scene asks for it (output.instruments or Scene::wishes) also has
//     static constexpr const char* instrument = "walls";
// and one that has a key of its own in the scene has
//     static bool wanted(const Scene& scene);
#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <memory>
#include <span>
#include <string>
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
    double period;           // m, of x; 0 for none
    Pose pose;               // of what the drive moves
    double start_energy;     // J, of all grains and contacts when the drive started
    const Traffic& traffic;  // what came and left since then
    std::span<const Face> faces = {};
    const WallSums* wall_sums = nullptr;  // since the drive started; null unless somebody needs them
    // The run's; null for a state that was put together by hand.
    const Surroundings* around = nullptr;
    const StepLoop* loop = nullptr;
    std::span<const std::int64_t> fed = {};  // how many grains each of the scene's feeds has given

    double floor_height() const { return pose.offset.z() + scene.container.base(); }  // m
    // Whether there is anything to segregate.
    bool has_two_kinds() const { return scene.species.size() > 1 && grains.size() > 0; }
};

class Observer {
  public:
    virtual ~Observer() = default;

    // Whether contact() is called. The contacts are visited once a moment, for all who want them.
    virtual bool needs_contacts() const { return false; }
    // Before the first contact of a moment.
    virtual void begin(const ObservedState&) {}
    virtual void contact(const ObservedState&, const ContactView&) {}
    // After the last contact: adds a value for each of its columns to `row`.
    virtual void look(const ObservedState& moment, std::vector<double>& row) = 0;

    // For an observer of fields: what they are, which stays the same for the whole run, and their values at a
    // moment. These are asked for in place of look(), after the same calls.
    virtual const FieldSet* fields() const { return nullptr; }
    virtual FieldValues look_at_fields(const ObservedState&) { return {}; }

    // The first step after `step` at which gather() is called, for an observer that gathers: every step,
    // every row, some phases. It must not depend on what was gathered, so that it does not matter where a run
    // was broken off and taken up again. gather() comes after the same calls as look(), and before it.
    static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
    virtual std::int64_t gathers_after(std::int64_t) const { return kNever; }
    // Whether ObservedState::wall_sums is there.
    virtual bool needs_wall_sums() const { return false; }
    // Called once, before all gathering: when the drive starts, or where a run goes on from a checkpoint that
    // knows nothing of this observer.
    virtual void start(const ObservedState&) {}
    virtual void gather(const ObservedState&) {}
    // Everything it has gathered, bit by bit, for the checkpoint. load() takes the place of start() and makes
    // the reading fail where save() could not have written what is read.
    virtual void save(std::ostream&) const {}
    virtual void load(const ObservedState&, Bytes&) {}
};

// What is known of an observer before it is made.
struct ObserverEntry {
    const char* instrument;              // null: it is always made, unless `wanted` says otherwise
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

// The steps at which rows of measures.csv come, for observers that gather at them.
class Rows {
  public:
    explicit Rows(const Plan& plan)
        : rhythm_(plan.measures_every, plan.measures_periods), clock_(plan.clock) {}

    // The first such step after `step`, which is at least -1.
    std::int64_t after(std::int64_t step) const { return rhythm_.next(step + 1, clock_); }

  private:
    Rhythm rhythm_;
    Clock clock_;
};

}  // namespace grainreel
