// The observers of one run: made from the list, asked for their row of values, and saved with what they
// gather.
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "engine/measure/measures.hpp"
#include "engine/measure/observer.hpp"

namespace grainreel {

// Shows all contacts of a moment to `see`.
using ShowContacts = std::function<void(const std::function<void(const ContactView&)>& see)>;

// The observers of observer_list.hpp, in the order of their columns.
const std::vector<ObserverEntry>& all_observers();

class Observers {
  public:
    // Makes the observers of `table` that are always made, and the instruments that scene.output names.
    Observers(const std::vector<ObserverEntry>& table, const Scene& scene, const Plan& plan);

    const std::vector<std::string>& names() const { return *names_; }
    // A value for each name. Calls show_contacts once where an observer needs contacts, else not at all.
    Measures look(const ObservedState& moment, const ShowContacts& show_contacts);
    // The value of one column, which must be there. Only the observer that gives it is asked.
    double look(const ObservedState& moment, const ShowContacts& show_contacts, const std::string& column);

    // On grids, observer by observer: what they give, and the values of a moment in the same order.
    std::vector<const FieldSet*> fields() const;
    std::vector<FieldValues> look_at_fields(const ObservedState& moment, const ShowContacts& show_contacts);

    // Whether somebody needs ObservedState::wall_sums.
    bool need_wall_sums() const;
    // Starts the observers when the drive starts, or those of which load() has found nothing.
    void start(const ObservedState& moment, const ShowContacts& show_contacts);
    // The first step after `step` at which somebody gathers; Observer::kNever.
    std::int64_t gathers_after(std::int64_t step) const;
    // Calls those that gather at this step.
    void gather(const ObservedState& moment, const ShowContacts& show_contacts);

    // What they have gathered, for the checkpoint. The reading fails where save() could not have written what
    // is read. What stands there of observers that are not made is passed over.
    void save(std::ostream& out) const;
    void load(const ObservedState& moment, Bytes& in);

  private:
    struct Entry {
        std::string name;  // in the checkpoint
        std::unique_ptr<Observer> observer;
        std::vector<std::string> columns;
        bool started = false;
    };
    template <class Wanted, class Call>
    void visit(const ObservedState& moment, const ShowContacts& show_contacts, const Wanted& wanted,
               const Call& call);

    Measures::Names names_;
    std::vector<Entry> entries_;
};

}  // namespace grainreel
